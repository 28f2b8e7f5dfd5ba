// SPDX-License-Identifier: Apache-2.0
#include "cli/first_contact/scan_ranges.hpp"

#include <cstdint>
#include <iterator>
#include <string_view>

#include "base/text.hpp"

namespace conform::cli {
namespace {

/// Communication, manufacturer and standardised profile area; the rest is reserved or of network variables.
constexpr engine::IndexRange usual[] = {{0x1000, 0x1FFF}, {0x2000, 0x5FFF}, {0x6000, 0x9FFF}};

Result<engine::IndexRange> range_of(std::string_view text) {
  const auto range = parse_number_range(text);
  if (!range || range->high > 0xFFFF || range->low == 0)
    return fail("'" + std::string(text) + "' is no range of indices", {}, "--range 2000h..2FFFh");
  return engine::IndexRange{static_cast<std::uint16_t>(range->low), static_cast<std::uint16_t>(range->high)};
}

}  // namespace

Result<std::vector<engine::IndexRange>> scan_ranges(const std::vector<std::string>& texts) {
  std::vector<engine::IndexRange> out;
  for (const auto& text : texts) {
    const auto range = range_of(text);
    if (!range) return std::unexpected(range.error());
    out.push_back(*range);
  }
  if (out.empty()) out.assign(std::begin(usual), std::end(usual));
  return out;
}

}  // namespace conform::cli
