// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string_view>

#include "base/text.hpp"
#include "reports/compare.hpp"
#include "result/run_json.hpp"

namespace conform::reports {
namespace {

using result::Json;
using result::text_json;

/// One element for each of `all`.
template <typename List, typename Function>
Json list_of(const List& all, Function&& one) {
  Json out = Json::array();
  for (const auto& each : all) out.push_back(one(each));
  return out;
}

Json verdict_json(std::optional<result::Verdict> verdict) {
  return verdict ? Json(std::string(to_string(*verdict))) : Json();
}

Json place_json(const result::Place& place) {
  const auto& finding = *place.finding;
  return {{"requirement", text_json(finding.requirement)},
          {"verdict", verdict_json(place.verdict)},
          {"case", text_json(place.owner->name())},
          {"step", text_json(finding.step)},
          {"came", text_json(finding.actual)},
          {"why", text_json(finding.reason)}};
}

Json new_json(const result::NewCause& one) {
  auto out = place_json(one.fresh.front());
  out["about"] = text_json(one.cause.about);
  out["verdict"] = verdict_json(one.verdict);
  out["spread"] = one.has_spread();
  out["findings"] = list_of(one.fresh, place_json);
  return out;
}

Json gone_json(const result::GoneCause& one) {
  auto out = place_json(one.cause.primary);
  out["about"] = text_json(one.cause.about);
  out["verdict"] = verdict_json(one.cause.verdict);
  out["gone"] = one.mended;
  out["left"] = one.left;
  return out;
}

Json turn_json(const result::Turn& turn) {
  Json out{{"requirement", text_json(turn.requirement)},
           {"before", verdict_json(turn.before)},
           {"after", verdict_json(turn.after)}};
  if (turn.where != nullptr) {
    out["case"] = text_json(turn.where->name());
    out["reason"] = text_json(turn.where->reason);
  }
  return out;
}

Json value_json(const result::ValueChange& change) {
  return {{"name", text_json(change.name)},
          {"before", text_json(change.before)},
          {"after", text_json(change.after)}};
}

/// "communication profile", ... without the range, which is that of the index.
std::string area_json(const result::EntryChange& change) {
  const auto words = result::to_string(result::area_of(change.object.index));
  return std::string(words.substr(0, words.find(" (")));
}

Json entry_json(const result::EntryChange& change) {
  return {{"name", conform::to_string(change.object)},
          {"before", text_json(change.before)},
          {"after", text_json(change.after)},
          {"area", area_json(change)},
          {"process", change.is_process}};
}

/// What was compared.
Json run_json(const result::RunResult& run, const std::string& file) {
  return {{"file", text_json(file)},
          {"device", text_json(run.device)},
          {"tool", text_json(run.tool)},
          {"host", text_json(run.host)},
          {"started", run.started_utc_ns},
          {"elapsed", run.elapsed.count()},
          {"exit_code", result::exit_code(run)},
          {"properties", list_of(run.properties, [](const result::Property& property) {
             return Json{{"name", text_json(property.name)}, {"value", text_json(property.value)}};
           })}};
}

Json observed_json(const result::ObservedChange& change) {
  return {{"case", text_json(change.where->name())},
          {"requirement", text_json(change.requirement)},
          {"step", text_json(change.step)},
          {"before", text_json(change.before)},
          {"after", text_json(change.after)}};
}

Json times_json(const result::TimesChange& change) {
  return {{"kind", text_json(change.kind)},
          {"of", text_json(change.of)},
          {"what", change.is_spread ? "spread" : "median"},
          {"before_ns", change.before.count()},
          {"after_ns", change.after.count()},
          {"samples_before", change.samples_before},
          {"samples_after", change.samples_after},
          {"p", change.p},
          {"longer", change.longer}};
}

}  // namespace

std::string compare_json(const result::Comparison& comparison, const CompareOptions& options) {
  const auto turns = [](const std::vector<result::Turn>& all) { return list_of(all, turn_json); };
  const auto values = [](const std::vector<result::ValueChange>& all) { return list_of(all, value_json); };
  Json out{{"canopen_conform_comparison", comparison_version},
           {"old", text_json(options.old_name)},
           {"new", text_json(options.new_name)},
           {"exit_code", exit_code(comparison, options.strict)},
           {"same", comparison.is_same()},
           {"outcome", outcome_words(comparison, options.strict)},
           {"new_causes", list_of(comparison.new_causes, new_json)},
           {"gone_causes", list_of(comparison.gone_causes, gone_json)},
           {"known_failures", comparison.known_failures},
           {"worse", turns(comparison.worse)},
           {"better", turns(comparison.better)},
           {"no_longer_judged", turns(comparison.lost)},
           {"now_judged", turns(comparison.gained)},
           {"answers", list_of(comparison.observed, observed_json)},
           {"identity", values(comparison.identity)},
           {"entries", list_of(comparison.entries, entry_json)},
           {"times", list_of(comparison.times, times_json)},
           {"circumstances", values(comparison.circumstances)},
           {"only_in_old", list_of(comparison.only_in_old, text_json)},
           {"only_in_new", list_of(comparison.only_in_new, text_json)},
           {"remarks", list_of(comparison.remarks, text_json)}};
  out["instances"] = list_of(comparison.instances, [](const result::InstancesChange& change) {
    return Json{{"scenario", text_json(change.id)},
                {"gone", list_of(change.gone, text_json)},
                {"added", list_of(change.added, text_json)}};
  });
  if (comparison.before != nullptr && comparison.after != nullptr) {
    out["runs"] = {{"old", run_json(*comparison.before, options.old_name)},
                   {"new", run_json(*comparison.after, options.new_name)}};
  }
  return out.dump(1) + "\n";
}

}  // namespace conform::reports
