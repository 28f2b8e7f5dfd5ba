// SPDX-License-Identifier: Apache-2.0
// The text of one input file and the way from a byte offset to what an editor calls line and column.
#pragma once

#include <compare>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace conform::yaml {

/// Both count from 1; a column is a code point, as editors count, not a byte.
struct Position {
  int line = 1;
  int column = 1;
  friend constexpr auto operator<=>(const Position&, const Position&) = default;
};

/// "14:19"
[[nodiscard]] std::string to_string(Position position);

/// Immutable, shared by the diagnostics that quote it. A byte order mark is dropped and CR LF becomes LF, so
/// that offsets mean the same here and in the parser.
class Source {
 public:
  Source(std::string name, std::string_view text);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::string_view text() const { return text_; }
  /// A last line without a newline counts; a text that ends in a newline has no empty line after it.
  [[nodiscard]] int line_count() const;
  /// Without its newline; empty when there is no such line.
  [[nodiscard]] std::string_view line(int number) const;
  /// The end of the text is behind the last character of its last line.
  [[nodiscard]] Position position(std::size_t offset) const;
  /// The byte offset of a position, clipped to its line.
  [[nodiscard]] std::size_t offset(Position position) const;

 private:
  std::string name_;
  std::string text_;
  std::vector<std::size_t> line_starts_;
};

using SourcePtr = std::shared_ptr<const Source>;

[[nodiscard]] SourcePtr make_source(std::string name, std::string_view text);

}  // namespace conform::yaml
