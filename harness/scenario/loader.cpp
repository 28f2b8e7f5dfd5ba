// SPDX-License-Identifier: Apache-2.0
#include "scenario/loader.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "base/text.hpp"
#include "scenario/query.hpp"
#include "yaml/fields.hpp"

namespace conform::scenario {
namespace {

void collect_checks(const std::vector<steps::Step>& list, std::set<std::string>& out) {
  for (const auto& step : list) {
    out.insert(step.expectation.checks.begin(), step.expectation.checks.end());
    if (step.walk) collect_checks(step.walk->steps, out);
    for (const auto& branch : step.branches) collect_checks(branch.steps, out);
  }
}

/// What the steps see the device through; walks and branches included.
void collect_channels(const std::vector<steps::Step>& list, steps::Channels& out) {
  for (const auto& step : list) {
    if (step.action != nullptr) steps::add_channels(out, step.action->rests_on());
    if (step.walk) collect_channels(step.walk->steps, out);
    for (const auto& branch : step.branches) collect_channels(branch.steps, out);
  }
}

/// `establishes: heartbeat`, `rests_on: [TPDO, SYNC]`
steps::Channels parse_channels(const yaml::Field& field) {
  steps::Channels out;
  if (!field) return out;
  for (const auto& item : field.items_or_one()) {
    const auto name = item.text();
    if (!name) continue;
    const auto known = steps::channels();
    if (steps::is_channel(*name)) {
      steps::add_channels(out, {known[steps::rank_of_channel(*name)].name});
      continue;
    }
    std::vector<std::string_view> names;
    for (const auto& channel : known) names.push_back(channel.name);
    const auto near = did_you_mean(*name, names);
    item.error("unknown channel '" + *name + "'", near.empty() ? "see 'canopen-conform explain channels'"
                                                               : "did you mean '" + std::string(near) + "'?");
  }
  return out;
}

bool is_id(std::string_view id) {
  return !id.empty() && id.size() <= 80 && std::ranges::all_of(id, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
}

/// `for_each`: {name: [values]}, {name: query}, or a list of rows (mappings; the first key names the
/// instance).
std::optional<ForEach> parse_for_each(const yaml::Field& field, steps::ParseContext& context) {
  ForEach out;
  std::set<std::string> seen;
  const auto add_row = [&](Row row, const yaml::Field& at) {
    if (!seen.insert(row.name).second) at.error("instance '" + row.name + "' is given twice");
    out.rows.push_back(std::move(row));
  };
  if (field.node()->is_sequence()) {
    if (field.node()->items().empty()) field.error("'for_each' without a row");
    std::optional<std::vector<std::string>> names;
    for (const auto& item : field.items()) {
      if (!item.node()->is_mapping() || item.node()->entries().empty()) {
        item.error("a row of for_each is a mapping", "write - {case: name, object: 1014h:00}");
        continue;
      }
      Row row;
      std::vector<std::string> keys;
      for (const auto& entry : item.node()->entries()) {
        keys.push_back(entry.key.text());
        const yaml::Field value(&entry.value, context.diagnostics, "'" + entry.key.text() + "'");
        row.texts[entry.key.text()] = value.text().value_or("");
      }
      row.name = item.node()->entries().front().value.text();
      if (!names) {
        names = keys;
      } else if (*names != keys) {
        item.error("this row has other names than the first one", "all rows give " + join(*names, ", "));
      }
      add_row(std::move(row), item);
    }
    for (const auto& name : names.value_or(std::vector<std::string>())) context.know(name);
    return out.rows.empty() ? std::nullopt : std::optional(out);
  }
  if (!field.node()->is_mapping() || field.node()->entries().size() != 1) {
    field.error("'for_each' needs one name with its values, or a list of rows");
    return std::nullopt;
  }
  const auto& entry = field.node()->entries().front();
  out.variable = entry.key.text();
  const yaml::Field values(&entry.value, context.diagnostics, out.variable);
  if (entry.value.is_sequence()) {
    if (entry.value.items().empty()) values.error("'for_each' without values");
    for (const auto& item : values.items()) {
      const auto text = item.text();
      if (!text) continue;
      Row row;
      row.name = *text;
      row.texts[out.variable] = *text;
      add_row(std::move(row), item);
    }
  } else if (const auto text = values.text()) {
    out.query = *text;
    const auto query = Query::parse(*text);
    if (!query) {
      values.error(query.error().what, query.error().hint);
    } else if (query->holding()) {
      values.error("what an entry holds is not known when the cases are planned",
                   "look for one such entry with 'given'");
    }
  }
  context.know(out.variable);
  return out;
}

/// `given: {long: entries with readable and holding 15.. bytes}`
std::vector<Given> parse_given(const yaml::Field& field, steps::ParseContext& context) {
  std::vector<Given> out;
  if (!field.node()->is_mapping() || field.node()->entries().empty()) {
    field.error("'given' needs names with queries",
                "write given: {long: entries with readable and holding 15.. bytes}");
    return out;
  }
  for (const auto& entry : field.node()->entries()) {
    const yaml::Field value(&entry.value, context.diagnostics, entry.key.text());
    const auto text = value.text();
    if (!text) continue;
    if (auto query = Query::parse(*text); !query) value.error(query.error().what, query.error().hint);
    context.know(entry.key.text());
    out.push_back({entry.key.text(), *text});
  }
  return out;
}

Scenario parse_scenario(const yaml::Field& item, steps::ParseContext& context, const std::string& path) {
  Scenario out;
  auto fields = item.fields("scenario");
  const auto id = fields.required("id");
  const auto name = id.text().value_or("");
  if (id && !is_id(name))
    id.error("'" + name + "' is not an id", "small letters, digits and hyphens: it is quoted for ever");
  out.suite = path.substr(0, path.rfind('.'));
  out.id = out.suite + "/" + name;
  out.position = {path, item.node()->position().line, item.node()->position().column};
  out.title = fields.required("title").text().value_or("");
  out.about = fields.optional("about").text().value_or("");
  if (const auto cct = fields.optional("cct")) {
    for (const auto& number : cct.items_or_one()) {
      if (auto text = number.text()) out.cct.push_back(*text);
    }
  }
  if (const auto risk = fields.optional("risk")) {
    out.risk = risk.one_of<Risk>({{"read-only", Risk::read_only},
                                  {"config", Risk::config},
                                  {"nvm", Risk::nvm},
                                  {"motion", Risk::motion}})
                   .value_or(Risk::motion);
  }
  if (const auto fresh = fields.optional("fresh")) {
    out.fresh = fresh.one_of<Fresh>({{"communication", Fresh::communication}, {"node", Fresh::node}})
                    .value_or(Fresh::none);
  }
  out.basic = fields.optional("basic").boolean().value_or(false);
  out.slow = fields.optional("slow").boolean().value_or(false);
  if (const auto sample = fields.optional("sample")) out.sample = sample.number(1, 65536).value_or(0);
  context.names.clear();
  context.default_checks.clear();
  context.inheriting.clear();
  if (const auto given = fields.optional("given")) out.given = parse_given(given, context);
  if (const auto for_each = fields.optional("for_each")) out.for_each = parse_for_each(for_each, context);
  if (const auto checks = fields.optional("checks")) context.default_checks = parse_checks(checks, context);
  if (const auto when = fields.optional("when")) out.when = steps::parse_condition_at(when, context.names);
  out.establishes = parse_channels(fields.optional("establishes"));
  out.rests_on = parse_channels(fields.optional("rests_on"));
  const auto errors_before = context.diagnostics.error_count();
  if (const auto steps = fields.required("steps")) out.steps = parse_steps(steps, context);
  // What only prepares would pass what it does not decide.
  if (context.inheriting.size() > 1) {
    const auto& [position, length] = context.inheriting[1];
    context.diagnostics.error(position, length,
                              "several steps would decide what stands at 'checks' of the scenario",
                              "write checks: ID at each step that decides, and none at those that prepare");
  }
  if (const auto cleanup = fields.optional("cleanup")) out.cleanup = parse_steps(cleanup, context);
  for (const auto& step : out.cleanup) {
    if (step.action == nullptr || !step.branches.empty()) {
      context.diagnostics.error(step.position, step.length, "'over' and 'either' have no place in a cleanup",
                                "write the steps one after the other; 'when' may choose among them");
    }
  }

  auto excess = steps::first_beyond(out.steps, out.risk);
  if (!excess) excess = steps::first_beyond(out.cleanup, out.risk);
  if (excess) {
    const auto tier = std::string(steps::word_of(excess->need.tier));
    context.diagnostics.error(
        excess->step->position, excess->step->length,
        out.risk == Risk::read_only ? "a read-only scenario may only upload from the device, and wait"
                                    : "a scenario of risk '" + std::string(steps::word_of(out.risk)) +
                                          "' must not " + std::string(excess->need.what),
        "give the scenario 'risk: " + tier + "'; 'canopen-conform explain tiers' says what may be sent when");
  } else if (out.risk == Risk::read_only && out.when && out.when->may_write()) {
    item.error("the condition of a read-only scenario may write: '" + out.when->text() + "'",
               "add risk: config");
  }
  collect_channels(out.steps, out.rests_on);
  // What judges a channel cannot rest on it, nor on one that is judged behind it.
  if (!out.establishes.empty()) {
    const auto first = steps::rank_of_channel(out.establishes.front());
    std::erase_if(out.rests_on,
                  [first](std::string_view channel) { return steps::rank_of_channel(channel) >= first; });
  }
  std::set<std::string> requirements;
  collect_checks(out.steps, requirements);
  // Steps with mistakes are left out, and their checks with them.
  if (requirements.empty() && !out.steps.empty() && context.diagnostics.error_count() == errors_before) {
    item.error("the scenario decides no requirement", "give an expectation 'checks: ID'");
  }
  // Words that rows give ("$rule") become the ids of all rows here; each instance knows its own.
  for (const auto& requirement : requirements) {
    if (!requirement.starts_with('$')) {
      out.requirements.push_back(requirement);
      continue;
    }
    for (auto& row : out.for_each ? out.for_each->rows : std::vector<Row>()) {
      const auto found = row.texts.find(requirement.substr(1));
      if (found == row.texts.end()) continue;
      if (const auto canonical = context.requirement(found->second)) {
        out.requirements.push_back(*canonical);
      } else {
        item.error("unknown requirement '" + found->second + "' in row '" + row.name + "' of for_each");
      }
    }
  }
  std::ranges::sort(out.requirements);
  const auto repeated = std::ranges::unique(out.requirements);
  out.requirements.erase(repeated.begin(), repeated.end());
  return out;
}

}  // namespace

ScenarioFile load_scenarios(const yaml::Node& root, yaml::Diagnostics& diagnostics, const std::string& path,
                            const Catalogue& catalogue) {
  ScenarioFile out;
  out.path = path;
  yaml::Fields fields(root, diagnostics, "scenario file");
  (void)fields.required("format").number(1, 1);
  out.title = fields.required("title").text().value_or("");
  out.about = fields.optional("about").text().value_or("");
  steps::ParseContext context{diagnostics, {}, {}, {}, {}, {}};
  context.check_query = [](std::string_view text) -> Result<void> {
    auto query = Query::parse(text);
    if (!query) return std::unexpected(query.error());
    if (query->holding())
      return fail("'holding' needs an answer of the device", {}, "look for one such entry with 'given'");
    return {};
  };
  context.requirement = [&catalogue](std::string_view id) { return catalogue.canonical(id); };
  context.all_requirements = [&catalogue] { return catalogue.ids(); };
  std::set<std::string> ids;
  const auto list = fields.required("scenarios");
  if (list && list.node()->is_sequence() && list.node()->items().empty())
    list.error("a file without a scenario");
  for (const auto& item : list.items()) {
    if (!item.node()->is_mapping()) {
      item.expected("a mapping with id, title and steps");
      continue;
    }
    auto scenario = parse_scenario(item, context, path);
    if (item.node()->find("id") != nullptr && !ids.insert(scenario.id).second)
      item.error("scenario id '" + scenario.id + "' is given twice");
    out.scenarios.push_back(std::move(scenario));
  }
  return out;
}

Result<Suite> load_suite(const std::string& root, const std::vector<std::string>& files,
                         const Catalogue& catalogue, bool colour) {
  Suite out;
  if (auto added = add_to_suite(out, {root, {}}, files, catalogue, colour); !added)
    return std::unexpected(added.error());
  return out;
}

Result<void> add_to_suite(Suite& suite, const Folder& folder, const std::vector<std::string>& files,
                          const Catalogue& catalogue, bool colour) {
  std::vector<yaml::NamedFile> named;
  for (const auto& file : files) {
    named.push_back({.path = file.starts_with('/') || folder.path.empty() ? file : folder.path + "/" + file,
                     .name = folder.shown.empty() ? file : folder.shown + "/" + file});
  }
  std::vector<std::optional<ScenarioFile>> loaded(files.size());
  auto documents =
      yaml::load_files(named, [&](std::size_t i, const yaml::Node& root, yaml::Diagnostics& diagnostics) {
        loaded[i] = load_scenarios(root, diagnostics, files[i], catalogue);
        loaded[i]->shown = named[i].name;
        for (auto& each : loaded[i]->scenarios) each.position.file = named[i].name;
      });
  for (std::size_t i = 0; i < files.size(); ++i) {
    auto& document = documents[i];
    if (!document) return std::unexpected(document.error());
    if (loaded[i]) {
      for (const auto& known : suite.files) {
        if (known.path == files[i]) refuse_same_name(*loaded[i], document->diagnostics, known.shown);
      }
      suite.files.push_back(*std::move(loaded[i]));
    }
    suite.errors += document->diagnostics.error_count();
    if (!document->diagnostics.empty()) suite.problems.push_back(document->diagnostics.render(colour));
  }
  return {};
}

void refuse_same_name(const ScenarioFile& file, yaml::Diagnostics& diagnostics, const std::string& other) {
  const auto at = file.scenarios.empty() ? result::SourcePosition{{}, 1, 1} : file.scenarios.front().position;
  diagnostics.error({at.line, at.column}, 1,
                    "two suites have a file of this name, so that their scenarios would have one id",
                    "rename one of them; the other is " + other);
}

}  // namespace conform::scenario
