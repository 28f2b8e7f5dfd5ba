// SPDX-License-Identifier: Apache-2.0
#include "cli/replay/stamps.hpp"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "base/text.hpp"
#include "reports/text_tools.hpp"

namespace conform::cli {
namespace {

/// Frames that are fetched from the controller together are stamped this close, and in any order.
constexpr Duration overtaking = std::chrono::milliseconds(1);

constexpr Duration longest = Duration::max();

/// `later` - `earlier`, as far as that can be told.
Duration between(BusTime earlier, BusTime later) {
  const auto from = earlier.time_since_epoch(), to = later.time_since_epoch();
  if (from < Duration(0) && to > longest + from) return longest;
  if (from > Duration(0) && to < -longest + from) return -longest;
  return to - from;
}

/// `time` is not before the origin, and neither is the result.
BusTime advanced(BusTime time, Duration by) {
  const auto from = time.time_since_epoch();
  if (by > longest - from) return BusTime(longest);
  return BusTime(std::max(from + by, Duration(0)));
}

std::string stamp_text(BusTime time) {
  constexpr Duration::rep second = 1'000'000'000;
  const auto count = time.time_since_epoch().count();
  const auto whole = count / second, rest = count % second;
  return fmt::format("{}{}.{:06} s", count < 0 ? "-" : "", whole < 0 ? -whole : whole,
                     (rest < 0 ? -rest : rest) / 1000);
}

/// Capture indices of all that a replay waits for, in its order, and of both ends.
std::vector<std::size_t> moments_of(const Side& side) {
  const auto& dialogue = side.dialogue;
  std::vector<std::size_t> out{side.first};
  auto power = dialogue.power.begin();
  for (const auto& turn : dialogue.turns) {
    const auto& sent = dialogue.sent[turn.sent];
    const auto index = turn.answer ? sent.answers[*turn.answer] : sent.index;
    for (; power != dialogue.power.end() && *power <= index; ++power) out.push_back(*power);
    out.push_back(index);
  }
  out.insert(out.end(), power, dialogue.power.end());
  out.push_back(side.end - 1);
  return out;
}

}  // namespace

SteadyTimes::SteadyTimes(std::span<const can::CapturedFrame> frames, std::size_t first, std::size_t end)
    : first_(first) {
  times_.reserve(end - first);
  BusTime now{};
  for (auto i = first; i < end; ++i) {
    auto gap = i == first ? Duration(0) : between(frames[i - 1].time, frames[i].time);
    if (gap < -overtaking) {
      set_back_.push_back(i);
      gap = Duration(0);
    }
    now = advanced(now, gap);
    times_.push_back(now);
  }
}

Result<void> gaps_are_bounded(const Side& then) {
  const SteadyTimes times(then.frames, then.first, then.end);
  const auto moments = moments_of(then);
  for (std::size_t i = 1; i < moments.size(); ++i) {
    const auto before = moments[i - 1], after = moments[i];
    if (times.at(after) - times.at(before) <= longest_gap) continue;
    return fail(
        fmt::format("frame {} (at {}) comes more than {} behind frame {} (at {}), and a replay does not wait "
                    "for that",
                    after + 1, stamp_text(then.at(after).time), to_string(longest_gap), before + 1,
                    stamp_text(then.at(before).time)),
        {}, "--frames FIRST-LAST takes the frames on one side of the gap; nothing was sent");
  }
  return {};
}

std::string set_back_note(const Side& then) {
  const SteadyTimes times(then.frames, then.first, then.end);
  if (times.set_back().empty()) return {};
  const auto index = times.set_back().front();
  const auto more = times.set_back().size() - 1;
  return fmt::format(
      "the stamps run back at frame {}, by {}{}: no time counts there, and frames follow each other at once",
      index + 1, to_string(between(then.at(index).time, then.at(index - 1).time)),
      more == 0 ? std::string() : fmt::format(", and at {} more", reports::counted(more, "frame")));
}

}  // namespace conform::cli
