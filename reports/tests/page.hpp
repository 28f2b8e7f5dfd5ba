// SPDX-License-Identifier: Apache-2.0
// What holds for every page, whatever it tells.
#pragma once

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

#include <pugixml.hpp>

#include "catch.hpp"

namespace conform::reports::testing {

inline bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

/// The page as XML; it must be well-formed.
inline pugi::xml_document parsed(const std::string& page) {
  pugi::xml_document document;
  const auto outcome = document.load_buffer(page.data(), page.size(),
                                            pugi::parse_default | pugi::parse_doctype, pugi::encoding_utf8);
  INFO(outcome.description() << " at " << page.substr(static_cast<std::size_t>(outcome.offset), 80));
  REQUIRE(outcome);
  return document;
}

inline std::string text_of(const pugi::xml_node& node) {
  std::string out;
  for (const auto& found : node.select_nodes(".//text()")) out += found.node().value();
  return out;
}
inline std::string text_of(const pugi::xml_document& document, const char* where) {
  return text_of(document.select_node(where).node());
}

/// Ids are unique, and whatever names one names one that is there.
inline void check_names(const pugi::xml_document& document) {
  std::set<std::string> ids;
  for (const auto& found : document.select_nodes("//@id"))
    CHECK(ids.insert(found.attribute().value()).second);
  for (const auto& found : document.select_nodes("//@href")) {
    const std::string target = found.attribute().value();
    INFO(target);
    REQUIRE(target.starts_with("#"));
    CHECK(ids.contains(target.substr(1)));
  }
  for (const auto& found : document.select_nodes("//@aria-labelledby"))
    CHECK(ids.contains(found.attribute().value()));
  for (const auto& found : document.select_nodes("//label/@for"))
    CHECK(ids.contains(found.attribute().value()));
}

/// Headings begin with one of the first level and skip none.
inline void check_headings(const pugi::xml_document& document) {
  int before = 0;
  for (const auto& found : document.select_nodes("//h1|//h2|//h3|//h4|//h5")) {
    const int level = found.node().name()[1] - '0';
    INFO(text_of(found.node()));
    CHECK(level <= before + 1);
    before = level;
  }
  CHECK(document.select_nodes("//h1").size() == 1);
  CHECK(document.select_nodes("//main").size() == 1);
}

/// Nothing is fetched, and only our own style and script are obeyed.
inline void check_alone(const pugi::xml_document& document) {
  CHECK(document.select_nodes("//@src|//link|//iframe|//object|//embed|//img|//base").empty());
  // A policy without 'unsafe-inline' ignores these, so a page that needed them would be broken.
  CHECK(document.select_nodes("//@style|//@onclick|//@onload").empty());
  CHECK(document.select_nodes("//script").size() == 1);
  CHECK(document.select_nodes("//style").size() == 1);
  const std::string policy =
      document.select_node("//meta[@http-equiv='Content-Security-Policy']/@content").attribute().value();
  CHECK(policy.starts_with("default-src 'none'; style-src 'sha256-"));
  CHECK(contains(policy, "script-src 'sha256-"));
  CHECK_FALSE(contains(policy, "unsafe"));
}

/// No byte of a device is a control character of it.
inline bool has_control_characters(std::string_view page) {
  return std::ranges::any_of(page, [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7F;
  });
}

}  // namespace conform::reports::testing
