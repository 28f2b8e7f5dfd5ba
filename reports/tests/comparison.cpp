// SPDX-License-Identifier: Apache-2.0
#include "comparison.hpp"

#include <chrono>

#include "fixture.hpp"

namespace conform::reports::testing {
namespace {

using namespace std::chrono_literals;
using result::CaseResult;
using result::RunResult;
using result::Verdict;

void pass(CaseResult& one) {
  for (auto& judgement : one.judgements) {
    judgement.findings.clear();
    judgement.verdict = Verdict::pass;
  }
  one.verdict = Verdict::pass;
  one.reason.clear();
}

/// A case that one step decided.
CaseResult answered(const std::string& id, const std::string& rule, const std::string& step,
                    const std::string& came) {
  CaseResult one;
  one.id = "cia301/dictionary/" + id;
  one.suite = "cia301/dictionary";
  one.title = "an entry is read";
  one.requirements = {rule};
  one.verdict = Verdict::pass;
  one.reason.clear();
  one.finished = true;
  result::Judgement judgement{rule, Verdict::pass, {}, 1};
  judgement.decided_by = result::DecidingStep{{}, step, came, {}};
  one.judgements = {judgement};
  return one;
}

CaseResult left_out(CaseResult one, const std::string& why) {
  for (auto& judgement : one.judgements) judgement.verdict = Verdict::not_applicable;
  one.verdict = Verdict::not_applicable;
  one.reason = why;
  return one;
}

/// Times around `middle` that are no two the same.
result::Measurement times(const std::string& kind, const std::string& of, Duration middle, Duration step) {
  constexpr int count = 60;
  result::Measurement out{kind, of, {}, {}, {}, count, middle, middle, middle, {}};
  for (int i = 0; i < count; ++i)
    out.samples.push_back({BusTime{1s} + i * 100ms, middle + ((i * 7) % count - count / 2) * step});
  return out;
}

}  // namespace

Pair sample_pair(const std::string& text) {
  Pair out{sample_run(), sample_run()};
  auto& before = out.before;
  auto& after = out.after;
  for (auto* run : {&before, &after}) {
    const bool is_new = run == &after;
    const auto add = [&](CaseResult one) { run->cases.push_back(std::move(one)); };
    add(answered("revision", "OD-1018-05", "upload 1018h:03", is_new ? "0002 0001h" : "0001 0001h"));
    add(answered("name", "OD-1008-02", "upload 1008h:00", is_new ? text : "\"motor 1\""));
    add(answered("long", "OD-1021-01", "upload 1021h:00",
                 std::string(500, '=') + (is_new ? "new" : "old") + std::string(500, '.')));
    add(answered("gain", "OD-ACC-01", "upload 2003h:05",
                 is_new ? "abort 0609 0011h (sub-index does not exist)" : "0005h"));
    add(answered("input", "OD-ACC-02", "upload 6000h:01", is_new ? "01h" : "00h"));
    add(answered(
        "refused", "OD-ACC-03", "download 1000h:00 = 00h",
        is_new ? "abort 0800 0000h (general error)" : "abort 0601 0002h (write of a read-only object)"));
    auto store = answered("store", "OD-1010-01", "upload 1010h:01", "0000 0001h");
    add(is_new ? left_out(store, "1010h:01 is absent: abort 0602 0000h (object does not exist)") : store);
    auto gained = answered("sync", "SYNC-PRO-01", "upload 1006h:00", "0000 0064h");
    add(is_new ? gained : left_out(gained, "1006h:00 is absent: abort 0602 0000h (object does not exist)"));
    for (const auto* instance : {"2000h:01", "2000h:02"}) {
      auto each = answered("each", "OD-ACC-04", "upload 2000h:00", "02h");
      each.instance = instance;
      if (is_new || each.instance != "2000h:02") add(each);
    }
    run->changes = {
        {{Index(0x2000), SubIndex(3)}, {static_cast<std::uint8_t>(is_new ? 9 : 5), 0}, "a", true}};
    run->measurements = {times("SDO answer", "1018h:01", is_new ? 5ms : 2ms, 5us),
                         times("boot-up", "", is_new ? 900ms : 300ms, 1ms)};
    run->properties.push_back({"dut.software_version", is_new ? text : "1.00"});
  }
  // The first failure of the sample is new, the second one is gone.
  bool is_first = true;
  for (std::size_t i = 0; i < after.cases.size(); ++i) {
    if (after.cases[i].verdict != Verdict::fail && after.cases[i].verdict != Verdict::warn) continue;
    pass(is_first ? before.cases[i] : after.cases[i]);
    is_first = false;
  }
  before.requirements.push_back({"OD-9999-01", "CiA 301", "optional", "Old", "only in the old run"});
  before.cases.push_back(answered("old", "OD-9999-01", "upload 1000h:00", "01h"));
  after.aborted = "the device " + text + " fell silent";
  return out;
}

Pair same_pair() { return {sample_run(), sample_run()}; }

}  // namespace conform::reports::testing
