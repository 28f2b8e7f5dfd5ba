// SPDX-License-Identifier: Apache-2.0
// Captures written frame by frame, for the tests of replay.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>

#include "can/capture_marks.hpp"
#include "catch.hpp"
#include "cli/replay/differences.hpp"

namespace conform::cli::testing {

using can::CasePart;
using can::Direction;
using namespace std::chrono_literals;

inline const NodeId node{5};

/// A capture, written frame by frame.
struct Trace {
  can::Capture capture;
  BusTime time{};

  Trace& add(Direction direction, std::uint32_t id, std::initializer_list<std::uint8_t> bytes,
             std::string comment = {}, Duration gap = 1ms) {
    time += gap;
    capture.add({.frame = can::data_frame(CanId(id), bytes),
                 .time = time,
                 .direction = direction,
                 .comment = std::move(comment)});
    return *this;
  }
  Trace& ask(std::uint8_t sub, std::string comment = {}) {
    return add(Direction::transmitted, 0x605, {0x40, 0x18, 0x10, sub, 0, 0, 0, 0}, std::move(comment));
  }
  Trace& answer(std::uint8_t sub, std::uint8_t value) {
    return add(Direction::received, 0x585, {0x43, 0x18, 0x10, sub, value, 0, 0, 0});
  }
  Trace& heartbeat(std::uint8_t state, Duration gap = 1ms) {
    return add(Direction::received, 0x705, {state}, {}, gap);
  }
  [[nodiscard]] Side side() const { return {capture.frames(), 0, capture.size(), node}; }
};

inline std::string mark(const std::string& name, CasePart part, std::size_t number = 0) {
  return can::to_comment({.name = name, .part = part, .number = number});
}

inline ReplayComparison compared(const Trace& then, const Trace& now) {
  const auto out = compare_replay(then.side(), now.side(), node);
  INFO((out ? std::string() : out.error().text()));
  REQUIRE(out.has_value());
  return *out;
}

}  // namespace conform::cli::testing
