// SPDX-License-Identifier: Apache-2.0
// Habits of SDO servers and dictionaries that few devices have, each more than a choice of a service.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>

#include "variants/tools.hpp"

namespace refnode::variant {

/// The server takes its time for some answers: `time` tells how long, 0 for the others.
How answers_after(std::function<Duration(Parts&, const SdoExchange&)> time);
[[nodiscard]] Duration written_in_30ms(Parts& parts, const SdoExchange& sdo);
[[nodiscard]] Duration operational_in_60ms(Parts& parts, const SdoExchange& sdo);
[[nodiscard]] Duration irregular(Parts& parts, const SdoExchange& sdo);
/// Whether what was written is there with this answer.
[[nodiscard]] bool ends_a_download(const SdoExchange& sdo);

/// `choose` is given the request that begins a block transfer before it is served.
How chosen_for_each_block_transfer(std::function<void(Parts&, const Frame&)> choose);
/// No larger sub-block than what was announced needs.
void fitting_block_size(Parts& parts, const Frame& request);
void crc_of_uploads(Parts& parts, const Frame& request);
/// Each acknowledge asks for another number of segments.
void restless_block_size(Parts& parts);
/// There is memory for one transfer, whichever channel it has.
void one_transfer_at_a_time(Parts& parts);
/// The last byte is sent with c = 0, and an empty segment behind it.
void last_segment_empty(Parts& parts);
void time_out_silent(Parts& parts);
void write_only_unsupported(Parts& parts);
/// Who has nothing that can be written is not asked for its sub-indices.
void read_only_before_absent(Parts& parts);

/// Some parameters are locked while the device works.
How locked_in_operational(std::function<bool(std::uint16_t index)> which);
[[nodiscard]] bool is_configuration(std::uint16_t index);
void printable_texts(Parts& parts);
/// A DOMAIN is written to a memory of words.
void domains_of_words(Parts& parts);
void domains_write_only(Parts& parts);
void running_status(Parts& parts);
/// Somebody has turned the key at the device.
How in_local_control(std::initializer_list<std::uint16_t> indices);

}  // namespace refnode::variant
