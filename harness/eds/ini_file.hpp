// SPDX-License-Identifier: Apache-2.0
// The text layer of EDS and DCF (CiA 306): sections and entries as they stand in the file, each with its
// place. Nothing is decoded, nothing is dropped that could be meant, and what is not as the standard says is
// remarked.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/error.hpp"
#include "eds/position.hpp"

namespace conform::eds {

/// `key=value`. Both are raw bytes without the blanks around them, inside the text that the IniFile keeps.
struct IniEntry {
  std::string_view key;
  std::string_view value;
  Position key_at;
  Position value_at;  ///< of an empty value: behind the '='
};

/// A section and its entries in the order of the file, duplicates included.
struct IniSection {
  std::string name;  ///< as spelled, without blanks around it
  Position at;       ///< of the '['
  std::vector<IniEntry> entries;
  bool repeated = false;  ///< an earlier section has the name, in whatever case

  /// The first entry with this key in whatever case; nullptr when there is none.
  [[nodiscard]] const IniEntry* find(std::string_view key) const;
};

class IniFile {
 public:
  static constexpr std::size_t most_bytes = 16U * 1024U * 1024U;
  static constexpr std::size_t most_sections = 100'000;
  static constexpr std::size_t most_entries = 1'000'000;

  /// Splits `bytes` at any line end (LF, CRLF, CR, also mixed). Only what exceeds a limit is refused; the
  /// error says where. `file_name` is for messages.
  [[nodiscard]] static Result<IniFile> parse(std::string_view bytes, std::string_view file_name);

  [[nodiscard]] const std::vector<IniSection>& sections() const { return sections_; }
  /// The first section with this name in whatever case; nullptr when there is none.
  [[nodiscard]] const IniSection* find(std::string_view name) const;
  [[nodiscard]] const Remarks& remarks() const { return remarks_; }
  [[nodiscard]] std::size_t line_count() const { return line_count_; }

 private:
  friend class IniParser;
  std::shared_ptr<const std::string> text_;  ///< what the entries point into, also in a copy
  std::vector<IniSection> sections_;
  std::unordered_map<std::string, std::size_t> first_by_name_;  ///< lower case -> place in sections_
  Remarks remarks_;
  std::size_t line_count_ = 0;
};

constexpr char lower_ascii(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// The same of two texts of one length.
[[nodiscard]] bool same_letters(std::string_view a, std::string_view b);

/// Equal apart from the case of ASCII letters. Nearly all words that are compared differ in length or in the
/// first letter, or not at all.
[[nodiscard]] inline bool same_word(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  return a.empty() || (lower_ascii(a.front()) == lower_ascii(b.front()) && same_letters(a, b));
}

}  // namespace conform::eds
