// SPDX-License-Identifier: Apache-2.0
// The page of `list --cct`.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/text.hpp"
#include "cli/pages/cct_cases.hpp"

namespace conform::cli {
namespace {

using Names = std::vector<std::string>;

/// SDO is what both tools have most of, and what a first look asks for; then the order of the tool.
std::vector<CctCase> sdo_first() {
  std::vector<CctCase> cases(cct_cases().begin(), cct_cases().end());
  std::ranges::stable_partition(cases, [](const CctCase& each) { return each.number.starts_with("2."); });
  return cases;
}

/// Names of one file on one line: "cia301/sdo/download: 16-bits, 8-bits".
std::string by_file(const std::map<std::string, Names>& files) {
  std::string out;
  for (const auto& [file, ids] : files) out += fmt::format("  {}\n      {}\n", file, join(ids, ", "));
  return out;
}

}  // namespace

CctNumbers::CctNumbers(const scenario::Suite& suite) {
  for (const auto& file : suite.files) {
    for (const auto& each : file.scenarios) marked_.insert(each.cct.begin(), each.cct.end());
  }
}

std::set<std::string> CctNumbers::of(const scenario::Scenario& scenario,
                                     const scenario::Catalogue& catalogue) const {
  std::set<std::string> out(scenario.cct.begin(), scenario.cct.end());
  for (const auto& id : scenario.requirements) {
    const auto* rule = catalogue.find(id);
    if (rule == nullptr) continue;
    for (const auto& number : rule->cct) {
      if (!marked_.contains(number)) out.insert(number);
    }
  }
  return out;
}

std::map<std::string, Names, std::less<>> scenarios_by_case(const scenario::Suite& suite,
                                                            const scenario::Catalogue& catalogue,
                                                            const scenario::Selection& selection) {
  std::map<std::string, Names, std::less<>> out;
  const CctNumbers numbers(suite);
  for (const auto& file : suite.files) {
    for (const auto& each : file.scenarios) {
      if (!selection.takes(each, "", catalogue)) continue;
      for (const auto& number : numbers.of(each, catalogue)) out[number].push_back(each.id);
    }
  }
  return out;
}

std::string cct_page(const scenario::Suite& suite, const scenario::Catalogue& catalogue,
                     const scenario::Selection& selection, bool everything) {
  const auto scenarios = scenarios_by_case(suite, catalogue, selection);
  std::map<std::string, Names, std::less<>> rules;
  std::map<std::string, Names> ours_alone;
  std::size_t alone = 0, chosen = 0;
  const CctNumbers numbers_of(suite);
  for (const auto& file : suite.files) {
    for (const auto& each : file.scenarios) {
      if (!selection.takes(each, "", catalogue)) continue;
      ++chosen;
      if (!numbers_of.of(each, catalogue).empty()) continue;
      ++alone;
      ours_alone[each.suite].push_back(each.id.substr(std::min(each.id.size(), each.suite.size() + 1)));
    }
  }
  for (const auto& rule : catalogue.all()) {
    for (const auto& number : rule.cct) rules[number].push_back(rule.id);
  }

  std::string out, without;
  std::string_view group;
  std::size_t matched = 0, missing = 0;
  for (const auto& each : sdo_first()) {
    const auto found = scenarios.find(each.number);
    const auto rule = rules.find(each.number);
    if (found == scenarios.end()) {
      ++missing;
      without += fmt::format("  {:6} {}: {}{}\n", each.number, each.group, each.title,
                             rule == rules.end() ? "" : " (" + join(rule->second, ", ") + ")");
      continue;
    }
    ++matched;
    if (group != each.group) out += fmt::format("{}{}\n", group.empty() ? "" : "\n", each.group);
    group = each.group;
    out += fmt::format("  {:6} {}\n", each.number, each.title);
    for (const auto& id : found->second) out += "           " + id + "\n";
    if (rule != rules.end()) out += "           rules " + join(rule->second, ", ") + "\n";
  }
  if (matched == 0) return {};
  if (!everything) return out + fmt::format("\n{} cases of CiA's tool\n", matched);
  if (missing > 0) out += "\nCases of CiA's tool without a scenario here\n" + without;
  if (alone > 0) out += "\nScenarios without a case in CiA's tool\n" + by_file(ours_alone);
  return out + fmt::format("\n{} cases of CiA's tool: {} with scenarios here, {} without\n"
                           "{} scenarios: {} with a case in CiA's tool, {} without\n",
                           matched + missing, matched, missing, chosen, chosen - alone, alone);
}

}  // namespace conform::cli
