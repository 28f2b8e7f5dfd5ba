// SPDX-License-Identifier: Apache-2.0
// A recorded trace is judged like the run it came from; and the suite makes no finding of a monitor against a
// conformant node.
#include "cli/run/judge.hpp"

#include <algorithm>
#include <atomic>
#include <set>

#include "can/candump_log.hpp"
#include "can/pcapng.hpp"
#include "catch.hpp"
#include "cli/proof/selftest.hpp"
#include "device/profile.hpp"
#include "engine/monitor_cases.hpp"
#include "monitor/watch.hpp"
#include "shipped.hpp"

using namespace conform;
namespace shipped = cli::shipped;
using result::Verdict;

namespace {

cli::SimulatedRun live(const std::vector<std::string>& defects,
                       const std::vector<std::string>& patterns = {}) {
  engine::RunOptions options;
  options.plan.selection.patterns = patterns;
  auto run = cli::simulate({.defects = defects}, shipped::reference(), shipped::suites().suite,
                           shipped::suites().catalogue, options, 1);
  INFO((run ? std::string() : run.error().text()));
  REQUIRE(run.has_value());
  return std::move(*run);
}

/// Everything the monitors said, a line each, without times and without the case that ran meanwhile.
std::vector<std::string> said(const result::RunResult& run) {
  std::vector<std::string> out;
  for (const auto& each : run.cases) {
    if (each.suite != monitor::suite_name) continue;
    out.push_back(each.name() + " " + std::string(to_string(each.verdict)) + " " + each.reason);
    for (const auto& judgement : each.judgements) {
      out.push_back("  " + judgement.requirement + " " + std::string(to_string(judgement.verdict)) + " " +
                    std::to_string(judgement.expectations));
      for (const auto& finding : judgement.findings) {
        auto line = "    " + std::string(to_string(finding.verdict)) + " " + finding.step + " -> " +
                    finding.actual + ", " + finding.accepts.at(0) + ", " + finding.reason;
        for (const auto& frame : finding.evidence) {
          line += " " + std::to_string(frame.capture_index) + (frame.decisive ? "! " : " ") + frame.meaning;
        }
        out.push_back(std::move(line));
      }
    }
  }
  return out;
}

std::size_t violations(const result::RunResult& run) {
  std::size_t out = 0;
  for (const auto& each : run.cases) {
    if (each.suite != monitor::suite_name) continue;
    for (const auto& judgement : each.judgements) out += judgement.findings.size();
  }
  return out;
}

result::RunResult judged(std::string_view content, bool inferred) {
  const auto recording = cli::read_recording(content, "test", {});
  INFO((recording ? std::string() : recording.error().text()));
  REQUIRE(recording.has_value());
  CHECK(recording->directions_inferred == inferred);
  return cli::judge(*recording, shipped::reference(), shipped::suites().catalogue, {});
}
result::RunResult judged_as_pcapng(const can::Capture& capture) {
  const auto bytes = can::write_pcapng(capture, {});
  return judged({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, false);
}

// Of each kind of rule one: answers, multiplexer, bits, toggle, states, boot-up, heartbeat.
const std::vector<std::string> defects{
    "sdo-double-response",   "mux-stale-subindex",  "abort-repeated",       "toggle-not-alternating",
    "sdo-served-in-stopped", "heartbeat-dlc-wrong", "client-abort-answered"};

}  // namespace

TEST_CASE(
    "No monitor finds anything in the whole suite against the conformant node, and most have seen something") {
  const auto run = live({});
  for (const auto& line : said(run.result)) {
    INFO(line);
    CHECK(line.find(" fail ") == std::string::npos);
    CHECK(line.find(" warn ") == std::string::npos);
  }
  CHECK(violations(run.result) == 0);
  const auto passed = std::ranges::count_if(run.result.cases, [](const result::CaseResult& each) {
    return each.suite == monitor::suite_name && each.verdict == Verdict::pass;
  });
  CHECK(passed >= 10);
  CHECK(said(judged_as_pcapng(run.capture)) == said(run.result));
}

TEST_CASE("The capture of a run is judged like the run") {
  for (const auto& defect : defects) {
    INFO(defect);
    const auto run = live({defect});
    CHECK(violations(run.result) > 0);
    CHECK(said(judged_as_pcapng(run.capture)) == said(run.result));
  }
}

TEST_CASE(
    "So is a candump log, which tells no directions, where the host sends nothing in the device's name") {
  for (const auto& defect : defects) {
    INFO(defect);
    // Not the dictionary's RPDO, of which nobody can tell who sent it.
    const auto run =
        live({defect}, {"cia301/dictionary/a*", "cia301/dictionary/c*", "cia301/dictionary/d*",
                        "cia301/dictionary/l*", "cia301/sdo/upload", "cia301/sdo/segmented-upload",
                        "cia301/sdo/states", "cia301/heartbeat/producer", "cia301/sdo/errors"});
    const auto log = can::write_candump_log(run.capture, {});
    CHECK(said(judged(log, true)) == said(run.result));
  }
}

TEST_CASE("A finding names the scenario that ran") {
  const auto run = live({"sdo-double-response"});
  bool named = false;
  for (const auto& each : run.result.cases) {
    for (const auto& judgement : each.judgements) {
      for (const auto& finding : judgement.findings) named |= finding.during.starts_with("cia301/");
    }
  }
  CHECK(named);
}

TEST_CASE("Monitors decide by ids of the catalogue, each under its own name") {
  for (const auto& rule : monitor::rules()) {
    for (const auto id : rule.requirements) {
      INFO(rule.name << ' ' << id);
      CHECK(shipped::suites().catalogue.canonical(id) == std::string(id));
    }
  }
}

TEST_CASE("A pattern about scenarios leaves the monitors on; a pattern about monitors chooses among them") {
  const auto monitors_of = [](std::vector<std::string> patterns, std::vector<std::string> excludes = {},
                              std::vector<std::string> requirements = {}) {
    std::vector<std::string> out;
    for (const auto* rule :
         engine::chosen_monitors({patterns, requirements, excludes}, shipped::suites().catalogue))
      out.emplace_back(rule->name);
    return out;
  };
  CHECK(monitors_of({"cia301/dictionary"}).size() == monitor::rules().size());
  CHECK(monitors_of({"monitor/sdo-toggle"}) == std::vector<std::string>{"sdo-toggle"});
  CHECK(monitors_of({"monitor/sdo-*", "cia301/nmt"}, {"monitor/sdo-s*"}).size() == 10);
  CHECK(monitors_of({}, {"monitor"}).empty());
  CHECK(monitors_of({}, {}, {"SDO-GEN-02"}) == std::vector<std::string>{"sdo-frame-form"});
  CHECK(monitors_of({}, {}, {"OD-1014-06"}).empty());
}

TEST_CASE("Nothing passes for a node of which only the host may have sent frames") {
  // The run plays the node 7Eh, whose heartbeat the device watches; as its EMCY would tell of it what a frame
  // of the device does, those cases are left out that send one.
  const auto run = live({}, {"cia301/heartbeat/consumer/boot-up*", "cia301/heartbeat/consumer/l*",
                             "cia301/heartbeat/consumer/n*", "cia301/sdo/channel"});
  auto profile = shipped::reference();
  for (const auto node : {NodeId(0x7E), NodeId(0x7D), NodeId(0x40), NodeId(0x02)}) {
    profile.node = node;
    const auto recording = cli::read_recording(can::write_candump_log(run.capture, {}), "test", {});
    REQUIRE(recording.has_value());
    const auto out = cli::judge(*recording, profile, shipped::suites().catalogue, {});
    INFO(node.value());
    CHECK(out.counts().pass == 0);
    CHECK(result::exit_code(out) == 3);
  }
}

TEST_CASE("A run that stopped before any scenario passes nothing") {
  std::atomic<int> stop{0};
  engine::RunOptions options;
  options.stop = &stop;
  struct StopsAtOnce final : engine::Observer {
    explicit StopsAtOnce(std::atomic<int>& stop) : stop_(stop) {}
    void planned(const result::RunResult&, const std::vector<bool>&) override { stop_ = 2; }
    std::atomic<int>& stop_;
  } observer(stop);
  options.observer = &observer;
  const auto run = cli::simulate({}, shipped::reference(), shipped::suites().suite,
                                 shipped::suites().catalogue, options, 1);
  REQUIRE(run.has_value());
  CHECK(run->result.aborted.has_value());
  CHECK(run->result.counts().pass == 0);
  CHECK(run->capture.size() > 100);
}

TEST_CASE("Files that are no captures are refused with a hint") {
  const auto error_of = [](std::string_view content) {
    const auto recording = cli::read_recording(content, "x.log", {});
    REQUIRE_FALSE(recording.has_value());
    return recording.error().text();
  };
  CHECK_THAT(error_of(""), Catch::Contains("empty"));
  CHECK_THAT(error_of("<xml/>\n"), Catch::Contains("x.log"));
  CHECK_THAT(error_of(std::string_view("\xD4\xC3\xB2\xA1\x02\x00", 6)), Catch::Contains("pcap"));
  CHECK_THAT(error_of(std::string_view("\x0A\x0D\x0D\x0A", 4)), Catch::Contains("x.log"));
}
