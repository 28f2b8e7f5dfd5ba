// SPDX-License-Identifier: Apache-2.0
// `explain`: a requirement, a verb, a defect, or the words conditions are made of.
#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "cli/commands.hpp"
#include "cli/suite_folder.hpp"
#include "cli/terminal.hpp"
#include "defects/defect.hpp"
#include "steps/condition.hpp"
#include "steps/step.hpp"

namespace conform::cli {
namespace {

std::string paragraph(std::string_view label, const std::string& text) {
  return text.empty() ? "" : fmt::format("  {:9} {}\n", label, text);
}

std::string explain_requirement(const scenario::Requirement& requirement, const LoadedSuites& suites) {
  auto out = fmt::format("{}  {}\n\n  {}\n\n", requirement.id, requirement.area, requirement.statement);
  out += paragraph("clause", requirement.clause);
  out += paragraph("object", requirement.object);
  out += paragraph("level", requirement.level);
  out += paragraph("applies", requirement.applies);
  out += paragraph("passes", requirement.passes);
  out += paragraph("warns", requirement.warns);
  out += paragraph("fails", requirement.fails);
  out += paragraph("risk", requirement.risk);
  out += paragraph("same as", join(requirement.same_as, ", "));
  out += paragraph("CCT", join(requirement.cct, ", "));
  out += paragraph("proof", requirement.proof.empty() ? "" : requirement.proof + ": " + requirement.proof_reason);
  out += paragraph("note", requirement.note);
  out += paragraph("source", "suites/" + requirement.file + ":" + std::to_string(requirement.line));
  std::string scenarios;
  for (const auto& file : suites.suite.files) {
    for (const auto& each : file.scenarios) {
      if (std::ranges::find(each.requirements, requirement.id) == each.requirements.end()) continue;
      scenarios += "    " + each.id + "\n";
    }
  }
  out += scenarios.empty() ? "\n  No scenario decides it yet.\n" : "\n  Decided by\n" + scenarios;
  std::string defects;
  for (const auto& defect : refnode::defects()) {
    for (const auto id : defect.violates) {
      if (suites.catalogue.canonical(id) == requirement.id) defects += fmt::format("    {}: {}\n", defect.id, defect.summary);
    }
  }
  if (!defects.empty()) out += "\n  Defects of the reference node that violate it\n" + defects;
  return out;
}

std::string explain_verb(const steps::Verb& verb) {
  auto out = fmt::format("{}: {}\n\n", verb.name, verb.summary);
  for (const auto line : split(verb.parameters, '\n')) out += "  " + std::string(line) + "\n";
  out += "\nExample\n";
  for (const auto line : split(verb.example, '\n')) out += "  " + std::string(line) + "\n";
  return out;
}

}  // namespace

int explain_command(const ExplainCommand& options) {
  auto root = find_suites(options.suites);
  if (!root) return report_error(root.error(), exit_usage);
  auto suites = load_suites(*root, use_colour("auto", 2));
  if (!suites) return report_error(suites.error(), exit_usage);
  if (const auto* requirement = suites->catalogue.find(options.topic)) {
    print(explain_requirement(*requirement, *suites));
    return 0;
  }
  if (const auto* verb = steps::find_verb(options.topic)) {
    print(explain_verb(*verb));
    return 0;
  }
  if (options.topic == "verbs") {
    std::string out;
    for (const auto& verb : steps::verbs()) out += fmt::format("  {:14} {}\n", verb.name, verb.summary);
    out += fmt::format("  {:14} {}\n", "over", "Walk over values inside one step and tell the offenders in one finding.");
    print(out);
    return 0;
  }
  if (options.topic == "conditions") {
    std::string out = "Conditions (when, unless, require) are made of\n";
    for (const auto form : steps::condition_forms()) out += "  " + std::string(form) + "\n";
    print(out);
    return 0;
  }
  if (const auto* defect = refnode::find_defect(options.topic)) {
    std::vector<std::string> ids(defect->violates.begin(), defect->violates.end());
    print(fmt::format("{}: {}\n  violates {}\n", defect->id, defect->summary, join(ids, ", ")));
    return 0;
  }
  auto known = suites->catalogue.ids();
  for (const auto& verb : steps::verbs()) known.push_back(verb.name);
  for (const auto& defect : refnode::defects()) known.push_back(defect.id);
  const auto near = did_you_mean(options.topic, known);
  return report_error({"nothing is known about '" + options.topic + "'", {},
                       near.empty() ? "a requirement id, a verb, a defect, 'verbs' or 'conditions'" : "did you mean '" + std::string(near) + "'?"},
                      exit_usage);
}

}  // namespace conform::cli
