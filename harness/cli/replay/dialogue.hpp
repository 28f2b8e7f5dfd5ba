// SPDX-License-Identifier: Apache-2.0
// A part of a capture as a dialogue: what the harness sent, what of the rest answers it, and what came
// unasked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/strong.hpp"
#include "can/capture.hpp"
#include "cli/replay/section.hpp"

namespace conform::cli {

/// What a frame of the harness is answered with, if anything.
struct AnswerKind {
  enum class Of : std::uint8_t { sdo, lss, remote, reset };
  Of of = Of::sdo;
  std::uint32_t id = 0;  ///< CAN-ID of the answer
  friend bool operator==(const AnswerKind&, const AnswerKind&) = default;
};
/// SDO requests on 600h + n, remote frames, LSS requests, and NMT resets of `node` (boot-up); nullopt:
/// others.
[[nodiscard]] std::optional<AnswerKind> answer_of(const can::Frame& sent, NodeId node);
/// Whether a frame that was received can be such an answer.
[[nodiscard]] bool is_answer(const can::Frame& received, const AnswerKind& kind);

/// A frame of the harness.
struct Sent {
  std::size_t index = 0;             ///< in the capture
  std::vector<std::size_t> answers;  ///< capture indices, in their order
};

/// One thing after the other: a frame of the harness, or an answer to one.
struct Turn {
  std::size_t sent = 0;                 ///< index into Dialogue::sent
  std::optional<std::size_t> answer{};  ///< index into Sent::answers; absent: it was sent
};

struct Dialogue {
  std::vector<Sent> sent;
  std::vector<Turn> turns;           ///< in the order of the capture
  std::vector<std::size_t> unasked;  ///< capture indices of frames that answer nothing
  std::vector<std::size_t> power;    ///< capture indices of frames before which the power was switched
};

/// Frames of the device's SDO server belong to the latest request on their channel, boot-ups to the latest
/// reset that has none yet, and so on. Error frames are left out.
[[nodiscard]] Dialogue dialogue_of(std::span<const can::CapturedFrame> frames, std::size_t first,
                                   std::size_t end, NodeId node);

}  // namespace conform::cli
