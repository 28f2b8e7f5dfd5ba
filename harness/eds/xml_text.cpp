// SPDX-License-Identifier: Apache-2.0
#include "eds/xml_text.hpp"

#include <algorithm>
#include <string>

#include "base/text.hpp"

namespace conform::eds {
namespace {

bool is_name_end(char c) { return std::string_view(" \t\r\n=/>").find(c) != std::string_view::npos; }

}  // namespace

XmlText::XmlText(std::string_view bytes) : bytes_(bytes) {
  lines_.push_back(0);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const bool end =
        bytes[i] == '\n' || (bytes[i] == '\r' && (i + 1 == bytes.size() || bytes[i + 1] != '\n'));
    if (end) lines_.push_back(i + 1);
  }
}

Position XmlText::position(std::size_t offset) const {
  const auto line = std::ranges::upper_bound(lines_, offset) - lines_.begin();
  return {static_cast<std::uint32_t>(line),
          static_cast<std::uint32_t>(offset - lines_[static_cast<std::size_t>(line - 1)] + 1)};
}

Position XmlText::position(const pugi::xml_node& node) const {
  const auto offset = node.offset_debug();
  // The offset is that of the name; the element begins with the '<' before it.
  return position(offset > 0 ? static_cast<std::size_t>(offset - 1) : 0);
}

Field XmlText::attribute(const pugi::xml_node& node, const char* name) const {
  const auto attribute = node.attribute(name);
  if (attribute.empty()) return {};
  Field out;
  out.text = std::string(trim(attribute.value()));
  out.present = true;
  out.key_at = out.at = position(node);
  const auto offset = node.offset_debug();
  if (offset < 0) return out;
  const std::string_view wanted = name;
  // Through the start tag, past the values, to the name of the attribute.
  auto at = static_cast<std::size_t>(offset);
  while (at < bytes_.size() && bytes_[at] != '>') {
    if (bytes_[at] == '"' || bytes_[at] == '\'') {
      at = bytes_.find(bytes_[at], at + 1);
      if (at == std::string_view::npos) return out;
      ++at;
      continue;
    }
    const auto here = bytes_.substr(at);
    if (here.starts_with(wanted) && here.size() > wanted.size() && is_name_end(here[wanted.size()]) &&
        is_name_end(bytes_[at - 1])) {
      out.key_at = position(at);
      const auto quote = bytes_.find_first_of("\"'", at);
      if (quote != std::string_view::npos) out.at = position(quote + 1);
      return out;
    }
    ++at;
  }
  return out;
}

Field XmlText::content(const pugi::xml_node& node) const {
  if (node.empty()) return {};
  Field out;
  out.text = std::string(trim(node.child_value()));
  out.present = true;
  out.key_at = out.at = position(node);
  return out;
}

std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const auto colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

pugi::xml_node child(const pugi::xml_node& node, std::string_view name) {
  for (const auto& each : node.children()) {
    if (local_name(each) == name) return each;
  }
  return {};
}

}  // namespace conform::eds
