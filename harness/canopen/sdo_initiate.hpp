// SPDX-License-Identifier: Apache-2.0
// SDO initiate and abort messages (CiA 301, 7.2.4.3.3, 7.2.4.3.5, 7.2.4.3.17): eight bytes, the command in
// byte 0, the multiplexer in bytes 1-3 (index little endian, sub-index), data or size in bytes 4-7.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/bytes.hpp"
#include "base/strong.hpp"

namespace conform::canopen {

using SdoBytes = std::array<std::uint8_t, 8>;

/// Index and sub-index of bytes 1-3; `bytes` has at least four.
[[nodiscard]] Multiplexer sdo_multiplexer(ByteView bytes);
/// Whether a request with this command byte begins a transfer (7.2.4.3.3 to 7.2.4.3.16).
[[nodiscard]] bool begins_transfer(std::uint8_t command);
/// Whether a server command of this byte answers such a request and leaves the transfer open: 60, 4x without
/// e, Ax with ss = 0, Cx with ss = 0 (7.2.4.3.3 to 7.2.4.3.15).
[[nodiscard]] bool has_begun_transfer(std::uint8_t command);

/// 40 m m m 00 00 00 00
[[nodiscard]] SdoBytes encode_upload_request(Multiplexer mux);
/// Expedited download of 1..4 bytes: 2F/2B/27/23 with the size, 22 without.
[[nodiscard]] SdoBytes encode_download_expedited(Multiplexer mux, ByteView data, bool size_indicated = true);
/// Segmented download: 21 and the size in bytes 4-7, or 20 without size.
[[nodiscard]] SdoBytes encode_download_segmented(Multiplexer mux, std::optional<std::uint32_t> size);
/// 80 m m m and the code.
[[nodiscard]] SdoBytes encode_abort(Multiplexer mux, AbortCode code);

/// Server to client: 0100 n n e s (40, 41, 42, 43, 47, 4B, 4F); client to server the same with 001x.
struct Initiate {
  Multiplexer mux;
  bool expedited = false;       ///< e
  bool size_indicated = false;  ///< s
  std::uint8_t unused = 0;      ///< n: bytes 4-7 without data, meaningful when e and s
  bool reserved_bit = false;    ///< bit 4
  std::uint32_t value = 0;      ///< bytes 4-7: data or size

  /// Number of data bytes of an expedited transfer (4 when the size is not indicated).
  [[nodiscard]] std::size_t expedited_size() const {
    return size_indicated ? std::size_t{4} - unused : std::size_t{4};
  }
};

struct Abort {
  Multiplexer mux;
  AbortCode code;
  bool reserved_bits = false;  ///< bits 0-4 of the command are not zero
};

/// Upload initiate response (scs 2); nullopt when shorter than eight bytes or another command.
[[nodiscard]] std::optional<Initiate> decode_upload_response(ByteView bytes);
/// Download initiate request (ccs 1), for listeners.
[[nodiscard]] std::optional<Initiate> decode_download_request(ByteView bytes);
/// Abort in either direction (cs 4).
[[nodiscard]] std::optional<Abort> decode_abort(ByteView bytes);

}  // namespace conform::canopen
