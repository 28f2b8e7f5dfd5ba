// SPDX-License-Identifier: Apache-2.0
// How text becomes markup. Whatever a device or a file said enters the page through one of these functions,
// so that it stays text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "result/run_result.hpp"

namespace conform::reports::html {

/// Any bytes as content of an element or of a quoted attribute: made printable, and nothing in it is markup.
[[nodiscard]] std::string text(std::string_view any);
/// The same with blanks and line breaks collapsed: for sentences.
[[nodiscard]] std::string sentence(std::string_view any);
/// At most so many characters of it: a device may send a string of a megabyte.
[[nodiscard]] std::string clipped(std::string_view any, std::size_t width);
/// <code>...</code> around text().
[[nodiscard]] std::string code(std::string_view any);

/// The verdict as a word with a shape before it; the colour only repeats it.
[[nodiscard]] std::string badge(result::Verdict verdict);
/// The same for words that are no verdict of ours, such as "skipped": `kind` is the class that lends the
/// shape.
[[nodiscard]] std::string badge(std::string_view kind, std::string_view words);
/// Class of a verdict: "na" for not applicable, else its spelling.
[[nodiscard]] std::string_view css_class(result::Verdict verdict);

/// "<a href="#target">content</a>"; both are markup already.
[[nodiscard]] std::string link(std::string_view target, std::string_view content);
/// Something to unfold: the summary and what is behind it, both markup.
[[nodiscard]] std::string folded(std::string_view summary, std::string_view content);
/// <li> elements as lists of a size that a browser lays out at once when it comes into view: thousands of
/// elements of which each waits for that by itself take it seconds to hide.
[[nodiscard]] std::string row_lists(std::string_view kind, const std::vector<std::string>& rows);
/// One line of a list of facts: <dt>label</dt><dd>value</dd>, both markup; nothing where there is no value.
[[nodiscard]] std::string fact(std::string_view label, std::string_view value);

struct Column {
  std::string_view words;  ///< markup
  bool is_number = false;
};
/// A table that scrolls by itself where the page is narrow. `label` names it for who cannot see it; `rows`
/// are <tr> elements.
[[nodiscard]] std::string table(std::string_view label, std::string_view kind,
                                const std::vector<Column>& columns, std::string_view rows);
/// "<td class=num>"; nothing is told quietly.
[[nodiscard]] std::string number_cell(std::size_t number);

/// A frame of the capture as Wireshark numbers it: from 1.
[[nodiscard]] constexpr std::size_t frame_number(std::size_t capture_index) { return capture_index + 1; }

/// A number with one decimal at most, for coordinates.
[[nodiscard]] std::string coordinate(double value);

}  // namespace conform::reports::html
