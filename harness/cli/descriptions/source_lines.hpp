// SPDX-License-Identifier: Apache-2.0
// Lines of a description, to quote them and to count their characters.
#pragma once

#include <string>
#include <string_view>

#include "eds/lint.hpp"
#include "eds/text_lines.hpp"

namespace conform::cli {

class SourceLines {
 public:
  /// `text` must outlive this.
  explicit SourceLines(std::string_view text) : lines_(text) {}

  /// In code points, as editors and SARIF count; positions count bytes. Ascending positions are counted once.
  [[nodiscard]] int column(eds::Position at);
  /// Two lines to print: the line of the place, and a caret below it.
  [[nodiscard]] std::string excerpt_at(eds::Position at, std::string_view tint, std::string_view off) const;

 private:
  eds::TextLines lines_;
  eds::Position counted_;  ///< up to where `counted_column_` has counted
  int counted_column_ = 1;
};

/// "message; hint", escaped.
[[nodiscard]] std::string with_hint(const eds::Finding& finding);

}  // namespace conform::cli
