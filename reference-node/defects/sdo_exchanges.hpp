// SPDX-License-Identifier: Apache-2.0
// What the tables of SDO defects ask of an exchange: which request it was, and how the conformant server
// answered.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/bytes.hpp"
#include "device/outbox.hpp"
#include "dictionary/abort_codes.hpp"

namespace refnode::defect {

using conform::AbortCode;
using Data = std::array<std::uint8_t, 8>;

inline bool always(const SdoExchange&) { return true; }
inline bool aborted(const SdoExchange& e) { return e.aborted.has_value(); }

inline bool upload_initiated(const SdoExchange& e) {
  return e.step == SdoStep::upload_initiate && !e.aborted;
}
inline bool upload_segment_sent(const SdoExchange& e) {
  return e.step == SdoStep::upload_segment && !e.aborted;
}
inline bool segment_without_transfer(const SdoExchange& e) {
  return e.step == SdoStep::upload_segment && e.aborted == abort_code::command_unknown;
}

inline bool download_initiated(const SdoExchange& e) {
  return e.step == SdoStep::download_initiate && !e.aborted;
}
inline bool download_segment_taken(const SdoExchange& e) {
  return e.step == SdoStep::download_segment && !e.aborted;
}
inline bool download_segment_without_transfer(const SdoExchange& e) {
  return e.step == SdoStep::download_segment && e.aborted == abort_code::command_unknown;
}

// Bits of the command byte of a request: e (bit 1) and s (bit 0) of an initiate, c (bit 0) of a segment.
inline bool is_expedited(const SdoExchange& e) { return (e.request[0] & 0x02U) != 0; }
inline bool is_sized(const SdoExchange& e) { return (e.request[0] & 0x01U) != 0; }
inline bool is_last_segment(const SdoExchange& e) { return (e.request[0] & 0x01U) != 0; }

inline bool segmented_download_initiated(const SdoExchange& e) {
  return download_initiated(e) && !is_expedited(e);
}
inline bool unsized_expedited_download(const SdoExchange& e) {
  return download_initiated(e) && is_expedited(e) && !is_sized(e);
}
inline bool last_download_segment(const SdoExchange& e) {
  return download_segment_taken(e) && is_last_segment(e);
}
inline bool unknown_command(const SdoExchange& e) {
  return e.step == SdoStep::other && e.aborted == abort_code::command_unknown;
}

// Of a response: 010x nnes with e = 1 tells how many bytes carry data.
inline bool is_expedited_upload(const Data& data) { return (data[0] & 0xE2U) == 0x42U; }
inline bool is_segmented_upload(const Data& data) { return (data[0] & 0xE2U) == 0x40U; }
inline std::size_t expedited_size(const Data& data) { return 4U - ((data[0] >> 2U) & 0x03U); }

inline void store_code(Data& data, AbortCode code) {
  conform::store_le(std::span(data).subspan(4), code.value());
}

}  // namespace refnode::defect
