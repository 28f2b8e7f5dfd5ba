// SPDX-License-Identifier: Apache-2.0
#include "canopen/abort_code.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"

namespace conform::canopen {
namespace {

constexpr std::array<AbortName, 31> names{{
    {abort::toggle_bit, "toggle bit not alternated"},
    {abort::timed_out, "protocol timed out"},
    {abort::command_specifier, "unknown command specifier"},
    {abort::block_size, "invalid block size"},
    {abort::sequence_number, "invalid sequence number"},
    {abort::crc, "CRC error"},
    {abort::out_of_memory, "out of memory"},
    {abort::unsupported_access, "unsupported access"},
    {abort::write_only, "read of a write-only object"},
    {abort::read_only, "write of a read-only object"},
    {abort::no_object, "object does not exist"},
    {abort::not_mappable, "object cannot be mapped"},
    {abort::pdo_length, "PDO length exceeded"},
    {abort::parameter_incompatible, "parameters incompatible"},
    {abort::internal_incompatible, "internal incompatibility"},
    {abort::hardware, "hardware error"},
    {abort::length_mismatch, "length does not match"},
    {abort::length_too_high, "length too high"},
    {abort::length_too_low, "length too low"},
    {abort::no_sub_index, "sub-index does not exist"},
    {abort::invalid_value, "invalid value"},
    {abort::value_too_high, "value too high"},
    {abort::value_too_low, "value too low"},
    {abort::max_below_min, "maximum below minimum"},
    {abort::no_sdo_connection, "no SDO connection"},
    {abort::general, "general error"},
    {abort::cannot_store, "cannot be transferred or stored"},
    {abort::local_control, "refused by local control"},
    {abort::device_state, "refused in this device state"},
    {abort::no_dictionary, "no object dictionary"},
    {abort::no_data, "no data available"},
}};

static_assert(std::ranges::is_sorted(names, {}, &AbortName::code));

}  // namespace

std::span<const AbortName> abort_codes() { return names; }

std::string_view meaning(AbortCode code) {
  const auto found = std::ranges::lower_bound(names, code, {}, &AbortName::code);
  return found != names.end() && found->code == code ? found->meaning : std::string_view{};
}

std::string describe(AbortCode code) {
  const std::string_view words = meaning(code);
  return fmt::format("{} ({})", to_string(code), words.empty() ? "reserved code" : words);
}

}  // namespace conform::canopen
