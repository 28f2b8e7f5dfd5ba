// SPDX-License-Identifier: Apache-2.0
#include "eds/section_name.hpp"

#include <charconv>
#include <string>

#include "base/text.hpp"

namespace conform::eds {
namespace {

struct Word {
  std::string_view name;  // lower case
  SectionKind kind;
};

constexpr Word fixed_names[] = {
    {"fileinfo", SectionKind::file_info},
    {"deviceinfo", SectionKind::device_info},
    {"dummyusage", SectionKind::dummy_usage},
    {"devicecomissioning", SectionKind::commissioning},
    {"devicecommissioning", SectionKind::commissioning},
    {"mandatoryobjects", SectionKind::mandatory_objects},
    {"optionalobjects", SectionKind::optional_objects},
    {"manufacturerobjects", SectionKind::manufacturer_objects},
    {"comments", SectionKind::comments},
    {"tools", SectionKind::tools},
    {"dynamicchannels", SectionKind::dynamic_channels},
    {"supportedmodules", SectionKind::supported_modules},
    {"connectedmodules", SectionKind::connected_modules},
};

constexpr Word after_index[] = {
    {"name", SectionKind::names},
    {"value", SectionKind::values},
    {"denotation", SectionKind::denotations},
    {"objectlinks", SectionKind::links},
};

constexpr Word after_module[] = {
    {"moduleinfo", SectionKind::module_info},
    {"comments", SectionKind::module_comments},
    {"fixedobjects", SectionKind::fixed_list},
    {"subextends", SectionKind::extension_list},
};

bool is_hex_digit(char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); }

/// The hexadecimal digits at the front, cut off `text`; a 0x before them and leading zeros are odd.
std::optional<std::uint32_t> hex_prefix(std::string_view& text, std::size_t usual_digits, bool& odd) {
  if (text.starts_with("0x")) {
    text.remove_prefix(2);
    odd = true;
  }
  std::size_t count = 0;
  while (count < text.size() && is_hex_digit(text[count])) ++count;
  // The first letters of this word are hexadecimal digits as well.
  if (usual_digits != 0 && count > usual_digits && text.substr(usual_digits).starts_with("denotation"))
    count = usual_digits;
  if (count == 0 || count > 8) return std::nullopt;
  std::uint32_t value = 0;
  for (const char c : text.substr(0, count))
    value = value * 16U + static_cast<std::uint32_t>(c <= '9' ? c - '0' : c - 'a' + 10);
  if (usual_digits != 0 ? count != usual_digits : count > 1 && text.front() == '0') odd = true;
  text.remove_prefix(count);
  return value;
}

/// What follows an index: nothing, sub..., or one of the words.
SectionName object_name(std::string_view text, SectionKind object, SectionKind sub_object) {
  SectionName out;
  const auto original = text;
  const auto index = hex_prefix(text, 4, out.odd_form);
  if (!index || *index > 0xFFFF) return {};
  // A word such as "fade" or "5" is an index only when it looks like one.
  if (out.odd_form && (original.front() < '0' || original.front() > '9')) return {};
  out.index = Index(static_cast<std::uint16_t>(*index));
  if (text.empty()) {
    out.kind = object;
    return out;
  }
  const auto word = trim(text);
  if (word.starts_with("sub")) {
    auto rest = trim(word.substr(3));
    out.odd_form = out.odd_form || word.size() != text.size() || rest.size() + 3 != word.size();
    const auto sub = hex_prefix(rest, 0, out.odd_form);
    if (!sub || *sub > 0xFF || !rest.empty()) return {};
    out.sub = SubIndex(static_cast<std::uint8_t>(*sub));
    out.kind = sub_object;
    return out;
  }
  if (object == SectionKind::object) {
    for (const auto& row : after_index) {
      if (word == row.name) out.kind = row.kind;
    }
  }
  return out.kind == SectionKind::unknown ? SectionName{} : out;
}

SectionName module_name(std::string_view text) {
  SectionName out;
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, 10);
  if (error != std::errc()) return {};
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  for (const auto& row : after_module) {
    if (text == row.name) out.kind = row.kind;
  }
  if (out.kind == SectionKind::unknown) {
    if (text.starts_with("fixed"))
      out = object_name(text.substr(5), SectionKind::fixed_object, SectionKind::fixed_sub_object);
    else if (text.starts_with("subext"))
      out = object_name(text.substr(6), SectionKind::extension, SectionKind::unknown);
  }
  out.module = number;
  return out;
}

}  // namespace

SectionName parse_section_name(std::string_view name) {
  const std::string text = lower(trim(name));
  if (text.empty()) return {};
  for (const auto& row : fixed_names) {
    if (text == row.name) {
      SectionName out;
      out.kind = row.kind;
      return out;
    }
  }
  if (text.starts_with("toolinfo") ||
      (text.starts_with("tool") && text.size() > 4 && text[4] >= '0' && text[4] <= '9')) {
    SectionName out;
    out.kind = SectionKind::tools;
    return out;
  }
  if (is_hex_digit(text.front())) {
    const auto out = object_name(text, SectionKind::object, SectionKind::sub_object);
    if (out.kind != SectionKind::unknown) return out;
  }
  if (text.front() == 'm') return module_name(std::string_view(text).substr(1));
  return {};
}

}  // namespace conform::eds
