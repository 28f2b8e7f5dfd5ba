// SPDX-License-Identifier: Apache-2.0
#include "result/compare_observed.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "base/text.hpp"
#include "result/compare_steps.hpp"

namespace conform::result {
namespace {

std::map<std::string, const CaseResult*> by_name(const RunResult& run) {
  std::map<std::string, const CaseResult*> out;
  for (const auto& one : run.cases) out.emplace(one.name(), &one);
  return out;
}

std::string applicability(const CaseResult& one) {
  return one.verdict == Verdict::not_applicable ? "not applicable: " + one.reason : "judged";
}

}  // namespace

std::vector<ObservedChange> observed_changes(const RunResult& before, const RunResult& after) {
  std::vector<ObservedChange> out;
  const auto old_cases = by_name(before);
  for (const auto& one : after.cases) {
    const auto found = old_cases.find(one.name());
    if (one.suite == "monitor" || found == old_cases.end()) continue;
    const auto& old = *found->second;
    const bool was = is_decided(old.verdict), is = is_decided(one.verdict);
    if (was != is && (was || old.verdict == Verdict::not_applicable) &&
        (is || one.verdict == Verdict::not_applicable) && !tells_of_restless(old) && !tells_of_restless(one))
      out.push_back({&one, {}, {}, applicability(old), applicability(one)});
  }
  const auto old_steps = seen_in(before);
  std::set<std::tuple<std::string, std::string_view, std::string>> told;  // one step may decide several rules
  for (const auto& [key, now] : seen_in(after)) {
    const auto found = old_steps.find(key);
    // Where the verdict is another one, that is told.
    if (found == old_steps.end() || found->second.verdict != now.verdict) continue;
    const auto was = answer_kind(found->second.step, found->second.actual);
    const auto is = answer_kind(now.step, now.actual);
    if (!was || !is || *was == *is) continue;
    const auto object = uploaded(now.step);
    if (object && is_restless(object->index) && !tells_of_absence(*was) && !tells_of_absence(*is)) continue;
    if (!told.emplace(std::get<0>(key), std::get<2>(key), *was + "\n" + *is).second) continue;
    out.push_back({now.owner, std::string(now.requirement), std::string(now.step),
                   std::string(found->second.actual), std::string(now.actual)});
  }
  return out;
}

std::vector<InstancesChange> instance_changes(const RunResult& before, const RunResult& after) {
  const auto instances_of = [](const RunResult& run) {
    std::map<std::string, std::set<std::string>> out;
    for (const auto& one : run.cases) out[one.id].insert(one.instance);
    return out;
  };
  std::vector<InstancesChange> out;
  const auto old = instances_of(before);
  for (const auto& [id, now] : instances_of(after)) {
    const auto found = old.find(id);
    if (found == old.end()) continue;
    const auto& was = found->second;
    InstancesChange change{id, {}, {}};
    std::ranges::set_difference(was, now, std::back_inserter(change.gone));
    std::ranges::set_difference(now, was, std::back_inserter(change.added));
    // As many others were drawn: a sample.
    if (change.gone.size() != change.added.size()) out.push_back(std::move(change));
  }
  return out;
}

std::vector<ValueChange> property_changes(const RunResult& before, const RunResult& after,
                                          const std::vector<std::string>& prefixes) {
  const auto chosen = [&](const RunResult& run) {
    std::map<std::string, std::string> out;
    for (const auto& each : run.properties) {
      if (std::ranges::any_of(prefixes, [&](const auto& prefix) { return each.name.starts_with(prefix); }))
        out.emplace(each.name, each.value);
    }
    return out;
  };
  std::map<std::string, ValueChange> all;
  for (const auto& [name, value] : chosen(before)) all[name].before = value;
  for (const auto& [name, value] : chosen(after)) all[name].after = value;
  std::vector<ValueChange> out;
  for (auto& [name, change] : all) {
    if (change.before == change.after) continue;
    change.name = name;
    out.push_back(std::move(change));
  }
  return out;
}

}  // namespace conform::result
