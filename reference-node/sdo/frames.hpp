// SPDX-License-Identifier: Apache-2.0
// The eight bytes of an SDO frame and what one request leads to.
#pragma once

#include <array>
#include <cstdint>
#include <expected>
#include <optional>

#include "base/strong.hpp"
#include "dictionary/object_dictionary.hpp"

namespace refnode {

using SdoData = std::array<std::uint8_t, 8>;

/// The response, nothing, or the code of an abort that ends the transfer.
using SdoReply = std::expected<std::optional<SdoData>, AbortCode>;

/// Bytes 1-3 of an initiate or abort: index, least significant byte first, and sub-index.
[[nodiscard]] inline Multiplexer mux_of(const SdoData& frame) {
  return {conform::Index(static_cast<std::uint16_t>(frame[1] | (frame[2] << 8))),
          conform::SubIndex(frame[3])};
}

[[nodiscard]] inline SdoData with_mux(std::uint8_t command, Multiplexer mux) {
  return {command,
          static_cast<std::uint8_t>(mux.index.value() & 0xFFU),
          static_cast<std::uint8_t>(mux.index.value() >> 8U),
          mux.sub.value(),
          0,
          0,
          0,
          0};
}

/// Bytes 4-7 as a number.
[[nodiscard]] inline std::size_t size_field(const SdoData& frame) {
  return static_cast<std::size_t>(conform::load_le(ByteView(frame).subspan(4)));
}
inline void put_size(SdoData& frame, std::size_t size) {
  conform::store_le(std::span(frame).subspan(4), size);
}

}  // namespace refnode
