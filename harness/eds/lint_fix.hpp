// SPDX-License-Identifier: Apache-2.0
// What can be put right without knowing the device: counts, numbering, forms of writing. In XDD and XDC only
// counts and numbers that an attribute says.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "eds/ini_file.hpp"
#include "eds/lint.hpp"
#include "eds/text_lines.hpp"

namespace conform::eds {

/// `length` bytes from `offset` on are replaced by `text`; every other byte stays.
struct TextEdit {
  std::size_t offset = 0;
  std::size_t length = 0;
  std::string text;
};

struct Fix {
  std::string what;             ///< "write SubNumber=3"
  std::vector<TextEdit> edits;  ///< ascending, apart from each other
};

class Fixer {
 public:
  /// `bytes`, from which `file` was read, and `file` must outlive the fixer.
  Fixer(std::string_view bytes, const EdsFile& file);

  /// nullopt when the finding cannot be mended without knowing more: most cannot. Never changes what the file
  /// says of the device, apart from counts that contradict what they count.
  [[nodiscard]] std::optional<Fix> fix(const Finding& finding) const;

 private:
  friend class CountFixes;
  [[nodiscard]] std::optional<Fix> spelling(const Finding& finding) const;
  [[nodiscard]] std::optional<Fix> section_form(const Finding& finding) const;
  [[nodiscard]] std::optional<Fix> absent_list(const Finding& finding) const;
  [[nodiscard]] std::optional<Fix> replace(Position at, std::size_t length, std::string text,
                                           std::string what) const;
  /// Writes an entry with this value: over the one that is there, or as the first of the section.
  [[nodiscard]] std::optional<Fix> write(const Field& field, Position section, std::string_view key,
                                         const std::string& value) const;
  /// From a position to the end of the line, without blanks at the end; in XML up to the closing quote, and
  /// empty outside of quotes.
  [[nodiscard]] std::string_view value_at(Position at) const;

  std::string_view bytes_;
  const EdsFile& file_;
  TextLines lines_;
};

/// The text with the fixes; one that overlaps an earlier one is left out.
[[nodiscard]] std::string with_fixes(std::string_view bytes, const std::vector<Fix>& fixes);

}  // namespace conform::eds
