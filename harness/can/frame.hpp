// SPDX-License-Identifier: Apache-2.0
// A classical CAN frame as it is on the wire, legal or not.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>

#include "base/bytes.hpp"
#include "base/strong.hpp"

namespace conform::can {

/// One data, remote or error frame. Nothing is normalised: what the kernel lets through can be held and sent.
struct Frame {
  std::uint32_t id = 0;   ///< 11 or 29 bits; for error frames the SocketCAN error class bits
  bool extended = false;  ///< 29-bit identifier
  bool remote = false;    ///< RTR; `dlc` is then the length asked for and `data` is meaningless
  bool error = false;     ///< SocketCAN error frame, made by the controller and never on the wire
  std::uint8_t dlc = 0;   ///< data length code 0..15; 9..15 mean eight bytes on the wire (ISO 11898-1)
  std::array<std::uint8_t, 8> data{};

  /// Number of data bytes that count: min(dlc, 8), 0 for remote frames.
  [[nodiscard]] constexpr std::uint8_t size() const {
    return remote ? std::uint8_t{0} : std::min<std::uint8_t>(dlc, 8);
  }
  [[nodiscard]] ByteView bytes() const { return ByteView(data).first(size()); }
  /// A data frame with this 11-bit identifier (not remote, not extended, not an error frame).
  [[nodiscard]] constexpr bool is_data(CanId can_id) const {
    return !remote && !error && !extended && id == can_id.value();
  }
  friend constexpr bool operator==(const Frame&, const Frame&) = default;
};

/// An 11-bit data frame; at most eight bytes.
[[nodiscard]] Frame data_frame(CanId id, ByteView bytes);
[[nodiscard]] inline Frame data_frame(CanId id, std::initializer_list<std::uint8_t> bytes) {
  return data_frame(id, ByteView(bytes.begin(), bytes.size()));
}
/// An 11-bit remote frame asking for `dlc` bytes.
[[nodiscard]] Frame remote_frame(CanId id, std::uint8_t dlc);

}  // namespace conform::can
