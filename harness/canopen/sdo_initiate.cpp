// SPDX-License-Identifier: Apache-2.0
#include "canopen/sdo_initiate.hpp"

#include <algorithm>

#include "base/check.hpp"

namespace conform::canopen {
namespace {

SdoBytes message(std::uint8_t command, Multiplexer mux) {
  SdoBytes bytes{};
  bytes[0] = command;
  store_le(std::span(bytes).subspan(1, 2), mux.index.value());
  bytes[3] = mux.sub.value();
  return bytes;
}

/// 7..5 command specifier, 4 reserved, 3..2 n, 1 e, 0 s.
std::optional<Initiate> decode_initiate(ByteView bytes, std::uint8_t specifier) {
  if (bytes.size() < 8 || bytes[0] >> 5U != specifier) return std::nullopt;
  Initiate out;
  out.mux = sdo_multiplexer(bytes);
  out.size_indicated = (bytes[0] & 0x01U) != 0;
  out.expedited = (bytes[0] & 0x02U) != 0;
  out.unused = bytes[0] >> 2U & 0x03U;
  out.reserved_bit = (bytes[0] & 0x10U) != 0;
  out.value = static_cast<std::uint32_t>(load_le(bytes.subspan(4, 4)));
  return out;
}

}  // namespace

Multiplexer sdo_multiplexer(ByteView bytes) {
  CONFORM_CHECK(bytes.size() >= 4);
  return {Index{static_cast<std::uint16_t>(load_le(bytes.subspan(1, 2)))}, SubIndex{bytes[3]}};
}

bool begins_transfer(std::uint8_t command) {
  switch (command >> 5U) {
    case 1:
    case 2: return true;
    case 5: return (command & 0x03U) == 0;
    case 6: return (command & 0x01U) == 0;
    default: return false;
  }
}

bool has_begun_transfer(std::uint8_t command) {
  switch (command >> 5U) {
    case 2: return (command & 0x02U) == 0;
    case 3: return true;
    // The server's sub-command 0 is that of the client.
    case 5:
    case 6: return begins_transfer(command);
    default: return false;
  }
}

SdoBytes encode_upload_request(Multiplexer mux) { return message(0x40, mux); }

SdoBytes encode_download_expedited(Multiplexer mux, ByteView data, bool size_indicated) {
  CONFORM_CHECK(!data.empty() && data.size() <= 4);
  const auto unused = static_cast<unsigned>(4 - data.size());
  SdoBytes bytes =
      message(size_indicated ? static_cast<std::uint8_t>(0x23U | unused << 2U) : std::uint8_t{0x22}, mux);
  std::ranges::copy(data, bytes.begin() + 4);
  return bytes;
}

SdoBytes encode_download_segmented(Multiplexer mux, std::optional<std::uint32_t> size) {
  SdoBytes bytes = message(size ? 0x21 : 0x20, mux);
  store_le(std::span(bytes).subspan(4), size.value_or(0));
  return bytes;
}

SdoBytes encode_abort(Multiplexer mux, AbortCode code) {
  SdoBytes bytes = message(0x80, mux);
  store_le(std::span(bytes).subspan(4), code.value());
  return bytes;
}

std::optional<Initiate> decode_upload_response(ByteView bytes) { return decode_initiate(bytes, 2); }
std::optional<Initiate> decode_download_request(ByteView bytes) { return decode_initiate(bytes, 1); }

std::optional<Abort> decode_abort(ByteView bytes) {
  if (bytes.size() < 8 || bytes[0] >> 5U != 4) return std::nullopt;
  return Abort{.mux = sdo_multiplexer(bytes),
               .code = AbortCode{static_cast<std::uint32_t>(load_le(bytes.subspan(4, 4)))},
               .reserved_bits = (bytes[0] & 0x1FU) != 0};
}

}  // namespace conform::canopen
