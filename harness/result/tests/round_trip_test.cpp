// SPDX-License-Identifier: Apache-2.0
#include "catch.hpp"
#include "result/run_json.hpp"

using namespace conform;
using namespace conform::result;
using namespace conform::result;

namespace {

/// Every member with a value that is not its default.
EvidenceFrame full_frame() {
  EvidenceFrame out;
  out.frame.id = 0x12345678;
  out.frame.extended = out.frame.remote = out.frame.error = true;
  out.frame.dlc = 12;
  out.frame.data = {1, 2, 3, 4, 5, 6, 7, 0xFF};
  out.time = BusTime(Duration(-5));
  out.direction = can::Direction::transmitted;
  out.capture_index = 77;
  out.meaning = "SDO upload";
  out.decisive = true;
  return out;
}

Finding full_finding() {
  Finding out;
  out.verdict = Verdict::warn;
  out.requirement = "OD-1003-06";
  out.position = {"cia301/x.yaml", 7, 9};
  out.step = "download 1003h:00 = 02h";
  out.accepts = {"abort", "silence"};
  out.tolerates = {"other"};
  out.actual = std::string("device said \xFF\x00\xC3(", 16);
  out.actual_bytes = {0, 0xFF};
  out.reason = "a sentence with \"quotes\", \n and umlauts \xC3\xA4";
  out.evidence = {full_frame(), {}};
  out.declared_at = "device.eds:120";
  out.during = "another";
  out.object = Index(0x1003);
  out.deviation = "confirmed instead of refused";
  out.broken_rules = {"SDO-GEN-02", "SDO-GEN-03"};
  out.frames_seen = 123456789;
  out.rests_on_time = true;
  out.listened = Listening{BusTime(Duration(5)), BusTime(Duration(70))};
  out.prepared = {"nmt start", "download 1017h:00 = 0064h"};
  return out;
}

CaseResult full_case() {
  CaseResult out;
  out.id = "a/b";
  out.instance = "02h";
  out.title = "A title";
  out.suite = "a";
  out.position = {"a.yaml", 1, 2};
  out.requirements = {"R-1", "R-2"};
  out.cct = {"5.1"};
  out.judgements = {
      {.requirement = "R-1",
       .verdict = Verdict::inconclusive,
       .findings = {full_finding()},
       .expectations = 3,
       .frames_seen = 4,
       .decided_by =
           DecidingStep{.position = {"a.yaml", 3, 4}, .step = "upload", .actual = "got", .frame = 9},
       .reason = "rests on R-2",
       .waived = "known"}};
  out.setup_findings = {full_finding()};
  out.verdict = Verdict::not_applicable;
  out.reason = "";
  out.rests_on = "R-2";
  out.wants = {{"object", "a DOMAIN"}};
  out.tried = "2 times";
  out.finished = true;
  out.begin = BusTime(Duration(1));
  out.end = BusTime(Duration(2));
  out.first_frame = 3;
  out.end_frame = 4;
  return out;
}

RunResult full_run() {
  RunResult out;
  out.tool = "tool";
  out.host = "host";
  out.started_utc_ns = 1'700'000'000'000'000'001;
  out.elapsed = Duration(5);
  out.device = "device";
  out.properties = {{"a", "b"}, {"a", "\x80"}};
  out.cases = {full_case(), {}};
  out.requirements = {{"R-1", "7.5", "mandatory", "area", "statement"}};
  out.notes = {"note", ""};
  out.aborted = "";
  out.signal = 15;
  out.unwritten = {"file: full"};
  out.likenesses = {{"R-1", "a/b", "a-defect", "what is wrong", 67}};
  EntryFacts entry{{Index(0x1018), SubIndex(1)},
                   "name",
                   "d.eds:7",
                   true,
                   "UNSIGNED32",
                   "ro",
                   true,
                   "0",
                   "9",
                   "1",
                   4,
                   "absent",
                   "why",
                   3,
                   "01 02 03"};
  out.dictionary = {entry};
  out.compared = {{"2.10", "SDO", "a value above the limit", "failed", "OD-RNG-01", {"a/b"}}};
  return out;
}

/// What a structure starts with; a member that is still so in the full run was forgotten there.
void no_default(const Json& json, const Json& plain, const std::string& path) {
  if (!json.is_object() || json.contains("hex")) return;
  for (const auto& [name, value] : json.items()) {
    INFO(path + "/" + name);
    if (plain.contains(name) && !value.is_object()) CHECK(value != plain.at(name));
    if (value.is_object())
      no_default(value, plain.contains(name) ? plain.at(name) : Json(), path + "/" + name);
  }
}

}  // namespace

TEST_CASE("every member of a run survives the way through JSON") {
  const auto run = full_run();
  const auto text = to_json(run).dump();
  RunResult back;
  from_json(Json::parse(text), back);
  REQUIRE(to_json(back).dump() == text);

  // The structures themselves, so that a member that the list of members drops is noticed.
  CHECK(back.tool == run.tool);
  CHECK(back.started_utc_ns == run.started_utc_ns);
  CHECK(back.elapsed == run.elapsed);
  CHECK(back.properties[1].value == "\x80");
  REQUIRE(back.aborted);
  CHECK(back.aborted->empty());
  CHECK(back.signal == 15);
  CHECK(back.notes == run.notes);
  CHECK(back.unwritten == run.unwritten);
  REQUIRE(back.compared.size() == 1);
  CHECK(back.compared[0].cases == run.compared[0].cases);
  CHECK(back.requirements[0].statement == "statement");
  REQUIRE(back.cases.size() == 2);
  CHECK(back.cases[1].reason == "not run");
  const auto& one = back.cases[0];
  CHECK(one.reason.empty());
  CHECK(one.wants == std::vector<Want>{{"object", "a DOMAIN"}});
  CHECK(one.finished);
  CHECK(one.end_frame == 4);
  CHECK(one.setup_findings.size() == 1);
  const auto& judgement = one.judgements.at(0);
  CHECK(judgement.expectations == 3);
  CHECK(judgement.frames_seen == 4);
  REQUIRE(judgement.decided_by);
  CHECK(judgement.decided_by->frame == 9);
  CHECK(judgement.reason == "rests on R-2");
  const auto& finding = judgement.findings.at(0);
  CHECK(finding.actual == full_finding().actual);
  CHECK(finding.actual_bytes == full_finding().actual_bytes);
  CHECK(finding.frames_seen == 123456789);
  CHECK(finding.evidence.size() == 2);
  CHECK(finding.evidence[0].frame == full_frame().frame);
  CHECK(finding.evidence[0].time == full_frame().time);
  CHECK(finding.evidence[0].direction == can::Direction::transmitted);
  CHECK(finding.evidence[0].decisive);
}

TEST_CASE("the full run of the test leaves no member at its default") {
  no_default(to_json(full_case()), to_json(CaseResult()), "case");
  no_default(to_json(full_run()), to_json(RunResult()), "run");
}

TEST_CASE("text that is no UTF-8 comes back byte for byte") {
  for (const std::string& text :
       {std::string("\xC0\x80", 2), std::string("\xED\xA0\x80", 3), std::string("\xF4\x90\x80\x80", 4),
        std::string("a\0b", 3), std::string("\xC3"), std::string("\xE2\x82\xAC")}) {
    CHECK(text_of(Json::parse(text_json(text).dump())) == text);
  }
}
