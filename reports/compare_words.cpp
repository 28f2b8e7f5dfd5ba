// SPDX-License-Identifier: Apache-2.0
// What text and Markdown say of a comparison, in the same words.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/text.hpp"
#include "reports/cause_lines.hpp"
#include "reports/compare.hpp"
#include "reports/phrases.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports {
namespace {

using result::Comparison;
using result::Verdict;
using Lines = std::vector<DifferenceLine>;

std::string verdict_text(std::optional<Verdict> verdict) {
  return verdict ? std::string(verdict_words(*verdict)) : "not judged";
}

/// "a, b, c and 4 more"
std::string listed(const std::vector<std::string>& all) {
  constexpr std::size_t most = 12;
  const auto shown = std::min(all.size(), most);
  auto text = join(std::span(all).first(shown), ", ");
  if (all.size() > shown) text += fmt::format(" and {} more", all.size() - shown);
  return text;
}

std::string of_cause(const result::Cause& cause, const result::Place& place) {
  return fmt::format("{} {}: {}", place.finding->requirement, prose(cause.about), headline(*place.finding));
}

/// Further requirements of the findings, without the one that is told first.
void add_further(const std::vector<result::Place>& places, DifferenceLine& line) {
  std::vector<std::string> rules;
  for (const auto& place : places) {
    const auto& rule = place.finding->requirement;
    if (rule != places.front().finding->requirement && std::ranges::find(rules, rule) == rules.end())
      rules.push_back(rule);
  }
  if (!rules.empty()) line.details.push_back("also violated: " + listed(rules));
}

Lines new_lines(const Comparison& comparison) {
  Lines out;
  for (const auto& each : comparison.new_causes) {
    const auto& first = each.fresh.front();
    DifferenceLine line{each.verdict, of_cause(each.cause, first), {}};
    line.details.push_back("case " + first.owner->name());
    if (each.has_spread()) {
      line.details.push_back(fmt::format("the old run has this cause as well; {} of {} are new",
                                         each.fresh.size(), counted(each.cause.findings.size(), "finding")));
    } else {
      line.details.push_back(extent(each.cause));
    }
    add_further(each.fresh, line);
    out.push_back(std::move(line));
  }
  return out;
}

Lines gone_lines(const Comparison& comparison) {
  Lines out;
  for (const auto& each : comparison.gone_causes) {
    DifferenceLine line{each.cause.verdict, of_cause(each.cause, each.cause.primary), {}};
    if (each.left > 0)
      line.details.push_back(
          fmt::format("only in part: {} gone, {} left", counted(each.mended, "finding"), each.left));
    out.push_back(std::move(line));
  }
  return out;
}

/// Requirements that turned in the same way, for the same reason, in one line.
Lines turn_lines(const std::vector<result::Turn>& turns) {
  struct Group {
    std::string turned, reason;
    std::vector<std::string> rules;
    const result::Turn* first = nullptr;
  };
  std::vector<Group> groups;
  for (const auto& turn : turns) {
    const auto turned = verdict_text(turn.after) + ", was " + verdict_text(turn.before);
    const auto reason = turn.where == nullptr ? std::string() : turn.where->reason;
    auto group = std::ranges::find_if(
        groups, [&](const Group& each) { return each.turned == turned && each.reason == reason; });
    if (group == groups.end()) group = groups.insert(groups.end(), {turned, reason, {}, &turn});
    group->rules.push_back(turn.requirement);
  }
  Lines out;
  for (const auto& group : groups) {
    DifferenceLine line{group.first->after, listed(group.rules) + ": " + group.turned, {}};
    if (!group.reason.empty())
      line.details.push_back("case " + group.first->where->name() + ": " + group.reason);
    out.push_back(std::move(line));
  }
  return out;
}

/// "NEW, was OLD", of long ones from shortly before they differ; the JSON has the whole.
std::string was_words(const std::string& before, const std::string& after) {
  constexpr std::size_t most = 100, context = 12;
  const auto different = static_cast<std::size_t>(std::ranges::mismatch(before, after).in1 - before.begin());
  const bool is_long = std::max(before.size(), after.size()) > most;
  const std::size_t from = is_long && different > 2 * context ? different - context : 0;
  const auto part = [&](const std::string& value) {
    if (value.empty()) return std::string("(not there)");
    return clip((from == 0 ? "" : "... ") + log_safe(std::string_view(value).substr(from)), most);
  };
  return part(after) + ", was " + part(before);
}

Lines value_lines(const std::vector<result::ValueChange>& changes) {
  Lines out;
  for (const auto& each : changes) {
    out.push_back({{}, each.name + ": " + was_words(each.before, each.after), {}});
  }
  return out;
}

Lines entry_lines(const Comparison& comparison) {
  Lines out;
  for (const auto& each : comparison.entries) {
    DifferenceLine line{{}, to_string(each.object) + ": " + was_words(each.before, each.after), {}};
    if (each.is_process) line.details.emplace_back(process_words);
    out.push_back(std::move(line));
  }
  return out;
}

Lines observed_lines(const Comparison& comparison) {
  Lines out;
  for (const auto& each : comparison.observed) {
    const auto rule = each.requirement.empty() ? "" : each.requirement + " ";
    const auto what = each.step.empty() ? each.where->name() : each.step;
    DifferenceLine line{{}, rule + what + ": " + was_words(each.before, each.after), {}};
    if (!each.step.empty()) line.details.push_back("case " + each.where->name());
    out.push_back(std::move(line));
  }
  return out;
}

Lines instance_lines(const Comparison& comparison) {
  Lines out;
  for (const auto& each : comparison.instances) {
    DifferenceLine line{{}, each.id, {}};
    if (!each.added.empty()) line.details.push_back("now also for " + listed(each.added));
    if (!each.gone.empty()) line.details.push_back("no longer for " + listed(each.gone));
    out.push_back(std::move(line));
  }
  return out;
}

Lines time_lines(const Comparison& comparison) {
  Lines out;
  for (const auto& each : comparison.times)
    out.push_back({{}, times_title(each) + ": " + times_words(each), {certainty_words(each)}});
  return out;
}

Lines left_out_lines(const Comparison& comparison) {
  Lines out;
  if (!comparison.only_in_old.empty())
    out.push_back({{},
                   counted(comparison.only_in_old.size(), "requirement") + " in the old run only",
                   {listed(comparison.only_in_old)}});
  if (!comparison.only_in_new.empty())
    out.push_back({{},
                   counted(comparison.only_in_new.size(), "requirement") + " in the new run only",
                   {listed(comparison.only_in_new)}});
  for (const auto& remark : comparison.remarks) out.push_back({{}, remark, {}});
  return out;
}

/// Never more than the test can say.
std::string likelihood(double p) {
  if (p < 1e-9) return "less than 1e-9";
  return fmt::format("{:.0e}", p);
}

}  // namespace

std::string times_title(const result::TimesChange& change) {
  return change.of.empty() ? change.kind + ", all of them" : change.kind + " " + change.of;
}

std::string times_words(const result::TimesChange& change) {
  return fmt::format("{} {}, was {}", change.is_spread ? "nine of ten within" : "median",
                     brief_duration(change.after), brief_duration(change.before));
}

std::string certainty_words(const result::TimesChange& change) {
  const auto percent = std::lround(100 * std::max(change.longer, 1 - change.longer));
  const std::string_view how =
      change.is_spread ? (change.longer > 0.5 ? "farther from the middle" : "nearer to the middle")
                       : (change.longer > 0.5 ? "longer" : "shorter");
  return fmt::format("{} in {} % of all pairs; by chance: {} ({} and {} samples)", how, percent,
                     likelihood(change.p), change.samples_before, change.samples_after);
}

std::vector<DifferenceSection> differences(const Comparison& comparison) {
  std::vector<DifferenceSection> out{
      {"New", new_lines(comparison)},
      {"Gone", gone_lines(comparison)},
      {"Requirements that are worse", turn_lines(comparison.worse), comparison.worse.size()},
      {"Requirements that are better", turn_lines(comparison.better), comparison.better.size()},
      {"No longer judged", turn_lines(comparison.lost), comparison.lost.size()},
      {"Now judged as well", turn_lines(comparison.gained), comparison.gained.size()},
      {"Other answers", observed_lines(comparison)},
      {"Identity", value_lines(comparison.identity)},
      {"Dictionary", entry_lines(comparison)},
      {"Tried for other objects", instance_lines(comparison)},
      {"Times", time_lines(comparison)},
      {"Circumstances", value_lines(comparison.circumstances)},
      {"Not compared", left_out_lines(comparison)},
  };
  std::erase_if(out, [](const DifferenceSection& each) { return each.lines.empty(); });
  return out;
}

Outcome outcome_of(const Comparison& comparison, bool strict) {
  const auto failures = static_cast<std::size_t>(
      std::ranges::count(comparison.new_causes, Verdict::fail, &result::NewCause::verdict));
  const auto warnings = comparison.new_causes.size() - failures;
  Outcome out{exit_code(comparison, strict), "not worse", {}};
  if (failures > 0) out.parts.push_back(counted(failures, "new failure"));
  if (warnings > 0) out.parts.push_back(counted(warnings, "new warning"));
  if (const auto undecided = comparison.undecided(); undecided > 0)
    out.parts.push_back(counted(undecided, "requirement") + " could not be judged any more");
  if (!comparison.gone_causes.empty())
    out.parts.push_back(counted(comparison.gone_causes.size(), "cause") + " gone");
  if (comparison.known_failures > 0) {
    out.parts.push_back(counted(comparison.known_failures, "failure") + " that the old run has as well " +
                        (comparison.known_failures == 1 ? "does" : "do") + " not count");
  }
  if (out.code == 1) {
    out.head = "worse";
  } else if (out.code == 3) {
    out.head = "not decided";
  } else if (comparison.is_same()) {
    out.head = "no difference";
  } else if (!comparison.gone_causes.empty() && warnings == 0) {
    out.head = "better";
  } else if (comparison.new_causes.empty()) {
    out.head = "different, but not worse";
  }
  return out;
}

std::string outcome_words(const Comparison& comparison, bool strict) {
  const auto outcome = outcome_of(comparison, strict);
  const std::string head(outcome.head);
  return outcome.parts.empty() ? head : head + ": " + join(outcome.parts, "; ");
}

}  // namespace conform::reports
