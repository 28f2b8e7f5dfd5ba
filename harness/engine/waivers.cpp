// SPDX-License-Identifier: Apache-2.0
#include "engine/waivers.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "scenario/selection.hpp"

namespace conform::engine {

using result::Verdict;

namespace {

/// "firmware 2.1; FW-12, drives team, until 2027-03-31"
std::string words(const device::Waiver& waiver) {
  std::vector<std::string> more;
  if (!waiver.ticket.empty()) more.push_back(waiver.ticket);
  if (!waiver.owner.empty()) more.push_back(waiver.owner);
  if (waiver.expires) more.push_back("until " + device::to_string(*waiver.expires));
  return waiver.reason + (more.empty() ? "" : " (" + join(more, ", ") + ")");
}

bool is_about(const device::Waiver& waiver, const result::CaseResult& one) {
  return waiver.case_name.empty() || scenario::matches_pattern(waiver.case_name, one.name());
}

/// Some case judged what the waiver is about: that nothing failed then says something.
bool was_judged(const device::Waiver& waiver, const std::string& requirement, const result::RunResult& run) {
  return std::ranges::any_of(run.cases, [&](const result::CaseResult& one) {
    return is_about(waiver, one) &&
           std::ranges::any_of(one.judgements, [&](const result::Judgement& judgement) {
             return judgement.requirement == requirement &&
                    (judgement.verdict == Verdict::pass || judgement.verdict == Verdict::warn);
           });
  });
}

}  // namespace

bool covers(const device::Waiver& waiver, std::string_view requirement, const result::CaseResult& one,
            const result::Judgement& judgement) {
  if (requirement != judgement.requirement || !is_about(waiver, one)) return false;
  // Of several objects that fail in one case every one has to be waived.
  return !waiver.object || std::ranges::all_of(judgement.findings, [&](const result::Finding& finding) {
    return finding.verdict != Verdict::fail || finding.object == waiver.object;
  });
}

Waivers::Waivers(std::span<const device::Waiver> waivers, const scenario::Catalogue& catalogue,
                 std::chrono::sys_days today)
    : waivers_(waivers), today_(today) {
  for (const auto& each : waivers)
    work_.push_back({.requirement = catalogue.canonical(each.requirement).value_or("")});
}

void Waivers::apply(result::CaseResult& one) {
  auto verdict = Verdict::not_applicable;
  for (auto& judgement : one.judgements) {
    for (std::size_t i = 0; i < waivers_.size() && judgement.verdict == Verdict::fail; ++i) {
      const auto& waiver = waivers_[i];
      if (!covers(waiver, work_[i].requirement, one, judgement)) continue;
      if (has_expired(waiver)) {
        work_[i].refused = true;
        for (auto& finding : judgement.findings) {
          if (finding.verdict == Verdict::fail)
            finding.reason +=
                "; it was waived until " + device::to_string(*waiver.expires) + ": " + waiver.reason;
        }
        continue;
      }
      judgement.verdict = Verdict::waived;
      judgement.waived = words(waiver);
      for (auto& finding : judgement.findings) {
        if (finding.verdict == Verdict::fail) finding.verdict = Verdict::waived;
        finding.reason += "; waived: " + judgement.waived;
      }
      work_[i].cases.push_back(one.name());
    }
    verdict = worst(verdict, judgement.verdict);
  }
  if (one.verdict == Verdict::fail) one.verdict = verdict;
}

std::vector<result::WaiverUse> Waivers::uses(const result::RunResult& run,
                                             const std::function<bool(std::string_view)>& names_a_case,
                                             bool strict) const {
  std::vector<result::WaiverUse> out;
  const auto doubtful = strict ? Verdict::fail : Verdict::warn;
  for (std::size_t i = 0; i < waivers_.size(); ++i) {
    const auto& waiver = waivers_[i];
    const auto& work = work_[i];
    result::WaiverUse use{.requirement = work.requirement.empty() ? waiver.requirement : work.requirement,
                          .case_name = waiver.case_name,
                          .object = waiver.object,
                          .reason = waiver.reason,
                          .owner = waiver.owner,
                          .ticket = waiver.ticket,
                          .expires = waiver.expires ? device::to_string(*waiver.expires) : "",
                          .place = waiver.place,
                          .cases = work.cases};
    if (work.requirement.empty()) {
      use.verdict = doubtful;
      use.state = "there is no such requirement";
    } else if (!waiver.case_name.empty() && !names_a_case(waiver.case_name)) {
      use.verdict = doubtful;
      use.state = "there is no such case";
    } else if (!work.cases.empty()) {
      use.verdict = Verdict::waived;
      use.state = "used";
    } else if (work.refused) {
      use.verdict = Verdict::fail;
      use.state = "expired";
    } else if (was_judged(waiver, work.requirement, run)) {
      use.verdict = doubtful;
      use.state = "not needed any more: nothing that it covers failed";
    } else {
      use.verdict = Verdict::not_applicable;
      use.state = "what it covers was not judged";
    }
    out.push_back(std::move(use));
  }
  return out;
}

}  // namespace conform::engine
