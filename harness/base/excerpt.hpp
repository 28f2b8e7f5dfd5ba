// SPDX-License-Identifier: Apache-2.0
// The line of an input file beside a message about it, with a caret under the place.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace conform {

/// A source line as it is printed, escaped and clipped around the place, and the marks to print below it.
struct Excerpt {
  std::string text;
  std::string underline;
};

/// `offset` is the byte of the place, or behind the line; `length` code points are underlined, at least one.
/// Takes the same time however long the line is.
[[nodiscard]] Excerpt excerpt(std::string_view line, std::size_t offset, int length);

/// Two lines: "   14 | text" and "      |   ^~~"; `tint` and `off` colour the marks, or are empty.
[[nodiscard]] std::string to_lines(const Excerpt& excerpt, int line_number, std::string_view tint,
                                   std::string_view off);

}  // namespace conform
