// SPDX-License-Identifier: Apache-2.0
#include "eds/file_date.hpp"

#include <fmt/format.h>

#include <charconv>
#include <chrono>

#include "base/text.hpp"

namespace conform::eds {
namespace {

/// A number of exactly so many digits, or of at least one and at most two where `digits` is 2.
std::optional<unsigned> number(std::string_view text, std::size_t digits) {
  if (text.empty() || text.size() > digits || (digits > 2 && text.size() != digits)) return std::nullopt;
  unsigned value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

bool exists(const FileDate& date) {
  return std::chrono::year_month_day(std::chrono::year(static_cast<int>(date.year)),
                                     std::chrono::month(date.month), std::chrono::day(date.day))
      .ok();
}

}  // namespace

std::optional<FileDate> file_date(std::string_view text) {
  auto parts = split(trim(text), '-');
  // xsd:date may end in Z or an offset from UTC: 2020-12-31Z, 2020-12-31+01:00.
  if (parts.size() >= 3 && parts[0].size() == 4 && parts[2].size() > 2) parts[2] = parts[2].substr(0, 2);
  const bool xml = parts.size() >= 3 && parts[0].size() == 4;
  if (parts.size() != 3 && !(xml && parts.size() == 4)) return std::nullopt;
  const auto year = number(parts[xml ? 0 : 2], 4);
  const auto month = number(parts[xml ? 1 : 0], 2);
  const auto day = number(parts[xml ? 2 : 1], 2);
  if (!year || !month || !day) return std::nullopt;
  const FileDate out{*year, *month, *day};
  return exists(out) ? std::optional(out) : std::nullopt;
}

std::string ini_date(const FileDate& date) {
  return fmt::format("{:02}-{:02}-{:04}", date.month, date.day, date.year);
}

std::string xml_date(const FileDate& date) {
  return fmt::format("{:04}-{:02}-{:02}", date.year, date.month, date.day);
}

std::optional<unsigned> file_time(std::string_view text) {
  text = trim(text);
  const auto colon = text.find(':');
  if (colon == std::string_view::npos || text.size() < colon + 3) return std::nullopt;
  const auto hour = number(text.substr(0, colon), 2);
  const auto minute = number(text.substr(colon + 1, 2), 2);
  if (!hour || !minute || *minute > 59) return std::nullopt;
  const auto rest = lower(trim(text.substr(colon + 3)));
  if (rest == "am" || rest == "pm") {
    if (*hour < 1 || *hour > 12) return std::nullopt;
    return (*hour % 12 + (rest == "pm" ? 12U : 0U)) * 60 + *minute;
  }
  if (*hour > 23 || (!rest.empty() && rest.front() != ':')) return std::nullopt;
  return *hour * 60 + *minute;
}

std::string ini_time(unsigned minutes) {
  const auto hour = minutes / 60;
  return fmt::format("{:02}:{:02}{}", hour % 12 == 0 ? 12 : hour % 12, minutes % 60, hour < 12 ? "AM" : "PM");
}

std::string xml_time(unsigned minutes) { return fmt::format("{:02}:{:02}:00", minutes / 60, minutes % 60); }

}  // namespace conform::eds
