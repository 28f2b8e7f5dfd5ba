// SPDX-License-Identifier: Apache-2.0
// What a device answered then and answers now, exchange by exchange.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "can/capture.hpp"
#include "canopen/frame_fields.hpp"
#include "cli/replay/dialogue.hpp"

namespace conform::cli {

/// A part of a capture with what its frames mean.
struct Side {
  /// `meanings` are found by listening from the first frame of the part on.
  Side(std::span<const can::CapturedFrame> frames, std::size_t first, std::size_t end, NodeId node);

  std::span<const can::CapturedFrame> frames;
  std::size_t first = 0, end = 0;
  Dialogue dialogue;

  [[nodiscard]] const can::CapturedFrame& at(std::size_t index) const { return frames[index]; }
  [[nodiscard]] const std::string& meaning(std::size_t index) const { return meanings_[index - first]; }
  [[nodiscard]] bool is_block_segment(std::size_t index) const {
    return at(index).direction == can::Direction::transmitted &&
           meaning(index).starts_with("SDO block segment");
  }

 private:
  std::vector<std::string> meanings_;
};

/// The n-th answer to a frame, then and now.
struct ComparedAnswer {
  std::optional<std::size_t> then, now;  ///< capture indices; absent: there was none
  bool differs = false;
  std::string not_compared{};  ///< why the contents are not: "1013h counts time"
  std::vector<canopen::FieldDifference> fields{};
};

struct Exchange {
  std::size_t then = 0;            ///< capture index of the frame that was sent
  std::optional<std::size_t> now;  ///< absent: it was not sent, since its transfer was over
  std::vector<ComparedAnswer> answers;
  [[nodiscard]] bool differs() const;  ///< also where nothing could be sent
};

/// Frames of one kind that nobody asked for.
struct Unasked {
  std::string kind;               ///< "heartbeat of node 5", "TPDO 1", "CAN-ID 2A0h"
  std::size_t then = 0, now = 0;  ///< how many
  std::vector<std::string> differences;
  std::string not_compared;  ///< what of them legally differs
};

struct ReplayComparison {
  std::vector<Exchange> exchanges;
  std::vector<Unasked> unasked;  ///< in the order in which the kinds came first
  [[nodiscard]] std::size_t exchanges_that_differ() const;
  [[nodiscard]] std::size_t unasked_that_differ() const;
  [[nodiscard]] bool differs() const { return exchanges_that_differ() + unasked_that_differ() > 0; }
  /// Whether the device was heard at all: silence then and silence now are the same of any device, also of
  /// one that is not there.
  [[nodiscard]] bool compares_something() const;
};

/// `now` holds the replay of `then`, but for what was `skipped` (indices into Dialogue::sent, ascending), and
/// with `aborts` (capture indices, ascending) that nobody sent then; what comes behind one on its channel is
/// compared with nothing. Answers are compared by their bytes; of what comes unasked the number, how often it
/// comes and, where its content is no measured value, what it says. When exactly it comes is not compared,
/// nor with which toggle bit guarding goes on from what was before. Error: the replay is not whole, the host
/// lost frames that it sent itself.
[[nodiscard]] Result<ReplayComparison> compare_replay(const Side& then, const Side& now, NodeId node,
                                                      const std::vector<std::size_t>& skipped = {},
                                                      const std::vector<std::size_t>& aborts = {});

}  // namespace conform::cli
