// SPDX-License-Identifier: Apache-2.0
// Other spellings of a value, as CiA 306 wants them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace conform::eds {

/// mm-dd-yyyy; nullopt when month and day could be either, or it is no date.
[[nodiscard]] std::optional<std::string> standard_date(std::string_view text);
/// hh:mmAM or hh:mmPM of a time of 12 or 24 hours, seconds left out; nullopt when it is no time.
[[nodiscard]] std::optional<std::string> standard_time(std::string_view text);
/// $NODEID first, in capitals, without blanks; the number as it is written.
[[nodiscard]] std::optional<std::string> standard_formula(std::string_view text);
/// A number without sign, suffix of C, or with 0x instead of the h behind it.
[[nodiscard]] std::optional<std::string> standard_number(std::string_view text);
/// `number` in the way `like` is written: 0x03 for 0x02, decimal otherwise.
[[nodiscard]] std::string number_like(std::string_view like, std::size_t number);

}  // namespace conform::eds
