// SPDX-License-Identifier: Apache-2.0
// What every page has in common, whatever it tells: one file that needs nothing but itself, its style and its
// script, the sections and the way to them, the filter, and the policy that forbids the rest.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace conform::reports::html {

/// A box of the filter: it leaves only rows whose `data-v` is `value`.
struct Choice {
  std::string_view value;  ///< stands in the address of the page: "worse"
  std::string_view kind;   ///< class that lends the shape: "fail"
  std::string_view words;
  std::size_t count = 0;  ///< of rows
};

/// Rows are elements with `data-v` in a section() that has nouns for them.
struct Filter {
  std::string_view of;     ///< "requirements and cases"
  std::string_view boxes;  ///< "verdicts"
  std::string_view hint;   ///< what one can search: "object, requirement, case"
  std::vector<Choice> choices;
};

struct Part {
  std::string_view id, words;  ///< of the section, and of the link to it
  std::string content;         ///< the whole <section>; empty: there is none
};

/// Markup, but for the words of the filter and of the parts, which are ours.
struct Document {
  std::string title;
  std::string brand;      ///< beside the links at the top: "CANopen conformance report"
  std::string generator;  ///< the tool
  std::string footer;     ///< one sentence
  Filter filter;
  std::vector<Part> parts;  ///< the first one is what a reader is led to
};

/// Well-formed XML as well. Nothing is fetched, and only the style and the script of ours are obeyed.
[[nodiscard]] std::string document(const Document& page);

/// What its rows are called, so that the filter can count them.
struct Nouns {
  std::string_view one, many;
};
/// A section with its heading of the second level; `title` is markup. Empty where there is no content.
[[nodiscard]] std::string section(std::string_view id, std::string_view title, const std::string& content,
                                  Nouns rows = {});

}  // namespace conform::reports::html
