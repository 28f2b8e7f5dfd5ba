// SPDX-License-Identifier: Apache-2.0
#include "canopen/sdo_segment.hpp"

#include <algorithm>

#include "base/check.hpp"

namespace conform::canopen {
namespace {

constexpr unsigned toggle_bit(bool toggle) { return toggle ? 0x10U : 0x00U; }

}  // namespace

SdoBytes encode_upload_segment_request(bool toggle) {
  SdoBytes bytes{};
  bytes[0] = static_cast<std::uint8_t>(0x60U | toggle_bit(toggle));
  return bytes;
}

SdoBytes encode_download_segment_request(bool toggle, ByteView data, bool last) {
  CONFORM_CHECK(data.size() <= 7);
  SdoBytes bytes{};
  const auto unused = static_cast<unsigned>(7 - data.size());
  bytes[0] = static_cast<std::uint8_t>(toggle_bit(toggle) | unused << 1U | (last ? 1U : 0U));
  std::ranges::copy(data, bytes.begin() + 1);
  return bytes;
}

std::optional<Segment> decode_segment(ByteView bytes) {
  if (bytes.size() < 8 || bytes[0] >> 5U != 0) return std::nullopt;
  Segment out;
  out.toggle = (bytes[0] & 0x10U) != 0;
  out.unused = bytes[0] >> 1U & 0x07U;
  out.last = (bytes[0] & 0x01U) != 0;
  std::ranges::copy(bytes.subspan(1, 7), out.data.begin());
  return out;
}

std::optional<SegmentAck> decode_download_segment_response(ByteView bytes) {
  if (bytes.size() < 8 || bytes[0] >> 5U != 1) return std::nullopt;
  const bool bytes_set =
      std::ranges::any_of(bytes.subspan(1, 7), [](std::uint8_t byte) { return byte != 0; });
  return SegmentAck{.toggle = (bytes[0] & 0x10U) != 0, .reserved_set = bytes_set || (bytes[0] & 0x0FU) != 0};
}

}  // namespace conform::canopen
