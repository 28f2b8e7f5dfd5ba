// SPDX-License-Identifier: Apache-2.0
// The line of an input file beside a message about it, with a caret under the place.
#pragma once

#include <string>
#include <string_view>

namespace conform {

/// Code points in a UTF-8 text; a byte of an invalid sequence counts as one.
[[nodiscard]] int code_points(std::string_view text);

/// A source line as it is printed, escaped and clipped, and the marks to print below it.
struct Excerpt {
  std::string text;
  std::string underline;
};

/// `column` counts code points from 1; `length` code points are underlined, at least one.
[[nodiscard]] Excerpt excerpt(std::string_view line, int column, int length);

/// Two lines: "   14 | text" and "      |   ^~~"; `tint` and `off` colour the marks, or are empty.
[[nodiscard]] std::string to_lines(const Excerpt& excerpt, int line_number, std::string_view tint,
                                   std::string_view off);

}  // namespace conform
