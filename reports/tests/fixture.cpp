// SPDX-License-Identifier: Apache-2.0
#include "fixture.hpp"

#include <csignal>
#include <utility>

namespace conform::reports::testing {
namespace {

using namespace std::chrono_literals;
using can::Direction;
using result::CaseResult;
using result::EvidenceFrame;
using result::Finding;
using result::Judgement;
using result::RunResult;
using result::Verdict;

BusTime at(Duration since_start) { return BusTime{since_start}; }

EvidenceFrame frame(std::size_t index, Duration time, Direction direction, can::Frame data,
                    std::string meaning, bool decisive = false) {
  return {data, at(time), direction, index, std::move(meaning), decisive};
}

CaseResult planned(std::string suite, const std::string& key, std::string instance, std::string title) {
  CaseResult one;
  one.id = suite + "/" + key;
  one.instance = std::move(instance);
  one.title = std::move(title);
  one.position = {suite + ".yaml", 8, 5};
  one.suite = std::move(suite);
  return one;
}

void finish(CaseResult& one, Verdict verdict, std::string reason, Duration begin, Duration end) {
  one.verdict = verdict;
  one.reason = std::move(reason);
  one.finished = true;
  one.begin = at(begin);
  one.end = at(end);
}

CaseResult passing() {
  CaseResult one =
      planned("cia301/dictionary/1000-device-type", "readable", "", "The device type can be read");
  one.requirements = {"OD-1000-01"};
  one.cct = {"4.1"};
  one.judgements = {{"OD-1000-01", Verdict::pass, {}, 1}};
  finish(one, Verdict::pass, "", 1s, 1s + 2ms + 400us);
  return one;
}

CaseResult failing() {
  CaseResult one = planned("cia301/dictionary/1003-error-history", "non-zero-write", "02h",
                           "A value other than 00h cannot be written to the number of errors");
  one.requirements = {"OD-1003-06", "OD-1003-07"};
  one.cct = {"4.5", "4.6"};
  Finding finding;
  finding.requirement = "OD-1003-06";
  finding.position = {"cia301/dictionary/1003-error-history.yaml", 14, 19};
  finding.step = "download 1003h:00 = 02h";
  finding.accepts = {"abort 0609 0030h (invalid value)"};
  finding.tolerates = {"abort 0609 0031h (value too high)", "abort 0800 0000h (general error)"};
  finding.actual = "confirmed";
  finding.actual_bytes = {0x60, 0x03, 0x10, 0x00, 0x00, 0x00, 0x00, 0x00};
  finding.reason = "the device confirmed a write that it has to refuse";
  finding.evidence = {
      frame(40, 2s + 100us, Direction::transmitted,
            can::data_frame(CanId{0x603}, {0x40, 0x03, 0x10, 0, 0, 0, 0, 0}), "SDO upload 1003h:00"),
      frame(41, 2s + 1350us, Direction::received,
            can::data_frame(CanId{0x583}, {0x4F, 0x03, 0x10, 0, 0, 0, 0, 0}), "SDO upload 1003h:00 -> 00h"),
      frame(42, 2s + 1600us, Direction::transmitted,
            can::data_frame(CanId{0x603}, {0x2F, 0x03, 0x10, 0, 2, 0, 0, 0}), "SDO download 1003h:00 = 02h"),
      frame(43, 2s + 2840us, Direction::received,
            can::data_frame(CanId{0x583}, {0x60, 0x03, 0x10, 0, 0, 0, 0, 0}),
            "SDO download 1003h:00 confirmed", true),
      frame(44, 2s + 9ms, Direction::received, can::data_frame(CanId{0x703}, {0x7F}),
            "heartbeat of node 03h, Pre-operational"),
  };
  one.judgements = {{"OD-1003-06", Verdict::fail, {finding}, 1}, {"OD-1003-07", Verdict::pass, {}, 1}};
  finish(one, Verdict::fail, "OD-1003-06 is violated", 2s, 2s + 12ms);
  return one;
}

CaseResult warning() {
  CaseResult one = planned("cia301/dictionary/1003-error-history", "field-write", "",
                           "The error fields cannot be written");
  one.requirements = {"OD-1003-08"};
  Finding finding;
  finding.requirement = "OD-1003-08";
  finding.verdict = Verdict::warn;
  finding.position = {"cia301/dictionary/1003-error-history.yaml", 31, 19};
  finding.step = "download 1003h:01 = 0000 0000h";
  finding.accepts = {"abort 0601 0002h (read only)"};
  finding.tolerates = {"abort 0601 0000h (unsupported access)", "abort 0800 0000h (general error)"};
  finding.actual = "abort 0800 0000h (general error)";
  finding.actual_bytes = {0x80, 0x03, 0x10, 0x01, 0x00, 0x00, 0x00, 0x08};
  finding.reason = "refused, but with a less precise abort code than the standard names";
  finding.evidence = {
      frame(50, 3s + 200us, Direction::transmitted,
            can::data_frame(CanId{0x603}, {0x23, 0x03, 0x10, 1, 0, 0, 0, 0}),
            "SDO download 1003h:01 = 0000 0000h"),
      frame(51, 3s + 900us, Direction::received,
            can::data_frame(CanId{0x583}, {0x80, 0x03, 0x10, 1, 0, 0, 0, 0x08}),
            "SDO abort 1003h:01 0800 0000h general error", true),
  };
  one.judgements = {{"OD-1003-08", Verdict::warn, {finding}, 1}};
  finish(one, Verdict::warn, "a tolerated outcome", 3s, 3s + 1ms);
  return one;
}

CaseResult failing_bytes() {
  CaseResult one =
      planned("cia301/nmt/error-control", "heartbeat-after-remote", "",
              "A remote frame on the heartbeat identifier is not answered while the heartbeat is produced");
  one.requirements = {"EC-HB-09"};
  Finding finding;
  finding.requirement = "EC-HB-09";
  finding.position = {"cia301/nmt/error-control.yaml", 52, 11};
  finding.step = "upload 1008h:00";
  finding.accepts = {"unchanged: \"Conforming drive, variant A\""};
  finding.actual = "\"Conforming drive, variant B\"";
  const std::string text = "Conforming drive, variant B";
  finding.actual_bytes.assign(text.begin(), text.end());
  can::Frame extended = can::data_frame(CanId{0x1ABCDE}, {1, 2, 3});
  extended.extended = true;
  can::Frame error;
  error.error = true;
  error.id = 0x4;
  error.dlc = 8;
  finding.evidence = {
      frame(60, 4s - 1200us, Direction::received, extended,
            "a frame with an identifier of 29 bits that belongs to nothing this node was configured for; "
            "seen shortly before the case began and kept because it may explain what follows"),
      frame(61, 4s + 5ms, Direction::transmitted, can::remote_frame(CanId{0x703}, 1),
            "node guarding request to node 03h"),
      frame(62, 4s + 6ms, Direction::received, error, "controller problem"),
      frame(63, 4s + 7ms, Direction::received, can::data_frame(CanId{0x703}, {}), "answer without data",
            true),
  };
  one.judgements = {{"EC-HB-09", Verdict::fail, {finding}, 1}};
  finish(one, Verdict::fail, "EC-HB-09 is violated", 4s, 4s + 1240ms);
  return one;
}

CaseResult inconclusive() {
  CaseResult one =
      planned("cia301/nmt/error-control", "heartbeat-period", "100 ms", "The heartbeat keeps its period");
  one.requirements = {"EC-HB-01", "EC-HB-02"};
  Finding finding;
  finding.verdict = Verdict::inconclusive;
  finding.position = {"cia301/nmt/error-control.yaml", 12, 9};
  finding.step = "download 1017h:00 = 100";
  finding.accepts = {"ok"};
  finding.actual = "abort 0800 0022h (device state)";
  finding.reason = "the heartbeat could not be configured, so its period was not measured";
  finding.evidence = {frame(70, 6s + 1ms, Direction::received,
                            can::data_frame(CanId{0x583}, {0x80, 0x17, 0x10, 0, 0x22, 0, 0, 0x08}),
                            "SDO abort 1017h:00 0800 0022h device state", true)};
  one.setup_findings = {finding};
  finish(one, Verdict::inconclusive, "a step of the set-up failed", 6s, 6s + 3ms);
  return one;
}

/// One as described, one that is judged, one that should be there.
std::vector<result::EntryFacts> dictionary() {
  result::EntryFacts type;
  type.object = {Index(0x1000), SubIndex(0)};
  type.name = "Device type";
  type.said_by = "drive.eds:31";
  type.claimed = true;
  type.type = "UNSIGNED32";
  type.access = "ro";
  type.default_value = type.value = "0002 0192h";
  type.length = type.size = 4;
  type.presence = result::present;
  result::EntryFacts errors = type;
  errors.object = {Index(0x1003), SubIndex(0)};
  errors.name = "Number of errors";
  errors.said_by = "CiA 301";
  errors.claimed = false;
  errors.type = "UNSIGNED8";
  errors.access = "rw";
  errors.default_value = "00h";
  errors.value = "03h";
  errors.length = errors.size = 1;
  result::EntryFacts mapping = errors;
  mapping.object = {Index(0x1A00), SubIndex(0)};
  mapping.name = "Number of mapped objects";
  mapping.said_by = "drive.eds:402";
  mapping.claimed = true;
  mapping.low = "00h";
  mapping.high = "40h";
  mapping.value.clear();
  mapping.size.reset();
  mapping.presence = result::absent;
  mapping.refusal = "abort 0602 0000h (object does not exist)";
  return {type, errors, mapping};
}

}  // namespace

RunResult sample_run() {
  RunResult run;
  run.tool = "canopen-conform 0.1.0";
  run.host = "simulation";
  run.elapsed = 7s + 250ms;
  run.device = "Conforming drive";
  run.properties = {
      {"dut.node_id", "03h"},
      {"dut.vendor_id", "0000 0000h"},
      {"dut.1008", "Conforming drive"},
      {"eds.file", "drive.eds"},
      {"can.interface", "vcan0"},
      {"can.driver", "vcan"},
      {"run.seed", "1"},
      {"run.command", "canopen-conform run -i vcan0 -n 3 --eds drive.eds --html 'my report.html'"}};
  run.cases = {passing(), failing(), warning(), failing_bytes(), inconclusive()};

  CaseResult skipped =
      planned("cia301/pdo/mapping", "too-long", "1A00h", "A mapping of more than 64 bits is refused");
  skipped.requirements = {"PDO-MAP-04"};
  finish(skipped, Verdict::not_applicable,
         "object 1A00h is present: no, it is not in the EDS and was not found", 7s, 7s);
  run.cases.push_back(skipped);

  CaseResult not_run =
      planned("cia301/pdo/mapping", "order", "", "Mapped objects come in the order of the mapping");
  not_run.requirements = {"PDO-MAP-05"};
  run.cases.push_back(not_run);

  const std::string od = "Pre-defined error field (1003h)";
  run.requirements = {
      {"EC-HB-01", "CiA 301 v4.2.0, 7.2.8.3.2", "mandatory", "Error control",
       "The heartbeat is produced cyclically."},
      {"EC-HB-02", "CiA 301 v4.2.0, 7.2.8.3.2", "recommended", "Error control",
       "The period is kept within its tolerance."},
      {"EC-HB-09", "CiA 301 v4.2.0, 7.2.8.3.2", "mandatory", "Error control",
       "Only one error control method is active at a time:\n  while the producer heartbeat time is not zero, remote frames\n"
       "  on the identifier of the heartbeat are not answered."},
      {"OD-1000-01", "CiA 301 v4.2.0, 7.5.2.1", "mandatory", "Device type (1000h)",
       "The device type is readable."},
      {"OD-1003-06", "CiA 301 v4.2.0, 7.5.2.4", "conditional", od,
       "Writing any other value than 00h to sub-index 00h is refused."},
      {"OD-1003-07", "CiA 301 v4.2.0, 7.5.2.4", "conditional", od,
       "A refused non-zero write leaves the history as it was."},
      {"OD-1003-08", "CiA 301 v4.2.0, 7.5.2.4", "conditional", od, "The error fields are read-only."},
      {"PDO-MAP-04", "CiA 301 v4.2.0, 7.5.2.36", "conditional", "PDO mapping",
       "A mapping longer than a PDO is refused."},
      {"PDO-MAP-05", "CiA 301 v4.2.0, 7.5.2.36", "conditional", "PDO mapping",
       "The order of the entries is kept."},
  };
  run.notes = {"1 case changed the device and everything was restored"};
  run.dictionary = dictionary();
  run.likenesses = {{"OD-1003-06", run.cases[1].name(), "1003-nonzero-write-accepted",
                     "1003h:00 confirms any value, but keeps the history", 88},
                    {"OD-1003-06", run.cases[1].name(), "1003-nonzero-write-wrong-abort",
                     "1003h:00 refuses a non-zero value with 0601 0002h instead of 0609 0030h", 75}};
  return run;
}

RunResult hostile_run(const std::string& text) {
  RunResult run = sample_run();
  run.device = text;
  run.host = text;
  for (result::Property& property : run.properties) property.value = text;
  run.properties.push_back({text, text});
  run.notes = {text};
  run.aborted = text;
  for (CaseResult& one : run.cases) {
    one.id += "-" + text;
    one.instance = text;
    one.title = text;
    one.suite += text;
    one.reason = text;
    one.cct = {text};
    one.position.file = text;
    for (auto* findings : {&one.setup_findings}) {
      for (Finding& finding : *findings) finding.actual = finding.step = text;
    }
    for (Judgement& judgement : one.judgements) {
      for (Finding& finding : judgement.findings) {
        finding.step = finding.actual = finding.reason = text;
        finding.accepts.push_back(text);
        finding.tolerates.push_back(text);
        finding.position.file = text;
        for (EvidenceFrame& frame : finding.evidence) frame.meaning = text;
      }
    }
  }
  for (result::EntryFacts& each : run.dictionary) {
    each.name = each.said_by = each.value = each.refusal = each.default_value = each.low = text;
    each.type = each.access = text;
  }
  for (result::Likeness& each : run.likenesses) {
    each.case_name = run.cases[1].name();
    each.name = each.summary = text;
  }
  for (result::RequirementInfo& info : run.requirements) info.clause = info.statement = info.area = text;
  return run;
}

std::string hostile_text() {
  std::string text =
      "]]> <b>&amp;\"'</b> <!-- -- --> \x1B[31mred\x1B[0m \u202Egnp.exe\n::error::x ##vso[task.complete] ";
  for (int byte = 0; byte < 256; ++byte) text += static_cast<char>(byte);
  text += "\xED\xA0\x80 \xEF\xBF\xBE \xEF\xBF\xBF \xF4\x90\x80\x80 \xC3";
  return text;
}

RunResult aborted_run() {
  RunResult run;
  run.tool = "canopen-conform 0.1.0";
  run.host = "bench";
  run.device = "node 05h";
  run.started_utc_ns = 1'795'305'301'000'000'000;  // 2026-11-21 23:55:01 UTC
  run.cases = {planned("cia301/sdo/upload", "expedited", "", "An object of four bytes is read"),
               planned("cia301/sdo/upload", "segmented", "", "A string is read")};
  run.aborted = "nothing was ever heard from node 05h on can0";
  return run;
}

}  // namespace conform::reports::testing
