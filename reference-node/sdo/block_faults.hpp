// SPDX-License-Identifier: Apache-2.0
// How block transfer misbehaves: switches of Behaviour, and what they make of the values they touch.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace refnode {

struct SdoBlockFaults {
  // Upload
  bool size_0_accepted = false;          ///< taken as 127
  bool size_above_127_accepted = false;  ///< taken as 127
  bool size_ignored = false;             ///< 127 segments whatever the client asks for
  bool next_size_ignored = false;        ///< the first block size holds for all sub-blocks
  bool next_size_unchecked = false;      ///< taken as 127 if it is not allowed
  bool acknowledge_unchecked = false;    ///< more than was sent counts as all that was sent
  bool acknowledge_counts_as_all = false;
  bool acknowledge_one_too_far = false;
  bool starts_at_once = false;
  bool zero_threshold_switches = false;
  bool threshold_inverted = false;
  bool client_abort_ignored = false;  ///< in both directions
  bool abort_waits_for_sub_block = false;
  bool goes_on_in_stopped = false;

  // Download: segments
  std::uint8_t offered_size = 0;  ///< 0: as configured
  bool gap_unnoticed = false;     ///< the number of a segment does not matter
  bool duplicate_appended = false;
  bool number_0_accepted = false;
  bool number_above_size_accepted = false;
  std::size_t receives_at_most = 127;  ///< segments of a sub-block; the rest is lost
  std::size_t buffer = 0;              ///< bytes that are kept, 0: all

  // Download: end
  bool not_stored = false;
  bool unused_ignored = false;
  bool unused_misread = false;  ///< n is taken from bits 3-1, where a segmented download has it
  bool surplus_cut = false;     ///< bytes beyond the announced or possible size are dropped
  bool shortfall_filled = false;
  bool length_unchecked = false;  ///< the announced size may differ from that of the entry
  bool range_unchecked = false;
  bool crc_unchecked = false;
  bool crc_always_checked = false;
  bool stored_despite_wrong_crc = false;
  bool crc_byte_swapped = false;
  bool crc_with_padding = false;
  std::uint16_t crc_polynomial = 0x1021;
  std::uint16_t crc_start = 0;

  [[nodiscard]] bool drops_surplus() const { return surplus_cut || duplicate_appended || length_unchecked; }
  /// n of the end request, 110n nnx1.
  [[nodiscard]] std::size_t unused(std::uint8_t command) const {
    if (unused_ignored) return 0;
    return (command >> (unused_misread ? 1U : 2U)) & 0x07U;
  }
  /// The CRC that the end request must hold, which is `right` in a conformant server.
  [[nodiscard]] std::uint16_t crc(std::uint16_t right, std::span<const std::uint8_t> data,
                                  std::span<const std::uint8_t> padded) const {
    const bool other = crc_with_padding || crc_always_checked || crc_polynomial != 0x1021 || crc_start != 0;
    std::uint16_t out = other ? crc_start : right;
    if (other) {
      for (const std::uint8_t byte : crc_with_padding ? padded : data) {
        out = static_cast<std::uint16_t>(out ^ (byte << 8U));
        for (int bit = 0; bit < 8; ++bit) {
          const bool high = (out & 0x8000U) != 0;
          out = static_cast<std::uint16_t>(out << 1U);
          if (high) out = static_cast<std::uint16_t>(out ^ crc_polynomial);
        }
      }
    }
    return crc_byte_swapped ? static_cast<std::uint16_t>((out << 8U) | (out >> 8U)) : out;
  }
  /// Block size of an initiate request.
  [[nodiscard]] std::uint8_t asked(std::uint8_t size) const {
    const bool taken_as_127 =
        size_ignored || (size == 0 && size_0_accepted) || (size > 127 && size_above_127_accepted);
    return taken_as_127 ? 127 : size;
  }
  /// A2h of the client, `sent` segments after the last one, `first_size` after the initiate request.
  [[nodiscard]] std::array<std::uint8_t, 8> acknowledged(std::array<std::uint8_t, 8> request,
                                                         std::uint8_t sent, std::uint8_t first_size) const {
    std::uint8_t& received = request[1];
    std::uint8_t& size = request[2];
    if (acknowledge_counts_as_all || (acknowledge_unchecked && received > sent)) received = sent;
    if (acknowledge_one_too_far && received < sent) ++received;
    const bool allowed = size >= 1 && size <= 127;
    if (next_size_unchecked && !allowed) size = 127;
    if (allowed && size_ignored) size = 127;
    if (allowed && next_size_ignored) size = first_size;
    return request;
  }
  [[nodiscard]] bool switches(std::size_t size, std::uint8_t threshold, bool by_the_rule) const {
    if (zero_threshold_switches && threshold == 0) return true;
    if (threshold_inverted) return threshold != 0 && size > threshold;
    return by_the_rule;
  }
};

}  // namespace refnode
