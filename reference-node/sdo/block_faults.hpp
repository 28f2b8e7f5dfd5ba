// SPDX-License-Identifier: Apache-2.0
// How block transfer misbehaves: switches of Behaviour, and what they make of the values they touch.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace refnode {

struct SdoBlockFaults {
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
