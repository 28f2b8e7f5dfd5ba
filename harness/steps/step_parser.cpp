// SPDX-License-Identifier: Apache-2.0
// From the YAML of a step list to steps: what all verbs have in common. The verbs themselves parse their own
// values.
#include <algorithm>

#include "base/text.hpp"
#include "steps/step.hpp"

namespace conform::steps {
namespace {

constexpr std::string_view common_keys[] = {"checks", "expect", "warn",  "fail",    "as",  "when",
                                            "unless", "either", "steps", "at_once", "note"};

std::optional<Walk> parse_walk(const yaml::Field& value, ParseContext& context) {
  Walk walk;
  if (!value.node()->is_mapping() || value.node()->entries().size() != 1) {
    value.error("'over' needs one name and its values",
                "write over: {id: restricted CAN-IDs} or over: {code: [1, 2, 10..20]}");
    return std::nullopt;
  }
  const auto& entry = value.node()->entries().front();
  walk.name = entry.key.text();
  const yaml::Field values(&entry.value, context.diagnostics, walk.name);
  for (const auto& item : values.items_or_one()) {
    const auto text = item.text();
    if (!text) continue;
    if (*text == "restricted CAN-IDs" || *text == "described bit rates") {
      walk.sets.push_back(*text);
    } else if (context.check_query && (text->starts_with("entries") || text->starts_with("objects"))) {
      if (auto fine = context.check_query(*text); !fine) item.error(fine.error().what, fine.error().hint);
      walk.sets.push_back(*text);
    } else if (text->find("..") != std::string::npos) {
      auto range = Range::parse(*text);
      if (!range) {
        item.error(range.error().what, range.error().hint);
      } else if (range->low.empty() || range->high.empty()) {
        item.error("a range to walk over needs both ends");
      } else {
        report_unknown_names(range->low.names(), item, context.names);
        report_unknown_names(range->high.names(), item, context.names);
        walk.ranges.push_back(*range);
      }
    } else if (auto expression = parse_expression_at(item, context.names)) {
      walk.values.push_back(*expression);
    }
  }
  if (entry.value.is_sequence() && entry.value.items().empty())
    values.error("'over' has no values to walk over");
  return walk;
}

/// The outcomes at a field, and whether the action can measure what they ask for.
std::vector<Outcome> outcomes_of(const yaml::Field& field, std::string_view verb, const Action* action,
                                 const ParseContext& context) {
  if (action != nullptr) check_measures(field, verb, action->measures());
  return parse_outcomes(field, context.names);
}

std::vector<Branch> parse_branches(const yaml::Field& field, const Step& of, ParseContext& context) {
  const auto* object = of.action == nullptr ? nullptr : of.action->object();
  std::vector<Branch> out;
  const auto known_before = context.names;
  if (field.node()->is_sequence() && field.node()->items().empty()) field.error("'either' without a branch");
  for (const auto& item : field.items()) {
    auto fields = item.fields("branch of 'either'");
    Branch branch;
    branch.position = item.node()->position();
    context.names = known_before;
    if (fields.has("talk")) {
      // A conversation as alternative: its first line tells whether this is the way the device went.
      fields.known({"checks", "expect", "warn", "fail", "note"});
      if (object != nullptr) context.branch_object = *object;
      auto talk = find_verb("talk")->parse(fields.optional("talk"), context);
      context.branch_object.reset();
      if (talk != nullptr) {
        Step step;
        step.verb = "talk";
        step.action = std::move(talk);
        step.position = branch.position;
        if (const auto checks = fields.optional("checks")) {
          step.expectation.checks = parse_checks(checks, context);
        } else {
          step.expectation.checks = context.default_checks;
        }
        branch.steps.push_back(std::move(step));
      }
    } else if (const auto on = fields.required("if")) {
      branch.on = outcomes_of(on, of.verb, of.action.get(), context);
    }
    if (const auto verdict = fields.optional("verdict")) {
      branch.verdict = verdict
                           .one_of<result::Verdict>({{"pass", result::Verdict::pass},
                                                     {"warn", result::Verdict::warn},
                                                     {"fail", result::Verdict::fail},
                                                     {"not applicable", result::Verdict::not_applicable}})
                           .value_or(result::Verdict::pass);
    }
    if (const auto steps = fields.optional("steps")) {
      for (auto& step : parse_steps(steps, context)) branch.steps.push_back(std::move(step));
    }
    if (!branch.on.empty() || !branch.steps.empty()) out.push_back(std::move(branch));
  }
  context.names = known_before;
  return out;
}

std::optional<Step> parse_step(const yaml::Field& item, ParseContext& context) {
  if (!item.node()->is_mapping()) {
    item.error("a step is a mapping with one verb", "write - upload: {object: 1000h:00}");
    return std::nullopt;
  }
  const yaml::Entry* verb_entry = nullptr;
  std::vector<const yaml::Entry*> unknown;
  for (const auto& entry : item.node()->entries()) {
    const auto& key = entry.key.text();
    if (std::ranges::find(common_keys, key) != std::end(common_keys)) continue;
    if (key != "over" && find_verb(key) == nullptr) {
      unknown.push_back(&entry);
    } else if (verb_entry != nullptr) {
      context.diagnostics.error(entry.key, "a second verb '" + key + "' in one step",
                                "one verb per step; '" + verb_entry->key.text() + "' stands before it");
    } else {
      verb_entry = &entry;
    }
  }
  std::vector<std::string_view> known(std::begin(common_keys), std::end(common_keys));
  for (const auto& verb : verbs()) known.push_back(verb.name);
  known.push_back("over");
  for (const auto* entry : unknown) {
    const auto near = did_you_mean(entry->key.text(), known);
    context.diagnostics.error(entry->key,
                              std::string(verb_entry != nullptr ? "unknown key '" : "unknown verb or key '") +
                                  entry->key.text() + "' in a step",
                              near.empty() ? "" : "did you mean '" + std::string(near) + "'?");
  }
  if (verb_entry == nullptr) {
    if (unknown.empty())
      item.error("a step without a verb",
                 "upload, download, nmt, talk, ...: see 'canopen-conform explain verbs'");
    return std::nullopt;
  }

  Step step;
  step.verb = verb_entry->key.text();
  step.position = verb_entry->key.position();
  step.length = verb_entry->key.length();
  yaml::Fields fields(*item.node(), context.diagnostics, "step");
  fields.allow_others();
  if (const auto when = fields.optional("when")) step.when = parse_condition_at(when, context.names);
  if (const auto unless = fields.optional("unless")) step.unless = parse_condition_at(unless, context.names);

  const yaml::Field value(&verb_entry->value, context.diagnostics, step.verb);
  if (step.verb == "over") {
    step.walk = parse_walk(value, context);
    const auto steps = fields.required("steps");
    if (!step.walk || !steps) return std::nullopt;
    const auto known_before = context.names;
    context.know(step.walk->name);
    step.walk->steps = parse_steps(steps, context);
    context.names = known_before;
  } else {
    if (fields.has("steps"))
      fields.optional("steps").error("'steps' belongs to 'over' and to branches of 'either'");
    step.action = find_verb(step.verb)->parse(value, context);
    if (step.action == nullptr) return std::nullopt;
  }
  step.at_once = fields.optional("at_once").boolean().value_or(false);
  if (const auto as = fields.optional("as")) {
    if (const auto name = as.text()) {
      step.label = *name;
      context.know(*name);
    }
  }
  if (const auto checks = fields.optional("checks")) {
    step.expectation.checks = parse_checks(checks, context);
  } else if (fields.has("expect") || fields.has("either") || fields.has("fail")) {
    step.expectation.checks = context.default_checks;
    if (!context.default_checks.empty()) context.inheriting.emplace_back(step.position, step.length);
  }
  for (auto [key, set] :
       {std::pair("expect", &step.expectation.pass), std::pair("warn", &step.expectation.warn),
        std::pair("fail", &step.expectation.fail)}) {
    if (const auto field = fields.optional(key)) {
      *set = outcomes_of(field, step.verb, step.action.get(), context);
      step.expectation.given = true;
    }
  }
  if (const auto either = fields.optional("either")) {
    if (step.expectation.given)
      either.error("'either' and 'expect' in one step", "the branches are the expectation");
    step.branches = parse_branches(either, step, context);
    for (auto& branch : step.branches) {
      // A conversation as alternative decides what the step decides, unless it says otherwise.
      if (!branch.on.empty() || branch.steps.empty()) continue;
      auto& own = branch.steps.front().expectation.checks;
      if (own.empty()) own = step.expectation.checks;
    }
  }
  if (step.walk && step.expectation.given)
    fields.optional("expect").error("'over' expects nothing itself; its steps do");
  return step;
}

}  // namespace

std::vector<std::string> parse_checks(const yaml::Field& field, const ParseContext& context) {
  std::vector<std::string> out;
  for (const auto& item : field.items_or_one()) {
    const auto id = item.text();
    if (!id) continue;
    if (id->starts_with('$')) {
      if (std::ranges::find(context.names, id->substr(1)) == context.names.end()) {
        item.error("unknown name " + *id, "a row of for_each must give it");
      }
      out.push_back(*id);
    } else if (const auto canonical = context.requirement(*id)) {
      out.push_back(*canonical);
    } else {
      const auto near = did_you_mean(*id, context.all_requirements());
      item.error("unknown requirement '" + *id + "'",
                 near.empty() ? "" : "did you mean '" + std::string(near) + "'?");
    }
  }
  return out;
}

std::span<const std::string_view> common_step_keys() { return common_keys; }

std::optional<Excess> first_beyond(const std::vector<Step>& list, Tier allowed) {
  for (const auto& step : list) {
    if (step.action != nullptr) {
      if (const auto need = step.action->need(); !need.covered_by(allowed)) return Excess{&step, need};
    }
    for (const auto* condition : {&step.when, &step.unless}) {
      const Need need{Tier::config, "try what a condition asks for"};
      if (*condition && (*condition)->may_write() && !need.covered_by(allowed)) return Excess{&step, need};
    }
    if (step.walk) {
      if (const auto inner = first_beyond(step.walk->steps, allowed)) return inner;
    }
    for (const auto& branch : step.branches) {
      if (const auto inner = first_beyond(branch.steps, allowed)) return inner;
    }
  }
  return std::nullopt;
}

std::vector<Step> parse_steps(const yaml::Field& list, ParseContext& context) {
  std::vector<Step> out;
  if (list.node()->is_sequence() && list.node()->items().empty())
    list.error("a list of steps without a step");
  for (const auto& item : list.items()) {
    if (auto step = parse_step(item, context)) out.push_back(std::move(*step));
  }
  return out;
}

}  // namespace conform::steps
