// SPDX-License-Identifier: Apache-2.0
// Which times a trace shows.
#include "monitor/stopwatch.hpp"

#include "trace.hpp"

using namespace conform;
using namespace conform::monitor;
using namespace conform::monitor::testing;
using namespace std::chrono_literals;

namespace {

std::vector<result::Measurement> measured(const std::vector<std::string>& lines,
                                          const std::vector<Loss>& losses = {}) {
  const auto frames = trace(lines);
  return measure(frames, Facts{}, losses);
}

/// "SDO answer of 1018h:01: 1 ms, 3 ms"
std::vector<std::string> words(const std::vector<result::Measurement>& all) {
  std::vector<std::string> out;
  for (const auto& each : all) {
    std::vector<std::string> values;
    for (const auto& sample : each.samples) values.push_back(to_string(sample.value));
    out.push_back(each.kind + " of " + each.of + ": " + join(values, ", "));
  }
  return out;
}

using Words = std::vector<std::string>;
const std::string reset = "> 000: 81 01", boot_up = "< 701: 00";
// The first answer of a trace may be one to a request before it.
const Words known = {"> 40 01 10 00 00 00 00 00", "< 4F 01 10 00 00 00 00 00"};
const Words heartbeat_of_100_ms = {"> 40 01 10 00 00 00 00 00", "< 4F 01 10 00 00 00 00 00",
                                   "> 2B 17 10 00 64 00 00 00", "< 60 17 10 00 00 00 00 00"};

Words operator+(Words one, const Words& other) {
  one.insert(one.end(), other.begin(), other.end());
  return one;
}

}  // namespace

TEST_CASE("The time of an SDO answer is that of the object, segments and aborts included") {
  CHECK(
      words(measured(known + Words{"> 40 08 10 00 00 00 00 00", "wait 4 ms", "< 41 08 10 00 08 00 00 00",
                                   "> 60 00 00 00 00 00 00 00", "< 00 41 42 43 44 45 46 47",
                                   "> 40 18 10 05 00 00 00 00", "wait 1 ms", "< 80 18 10 05 11 00 09 06"})) ==
      Words{"SDO answer of 1008h:00: 5 ms, 1 ms", "SDO answer of 1018h:05: 2 ms"});
}

TEST_CASE("Of two open requests nobody knows which one was answered") {
  CHECK(measured({"> 40 00 10 00 00 00 00 00", "> 40 00 10 00 00 00 00 00", "< 43 00 10 00 91 01 0F 00"})
            .empty());
}

TEST_CASE("Heartbeats are measured against 1017h, and not over a change, a reset or a loss") {
  const std::string beat = "< 701: 7F";
  const auto told = measured(heartbeat_of_100_ms + Words{beat, "wait 99 ms", beat, "wait 109 ms", beat});
  REQUIRE(told.size() == 2);
  CHECK(words({told[1]}) == Words{"heartbeat of 1017h = 100 ms: 100 ms, 110 ms"});
  CHECK(told[1].nominal == 100ms);
  CHECK(told[1].least == 90ms);
  CHECK(told[1].most == 110ms);
  CHECK(told[1].count == 2);
  CHECK(told[1].shortest == 100ms);
  CHECK(told[1].longest == 110ms);
  CHECK(told[1].mean == 105ms);
  CHECK(measured(heartbeat_of_100_ms + Words{beat} + heartbeat_of_100_ms + Words{beat}).back().kind ==
        "SDO answer");
  CHECK(measured(heartbeat_of_100_ms + Words{beat, reset, boot_up, beat}).size() == 2);  // the boot-up
  CHECK(measured(heartbeat_of_100_ms + Words{beat, "wait 50 ms", beat}, {{5, 5}}).size() == 1);
  CHECK(measured({beat, "wait 99 ms", beat}).empty());
  // What may answer a guarding request is no heartbeat for sure.
  CHECK(measured(heartbeat_of_100_ms + Words{beat, "> 701: remote", beat, "wait 99 ms", beat}).back().kind ==
        "SDO answer");
}

TEST_CASE("A boot-up message is measured from the reset that asked for it") {
  CHECK(words(measured({reset, "wait 20 ms", boot_up, "> 000: 82 00", "wait 9 ms", boot_up})) ==
        Words{"boot-up of reset communication: 10 ms", "boot-up of reset node: 21 ms"});
  CHECK(measured({"> 000: 81 02", boot_up}).empty());
  CHECK(measured({boot_up}).empty());
  CHECK(measured({reset, "> 7E5: 04 01 00 00 00 00 00 00", boot_up}).empty());
}

TEST_CASE("TPDOs and SYNC are measured where an entry says that they are the device's") {
  const std::string tpdo = "< 181: 01";
  const Words seen = known + Words{"> 40 00 18 01 00 00 00 00", "< 43 00 18 01 81 01 00 00"};
  CHECK(words(measured(seen + Words{tpdo, "wait 9 ms", tpdo})) ==
        Words{"SDO answer of 1800h:01: 1 ms", "TPDO of 1800h: 10 ms"});
  CHECK(measured({tpdo, "wait 9 ms", tpdo}).empty());
  const Words cycle = known + Words{"> 23 06 10 00 10 27 00 00", "< 60 06 10 00 00 00 00 00",
                                    "> 40 05 10 00 00 00 00 00", "< 43 05 10 00 80 00 00 40"};
  const auto told = measured(cycle + Words{"< 080:", "wait 9 ms", "< 080:"});
  REQUIRE(told.size() == 3);
  CHECK(words({told[2]}) == Words{"SYNC of 1006h = 10 ms: 10 ms"});
  CHECK(told[2].nominal == 10ms);
}

TEST_CASE("Of very many times some are kept, evenly drawn, and all are counted") {
  Words lines = heartbeat_of_100_ms;
  for (int i = 0; i < 3000; ++i) lines.emplace_back("< 701: 7F");
  const auto told = measured(lines);
  REQUIRE(told.size() == 2);
  CHECK(told[1].count == 2999);
  CHECK(told[1].samples.size() >= Stopwatch::most_samples);
  CHECK(told[1].samples.size() < 2 * Stopwatch::most_samples);
  CHECK(told[1].samples[1].at - told[1].samples[0].at == told[1].samples[400].at - told[1].samples[399].at);
}

TEST_CASE("The load of the bus is told in stretches of one length") {
  const auto frames = trace({"> 40 00 10 00 00 00 00 00", "wait 1 s", "< 701: 7F", "< 701: 7F"});
  const auto load = load_of(frames, 125'000);
  REQUIRE(load.size() == 11);
  CHECK(load[0].frames == 1);
  CHECK(load[5].frames == 0);
  CHECK(load[10].frames == 2);
  CHECK(load[0].busy > 800us);
  CHECK(load[0].busy < 1100us);
  CHECK(load_of(frames, 0)[0].busy == Duration::zero());
  CHECK(load_of({}, 125'000).empty());
}
