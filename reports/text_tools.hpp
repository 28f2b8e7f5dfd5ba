// SPDX-License-Identifier: Apache-2.0
// Text for people: measuring, cutting and wrapping, and numbers as all writers print them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/time.hpp"

namespace conform::reports {

/// Columns on a terminal, counted as code points; `text` is valid UTF-8 (printable() made it so).
[[nodiscard]] std::size_t columns(std::string_view text);
/// `text` filled with blanks to at least `width` columns.
[[nodiscard]] std::string pad_right(std::string_view text, std::size_t width);
[[nodiscard]] std::string pad_left(std::string_view text, std::size_t width);
/// `text` cut to at most `width` columns; a cut shows as "...".
[[nodiscard]] std::string clip(std::string_view text, std::size_t width);
/// The same, but the end is kept.
[[nodiscard]] std::string clip_front(std::string_view text, std::size_t width);
/// `text` cut to at most `size` bytes at the end of a character; a cut shows as "...".
[[nodiscard]] std::string clip_bytes(std::string_view text, std::size_t size);
/// Lines of at most `width` columns, broken at blanks where possible; at least one line.
[[nodiscard]] std::vector<std::string> wrap(std::string_view text, std::size_t width);

/// Text of a catalogue or scenario as one line: blanks and line breaks collapse, the rest is made printable.
[[nodiscard]] std::string prose(std::string_view text);
/// Anything a device or a file said, for a log: printable, and without the marks that make CI systems obey a
/// line
/// ("::error::", "##[...]", "##vso[...]").
[[nodiscard]] std::string log_safe(std::string_view text);

/// A path of a file as a relative reference in a page: what URLs have a meaning for is percent-encoded, and
/// nothing in it is taken for a scheme.
[[nodiscard]] std::string url_path(std::string_view path);

/// "0.4 ms", "12 ms", "1.24 s", "3 min 05 s": how long something took, rounded for reading.
[[nodiscard]] std::string brief_duration(Duration duration);
/// Milliseconds with three decimals: "1.240", "-0.500".
[[nodiscard]] std::string milliseconds(Duration duration);
/// Seconds with exactly three decimals, never negative: "0.012".
[[nodiscard]] std::string seconds(Duration duration);
/// "2026-11-20T23:55:01Z"
[[nodiscard]] std::string utc_timestamp(std::int64_t utc_ns);
/// "1 case", "2 cases"
[[nodiscard]] std::string counted(std::size_t count, std::string_view noun);

}  // namespace conform::reports
