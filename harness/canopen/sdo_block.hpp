// SPDX-License-Identifier: Apache-2.0
// Messages of SDO block transfers (CiA 301, 7.2.4.3.8 to 7.2.4.3.16). Bits of the commands that are marked x
// below are reserved.
//
//   block download   > 110x x c s 0  m m m size     initiate; c: CRC wanted, s: size told
//                    < 101x x c 0 0  m m m blksize
//                    > c nnn nnnn    7 bytes        segment; c: no more segments, n: sequence number 1..127
//                    < 101x xx 1 0   ackseq blksize acknowledge of a sub-block
//                    > 110n nn x 1   crc crc        end; n: bytes of the last segment without data
//                    < 101x xx 0 1
//   block upload     > 101x x c 0 0  m m m blksize pst
//                    < 110x x c s 0  m m m size
//                    > 101x xx 1 1                  start
//                    < c nnn nnnn    7 bytes
//                    > 101x xx 1 0   ackseq blksize
//                    < 110n nn x 1   crc crc
//                    > 101x xx 0 1
#pragma once

#include <cstdint>
#include <optional>

#include "canopen/sdo_initiate.hpp"

namespace conform::canopen {

/// x^16 + x^12 + x^5 + 1, start 0, not reflected (7.2.4.3.16): "123456789" has 31C3h.
[[nodiscard]] std::uint16_t block_crc(ByteView data);
/// Goes on from `start`, the CRC of what came before.
[[nodiscard]] std::uint16_t block_crc(std::uint16_t start, ByteView data);

inline constexpr std::uint8_t most_block_segments = 127;
inline constexpr std::size_t segment_bytes = 7;

[[nodiscard]] SdoBytes encode_block_download(Multiplexer mux, std::optional<std::uint32_t> size, bool crc);
/// At most seven bytes; the rest is zero.
[[nodiscard]] SdoBytes encode_block_segment(std::uint8_t number, ByteView data, bool last);
[[nodiscard]] SdoBytes encode_block_download_end(std::uint8_t unused, std::uint16_t crc);
/// Block size and threshold as they are, legal or not.
[[nodiscard]] SdoBytes encode_block_upload(Multiplexer mux, std::uint8_t blksize, std::uint8_t pst, bool crc);
[[nodiscard]] SdoBytes encode_block_upload_start();
[[nodiscard]] SdoBytes encode_block_acknowledge(std::uint8_t ackseq, std::uint8_t blksize);
[[nodiscard]] SdoBytes encode_block_upload_end();

/// Answer to the initiate request of a block download.
struct BlockDownloadResponse {
  Multiplexer mux;
  bool crc = false;
  std::uint8_t blksize = 0;
  bool reserved_set = false;  ///< bits 4 and 3, or bytes 5 to 7
};
/// Answer to the initiate request of a block upload.
struct BlockUploadResponse {
  Multiplexer mux;
  bool crc = false;
  bool size_indicated = false;
  std::uint32_t size = 0;
  bool reserved_bits = false;
};
struct BlockAcknowledge {
  std::uint8_t ackseq = 0;
  std::uint8_t blksize = 0;
  bool reserved_set = false;
};
struct BlockEnd {
  std::uint8_t unused = 0;
  std::uint16_t crc = 0;
  bool reserved_set = false;
};
// nullopt: shorter than eight bytes, or another command.
[[nodiscard]] std::optional<BlockDownloadResponse> decode_block_download_response(ByteView bytes);
[[nodiscard]] std::optional<BlockUploadResponse> decode_block_upload_response(ByteView bytes);
[[nodiscard]] std::optional<BlockAcknowledge> decode_block_acknowledge(ByteView bytes);
/// The server's end frame of a block upload.
[[nodiscard]] std::optional<BlockEnd> decode_block_upload_end(ByteView bytes);
/// Whether it is the server's end of a block download, and if so whether reserved bits or bytes are set.
[[nodiscard]] std::optional<bool> decode_block_download_end(ByteView bytes);

}  // namespace conform::canopen
