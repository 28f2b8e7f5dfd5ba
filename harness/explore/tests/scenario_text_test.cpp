// SPDX-License-Identifier: Apache-2.0
#include "explore/scenario_text.hpp"

#include <chrono>
#include "catch.hpp"

#include "canopen/abort_code.hpp"
#include "explore/tests/device.hpp"

using namespace conform;
using namespace conform::explore;
using namespace std::chrono_literals;

TEST_CASE("a finding becomes a scenario that ends with what the model answers") {
  Finding finding;
  finding.conversation = {nmt(NodeId(5), 1), wait(20ms),
                          download({Index(0x1017), SubIndex(0)}, {0xE8, 0x03, 0})};
  finding.assigned = Assigned{"OD-LEN-02", Grade::violated};
  auto& difference = finding.played.difference.emplace();
  difference.action = 2;
  difference.device.kind = Answer::Kind::confirmed;
  difference.model.kind = Answer::Kind::aborted;
  difference.model.code = canopen::abort::length_too_high;
  const auto words = words_of_the_standard();
  const auto text = scenario_file({&finding, 1}, words, "canopen-conform explore");
  CHECK(text == "# Found by: canopen-conform explore\n"
                "format: 1\n"
                "title: Found by exploration\n"
                "\n"
                "scenarios:\n"
                "  - id: finding-1\n"
                "    title: \"confirmed instead of abort 0607 0012h (length too high)\"\n"
                "    risk: motion\n"
                "    steps:\n"
                "      - nmt: start\n"
                "      - wait: 20 ms\n"
                "      - download: {object: 1017h:00, bytes: \"E8 03 00\"}\n"
                "        checks: OD-LEN-02\n"
                "        expect: abort 0607 0012h\n"
                "        warn: [abort any]\n");
}

TEST_CASE("a frame that is missing is waited for from the last thing that was sent") {
  Finding finding;
  finding.conversation = {nmt(NodeId(5), 1), wait(20ms)};
  finding.assigned = Assigned{"EC-HBP-01", Grade::violated};
  auto& difference = finding.played.difference.emplace();
  difference.what = Difference::What::missing;
  difference.action = 1;
  difference.due = can::data_frame(CanId(0x705), {std::uint8_t{5}});
  const auto text = scenario_file({&finding, 1}, words_of_the_standard(), "x");
  CHECK(text.ends_with("      - nmt: start\n"
                       "      - frame: {id: 705h, within: 70 ms}\n"
                       "        checks: EC-HBP-01\n"));
  // The next one of its kind is another one: when it came with the model is known.
  finding.played.begins = {BusTime(100ms), BusTime(100ms)};
  difference.time = BusTime(105ms);
  CHECK(scenario_file({&finding, 1}, words_of_the_standard(), "x").find("within: 15 ms") !=
        std::string::npos);
}

TEST_CASE("frames that agreed are let pass before the one that does not") {
  Finding found;
  found.conversation = {
      {.kind = Action::Kind::download, .object = {Index(0x1005), SubIndex(0)}, .data = {0x80, 0, 0, 0x40}}};
  found.assigned = Assigned{"SYNC-PRO-04", Grade::violated};
  auto& difference = found.played.difference.emplace();
  difference.what = Difference::What::other_data;
  difference.due = difference.came = can::data_frame(CanId(0x80), {1});
  difference.came.data[0] = 0;
  difference.time = BusTime(60ms);
  found.played.begins = {BusTime(10ms)};
  for (const auto at : {5ms, 20ms, 30ms, 40ms, 60ms})
    found.played.trace.push_back({difference.due, BusTime(at), can::Direction::received, {}});
  const auto text = scenario_file({&found, 1}, words_of_the_standard(), "x");
  CHECK(text.contains("      - over: {number: 1..3}\n        steps:\n"
                      "          - frame: {id: 080h, within: 50 ms}\n"
                      "      - frame: {id: 080h, within: 50 ms}\n"));
}

TEST_CASE("an abort that names another object is held against all of its bytes") {
  Finding finding;
  finding.conversation = {request(can::data_frame(CanId(0x605), {0x60, 0, 0, 0, 0, 0, 0, 0}))};
  finding.assigned = Assigned{"SDO-ERR-04", Grade::tolerated};
  auto& difference = finding.played.difference.emplace();
  difference.model = {.kind = Answer::Kind::aborted,
                      .code = canopen::abort::command_specifier,
                      .data = {0x80, 0, 0, 0, 1, 0, 4, 5}};
  difference.device = difference.model;
  difference.device.data[1] = 7;
  CHECK(scenario_file({&finding, 1}, words_of_the_standard(), "x")
            .find("< 580+N: 80 00 00 00 01 00 04 05 {warn any}") != std::string::npos);
}

TEST_CASE("a transfer that does not end well because of what a monitor saw is judged itself") {
  Finding finding;
  finding.conversation = {upload({Index(0x1008), SubIndex(0)})};
  auto& difference = finding.played.difference.emplace();
  difference.what = Difference::What::rule;
  difference.requirement = "SDO-SUP-02";
  finding.played.answers = {{.kind = Answer::Kind::violation}};
  finding.assigned = Assigned{"SDO-SUP-02", Grade::violated};
  CHECK(scenario_file({&finding, 1}, words_of_the_standard(), "x")
            .find("      - upload: {object: 1008h:00}\n        checks: SDO-SUP-02\n        expect:") !=
        std::string::npos);
}

TEST_CASE("an answer that is only late is asked for in time") {
  Finding finding;
  finding.conversation = {upload({Index(0x1000), SubIndex(0)})};
  finding.assigned = Assigned{"SDO-GEN-18", Grade::tolerated};
  auto& difference = finding.played.difference.emplace();
  difference.what = Difference::What::late;
  difference.device = {.kind = Answer::Kind::confirmed, .answered = 300ms};
  difference.model = {.kind = Answer::Kind::confirmed};
  CHECK(becomes_scenario(finding, words_of_the_standard()));
  CHECK(scenario_file({&finding, 1}, words_of_the_standard(), "x")
            .ends_with("      - upload: {object: 1000h:00}\n"
                       "        checks: SDO-GEN-18\n"
                       "        expect: {latency: ..100 ms}\n"
                       "        warn: [ok, abort any]\n"));
  // A single request has no such measurement.
  finding.conversation = {request(can::data_frame(CanId(0x605), {0x60, 0, 0, 0, 0, 0, 0, 0}))};
  CHECK_FALSE(becomes_scenario(finding, words_of_the_standard()));
  CHECK(scenario_file({&finding, 1}, words_of_the_standard(), "x")
            .contains("\n  # No step can ask for this one: it is to be given a step with 'checks: ID'.\n"));
}

TEST_CASE("a device that does not come back is reset once more and waited for") {
  Finding finding;
  finding.conversation = {upload({Index(0x1000), SubIndex(0)})};
  finding.assigned = Assigned{"NMT-BOOT-02", Grade::violated};
  finding.played.difference.emplace().what = Difference::What::gone;
  CHECK(scenario_file({&finding, 1}, words_of_the_standard(), "x")
            .ends_with("      - upload: {object: 1000h:00}\n"
                       "      - nmt: reset node\n"
                       "      - boot_up: {within: $profile.boot_time}\n"
                       "        checks: NMT-BOOT-02\n"));
}

TEST_CASE("a scenario that does not show what was found is a comment, with the reason") {
  Finding finding;
  finding.conversation = {upload({Index(0x1000), SubIndex(0)})};
  auto& difference = finding.played.difference.emplace();
  difference.device.kind = Answer::Kind::silence;
  difference.model.kind = Answer::Kind::confirmed;
  finding.assigned = Assigned{"SDO-GEN-01", Grade::violated};
  const std::vector<Finding> two{finding, finding};
  const std::vector<std::string> remarks{"", "It shows nothing"};
  const auto text = scenario_file(two, words_of_the_standard(), "x", remarks);
  CHECK(text.find("scenarios:\n  - id: finding-1\n") != std::string::npos);
  CHECK(text.find("  # It shows nothing.\n  # - id: finding-2\n") != std::string::npos);
}

TEST_CASE("a finding of a monitor names its rule, and one without a rule is a comment") {
  Finding finding;
  finding.conversation = {upload({Index(0x1000), SubIndex(0)})};
  auto& difference = finding.played.difference.emplace();
  difference.what = Difference::What::rule;
  difference.requirement = "SDO-GEN-02";
  auto of_monitor = finding;
  of_monitor.assigned = Assigned{"SDO-GEN-02", Grade::violated};
  const std::vector<Finding> two{of_monitor, finding};
  const auto text = scenario_file(two, words_of_the_standard(), "x");
  CHECK(text.find("      - upload: {object: 1000h:00}\n"
                  "        checks: SDO-GEN-02\n"
                  "        expect: [ok, abort any, silence]\n") != std::string::npos);
  CHECK(text.find("  # - id: finding-2\n") != std::string::npos);
  CHECK(text.find("\n  - id: finding-2\n") == std::string::npos);
}
