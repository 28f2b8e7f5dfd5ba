// SPDX-License-Identifier: Apache-2.0
// What CiA 301 leaves to the maker of an SDO server. Every combination is conformant; the defaults offer all.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/time.hpp"
#include "dictionary/abort_codes.hpp"

namespace refnode {

using conform::AbortCode;

struct SdoChoices {
  bool segmented = true;  ///< false: expedited transfers only (and block transfer, if that is offered)
  AbortCode no_segmented = abort_code::command_unknown;  ///< what a segmented download is refused with then
  bool block = true;                   ///< false: block requests are refused with 0504 0001h
  bool expedited_upload = true;        ///< false: objects of one to four bytes are uploaded in segments too
  bool upload_size_indicated = true;   ///< segmented and block upload; false: bytes 4-7 stay zero
  std::size_t upload_segment = 7;      ///< segmented upload: bytes in each segment but the last, 1 to 7
  bool toggle_errors_ignored = false;  ///< true: no reply to a repeated segment in place of 0503 0000h
  bool wrong_toggle_ignored_in_downloads = false;  ///< the same, in downloads alone
  /// What names no entry is refused with the multiplexer of the last that did.
  bool former_mux_in_aborts = false;
  bool reserved_bits_refused = false;  ///< 0504 0001h for a command byte with one of its reserved bits set
  /// A download begins whatever its entry is; its first segment is refused.
  bool entry_looked_at_late = false;
  /// A segmented or block download that does not tell its size begins and is refused with its first segment.
  bool unsized_refused_late = false;

  /// Answer to a new initiate request while a transfer is open, which it ends; nullopt: the new one is
  /// served.
  std::optional<AbortCode> initiate_while_busy;

  // Block transfer
  bool crc = true;                        ///< this side can generate and check the CRC
  std::size_t block_upload_from = 0;      ///< upload: objects of fewer bytes are refused with 0504 0001h
  bool protocol_switch = true;            ///< upload: switch protocol when the size is not above a pst > 0
  std::uint8_t block_size = 127;          ///< download: segments per sub-block, 1 to 127
  std::uint8_t next_block_size = 0;       ///< download: block size in acknowledges; 0: the same
  bool ack_gap_at_once = false;           ///< download: acknowledge at a gap, not at the end of the sub-block
  bool first_segment_awaited = false;     ///< download: what comes in place of segment 1 is no segment at all
  bool invalid_sequence_ignored = false;  ///< download: wait at sequence number 0 or above the block size
  bool invalid_sequence_spoils = false;   ///< and acknowledge none of the sub-block, so that it comes again
  bool sub_block_queued = false;          ///< upload: the driver takes up to 64 segments at once

  /// From a request to the response, and to the first segment of a sub-block.
  conform::Duration turnaround{};
  /// Silence of the client that ends a transfer with 0504 0000h; nullopt: a transfer stays open for ever.
  std::optional<conform::Duration> time_out = std::chrono::seconds(1);
  /// Silence inside a sub-block of a download after which what has come is acknowledged.
  conform::Duration sub_block_time_out = std::chrono::milliseconds(250);
};

}  // namespace refnode
