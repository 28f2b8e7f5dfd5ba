// SPDX-License-Identifier: Apache-2.0
// The lines of a file, ended as the readers of descriptions take them: LF, CR LF or CR, also mixed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "eds/position.hpp"

namespace conform::eds {

/// Where the line that `from` is in ends; the size of the text when nothing ends it.
[[nodiscard]] std::size_t end_of_line(std::string_view bytes, std::size_t from);

/// The same for one line after the other. Where no CR is in the text, as in most, only LF is looked for.
class LineEnds {
 public:
  explicit LineEnds(std::string_view bytes) : bytes_(bytes), returns_(bytes.contains('\r')) {}
  [[nodiscard]] std::size_t from(std::size_t begin) const {
    return returns_ ? end_of_line(bytes_, begin) : std::min(bytes_.find('\n', begin), bytes_.size());
  }

 private:
  std::string_view bytes_;
  bool returns_;
};

class TextLines {
 public:
  /// `bytes` must outlive the lines. A byte order mark belongs to no line.
  explicit TextLines(std::string_view bytes);

  [[nodiscard]] std::size_t count() const { return starts_.size(); }
  /// Without its end; empty when there is no such line. Lines count from 1.
  [[nodiscard]] std::string_view line(std::size_t number) const;
  /// Where the line begins; the end of the file when there is no such line.
  [[nodiscard]] std::size_t start(std::size_t number) const;
  /// Of the byte at a position; nullopt when it is not in the file.
  [[nodiscard]] std::optional<std::size_t> offset(Position at) const;
  [[nodiscard]] Position position(std::size_t offset) const;
  /// How lines end, by the first that does; LF when none does.
  [[nodiscard]] std::string_view line_end() const;

 private:
  std::string_view bytes_;
  std::vector<std::size_t> starts_;
};

}  // namespace conform::eds
