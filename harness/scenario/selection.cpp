// SPDX-License-Identifier: Apache-2.0
#include "scenario/selection.hpp"

#include <algorithm>

namespace conform::scenario {
namespace {

// Linear time, no recursion: a hostile pattern cannot hang the command line.
bool glob(std::string_view pattern, std::string_view text) {
  std::size_t p = 0, t = 0, star = std::string_view::npos, mark = 0;
  while (t < text.size()) {
    if (p < pattern.size() && (pattern[p] == '?' || (pattern[p] == text[t] && pattern[p] != '*'))) {
      ++p;
      ++t;
    } else if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      mark = t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++mark;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

}  // namespace

bool matches_pattern(std::string_view pattern, std::string_view id) {
  if (pattern.ends_with('/')) pattern.remove_suffix(1);
  if (pattern.ends_with(".yaml")) pattern.remove_suffix(5);
  if (glob(pattern, id)) return true;
  // "cia301/dictionary" takes everything below it, and a scenario's id takes all its instances.
  return glob(std::string(pattern) + "/*", id) || glob(std::string(pattern) + "[*", id);
}

bool Selection::takes(const Scenario& scenario, std::string_view instance, const Catalogue& catalogue) const {
  const auto name = instance.empty() ? scenario.id : scenario.id + "[" + std::string(instance) + "]";
  const auto hit = [&name](const std::string& pattern) { return matches_pattern(pattern, name); };
  if (!patterns.empty() && std::ranges::none_of(patterns, hit)) return false;
  if (std::ranges::any_of(excludes, hit)) return false;
  return wants_one_of(scenario.requirements, catalogue);
}

bool Selection::takes_any_of(const Scenario& scenario, const Catalogue& catalogue) const {
  return wants_one_of(scenario.requirements, catalogue);
}

bool Selection::takes_monitor(std::string_view id, const std::vector<std::string>& decides,
                              const Catalogue& catalogue) const {
  const auto hit = [id](const std::string& pattern) { return matches_pattern(pattern, id); };
  const bool about_monitors = std::ranges::any_of(
      patterns, [](const std::string& pattern) { return pattern.starts_with("monitor"); });
  if (about_monitors && std::ranges::none_of(patterns, hit)) return false;
  if (std::ranges::any_of(excludes, hit)) return false;
  return wants_one_of(decides, catalogue);
}

bool Selection::wants_one_of(const std::vector<std::string>& decides, const Catalogue& catalogue) const {
  if (requirements.empty()) return true;
  return std::ranges::any_of(requirements, [&](const std::string& wanted) {
    const auto* known = catalogue.find(wanted);
    const std::string& pattern = known != nullptr ? known->id : wanted;
    return std::ranges::any_of(decides, [&](const std::string& id) { return glob(pattern, id); });
  });
}

}  // namespace conform::scenario
