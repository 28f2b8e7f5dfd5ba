// SPDX-License-Identifier: Apache-2.0
// What a difference is called: for the tests of the tables.
#pragma once

#include <string>
#include <utility>

#include "explore/assign.hpp"
#include "explore/tests/device.hpp"

namespace conform::explore {

inline Answer confirmed(Bytes data = {}) {
  Answer out;
  out.kind = Answer::Kind::confirmed;
  out.data = std::move(data);
  return out;
}
inline Answer aborted(AbortCode code) {
  Answer out;
  out.kind = Answer::Kind::aborted;
  out.code = code;
  return out;
}
inline Answer silent() {
  Answer out;
  out.kind = Answer::Kind::silence;
  return out;
}

/// The last action of `talk` was answered by the device and by the model like this.
inline std::optional<Assigned> judged(const Conversation& talk, const Answer& device, const Answer& model) {
  const auto words = words_of_the_standard();
  Played played;
  played.difference.emplace();
  played.difference->action = talk.size() - 1;
  played.difference->device = device;
  played.difference->model = model;
  played.answers.assign(talk.size(), confirmed());
  played.due.assign(talk.size(), confirmed());
  return assign({words, talk, played});
}

/// In `talk` this came, and with the model that; before it the device has sent `trace`.
inline std::optional<Assigned> judged_frames(const Conversation& talk, Difference::What what,
                                             const can::Frame& came, const can::Frame& due,
                                             std::vector<can::Frame> trace = {}) {
  const auto words = words_of_the_standard();
  Played played;
  played.difference.emplace();
  played.difference->what = what;
  played.difference->action = talk.size() - 1;
  played.difference->came = came;
  played.difference->due = due;
  played.difference->time = BusTime(std::chrono::seconds(1));
  for (auto& each : trace) {
    can::CapturedFrame captured;
    captured.frame = each;
    played.trace.push_back(captured);
  }
  return assign({words, talk, played});
}

inline std::string text_of(const std::optional<Assigned>& assigned) {
  if (!assigned) return "";
  constexpr const char* words[] = {" violated", " tolerated", " allowed"};
  return assigned->requirement + words[static_cast<std::size_t>(assigned->grade)];
}

}  // namespace conform::explore
