// SPDX-License-Identifier: Apache-2.0
// What a fuzz target reads its decisions from: the bytes of the input one after the other, then zeros.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/bytes.hpp"

namespace conform::fuzz {

class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : left_(data, size) {}

  [[nodiscard]] bool empty() const { return left_.empty(); }
  [[nodiscard]] std::size_t left() const { return left_.size(); }
  [[nodiscard]] std::uint8_t u8() { return static_cast<std::uint8_t>(number(1)); }
  [[nodiscard]] std::uint16_t u16() { return static_cast<std::uint16_t>(number(2)); }
  [[nodiscard]] std::uint32_t u32() { return static_cast<std::uint32_t>(number(4)); }
  /// At most `most` bytes, fewer at the end of the input.
  [[nodiscard]] ByteView take(std::size_t most) {
    const auto part = left_.first(std::min(most, left_.size()));
    left_ = left_.subspan(part.size());
    return part;
  }

 private:
  [[nodiscard]] std::uint64_t number(std::size_t size) { return load_le(take(size)); }

  ByteView left_;
};

}  // namespace conform::fuzz
