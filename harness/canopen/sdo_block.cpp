// SPDX-License-Identifier: Apache-2.0
#include "canopen/sdo_block.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "base/check.hpp"

namespace conform::canopen {
namespace {

constexpr auto crc_table = [] {
  std::array<std::uint16_t, 256> table{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t value = i << 8U;
    for (int bit = 0; bit < 8; ++bit) value = (value & 0x8000U) != 0 ? (value << 1U) ^ 0x1021U : value << 1U;
    table[i] = static_cast<std::uint16_t>(value & 0xFFFFU);
  }
  return table;
}();

SdoBytes message(unsigned command, Multiplexer mux) {
  SdoBytes bytes{};
  bytes[0] = static_cast<std::uint8_t>(command);
  store_le(std::span(bytes).subspan(1, 2), mux.index.value());
  bytes[3] = mux.sub.value();
  return bytes;
}

bool has_set(ByteView bytes) {
  return std::ranges::any_of(bytes, [](std::uint8_t byte) { return byte != 0; });
}

}  // namespace

std::uint16_t block_crc(ByteView data) { return block_crc(0, data); }

std::uint16_t block_crc(std::uint16_t start, ByteView data) {
  std::uint32_t crc = start;
  for (const auto byte : data) crc = ((crc << 8U) & 0xFFFFU) ^ crc_table[(crc >> 8U) ^ byte];
  return static_cast<std::uint16_t>(crc);
}

SdoBytes encode_block_download(Multiplexer mux, std::optional<std::uint32_t> size, bool crc) {
  auto bytes = message(0xC0U | (crc ? 0x04U : 0U) | (size ? 0x02U : 0U), mux);
  store_le(std::span(bytes).subspan(4), size.value_or(0));
  return bytes;
}

SdoBytes encode_block_segment(std::uint8_t number, ByteView data, bool last) {
  CONFORM_CHECK(data.size() <= segment_bytes && number <= most_block_segments);
  SdoBytes bytes{};
  bytes[0] = static_cast<std::uint8_t>((last ? 0x80U : 0U) | number);
  std::ranges::copy(data, bytes.begin() + 1);
  return bytes;
}

SdoBytes encode_block_download_end(std::uint8_t unused, std::uint16_t crc) {
  SdoBytes bytes{static_cast<std::uint8_t>(0xC1U | (unused & 7U) << 2U)};
  store_le(std::span(bytes).subspan(1, 2), crc);
  return bytes;
}

SdoBytes encode_block_upload(Multiplexer mux, std::uint8_t blksize, std::uint8_t pst, bool crc) {
  auto bytes = message(0xA0U | (crc ? 0x04U : 0U), mux);
  bytes[4] = blksize;
  bytes[5] = pst;
  return bytes;
}

SdoBytes encode_block_upload_start() { return {0xA3}; }

SdoBytes encode_block_acknowledge(std::uint8_t ackseq, std::uint8_t blksize) {
  return {0xA2, ackseq, blksize};
}

SdoBytes encode_block_upload_end() { return {0xA1}; }

std::optional<BlockDownloadResponse> decode_block_download_response(ByteView bytes) {
  if (bytes.size() < 8 || (bytes[0] & 0xE3U) != 0xA0) return std::nullopt;
  return BlockDownloadResponse{.mux = sdo_multiplexer(bytes),
                               .crc = (bytes[0] & 0x04U) != 0,
                               .blksize = bytes[4],
                               .reserved_set = (bytes[0] & 0x18U) != 0 || has_set(bytes.subspan(5, 3))};
}

std::optional<BlockUploadResponse> decode_block_upload_response(ByteView bytes) {
  if (bytes.size() < 8 || (bytes[0] & 0xE1U) != 0xC0) return std::nullopt;
  return BlockUploadResponse{.mux = sdo_multiplexer(bytes),
                             .crc = (bytes[0] & 0x04U) != 0,
                             .size_indicated = (bytes[0] & 0x02U) != 0,
                             .size = static_cast<std::uint32_t>(load_le(bytes.subspan(4, 4))),
                             .reserved_bits = (bytes[0] & 0x18U) != 0};
}

std::optional<BlockAcknowledge> decode_block_acknowledge(ByteView bytes) {
  if (bytes.size() < 8 || (bytes[0] & 0xE3U) != 0xA2) return std::nullopt;
  return BlockAcknowledge{.ackseq = bytes[1],
                          .blksize = bytes[2],
                          .reserved_set = (bytes[0] & 0x1CU) != 0 || has_set(bytes.subspan(3, 5))};
}

std::optional<BlockEnd> decode_block_upload_end(ByteView bytes) {
  if (bytes.size() < 8 || (bytes[0] & 0xE1U) != 0xC1) return std::nullopt;
  return BlockEnd{.unused = static_cast<std::uint8_t>(bytes[0] >> 2U & 0x07U),
                  .crc = static_cast<std::uint16_t>(load_le(bytes.subspan(1, 2))),
                  .reserved_set = (bytes[0] & 0x02U) != 0 || has_set(bytes.subspan(3, 5))};
}

std::optional<bool> decode_block_download_end(ByteView bytes) {
  if (bytes.size() < 8 || (bytes[0] & 0xE3U) != 0xA1) return std::nullopt;
  return (bytes[0] & 0x1CU) != 0 || has_set(bytes.subspan(1, 7));
}

}  // namespace conform::canopen
