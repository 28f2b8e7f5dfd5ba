// SPDX-License-Identifier: Apache-2.0
// `explain`: requirements, scenarios, monitors, verbs, defects, variants, rules of the lint of descriptions,
// the words conditions are made of, and what each tier may send.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include <nlohmann/json.hpp>

#include "base/text.hpp"
#include "cli/commands/commands.hpp"
#include "cli/descriptions/explain_rule.hpp"
#include "cli/pages/coverage.hpp"
#include "cli/run/terminal.hpp"
#include "cli/suite_folder.hpp"
#include "defects/defect.hpp"
#include "device/profile.hpp"
#include "eds/lint.hpp"
#include "monitor/watch.hpp"
#include "result/case_name.hpp"
#include "steps/channels.hpp"
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
  out += paragraph("source", requirement.file + ":" + std::to_string(requirement.line));
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
  out += paragraph("risk", std::string(steps::word_of(each.risk)));
  out += paragraph("when", each.when ? each.when->text() : "");
  out += paragraph("slow", each.slow ? "takes long on a real bus: run with --slow" : "");
  out += paragraph("CCT", join(each.cct, ", "));
  out += paragraph("source", fmt::format("{}:{}", each.position.file, each.position.line));
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
    "NAME: a list of values and ranges, restricted CAN-IDs (a sample of them; all with --all-objects), described bit rates (their places in the table of LSS), or a query (entries with ...)\nsteps: beside it, what is done with each value",
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

std::string verb_list() {
  std::string out;
  for (const auto& verb : steps::verbs()) out += fmt::format("  {:14} {}\n", verb.name, verb.summary);
  return out + fmt::format("  {:14} {}\n", over.name, over.summary);
}

std::string condition_list() {
  std::string out = "Conditions (when, unless, require) are made of\n";
  for (const auto form : steps::condition_forms()) out += "  " + std::string(form) + "\n";
  return out;
}

std::string tier_list() {
  std::string out =
      "What a run may send, by --allow; each tier includes those above it. N is the node-ID of the device.\n";
  for (const auto& row : steps::tier_table())
    out += fmt::format("  {:9}  {}\n", steps::word_of(row.tier), row.sends);
  return out + fmt::format("  {:9}  {}\n", "never", steps::never_sent());
}

std::string channel_list() {
  std::string out = "What scenarios see a device through, each judged first (establishes, rests_on):\n";
  for (const auto& channel : steps::channels())
    out += fmt::format("  {:20} {}\n", channel.name, channel.summary);
  return out;
}

using Json = nlohmann::ordered_json;

/// What the schema says of a key, and of the keys below it.
void tell_key(const std::string& name, const Json& key, int depth, std::string& out) {
  const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
  out += fmt::format("{}{:{}} {}\n", indent, name, 20 - 2 * depth, key.value("description", ""));
  const Json* inside = &key;
  if (const auto items = key.find("items"); items != key.end()) inside = &*items;
  if (const auto ways = inside->find("oneOf"); ways != inside->end()) {
    for (const auto& way : *ways) {
      if (way.contains("properties")) inside = &way;
    }
  }
  const auto below = inside->find("properties");
  if (below == inside->end()) return;
  for (const auto& [inner, value] : below->items()) tell_key(inner, value, depth + 1, out);
}

/// Keys of a device profile, as the schema for editors has them: "profile" for all, or one by its name.
std::string explain_profile(const std::string& topic, const std::string& root) {
  std::ifstream file(root + "/schema/device.schema.json");
  const auto schema = Json::parse(file, nullptr, false);
  if (schema.is_discarded() || !schema.contains("properties")) return {};
  const auto& keys = schema["properties"];
  std::string out;
  if (topic == "profile") {
    out = "Keys of a device profile (docs/profile.md)\n";
    for (const auto& [name, key] : keys.items()) tell_key(name, key, 1, out);
    return out;
  }
  const auto key = keys.find(topic);
  if (key == keys.end()) return {};
  out = "A key of the device profile\n";
  tell_key(topic, *key, 1, out);
  if (topic == "claims" || topic == "not_claimed") {
    for (const auto& feature : device::features())
      out += fmt::format("    {:24} {}\n", feature.word, feature.meaning);
  }
  return out;
}

/// Empty: nothing is known about it; `known` then holds the names there are.
std::string explain_one(const std::string& topic, const LoadedSuites& suites, const std::string& root,
                        std::vector<std::string>& known) {
  if (topic == "coverage") return coverage_summary(coverage(suites));
  if (const auto* requirement = suites.catalogue.find(topic))
    return explain_requirement(*requirement, suites);
  if (const auto* rule = eds::find_rule(topic)) return explain_rule(*rule);
  if (const auto* verb = steps::find_verb(topic)) return explain_verb(*verb);
  if (topic == over.name) return explain_verb(over);
  if (topic == "verbs") return verb_list();
  if (topic == "conditions") return condition_list();
  if (topic == "tiers") return tier_list();
  if (topic == "channels") return channel_list();
  if (auto text = explain_profile(topic, root); !text.empty()) return text;
  if (const auto* defect = refnode::find_defect(topic)) return explain_defect(*defect, suites.catalogue);
  if (const auto* variant = refnode::find_variant(topic)) return explain_variant(*variant, suites.catalogue);
  for (const auto id : suites.catalogue.ids()) known.emplace_back(id);
  // An instance of a case, "upper-bits[1400h:01]", is explained by its scenario.
  const auto name = result::scenario_of(topic);
  for (const auto& file : suites.suite.files) {
    for (const auto& each : file.scenarios) {
      if (each.id == name) return explain_scenario(each, suites.catalogue);
      known.push_back(each.id);
    }
  }
  for (const auto& rule : monitor::rules()) {
    if (monitor::case_id(rule) == topic || rule.name == topic) return explain_monitor(rule, suites.catalogue);
    known.push_back(monitor::case_id(rule));
  }
  for (const auto& verb : steps::verbs()) known.emplace_back(verb.name);
  for (const auto& defect : refnode::defects()) known.emplace_back(defect.id);
  for (const auto& variant : refnode::variants()) known.emplace_back(variant.id);
  for (const auto& group : eds::all_rule_groups()) {
    for (const auto* rule : group.rules) known.emplace_back(rule->code);
  }
  return {};
}

}  // namespace

int explain_command(const ExplainCommand& options) {
  const auto asked_for = [&options](std::string_view topic) {
    return options.topics.size() == 1 && options.topics.front() == topic;
  };
  if (options.markdown && !asked_for("verbs") && !asked_for("coverage")) {
    return report_error({"--markdown goes with 'verbs' and 'coverage' only", {}, {}}, exit_usage);
  }
  if ((options.markdown && asked_for("verbs")) || asked_for("words")) {
    print(options.markdown ? verbs_page() : word_list());
    return 0;
  }
  auto root = find_suites(options.suites);
  if (!root) return report_error(root.error(), exit_usage);
  auto suites = load_suites(*root, use_colour("auto", 2));
  if (!suites) return report_error(suites.error(), exit_usage);
  if (options.markdown) {
    print(coverage_page(coverage(*suites)));
    return 0;
  }
  // What is known is printed, whatever else was mistyped.
  int code = 0;
  bool first = true;
  for (const auto& topic : options.topics) {
    std::vector<std::string> known;
    const auto text = explain_one(topic, *suites, root->root, known);
    if (!text.empty()) {
      print((first ? "" : "\n") + text);
      first = false;
      continue;
    }
    const auto near = did_you_mean(topic, std::vector<std::string_view>(known.begin(), known.end()));
    code = report_error(
        {"nothing is known about '" + topic + "'",
         {},
         near.empty()
             ? "a requirement, scenario, monitor, verb, defect, variant or rule of 'eds lint'; or 'verbs', 'conditions', 'tiers', 'channels', 'profile', 'coverage'"
             : "did you mean '" + std::string(near) + "'?"},
        exit_usage);
  }
  return code;
}

}  // namespace conform::cli
