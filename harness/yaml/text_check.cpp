// SPDX-License-Identifier: Apache-2.0
#include "yaml/text_check.hpp"

#include <cstdint>

#include <fmt/format.h>

#include "yaml/loader.hpp"

namespace conform::yaml {
namespace {

struct Decoded {
  std::uint32_t code_point = 0;
  std::size_t size = 0;  // 0: not valid UTF-8
};

/// RFC 3629: no overlong forms, no surrogates, nothing above 10FFFFh.
Decoded decode(std::string_view text) {
  const auto byte = [&](std::size_t i) -> std::uint32_t { return static_cast<unsigned char>(text[i]); };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80U) return {lead, 1};
  const std::size_t size = lead >= 0xF0U ? 4 : lead >= 0xE0U ? 3 : 2;
  if (lead < 0xC2U || lead > 0xF4U || text.size() < size) return {};
  std::uint32_t value = lead & (0x7FU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {};
    value = (value << 6U) | (byte(i) & 0x3FU);
  }
  const bool overlong = (size == 3 && value < 0x800U) || (size == 4 && value < 0x10000U);
  if (overlong || value > 0x10FFFFU || (value >= 0xD800U && value <= 0xDFFFU)) return {};
  return {value, size};
}

/// What nearly all of a file is.
constexpr bool is_common(char c) { return (c >= ' ' && c <= '~') || c == '\n'; }

constexpr bool is_direction_mark(std::uint32_t c) {
  return c == 0x200EU || c == 0x200FU || (c >= 0x202AU && c <= 0x202EU) || (c >= 0x2066U && c <= 0x2069U);
}

constexpr bool is_control(std::uint32_t c) {
  return (c < 0x20U && c != '\n' && c != '\t') || (c >= 0x7FU && c < 0xA0U) || c == 0x2028U || c == 0x2029U;
}

}  // namespace

bool check_text(const Source& source, Diagnostics& diagnostics) {
  const auto text = source.text();
  if (text.size() > max_file_size) {
    diagnostics.error({}, 1, fmt::format("the text is longer than {} bytes", max_file_size), "split it");
    return false;
  }
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    diagnostics.error({}, 1, "the file is UTF-16", "save it as UTF-8");
    return false;
  }
  bool good = true;
  constexpr int enough = 20;  // a binary file would otherwise report each byte
  int faults = 0;
  for (std::size_t i = 0; i < text.size() && faults < enough;) {
    if (is_common(text[i])) {
      ++i;
      continue;
    }
    const auto decoded = decode(text.substr(i));
    const auto c = decoded.code_point;
    if (decoded.size == 0) {
      diagnostics.error(source.position(i), 1,
                        fmt::format("byte {:02X}h is not valid UTF-8", static_cast<unsigned char>(text[i])),
                        "save the file as UTF-8");
      good = false;
      ++faults;
    } else if (c == '\r') {
      diagnostics.error(source.position(i), 1, "carriage return without line feed",
                        "save the file with LF line ends");
      good = false;
      ++faults;
    } else if (is_control(c)) {
      diagnostics.error(
          source.position(i), 1,
          c == 0 ? "NUL character; this is not a text file" : fmt::format("control character {:04X}h", c));
      good = false;
      ++faults;
    } else if (is_direction_mark(c)) {
      diagnostics.error(source.position(i), 1,
                        fmt::format("invisible character {:04X}h changes the reading direction", c),
                        "remove it");
      ++faults;
    }
    i += decoded.size == 0 ? 1 : decoded.size;
  }
  return good;
}

}  // namespace conform::yaml
