// SPDX-License-Identifier: Apache-2.0
// Dates and times of day of a description: CiA 306 writes 12-31-2020 and 11:59PM, CiA 311 writes 2020-12-31
// and 23:59:00.
#pragma once

#include <compare>
#include <optional>
#include <string>
#include <string_view>

namespace conform::eds {

struct FileDate {
  unsigned year = 0, month = 0, day = 0;
  friend constexpr auto operator<=>(const FileDate&, const FileDate&) = default;
};

/// Both forms; nullopt for anything else and for a day that no month has.
[[nodiscard]] std::optional<FileDate> file_date(std::string_view text);
[[nodiscard]] std::string ini_date(const FileDate& date);
[[nodiscard]] std::string xml_date(const FileDate& date);

/// Minutes since midnight. Seconds and the offset from UTC that XML may have are left out.
[[nodiscard]] std::optional<unsigned> file_time(std::string_view text);
[[nodiscard]] std::string ini_time(unsigned minutes);
[[nodiscard]] std::string xml_time(unsigned minutes);

}  // namespace conform::eds
