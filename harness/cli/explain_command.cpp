// SPDX-License-Identifier: Apache-2.0
// `explain`: a requirement, a scenario, a monitor, a verb, a defect, a variant, or the words conditions are
// made of.
#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "cli/commands.hpp"
#include "cli/coverage.hpp"
#include "cli/suite_folder.hpp"
#include "cli/terminal.hpp"
#include "defects/defect.hpp"
#include "monitor/watch.hpp"
#include "steps/condition.hpp"
#include "steps/step.hpp"
#include "variants/variant.hpp"

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
  out += paragraph("proof",
                   requirement.proof.empty() ? "" : requirement.proof + ": " + requirement.proof_reason);
  out += paragraph("left out", requirement.not_judged);
  out += paragraph("to come with", requirement.planned);
  out += paragraph("note", requirement.note);
  out += paragraph("source", "suites/" + requirement.file + ":" + std::to_string(requirement.line));
  std::string scenarios;
  for (const auto& file : suites.suite.files) {
    for (const auto& each : file.scenarios) {
      if (std::ranges::find(each.requirements, requirement.id) == each.requirements.end()) continue;
      scenarios += "    " + each.id + "\n";
    }
  }
  for (const auto& rule : monitor::rules()) {
    if (std::ranges::find(rule.requirements, requirement.id) != rule.requirements.end())
      scenarios += "    " + monitor::case_id(rule) + "\n";
  }
  out += scenarios.empty() ? "\n  No scenario decides it yet.\n" : "\n  Decided by\n" + scenarios;
  std::string defects;
  for (const auto& defect : refnode::defects()) {
    // Several of the ids a row names may be one rule by now.
    const bool violates = std::ranges::any_of(defect.violates, [&](std::string_view id) {
      return suites.catalogue.canonical(id) == requirement.id;
    });
    if (violates) defects += fmt::format("    {}: {}\n", defect.id, defect.summary);
  }
  if (!defects.empty()) out += "\n  Defects of the reference node that violate it\n" + defects;
  return out;
}

/// "  decides   OD-1003-06 Writing anything but 0 ..." for each.
std::string requirement_lines(const auto& ids, const scenario::Catalogue& catalogue) {
  std::string out;
  for (const auto& id : ids) {
    const auto* found = catalogue.find(id);
    out += fmt::format("    {}  {}\n", id, found == nullptr ? "" : found->statement);
  }
  return out;
}

std::string explain_scenario(const scenario::Scenario& each, const scenario::Catalogue& catalogue) {
  auto out = fmt::format("{}: {}\n\n", each.id, each.title);
  out += paragraph("about", each.about);
  out += paragraph("risk", std::string(to_string(each.risk)));
  out += paragraph("when", each.when ? each.when->text() : "");
  out += paragraph("slow", each.slow ? "takes long on a real bus: run with --slow" : "");
  out += paragraph("CCT", join(each.cct, ", "));
  out += paragraph("source", fmt::format("suites/{}:{}", each.position.file, each.position.line));
  return out + "\n  Decides\n" + requirement_lines(each.requirements, catalogue);
}

std::string explain_monitor(const monitor::Rule& rule, const scenario::Catalogue& catalogue) {
  return fmt::format(
             "{}: {}\n\n  It watches every frame of a run, and of a capture given to 'judge'.\n  Not applicable "
             "when: {}\n\n  Decides\n",
             monitor::case_id(rule), rule.title, rule.nothing) +
         requirement_lines(rule.requirements, catalogue);
}

std::string explain_defect(const refnode::Defect& defect, const scenario::Catalogue& catalogue) {
  return fmt::format(
             "{}: {}\n\n  A defect of the reference node: canopen-refnode --defect {}\n\n  Violates\n",
             defect.id, defect.summary, defect.id) +
         requirement_lines(defect.violates, catalogue);
}

std::string explain_variant(const refnode::Variant& variant, const scenario::Catalogue& catalogue) {
  auto out =
      fmt::format("{}: {}\n\n  Legal behaviour of the reference node: canopen-refnode --variant {}\n\n",
                  variant.id, variant.summary, variant.id);
  const auto list = [](const auto& words) {
    return join(std::vector<std::string>(words.begin(), words.end()), ", ");
  };
  out += paragraph("legal by", std::string(variant.legal));
  out += paragraph("one of", std::string(variant.group));
  out += paragraph("excludes", list(variant.excludes));
  out += paragraph("lacks", list(variant.lacks));
  out += paragraph("gains", list(variant.gains));
  return variant.warns.empty() ? out
                               : out + "\n  Warned of by\n" + requirement_lines(variant.warns, catalogue);
}

std::string explain_verb(const steps::Verb& verb) {
  auto out = fmt::format("{}: {}\n\n", verb.name, verb.summary);
  for (const auto line : split(verb.parameters, '\n')) out += "  " + std::string(line) + "\n";
  out += "\nExample\n";
  for (const auto line : split(verb.example, '\n')) out += "  " + std::string(line) + "\n";
  return out;
}

constexpr steps::Verb over = {
    "over", "Walk over values inside one step and tell the offenders in one finding.",
    "NAME: a list of values and ranges, restricted CAN-IDs, or a query (entries with ...)\nsteps: beside it, what is done with each value",
    "- over: {id: restricted CAN-IDs}\n  steps:\n    - download: {object: 1014h:00, value: 8000 0000h | $id}\n      checks: CAN-RID-01\n"
    "      expect: abort 0609 0030h",
    nullptr};

/// docs/verbs.md: generated, so that the page cannot disagree with the program.
std::string verbs_page() {
  std::string out =
      "# Verbs of scenarios\n\n"
      "Generated by `canopen-conform explain verbs --markdown`; edit the verb tables in `harness/steps`, not this page.\n"
      "How scenarios are written: [writing-scenarios.md](writing-scenarios.md).\n\n"
      "| verb | |\n|---|---|\n";
  std::vector<const steps::Verb*> all;
  for (const auto& verb : steps::verbs()) all.push_back(&verb);
  all.push_back(&over);
  for (const auto* verb : all) out += fmt::format("| [{0}](#{0}) | {1} |\n", verb->name, verb->summary);
  for (const auto* verb : all) {
    out += fmt::format("\n## {}\n{}\n\n", verb->name, verb->summary);
    for (const auto line : split(verb->parameters, '\n')) {
      const auto colon = line.find(':');
      // "> 600+N: bytes" in the notes of talk is no parameter.
      if (colon == std::string_view::npos || line.front() == '>') {
        out += fmt::format("- {}\n", line);
      } else {
        out += fmt::format("- `{}`:{}\n", line.substr(0, colon), line.substr(colon + 1));
      }
    }
    out += fmt::format("\n```yaml\n{}\n```\n", verb->example);
  }
  out += "\n## Beside the verb\n";
  std::vector<std::string> keys;
  for (const auto key : steps::common_step_keys()) keys.push_back("`" + std::string(key) + "`");
  out += "A step may also have " + join(keys, ", ") +
         ".\n\n## Outcomes\n`ok`, `abort 0609 0030h`, `abort any`, `silence`, `unchanged`, " +
         "or a mapping of\n";
  keys.clear();
  for (const auto key : steps::outcome_keys()) keys.push_back("`" + std::string(key) + "`");
  out += join(keys, ", ") + ".\n\n## Conditions\n`when`, `unless` and `require` are made of\n";
  for (const auto form : steps::condition_forms()) out += fmt::format("- {}\n", form);
  return out;
}

/// Every word of the language, for the test that compares them with the schema.
std::string word_list() {
  std::string out;
  for (const auto& verb : steps::verbs()) out += fmt::format("verb {}\n", verb.name);
  out += "verb over\n";
  for (const auto key : steps::common_step_keys()) out += fmt::format("key {}\n", key);
  for (const auto key : steps::outcome_keys()) out += fmt::format("outcome {}\n", key);
  return out;
}

}  // namespace

int explain_command(const ExplainCommand& options) {
  const bool about_coverage = options.topic == "coverage";
  if (options.markdown && options.topic != "verbs" && !about_coverage) {
    return report_error({"--markdown goes with 'verbs' and 'coverage' only", {}, {}}, exit_usage);
  }
  if ((options.markdown && !about_coverage) || options.topic == "words") {
    print(options.markdown ? verbs_page() : word_list());
    return 0;
  }
  auto root = find_suites(options.suites);
  if (!root) return report_error(root.error(), exit_usage);
  auto suites = load_suites(*root, use_colour("auto", 2));
  if (!suites) return report_error(suites.error(), exit_usage);
  if (about_coverage) {
    const auto rules = coverage(*suites);
    print(options.markdown ? coverage_page(rules) : coverage_summary(rules));
    return 0;
  }
  if (const auto* requirement = suites->catalogue.find(options.topic)) {
    print(explain_requirement(*requirement, *suites));
    return 0;
  }
  if (const auto* verb = steps::find_verb(options.topic)) {
    print(explain_verb(*verb));
    return 0;
  }
  if (options.topic == over.name) {
    print(explain_verb(over));
    return 0;
  }
  if (options.topic == "verbs") {
    std::string out;
    for (const auto& verb : steps::verbs()) out += fmt::format("  {:14} {}\n", verb.name, verb.summary);
    out += fmt::format("  {:14} {}\n", over.name, over.summary);
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
    print(explain_defect(*defect, suites->catalogue));
    return 0;
  }
  if (const auto* variant = refnode::find_variant(options.topic)) {
    print(explain_variant(*variant, suites->catalogue));
    return 0;
  }
  auto known = suites->catalogue.ids();
  // An instance of a case, "upper-bits[1400h:01]", is explained by its scenario.
  const auto name = options.topic.substr(0, options.topic.find('['));
  for (const auto& file : suites->suite.files) {
    for (const auto& each : file.scenarios) {
      if (each.id == name) {
        print(explain_scenario(each, suites->catalogue));
        return 0;
      }
      known.push_back(each.id);
    }
  }
  std::vector<std::string> monitors;
  for (const auto& rule : monitor::rules()) {
    if (monitor::case_id(rule) == options.topic || rule.name == options.topic) {
      print(explain_monitor(rule, suites->catalogue));
      return 0;
    }
    monitors.push_back(monitor::case_id(rule));
  }
  known.insert(known.end(), monitors.begin(), monitors.end());
  for (const auto& verb : steps::verbs()) known.push_back(verb.name);
  for (const auto& defect : refnode::defects()) known.emplace_back(defect.id);
  for (const auto& variant : refnode::variants()) known.emplace_back(variant.id);
  const auto near = did_you_mean(options.topic, known);
  return report_error(
      {"nothing is known about '" + options.topic + "'",
       {},
       near.empty()
           ? "a requirement, scenario, monitor, verb, defect or variant; or 'verbs', 'conditions', 'coverage'"
           : "did you mean '" + std::string(near) + "'?"},
      exit_usage);
}

}  // namespace conform::cli
