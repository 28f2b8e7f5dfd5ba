// SPDX-License-Identifier: Apache-2.0
// Emergency messages (CiA 301, 7.2.7): error code, error register, five manufacturer-specific bytes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/bytes.hpp"

namespace conform::canopen {

struct Emcy {
  std::uint16_t code = 0;           ///< 0000h: error reset or no error
  std::uint8_t error_register = 0;  ///< object 1001h
  std::array<std::uint8_t, 5> manufacturer{};
  friend bool operator==(const Emcy&, const Emcy&) = default;
};

/// Exactly eight bytes, else nullopt.
[[nodiscard]] std::optional<Emcy> decode_emcy(ByteView bytes);
[[nodiscard]] std::array<std::uint8_t, 8> encode(const Emcy& emcy);
/// The class (tables 26 and 27) in a few words, the most specific one known: "heartbeat or life guarding",
/// "voltage", "device specific"; "" when reserved.
[[nodiscard]] std::string_view emcy_class(std::uint16_t code);
/// "8130h (heartbeat or life guarding)"
[[nodiscard]] std::string describe_emcy_code(std::uint16_t code);

}  // namespace conform::canopen
