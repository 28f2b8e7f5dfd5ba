// SPDX-License-Identifier: Apache-2.0
#include "result/compare_observed.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "base/text.hpp"

namespace conform::result {
namespace {

/// A step without the value that it writes, which may be drawn: "download 2002h:01".
std::string_view step_shape(std::string_view step) { return step.substr(0, step.find(" = ")); }

/// What kind of answer it was, with what is the same in every run: an abort code, an error code. none: it
/// tells of times, counts or values of the process only.
std::optional<std::string> answer_kind(std::string_view step, std::string_view actual) {
  if (actual.starts_with("abort ")) return std::string(actual);
  if (actual.starts_with("confirmed")) return "confirmed";
  if (actual.starts_with("error code ")) return std::string(actual);
  // "EMCY 8210h (PDO too short), error register 11h": the register may hold another error beside it.
  if (actual.starts_with("EMCY ")) return std::string(actual.substr(0, actual.find(',')));
  if (actual.starts_with("no answer")) return "no answer";
  if (actual.find(" values: ") != std::string_view::npos) return std::nullopt;  // of a step played for many
  if (step.starts_with("upload ")) return "a value";
  return std::nullopt;
}

/// Entries that a device changes by itself: errors, clocks, the reply of a command, the state of a store.
constexpr std::array<std::uint16_t, 8> restless{0x1001, 0x1002, 0x1003, 0x1010,
                                                0x1011, 0x1013, 0x1023, 0x1025};

bool is_restless(Index index) { return std::ranges::find(restless, index.value()) != restless.end(); }

bool is_steady(const Multiplexer& object) {
  const auto index = object.index.value();
  return index >= 0x1000 && index <= 0x1FFF && !is_restless(object.index);
}

/// There or not there: that is no matter of what had happened before.
bool tells_of_absence(std::string_view kind) {
  return kind.find("abort 0602 0000h") != std::string_view::npos;
}

/// Whether a condition asked for such an entry: it held or not by what had happened before.
bool tells_of_restless(const CaseResult& one) {
  if (tells_of_absence(one.reason)) return false;
  return std::ranges::any_of(restless, [&](std::uint16_t index) {
    return one.reason.find(to_string(Index(index))) != std::string::npos;
  });
}

/// The object of "upload 1018h:01 by block", and no other step.
std::optional<Multiplexer> uploaded(std::string_view step) {
  constexpr std::string_view verb = "upload ";
  if (!step.starts_with(verb)) return std::nullopt;
  const auto rest = step.substr(verb.size());
  // Behind a comma a step says how it departs from a usual transfer.
  if (rest.find(',') != std::string_view::npos) return std::nullopt;
  return parse_multiplexer(rest.substr(0, rest.find(' ')));
}

/// A value without how it was transferred: "1.00" of "1.00 (1 segments in 1 sub-blocks, ...)".
std::string_view value_of(std::string_view actual) { return actual.substr(0, actual.find(" (")); }

bool is_decided(Verdict verdict) {
  return verdict == Verdict::pass || verdict == Verdict::waived || verdict == Verdict::warn ||
         verdict == Verdict::fail;
}

/// The step that decided, or that was found wanting.
struct Seen {
  const CaseResult* owner = nullptr;
  Verdict verdict = Verdict::pass;
  std::string_view requirement, step, actual;
};

/// By case, requirement and step; of several of one key the first.
using SeenByStep = std::map<std::tuple<std::string, std::string_view, std::string_view>, Seen>;

SeenByStep seen_in(const RunResult& run) {
  SeenByStep out;
  for (const auto& one : run.cases) {
    // Monitors judge whatever came by; what decided is another frame in every run.
    if (one.suite == "monitor") continue;
    for (const auto& judgement : one.judgements) {
      if (!is_decided(judgement.verdict)) continue;
      const auto add = [&](std::string_view step, std::string_view actual) {
        out.try_emplace({one.name(), judgement.requirement, step_shape(step)},
                        Seen{&one, judgement.verdict, judgement.requirement, step, actual});
      };
      for (const auto& finding : judgement.findings) add(finding.step, finding.actual);
      if (judgement.decided_by) add(judgement.decided_by->step, judgement.decided_by->actual);
    }
  }
  return out;
}

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

std::vector<ValueChange> entry_changes(const RunResult& before, const RunResult& after) {
  std::map<Multiplexer, ValueChange> out;
  const auto old_steps = seen_in(before);
  for (const auto& [key, now] : seen_in(after)) {
    const auto found = old_steps.find(key);
    const auto object = uploaded(now.step);
    if (found == old_steps.end() || !object || !is_steady(*object)) continue;
    const auto is_value = [](const Seen& seen) { return answer_kind(seen.step, seen.actual) == "a value"; };
    if (!is_value(found->second) || !is_value(now)) continue;
    const auto was = value_of(found->second.actual), is = value_of(now.actual);
    if (was != is)
      out.try_emplace(*object, ValueChange{to_string(*object), std::string(was), std::string(is)});
  }
  // What a run wrote, it had looked at before.
  std::map<Multiplexer, const Change*> old_values;
  for (const auto& each : before.changes) old_values.emplace(each.object, &each);
  for (const auto& each : after.changes) {
    const auto found = old_values.find(each.object);
    if (found == old_values.end() || !is_steady(each.object) || found->second->before == each.before)
      continue;
    out.try_emplace(each.object, ValueChange{to_string(each.object), hex_bytes(found->second->before),
                                             hex_bytes(each.before)});
  }
  std::vector<ValueChange> list;
  for (auto& [object, change] : out) list.push_back(std::move(change));
  return list;
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
