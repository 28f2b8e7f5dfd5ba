// SPDX-License-Identifier: Apache-2.0
#include "cli/replay/block_answer.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "canopen/sdo_initiate.hpp"

namespace conform::cli {
namespace {

/// What the server of a block download says of the segments that it takes.
enum class BlockAnswer : std::uint8_t { none, offer, acknowledge };
BlockAnswer block_answer(const can::Frame& answer) {
  if (answer.size() < 8) return BlockAnswer::none;
  switch (answer.data[0] & 0xE3U) {
    case 0xA0: return BlockAnswer::offer;
    case 0xA2: return BlockAnswer::acknowledge;
    default: return BlockAnswer::none;
  }
}

}  // namespace

bool is_abort(const can::Frame& frame) { return frame.size() == 8 && frame.data[0] == 0x80; }

bool begins_anew(const can::Frame& frame) {
  const auto command = frame.data[0];
  return canopen::begins_transfer(command) || command >> 5U == 4;
}

std::string why_out_of_step(const can::Frame& then, const can::Frame& now, bool segments) {
  const auto was = block_answer(then), is = block_answer(now);
  if (is_abort(now) || (was == BlockAnswer::none && !segments)) return {};
  if (is != was) return "the device answers with another command than then";
  if (is == BlockAnswer::offer && then.data[4] != now.data[4])
    return fmt::format("the device takes {} segments per block, and took {} then", now.data[4], then.data[4]);
  if (is != BlockAnswer::acknowledge) return {};
  if (then.data[1] != now.data[1])
    return fmt::format("the device acknowledges segment {}, and acknowledged {} then", now.data[1],
                       then.data[1]);
  if (segments && then.data[2] != now.data[2])
    return fmt::format("the device takes {} segments in the next block, and took {} then", now.data[2],
                       then.data[2]);
  return {};
}

}  // namespace conform::cli
