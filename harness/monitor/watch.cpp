// SPDX-License-Identifier: Apache-2.0
#include "monitor/watch.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/check.hpp"
#include "base/text.hpp"
#include "canopen/decode.hpp"

namespace conform::monitor {
namespace {

using result::Verdict;

constexpr std::size_t evidence_before = 6;
constexpr std::size_t evidence_after = 2;
// So that the decoder knows the open transfer: a sub-block has at most 127 segments.
constexpr std::size_t decoded_before = 160;

std::vector<result::EvidenceFrame> evidence(std::span<const can::CapturedFrame> frames, NodeId node,
                                            std::size_t decisive) {
  std::vector<result::EvidenceFrame> out;
  const auto back = [decisive](std::size_t count) { return decisive > count ? decisive - count : 0; };
  const auto last = std::min(frames.size(), decisive + evidence_after + 1);
  canopen::Decoder decoder(node);
  for (auto i = back(decoded_before); i < last; ++i) {
    auto meaning = decoder.meaning(frames[i].frame, frames[i].direction);
    if (i < back(evidence_before)) continue;
    out.push_back({.frame = frames[i].frame,
                   .time = frames[i].time,
                   .direction = frames[i].direction,
                   .capture_index = i,
                   .meaning = std::move(meaning),
                   .decisive = i == decisive});
  }
  return out;
}

/// Numbered from 1, as Wireshark does.
std::string words(const Violation& violation) {
  const auto& frame = violation.frame;
  return fmt::format("frame {}, {}{}{}", violation.index + 1,
                     frame.extended ? hex(frame.id, 8) : to_string(CanId(frame.id)),
                     frame.size() > 0 ? " " : "", hex_bytes(frame.bytes()));
}

/// Which case ran when the frame came; empty where no cases ran at all.
std::string case_at(std::size_t index, std::span<const result::CaseResult> cases) {
  bool before = true;
  for (const auto& each : cases) {
    if (each.first_frame == each.end_frame) continue;
    if (index >= each.first_frame && index < each.end_frame) return each.name();
    before = before && index < each.first_frame;
  }
  if (cases.empty()) return "";
  return before ? "the preparation of the run" : "no case: between or behind them";
}

Verdict capped(Verdict verdict, Verdict cap) { return verdict == Verdict::fail ? cap : verdict; }

void conclude_one(const Monitor& monitor, std::span<const can::CapturedFrame> frames, NodeId node,
                  const Cap& cap, std::span<const Loss> losses, std::span<const Loss> late,
                  std::span<const result::CaseResult> others, result::CaseResult& out) {
  const auto& rule = monitor.rule();
  out.verdict = Verdict::not_applicable;
  for (std::size_t i = 0; i < rule.requirements.size(); ++i) {
    const auto worst_allowed = cap(rule.requirements[i]);
    if (!worst_allowed) continue;
    const auto& tally = monitor.tallies()[i];
    result::Judgement judgement;
    judgement.requirement = rule.requirements[i];
    judgement.expectations = tally.judged;
    judgement.verdict = tally.judged > 0 ? Verdict::pass : Verdict::not_applicable;
    for (const auto& violation : monitor.violations()) {
      if (violation.requirement != i) continue;
      result::Finding finding;
      finding.requirement = judgement.requirement;
      finding.verdict = capped(violation.verdict, *worst_allowed);
      finding.step = words(violation);
      finding.accepts = {violation.expected};
      finding.actual = violation.actual;
      finding.reason = violation.reason;
      finding.evidence = evidence(frames, node, violation.index);
      finding.frames_seen = violation.index + 1;
      const auto among = [&violation](std::span<const Loss> all) {
        return std::ranges::any_of(all, [&](const Loss& each) {
          return violation.index >= each.begin && violation.index < each.end;
        });
      };
      finding.during = case_at(violation.index, others);
      if (among(losses)) {
        finding.verdict = Verdict::inconclusive;
        finding.reason += "; but the host lost frames at that time";
      } else if (monitor.rests_on_time(i) && among(late)) {
        finding.verdict = Verdict::inconclusive;
        finding.reason += "; but the machine, which the device shares, was late at that time";
      }
      judgement.verdict = worst(judgement.verdict, finding.verdict);
      judgement.findings.push_back(std::move(finding));
    }
    if (tally.violated > judgement.findings.size() && !judgement.findings.empty()) {
      judgement.findings.back().reason +=
          fmt::format("; {} more of this kind were counted", tally.violated - judgement.findings.size());
    }
    out.verdict = worst(out.verdict, judgement.verdict);
    out.judgements.push_back(std::move(judgement));
  }
  out.reason = out.verdict == Verdict::not_applicable ? std::string(rule.nothing) : std::string();
  out.finished = true;
  if (!frames.empty()) out.begin = out.end = frames.front().time;
  out.end_frame = frames.size();
}

}  // namespace

Watch::Watch(const Facts& facts, std::span<const Rule* const> chosen) : follower_(facts) {
  for (const auto* rule : chosen) {
    monitors_.push_back(rule->make(*rule));
    for (std::size_t i = 0; i < concerned_.size(); ++i) {
      if (monitors_.back()->wants(static_cast<Observation::Subject>(i)))
        concerned_[i].push_back(monitors_.back().get());
    }
  }
}

const Observation& Watch::look_at(const can::CapturedFrame& captured, std::size_t index) {
  const auto& seen = follower_.follow(captured, index);
  if (seen.subject == Observation::Subject::other) return seen;
  for (auto* monitor : concerned_[static_cast<std::size_t>(seen.subject)]) {
    const auto before = monitor->counted();
    monitor->on_frame(seen, follower_);
    counted_ += monitor->counted() - before;
    waiting_ = waiting_ || monitor->waits();
  }
  if (waiting_ && seen.from_device()) {
    waiting_ = false;
    for (const auto& monitor : monitors_) monitor->alive();
  }
  return seen;
}

void Watch::on_loss() {
  follower_.lose_track();
  for (const auto& monitor : monitors_) {
    const auto before = monitor->counted();
    monitor->on_loss();
    counted_ += monitor->counted() - before;
  }
}

void Watch::end() {
  for (const auto& monitor : monitors_) monitor->end(follower_);
}

std::string case_id(const Rule& rule) { return fmt::format("{}/{}", suite_name, rule.name); }

result::CaseResult planned_case(const Rule& rule, const Cap& cap) {
  result::CaseResult out;
  out.id = case_id(rule);
  out.title = rule.title;
  out.suite = suite_name;
  for (const auto requirement : rule.requirements) {
    if (cap(requirement)) out.requirements.emplace_back(requirement);
  }
  return out;
}

void conclude(Watch& watch, std::span<const can::CapturedFrame> frames, NodeId node,
              std::span<const Rule* const> chosen, const Cap& cap, std::span<const Loss> losses,
              std::span<const result::CaseResult> others, std::span<result::CaseResult> cases,
              std::span<const Loss> late) {
  CONFORM_CHECK(chosen.size() == cases.size());
  watch.end();
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto found =
        std::ranges::find_if(watch.monitors(), [&](const auto& each) { return &each->rule() == chosen[i]; });
    CONFORM_CHECK(found != watch.monitors().end());
    conclude_one(**found, frames, node, cap, losses, late, others, cases[i]);
  }
}

void judge(std::span<const can::CapturedFrame> frames, const Facts& facts,
           std::span<const Rule* const> chosen, const Cap& cap, std::span<const Loss> losses,
           std::span<const result::CaseResult> others, std::span<result::CaseResult> cases,
           std::span<const Loss> late) {
  Watch watch(facts, chosen);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (std::ranges::any_of(losses, [i](const Loss& loss) { return loss.end == i; })) watch.on_loss();
    watch.on_frame(frames[i], i);
  }
  conclude(watch, frames, facts.node, chosen, cap, losses, others, cases, late);
}

}  // namespace conform::monitor
