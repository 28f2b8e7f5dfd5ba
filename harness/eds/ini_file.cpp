// SPDX-License-Identifier: Apache-2.0
#include "eds/ini_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <unordered_set>
#include <utility>

#include "base/text.hpp"
#include "eds/text_lines.hpp"

namespace conform::eds {
namespace {

constexpr std::size_t longest_line = 255;  // CiA 306: characters of a line
constexpr std::string_view utf8_mark = "\xEF\xBB\xBF";
constexpr char dos_end = '\x1A';  ///< what programs of DOS put behind the text

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

// Nearly all texts begin and end with something else.
std::size_t leading_blanks(std::string_view text) {
  std::size_t count = 0;
  while (count < text.size() && is_blank(text[count])) ++count;
  return count;
}

std::string_view without_blanks(std::string_view text) {
  text.remove_prefix(leading_blanks(text));
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

Position at(std::size_t line, std::size_t offset) {
  return {static_cast<std::uint32_t>(line), static_cast<std::uint32_t>(offset + 1)};
}

/// Without the end-of-file mark of DOS and the line ends around it, when it is the last of the text.
std::string_view without_end_mark(std::string_view text) {
  const auto last = text.find_last_not_of("\r\n");
  if (last == std::string_view::npos || text[last] != dos_end) return text;
  const auto end = text.find_last_not_of(dos_end, last);
  return text.substr(0, end == std::string_view::npos ? 0 : end + 1);
}

bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte < 0x20 && !is_blank(c)) || byte == 0x7F;
}

enum class LineEnd { none, lf, crlf, cr };

}  // namespace

bool same_letters(std::string_view a, std::string_view b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] != b[i] && lower_ascii(a[i]) != lower_ascii(b[i])) return false;
  }
  return true;
}

const IniEntry* IniSection::find(std::string_view key) const {
  const auto found =
      std::ranges::find_if(entries, [key](const auto& entry) { return same_word(entry.key, key); });
  return found == entries.end() ? nullptr : &*found;
}

const IniSection* IniFile::find(std::string_view name) const {
  const auto found = first_by_name_.find(lower(name));
  return found == first_by_name_.end() ? nullptr : &sections_[found->second];
}

/// Goes through the text line by line.
class IniParser {
 public:
  IniParser(std::string_view bytes, std::string_view file_name) : bytes_(bytes), file_name_(file_name) {}

  Result<IniFile> parse() {
    if (bytes_.size() > IniFile::most_bytes) {
      return fail(
          fmt::format("the file has {} bytes; at most {} are read", bytes_.size(), IniFile::most_bytes),
          place({1, 1}));
    }
    file_.text_ = std::make_shared<const std::string>(bytes_);
    bytes_ = without_end_mark(*file_.text_);
    // Of most files one look is enough.
    only_plain_ = std::ranges::none_of(bytes_, [](char c) {
      return static_cast<unsigned char>(c) >= 0x80 || (is_control(c) && c != '\r' && c != '\n');
    });
    const auto sections = std::min<std::size_t>(static_cast<std::size_t>(std::ranges::count(bytes_, '[')),
                                                IniFile::most_sections);
    file_.sections_.reserve(sections);
    file_.first_by_name_.reserve(sections);
    std::size_t begin = 0;
    if (bytes_.starts_with(utf8_mark)) {
      remark(Deviation::byte_order_mark, 0);
      begin = utf8_mark.size();
    }
    const LineEnds ends(bytes_);
    while (begin < bytes_.size() && !refused_) {
      const auto end = ends.from(begin);
      line(bytes_.substr(begin, end - begin));
      begin = end;
      if (begin == bytes_.size()) break;
      const auto kind = bytes_[begin] == '\n'                                    ? LineEnd::lf
                        : begin + 1 < bytes_.size() && bytes_[begin + 1] == '\n' ? LineEnd::crlf
                                                                                 : LineEnd::cr;
      line_end(kind);
      begin += kind == LineEnd::crlf ? 2 : 1;
    }
    if (refused_) return std::unexpected(*refused_);
    file_.line_count_ = number_;
    return std::move(file_);
  }

 private:
  std::string place(Position position) const {
    return fmt::format("{}:{}:{}", file_name_, position.line, position.column);
  }

  void remark(Deviation what, std::size_t offset, std::string_view detail = {}, Position first = {}) {
    file_.remarks_.add(what, at(std::max<std::size_t>(number_, 1), offset), detail, first);
  }

  void line_end(LineEnd kind) {
    const auto offset = line_.size();
    if (first_end_ == LineEnd::none) first_end_ = kind;
    if (kind == LineEnd::cr && !std::exchange(said_cr_, true))
      remark(Deviation::carriage_return_only, offset);
    if (kind != first_end_ && !std::exchange(said_mixed_, true)) remark(Deviation::mixed_line_ends, offset);
  }

  void line(std::string_view text) {
    line_ = text;
    ++number_;
    if (text.size() > longest_line) remark(Deviation::long_line, longest_line, std::to_string(text.size()));
    look_at_characters(text);
    const auto lead = leading_blanks(text);
    const auto body = without_blanks(text);
    if (body.empty()) return;
    switch (body.front()) {
      case ';':
        if (lead > 0) remark(Deviation::indented_comment, lead, body);
        return;
      case '#': return remark(Deviation::hash_comment, lead, body);
      case '[': return section(body, lead);
      default: return entry(text, body, lead);
    }
  }

  void look_at_characters(std::string_view text) {
    if (only_plain_) return;
    const auto high =
        std::ranges::find_if(text, [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
    if (high != text.end()) {
      const auto offset = static_cast<std::size_t>(high - text.begin());
      remark(Deviation::non_ascii, offset, text.substr(offset, 1));
    }
    const auto control = std::ranges::find_if(text, is_control);
    if (control != text.end()) {
      const auto offset = static_cast<std::size_t>(control - text.begin());
      remark(Deviation::control_character, offset, text.substr(offset, 1));
    }
  }

  void section(std::string_view body, std::size_t lead) {
    if (lead > 0) remark(Deviation::indented_section, lead, body);
    const auto close = body.find(']');
    std::string_view inside;
    if (close == std::string_view::npos) {
      remark(Deviation::unclosed_section, lead, body);
      // A comment behind the name is no part of it.
      inside = body.substr(1, body.find_first_of(";#") - 1);
    } else {
      inside = body.substr(1, close - 1);
      const auto rest = body.substr(close + 1);
      const auto text = leading_blanks(rest);
      if (text < rest.size())
        remark(Deviation::text_after_section, lead + close + 1 + text, rest.substr(text));
    }
    const auto name = without_blanks(inside);
    if (name.empty()) remark(Deviation::empty_section_name, lead);
    if (name.size() != inside.size()) remark(Deviation::blank_in_section_name, lead + 1, body);
    if (file_.sections_.size() >= IniFile::most_sections) {
      refused_ =
          Error{fmt::format("more than {} sections", IniFile::most_sections), place(at(number_, lead)), {}};
      return;
    }
    const auto [known, is_new] = file_.first_by_name_.try_emplace(lower(name), file_.sections_.size());
    if (!is_new && !name.empty())
      remark(Deviation::duplicate_section, lead, name, file_.sections_[known->second].at);
    file_.sections_.push_back({std::string(name), at(number_, lead), {}, !is_new});
    file_.sections_.back().entries.reserve(8);  // as many as an object has, mostly
  }

  void entry(std::string_view text, std::string_view body, std::size_t lead) {
    const auto equals = text.find('=');
    if (equals == std::string_view::npos) {
      // The end-of-file mark of DOS, or what a deleted text left behind, has been remarked already.
      if (!std::ranges::all_of(body, is_control)) remark(Deviation::junk_line, lead, body);
      return;
    }
    const auto key = without_blanks(text.substr(0, equals));
    if (key.empty()) return remark(Deviation::no_key, lead, body);
    if (lead > 0 || key.size() != equals) remark(Deviation::blank_around_key, lead, key);
    if (file_.sections_.empty()) return remark(Deviation::entry_outside_section, lead, body);
    if (++entries_ > IniFile::most_entries) {
      refused_ =
          Error{fmt::format("more than {} entries", IniFile::most_entries), place(at(number_, lead)), {}};
      return;
    }
    const auto behind = text.substr(equals + 1);
    const auto value = without_blanks(behind);
    const auto value_offset = equals + 1 + (value.empty() ? 0 : leading_blanks(behind));
    file_.sections_.back().entries.push_back({key, value, at(number_, lead), at(number_, value_offset)});
  }

  std::string_view bytes_;
  std::string_view file_name_;
  IniFile file_;
  std::optional<Error> refused_;
  std::string_view line_;
  std::size_t number_ = 0;
  std::size_t entries_ = 0;
  LineEnd first_end_ = LineEnd::none;
  bool only_plain_ = false;
  bool said_cr_ = false;
  bool said_mixed_ = false;
};

Result<IniFile> IniFile::parse(std::string_view bytes, std::string_view file_name) {
  return IniParser(bytes, file_name).parse();
}

}  // namespace conform::eds
