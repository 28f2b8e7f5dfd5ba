// SPDX-License-Identifier: Apache-2.0
#include "explore/coverage.hpp"

#include <algorithm>

#include "canopen/cob_id.hpp"

namespace conform::explore {
namespace {

/// Each is a bit of the state.
enum class Timer : std::uint8_t { heartbeat, guarding, consumer, sync, event, inhibit, transfer };
enum class Service : std::uint8_t { sync_producer, emcy_off, rpdo, tpdo, mapping, more_sdo, lss, history };

/// What an action speaks to.
enum class Spoken : std::uint8_t { upload, download, request, nmt, sync, guard, pdo, lss, other, time };

template <typename Bit>
void set(std::uint64_t& bits, Bit bit, bool on) {
  const auto mask = std::uint64_t{1} << static_cast<unsigned>(bit);
  bits = on ? bits | mask : bits & ~mask;
}

Spoken spoken_to(const Action& action, NodeId node) {
  switch (action.kind) {
    case Action::Kind::upload: return Spoken::upload;
    case Action::Kind::download: return Spoken::download;
    case Action::Kind::request: return Spoken::request;
    case Action::Kind::power: return Spoken::nmt;
    case Action::Kind::wait: return Spoken::time;
    case Action::Kind::frame: break;
  }
  const auto& frame = action.frame;
  if (frame.extended) return Spoken::other;
  if (frame.id == canopen::nmt_can_id.value()) return Spoken::nmt;
  if (frame.id == canopen::sync_can_id.value()) return Spoken::sync;
  if (frame.id == canopen::lss_request_can_id.value()) return Spoken::lss;
  if (frame.id == 0x700U + node.value()) return Spoken::guard;
  return frame.id > 0x180 && frame.id < 0x580 ? Spoken::pdo : Spoken::other;
}

/// Abort codes by their class, all else by its kind.
unsigned outcome_of(const Answer& answer) {
  if (answer.kind != Answer::Kind::aborted) return static_cast<unsigned>(answer.kind);
  return 8U + (answer.code.value() >> 24U & 7U);
}

class Sketch {
 public:
  explicit Sketch(NodeId node) : node_(node) {}

  std::uint64_t note(const Action& action, const Answer& answer) {
    if (action.kind == Action::Kind::power) start();
    if (const auto command = action.nmt_command(node_); command != 0) obey(command);
    if (action.is_transfer() && !action.fault.empty())
      set(timers_, Timer::transfer, action.fault.starts_with("silence") || action.fault == "no end");
    if (action.kind == Action::Kind::download && answer.kind == Answer::Kind::confirmed) written(action);
    const auto spoken = spoken_to(action, node_);
    if (spoken == Spoken::lss && action.frame.data[0] == 0x04)
      set(services_, Service::lss, action.frame.data[1] == 1);
    if (spoken == Spoken::guard && action.frame.remote) set(timers_, Timer::guarding, true);
    return nmt_ | timers_ << 8U | services_ << 16U | static_cast<std::uint64_t>(spoken) << 24U |
           std::uint64_t{outcome_of(answer)} << 28U;
  }

 private:
  /// With the values of power-on, or with what was stored, which only the device knows.
  void start() {
    nmt_ = 0x80;
    timers_ = services_ = 0;
  }

  void obey(std::uint8_t command) {
    if (command == 0x81 || command == 0x82) return start();
    if (command == 1 || command == 2 || command == 0x80) nmt_ = command;
  }

  void written(const Action& action) {
    const auto index = action.object.index.value();
    const auto sub = action.object.sub.value();
    const auto value = load_le(ByteView(action.data).first(std::min<std::size_t>(action.data.size(), 8)));
    if (index == 0x1017) return set(timers_, Timer::heartbeat, value != 0);
    if (index == 0x100C || index == 0x100D) return set(timers_, Timer::guarding, value != 0);
    if (index == 0x1016) return set(timers_, Timer::consumer, (value & 0xFFFFU) != 0);
    if (index == 0x1006) return set(timers_, Timer::sync, value != 0);
    if (index == 0x1015) return set(timers_, Timer::inhibit, value != 0);
    if (index == 0x1005) return set(services_, Service::sync_producer, (value & canopen::cob_id::bit30) != 0);
    if (index == 0x1014) return set(services_, Service::emcy_off, (value & canopen::cob_id::bit31) != 0);
    if (index == 0x1003) return set(services_, Service::history, true);
    if (index >= 0x1200 && index <= 0x12FF) return set(services_, Service::more_sdo, true);
    if (index >= 0x1400 && index <= 0x15FF) return set(services_, Service::rpdo, true);
    if (index >= 0x1600 && index <= 0x17FF) return set(services_, Service::mapping, true);
    if (index >= 0x1A00 && index <= 0x1BFF) return set(services_, Service::mapping, true);
    if (index < 0x1800 || index > 0x19FF) return;
    if (sub == 3) return set(timers_, Timer::inhibit, value != 0);
    if (sub == 5) return set(timers_, Timer::event, value != 0);
    set(services_, Service::tpdo, true);
  }

  NodeId node_;
  std::uint64_t nmt_ = 0x80, timers_ = 0, services_ = 0;
};

}  // namespace

std::vector<std::uint64_t> states_of(std::span<const Action> conversation, std::span<const Answer> answers,
                                     NodeId node) {
  Sketch sketch(node);
  std::vector<std::uint64_t> out;
  out.reserve(answers.size());
  for (std::size_t i = 0; i < std::min(conversation.size(), answers.size()); ++i)
    out.push_back(sketch.note(conversation[i], answers[i]));
  return out;
}

}  // namespace conform::explore
