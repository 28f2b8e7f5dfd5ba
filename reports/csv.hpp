// SPDX-License-Identifier: Apache-2.0
// Rows for spreadsheets, of text that others wrote.
#pragma once

#include <span>
#include <string>

namespace conform::reports {

/// RFC 4180, with its end of line. A device may call itself "=cmd|...": what a spreadsheet would run gets an
/// apostrophe in front.
[[nodiscard]] std::string csv_line(std::span<const std::string> cells);

}  // namespace conform::reports
