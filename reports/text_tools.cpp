// SPDX-License-Identifier: Apache-2.0
#include "reports/text_tools.hpp"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "base/text.hpp"

namespace conform::reports {
namespace {

constexpr std::string_view ellipsis = "...";

constexpr bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

/// Byte offset behind the first `count` characters.
std::size_t offset_of(std::string_view text, std::size_t count) {
  std::size_t i = 0;
  while (i < text.size() && count > 0) {
    ++i;
    while (i < text.size() && continues_character(text[i])) ++i;
    --count;
  }
  return i;
}

std::string replace_all(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// Microseconds, rounded half away from zero.
std::int64_t microseconds(Duration duration) {
  const std::int64_t ns = duration.count();
  return ns / 1000 + (ns % 1000 >= 500 ? 1 : 0) - (ns % 1000 <= -500 ? 1 : 0);
}

}  // namespace

std::size_t columns(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return !continues_character(c); }));
}

std::string pad_right(std::string_view text, std::size_t width) {
  const std::size_t used = columns(text);
  return std::string(text) + std::string(used < width ? width - used : 0, ' ');
}

std::string pad_left(std::string_view text, std::size_t width) {
  const std::size_t used = columns(text);
  return std::string(used < width ? width - used : 0, ' ') + std::string(text);
}

std::string clip(std::string_view text, std::size_t width) {
  if (columns(text) <= width) return std::string(text);
  if (width <= ellipsis.size()) return std::string(text.substr(0, offset_of(text, width)));
  return std::string(text.substr(0, offset_of(text, width - ellipsis.size()))) + std::string(ellipsis);
}

std::string clip_front(std::string_view text, std::size_t width) {
  const std::size_t used = columns(text);
  if (used <= width) return std::string(text);
  if (width <= ellipsis.size()) return std::string(text.substr(offset_of(text, used - width)));
  const std::string_view end = text.substr(offset_of(text, used - width + ellipsis.size()));
  return fmt::format("{}{}", ellipsis, end);
}

std::string clip_bytes(std::string_view text, std::size_t size) {
  if (text.size() <= size) return std::string(text);
  std::size_t end = size > ellipsis.size() ? size - ellipsis.size() : 0;
  while (end > 0 && continues_character(text[end])) --end;
  return std::string(text.substr(0, end)) + std::string(ellipsis);
}

std::vector<std::string> wrap(std::string_view text, std::size_t width) {
  width = std::max<std::size_t>(width, 8);
  std::vector<std::string> lines;
  std::string line;
  for (std::string_view word : split(text, ' ')) {
    if (word.empty()) continue;
    if (!line.empty() && columns(line) + 1 + columns(word) > width) {
      lines.push_back(std::move(line));
      line.clear();
    }
    while (columns(word) > width) {  // only a word of its own line can be too long
      const std::size_t end = offset_of(word, width);
      lines.emplace_back(word.substr(0, end));
      word.remove_prefix(end);
    }
    if (!line.empty()) line += ' ';
    line += word;
  }
  if (!line.empty() || lines.empty()) lines.push_back(std::move(line));
  return lines;
}

std::string prose(std::string_view text) {
  std::string out;
  bool blank = false;
  for (const char c : text) {
    if (c == ' ' || c == '\n' || c == '\t' || c == '\r') {
      blank = !out.empty();
      continue;
    }
    if (blank) out += ' ';
    blank = false;
    out += c;
  }
  return log_safe(out);
}

std::string log_safe(std::string_view text) {
  std::string out = printable(text);
  out = replace_all(std::move(out), "::", "\\x3A\\x3A");
  return replace_all(std::move(out), "##", "\\x23\\x23");
}

std::string url_path(std::string_view path) {
  std::string out;
  for (const char c : path) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::string_view("-._~/").find(c) != std::string_view::npos;
    if (plain) {
      out += c;
    } else {
      constexpr std::string_view digits = "0123456789ABCDEF";
      const auto byte = static_cast<std::uint8_t>(c);
      out += '%';
      out += digits[byte >> 4U];
      out += digits[byte & 0xFU];
    }
  }
  return out;
}

std::string brief_duration(Duration duration) {
  const std::int64_t us = std::max<std::int64_t>(microseconds(duration), 0);
  if (us < 9'950) return fmt::format("{}.{} ms", (us + 50) / 1000, (us + 50) / 100 % 10);
  if (us < 999'500) return fmt::format("{} ms", (us + 500) / 1000);
  if (us < 59'995'000)
    return fmt::format("{}.{:02} s", (us + 5'000) / 1'000'000, (us + 5'000) / 10'000 % 100);
  const std::int64_t s = (us + 500'000) / 1'000'000;
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s % 3600 / 60);
}

std::string milliseconds(Duration duration) {
  const std::int64_t us = microseconds(duration);
  const std::int64_t magnitude = us < 0 ? -us : us;
  return fmt::format("{}{}.{:03}", us < 0 ? "-" : "", magnitude / 1000, magnitude % 1000);
}

std::string seconds(Duration duration) {
  const std::int64_t ms = (std::max<std::int64_t>(microseconds(duration), 0) + 500) / 1000;
  return fmt::format("{}.{:03}", ms / 1000, ms % 1000);
}

std::string utc_timestamp(std::int64_t utc_ns) {
  using namespace std::chrono;
  const sys_seconds at{floor<std::chrono::seconds>(nanoseconds{utc_ns})};
  const sys_days day = floor<days>(at);
  const year_month_day date{day};
  const hh_mm_ss clock{at - day};
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                     clock.hours().count(), clock.minutes().count(), clock.seconds().count());
}

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace conform::reports
