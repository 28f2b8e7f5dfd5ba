// SPDX-License-Identifier: Apache-2.0
#include "engine/case_book.hpp"

#include <algorithm>
#include <iterator>

#include "base/check.hpp"

namespace conform::engine {

using result::Verdict;
using steps::Actual;
using steps::Grade;
using steps::Step;

namespace {

constexpr std::size_t offenders_named = 8;

}  // namespace

result::Judgement& CaseBook::judgement(const std::string& requirement) {
  auto& all = out_->judgements;
  const auto found = std::ranges::find(all, requirement, &result::Judgement::requirement);
  if (found != all.end()) return *found;
  result::Judgement fresh;
  fresh.requirement = requirement;
  fresh.verdict = Verdict::not_applicable;
  return all.emplace_back(std::move(fresh));
}

void CaseBook::record(const Step& step, const std::string& requirement, const Grade& given,
                      const Actual& actual) {
  auto grade = given;
  if (grade.verdict == Verdict::fail || grade.verdict == Verdict::warn) {
    if (const auto rule = witness_.rule_below(requirement, actual, catalogue_)) {
      grade = {Verdict::inconclusive, "rests on " + *rule + ", which failed"};
      out_->rests_on = *rule;
    }
  }
  auto& target = judgement(requirement);
  ++target.expectations;
  target.frames_seen = session_.capture().size();
  // The first that passed, unless something worse came.
  if (grade.verdict != Verdict::not_applicable && (!target.decided_by || grade.verdict > target.verdict)) {
    target.decided_by = result::DecidingStep{{out_->position.file, step.position.line, step.position.column},
                                             step.action->words(session_),
                                             actual.words(),
                                             actual.decisive};
  }
  target.verdict = worst(target.verdict, grade.verdict);
  const bool in_walk = !value_.empty();
  if (in_walk) ++offenders(step, requirement).judged;
  if (grade.verdict == Verdict::pass || grade.verdict == Verdict::not_applicable) return;
  if (in_walk) {
    auto& all = offenders(step, requirement);
    const auto described = witness_.declared_at(step, actual);
    all.values.push_back(value_ + (described.empty() ? "" : " (" + described + ")") + ": " + actual.words());
    if (all.values.size() > 1) {
      // One finding for all, with the evidence of the first of the worst.
      auto& told = target.findings[all.finding];
      if (told.verdict < grade.verdict) told = witness_.finding(step, requirement, grade, actual);
      return;
    }
    all.finding = target.findings.size();
  }
  target.findings.push_back(witness_.finding(step, requirement, grade, actual));
}

CaseBook::Offenders& CaseBook::offenders(const Step& step, const std::string& requirement) {
  const auto found = std::ranges::find_if(offenders_, [&](const Offenders& each) {
    return each.step == &step && each.requirement == requirement;
  });
  if (found != offenders_.end()) return *found;
  Offenders fresh;
  fresh.step = &step;
  fresh.requirement = requirement;
  return offenders_.emplace_back(std::move(fresh));
}

void CaseBook::end_walk(const std::string& why) {
  for (const auto& offenders : offenders_) {
    if (offenders.values.empty()) continue;
    auto& finding = judgement(offenders.requirement).findings[offenders.finding];
    std::string text =
        std::to_string(offenders.values.size()) + " of " + std::to_string(offenders.judged) + " values: ";
    for (std::size_t i = 0; i < std::min(offenders.values.size(), offenders_named); ++i) {
      text += (i == 0 ? "" : "; ") + offenders.values[i];
    }
    if (offenders.values.size() > offenders_named) text += "; ...";
    if (!why.empty()) text += "; " + why;
    finding.actual = text;
  }
  offenders_.clear();
  value_.clear();
}

std::size_t CaseBook::offences() const {
  std::size_t out = out_->setup_findings.size();
  for (const auto& each : offenders_) out += each.values.size();
  return out;
}

std::vector<result::Judgement> CaseBook::passes() const {
  std::vector<result::Judgement> out;
  // Findings are heavy, and a pass has none.
  std::ranges::copy_if(out_->judgements, std::back_inserter(out),
                       [](const auto& each) { return each.verdict == Verdict::pass; });
  return out;
}

void CaseBook::withdraw_passes(const std::vector<std::string>& open,
                               const std::vector<result::Judgement>& before) {
  for (const auto& requirement : open) {
    const auto found = std::ranges::find(out_->judgements, requirement, &result::Judgement::requirement);
    if (found == out_->judgements.end() || found->verdict != Verdict::pass) continue;
    // Other values of an `over` may have decided it.
    const auto was = std::ranges::find(before, requirement, &result::Judgement::requirement);
    if (was != before.end()) {
      *found = *was;
      continue;
    }
    found->verdict = Verdict::not_applicable;
    found->decided_by.reset();
    found->reason = out_->reason;
  }
}

void CaseBook::conclude(const std::string& stopped_because, const std::vector<std::string>& open) {
  // What the case could have judged and did not reach, because it had to stop, is open and not passed.
  if (!stopped_because.empty()) {
    for (const auto& requirement : out_->requirements) {
      auto& target = judgement(requirement);
      if (target.expectations == 0) target.verdict = Verdict::inconclusive;
    }
    // Nor has passed what was judged in part only.
    for (const auto& requirement : open) {
      auto& target = judgement(requirement);
      target.verdict = worst(target.verdict, Verdict::inconclusive);
    }
  }
  auto verdict = Verdict::not_applicable;
  for (const auto& each : out_->judgements) {
    CONFORM_CHECK(each.verdict != Verdict::pass || each.decided_by);
    verdict = worst(verdict, each.verdict);
  }
  if (!stopped_because.empty()) verdict = worst(verdict, Verdict::inconclusive);
  out_->verdict = verdict;
  if (!stopped_because.empty()) {
    out_->reason = stopped_because;
  } else if (verdict != Verdict::not_applicable) {
    out_->reason.clear();
  }
}

void CaseBook::judge_restart(result::CaseResult& out, std::size_t restart,
                             const std::optional<monitor::Stimulus>& stimulus, bool again, bool doubtful) {
  const auto frame = "boot-up message in frame " + std::to_string(restart + 1);
  // It may have gone long before it said that it was back.
  const auto since = stimulus ? stimulus->first : restart;
  const auto why = std::string("the device restarted although nobody told it to (") + frame + ")";
  for (auto& judgement : out.judgements) {
    if (judgement.verdict == Verdict::not_applicable || judgement.verdict == Verdict::error) continue;
    if (judgement.frames_seen <= since) continue;
    const auto* requirement = catalogue_.find(judgement.requirement);
    const bool named = requirement != nullptr && requirement->forbids_restart();
    if (named && stimulus && judgement.verdict == Verdict::fail && (again || !doubtful)) continue;
    if (named && again) {
      result::Finding finding;
      finding.verdict = judgement.verdict = Verdict::fail;
      finding.requirement = judgement.requirement;
      finding.position = out.position;
      finding.step = "the frames from " + std::to_string(stimulus->first + 1) + " to " +
                     std::to_string(stimulus->last + 1);
      finding.accepts = {"the device goes on"};
      finding.actual = "the device restarted: " + frame;
      finding.reason = "it restarted again when it got the same frames once more";
      finding.evidence = witness_.evidence(out.first_frame, stimulus->first, restart);
      finding.frames_seen = session_.capture().size();
      judgement.findings.push_back(std::move(finding));
      continue;
    }
    judgement.verdict = Verdict::inconclusive;
    judgement.reason = why;
    for (auto& finding : judgement.findings) {
      if (finding.frames_seen <= since) {
        judgement.verdict = worst(judgement.verdict, finding.verdict);
      } else {
        finding.verdict = Verdict::inconclusive;
        finding.reason += "; but " + why;
      }
    }
  }
  auto verdict = Verdict::not_applicable;
  for (const auto& each : out.judgements) verdict = worst(verdict, each.verdict);
  if (!out.setup_findings.empty()) verdict = worst(verdict, Verdict::inconclusive);
  out.verdict = verdict;
  if (verdict == Verdict::inconclusive) out.reason = why;
}

}  // namespace conform::engine
