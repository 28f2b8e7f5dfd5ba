// SPDX-License-Identifier: Apache-2.0
#include "engine/trust.hpp"

#include <chrono>

#include "base/text.hpp"

namespace conform::engine {

using result::Verdict;
using namespace std::chrono_literals;

namespace {

/// A busy machine is late once in some seconds.
constexpr Duration remembered = 30s;

}  // namespace

std::optional<HostTrouble> trouble_of(const can::BusHealth& before, const can::BusHealth& after,
                                      const Recorder::Lateness& lateness, bool other_client) {
  if (after.frames_dropped > before.frames_dropped) {
    return HostTrouble{"the host lost " + std::to_string(after.frames_dropped - before.frames_dropped) +
                       " frames during the case"};
  }
  if (after.bus_offs > before.bus_offs || (after.bus_off && !before.bus_off))
    return HostTrouble{"bus-off during the case"};
  if (after.clock_steps > before.clock_steps || (after.clock_stepped && !before.clock_stepped))
    return HostTrouble{"the host's clock was set during the case"};
  if (after.transmit_stalls > before.transmit_stalls) {
    return HostTrouble{.why = "the interface held a frame back for more than " +
                              to_string(can::host_is_late) + " during the case",
                       .passes_by = true};
  }
  if (other_client) return HostTrouble{"another SDO client used the channel during the case"};
  if (lateness.producing > Duration(0)) {
    return HostTrouble{.why = "the host sent a cyclic frame " + to_string(lateness.producing) + " late",
                       .passes_by = true};
  }
  if (lateness.waking > can::host_is_late || after.late_frames > before.late_frames) {
    return HostTrouble{
        .why = "the host was late by more than " + to_string(can::host_is_late) + " during the case",
        .late_only = true,
        .passes_by = true};
  }
  return std::nullopt;
}

std::optional<HostTrouble> machine_trouble(const can::TransportInfo& info,
                                           const std::optional<Recorder::LateWaking>& latest, BusTime begin) {
  if (!info.is_virtual || !latest || latest->at + remembered < begin) return std::nullopt;
  return HostTrouble{
      .why = "the machine, which the device shares, was late by " +
             std::to_string(std::chrono::round<std::chrono::milliseconds>(latest->by).count()) + " ms",
      .late_only = true,
      .passes_by = true,
      .machine_only = true};
}

void distrust(result::CaseResult& result, const HostTrouble& trouble) {
  if (result.verdict == Verdict::not_applicable) return;
  auto verdict = Verdict::not_applicable;
  for (auto& judgement : result.judgements) {
    const bool good = judgement.verdict == Verdict::pass || judgement.verdict == Verdict::not_applicable;
    if (!good || !trouble.late_only) {
      judgement.verdict = trouble.late_only ? Verdict::not_applicable : Verdict::inconclusive;
      for (auto& finding : judgement.findings) {
        if (finding.rests_on_time || !trouble.late_only) finding.verdict = Verdict::inconclusive;
        judgement.verdict = worst(judgement.verdict, finding.verdict);
      }
      if (judgement.findings.empty()) judgement.verdict = Verdict::inconclusive;
    }
    verdict = worst(verdict, judgement.verdict);
  }
  for (auto& finding : result.setup_findings) {
    finding.verdict = Verdict::inconclusive;
    verdict = worst(verdict, Verdict::inconclusive);
  }
  if (result.judgements.empty() && result.setup_findings.empty()) verdict = Verdict::inconclusive;
  // Stopped for a reason of its own.
  if (result.verdict == Verdict::inconclusive) verdict = worst(verdict, Verdict::inconclusive);
  if (verdict != result.verdict) result.reason = trouble.why;
  result.verdict = verdict;
}

void withdraw(result::CaseResult& result, std::size_t last_heard) {
  result.verdict = Verdict::error;
  for (auto& judgement : result.judgements) {
    judgement.verdict = Verdict::error;
    for (auto& finding : judgement.findings) {
      if (finding.frames_seen >= last_heard) finding.verdict = Verdict::error;
      judgement.verdict = worst(judgement.verdict, finding.verdict);
    }
    result.verdict = worst(result.verdict, judgement.verdict);
  }
}

}  // namespace conform::engine
