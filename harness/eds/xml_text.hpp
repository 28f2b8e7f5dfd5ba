// SPDX-License-Identifier: Apache-2.0
// Places in XML: pugixml knows the offset of an element, this finds its line and those of its attributes.
#pragma once

#include <pugixml.hpp>

#include <cstddef>
#include <string_view>
#include <vector>

#include "eds/eds.hpp"

namespace conform::eds {

/// The text of an XML file as it was before it was parsed.
class XmlText {
 public:
  explicit XmlText(std::string_view bytes);

  [[nodiscard]] Position position(std::size_t offset) const;
  [[nodiscard]] Position position(const pugi::xml_node& node) const;
  /// An attribute as a field: its value and the places of both; not present when there is none.
  [[nodiscard]] Field attribute(const pugi::xml_node& node, const char* name) const;
  /// The text inside an element as a field; not present when the node is null.
  [[nodiscard]] Field content(const pugi::xml_node& node) const;

 private:
  std::string_view bytes_;
  std::vector<std::size_t> lines_;  ///< where each begins
};

/// The name without the prefix of a namespace.
[[nodiscard]] std::string_view local_name(const pugi::xml_node& node);
/// The first child with this local name; a null node when there is none.
[[nodiscard]] pugi::xml_node child(const pugi::xml_node& node, std::string_view name);

}  // namespace conform::eds
