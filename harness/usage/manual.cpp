// SPDX-License-Identifier: Apache-2.0
#include "usage/manual.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "usage/model.hpp"

namespace conform::usage {

const CommandPage* page_of(const Manual& manual, const CLI::App& command) {
  const auto found = std::ranges::find(manual.pages, path_of(command), &CommandPage::command);
  return found == manual.pages.end() ? nullptr : &*found;
}

void add_examples(CLI::App& app, const Manual& manual) {
  if (const auto* page = page_of(manual, app); page != nullptr && !page->examples.empty()) {
    std::string text = "Examples:";
    for (const auto& each : page->examples) text += fmt::format("\n  {}\n      {}", each.line, each.does);
    app.footer(text);
  }
  for (auto* sub : commands_of(app)) add_examples(*sub, manual);
}

std::string example_list(const Manual& manual) {
  std::string out;
  for (const auto& page : manual.pages) {
    for (const auto& each : page.examples) out += fmt::format("{}\t{}\n", each.exits, each.line);
  }
  return out;
}

}  // namespace conform::usage
