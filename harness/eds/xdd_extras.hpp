// SPDX-License-Identifier: Apache-2.0
// What an XDD says beyond CiA 306: lists of LEDs, units, groups of parameters. The model has no place for it;
// it is counted, so that a conversion can tell what it leaves behind.
#pragma once

#include <pugixml.hpp>

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "eds/eds.hpp"
#include "eds/xml_text.hpp"

namespace conform::eds {

class XddExtras {
 public:
  explicit XddExtras(const XmlText& text) : text_(text) {}

  /// Notes what the element itself says; its children are looked at on their own.
  void look(const pugi::xml_node& node);
  void note(std::string_view what, const pugi::xml_node& node);
  /// In the order of the file.
  [[nodiscard]] std::vector<Unmodelled> take();

 private:
  const XmlText& text_;
  std::map<std::string, Unmodelled, std::less<>> found_;
};

/// The one characteristic that an XDD must have and that a conversion writes: it says nothing new.
inline constexpr const char* filler_name = "Communication profile";
inline constexpr const char* filler_content = "CiA 301";

}  // namespace conform::eds
