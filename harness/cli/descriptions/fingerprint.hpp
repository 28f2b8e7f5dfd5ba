// SPDX-License-Identifier: Apache-2.0
// What makes a finding the same finding in another version of the file: not its line.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "eds/lint.hpp"
#include "eds/text_lines.hpp"

namespace conform::cli {

/// Places as a person names them.
class FindingPlaces {
 public:
  /// `bytes` must outlive this.
  FindingPlaces(std::string_view bytes, bool xml);
  /// "[1018sub1] DefaultValue", "[1018]"; in XML "1018h", "1018h:01"; empty above everything.
  [[nodiscard]] std::string name(eds::Position at) const;

 private:
  [[nodiscard]] std::string in_xml(eds::Position at) const;

  std::string_view bytes_;
  bool xml_;
  eds::TextLines lines_;
  std::vector<std::size_t> sections_;        ///< lines, ascending
  std::vector<std::size_t> objects_, subs_;  ///< offsets of start tags in XML, ascending
};

/// 32 hexadecimal digits of code, place and message; of equal ones the second has ":2" behind it.
[[nodiscard]] std::vector<std::string> fingerprints(const eds::LintReport& report,
                                                    const FindingPlaces& places);

}  // namespace conform::cli
