// SPDX-License-Identifier: Apache-2.0
// Which cases a run plays, and how often.
#include <set>

#include "bench.hpp"
#include "engine/plan.hpp"

using namespace conform;
using namespace conform::engine;
using namespace conform::engine::testing;
using result::Verdict;

namespace {

const std::string five_reads = R"(
  - id: reads
    title: t
    for_each: {object: [1000h:00, 1001h:00, 1017h:00, 1018h:00, 1018h:01]}
    steps:
      - upload: {object: $object}
        checks: T-MUST
)";

std::vector<std::string> names(const RunOptions& options, const std::string& scenarios = five_reads) {
  ScriptedDevice device;
  std::vector<std::string> out;
  for (const auto& each : play(device, scenarios, options).run.cases) {
    if (each.suite != "monitor") out.push_back(each.name());
  }
  return out;
}

/// Aborts the n-th, 2n-th ... upload of 1018h:01.
ScriptedDevice::Intercept failing_every(std::size_t n, std::size_t& asked) {
  return [n, &asked](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if (frame.data[0] != 0x40 || frame.data[1] != 0x18 || frame.data[2] != 0x10 || frame.data[3] != 1)
      return false;
    if (++asked % n != 0) return false;
    self.abort(frame, 0x08000000);
    return true;
  };
}

const std::string read_vendor = R"(
  - id: vendor
    title: t
    steps:
      - upload: {object: 1018h:01}
        checks: T-MUST
)";

}  // namespace

TEST_CASE("the shards of a run are the run, each case once") {
  const auto whole = names({});
  std::multiset<std::string> together;
  for (std::size_t number = 1; number <= 3; ++number) {
    RunOptions options;
    options.plan.shard = {number, 3};
    for (const auto& each : names(options)) together.insert(each);
  }
  CHECK(together == std::multiset<std::string>(whole.begin(), whole.end()));
  CHECK(whole.size() == 5);
}

TEST_CASE("of a run that is repeated in part only the named cases are played") {
  const auto whole = names({});
  RunOptions options;
  options.plan.only = {{whole[1], whole[4]}};
  CHECK(names(options) == std::vector{whole[1], whole[4]});
}

TEST_CASE("what is asked for by name and is not there stays open instead of passing in silence") {
  RunOptions options;
  SECTION("by a pattern") { options.plan.selection.patterns = {"*reads[1018h:09]"}; }
  SECTION("by the name of a case of an earlier run") {
    options.plan.only = {{names({})[0].substr(0, names({})[0].find('[')) + "[1018h:09]"}};
  }
  ScriptedDevice device;
  const auto out = play(device, five_reads, options);
  REQUIRE(out.run.cases.size() >= 1);
  CHECK(out.run.cases.front().verdict == Verdict::inconclusive);
  CHECK(out.run.cases.front().instance == "1018h:09");
  CHECK(out.run.cases.front().reason.contains("there is no such case for this device"));
  CHECK(exit_code(out.run) == 3);
}

TEST_CASE("an instance is played by its name also where the sample is without it") {
  const std::string sampled = R"(
  - id: reads
    title: t
    sample: 1
    for_each: {object: "objects with access ro"}
    steps:
      - upload: {object: $object}
        checks: T-MUST
)";
  const auto some = names({}, sampled);
  REQUIRE(some.size() == 1);
  RunOptions options;
  options.plan.all_objects = true;
  const auto all = names(options, sampled);
  REQUIRE(all.size() > 1);
  options.plan.all_objects = false;
  options.plan.only = {{all.back()}};
  CHECK(names(options, sampled) == std::vector{all.back()});
}

TEST_CASE("a sample is drawn anew where the case does not apply to what was drawn") {
  const auto play_for = [](const std::string& when) {
    ScriptedDevice device;
    const std::string scenario = R"(
  - id: reads
    title: t
    sample: 1
    for_each: {object: "objects with access ro"}
    when: )" + when + R"(
    steps:
      - upload: {object: $object}
        checks: T-MUST
)";
    return play(device, scenario).run.cases.front();
  };
  const auto any = play_for("$object is present");
  REQUIRE(any.verdict == Verdict::pass);
  // Another one stands in for it, under its own name.
  const auto other_value = [&](int value) {
    return play_for("value of $object is not " + std::to_string(value));
  };
  int held = 0;
  while (held < 100 && other_value(held).instance == any.instance) ++held;
  const auto another = other_value(held);
  CHECK(another.verdict == Verdict::pass);
  CHECK(another.instance != any.instance);
  // Where there is none, the first one says why.
  const auto none = play_for("value of $object is 12345678h");
  CHECK(none.verdict == Verdict::not_applicable);
  CHECK(none.instance == any.instance);
  CHECK(none.reason.contains(any.instance));
}

TEST_CASE("a run with a budget plays what is worth most first and leaves out what would not end in time") {
  const auto whole = names({});
  const result::Worths worths({{whole[3], std::chrono::milliseconds(1), 9},
                               {whole[1], std::chrono::hours(1), 8},
                               {whole[0], std::chrono::milliseconds(1), 7}});
  RunOptions options;
  options.plan.worths = &worths;
  options.budget = std::chrono::seconds(60);
  ScriptedDevice device;
  const auto out = play(device, five_reads, options);
  const auto& cases = out.run.cases;
  REQUIRE(cases.size() >= 5);
  CHECK(cases[0].name() == whole[3]);
  CHECK(cases[0].verdict == Verdict::pass);
  CHECK(cases[1].name() == whole[1]);
  CHECK(cases[1].verdict == Verdict::not_applicable);
  CHECK(cases[1].reason == "left out: does not fit into --budget 60 s");
  CHECK(cases[2].name() == whole[0]);
  CHECK(cases[2].verdict == Verdict::pass);
  CHECK(std::ranges::any_of(
      out.run.notes, [](const std::string& note) { return note.starts_with("3 cases were left out"); }));
}

TEST_CASE("the look at a slow device leaves time of the budget for cases") {
  ScriptedDevice device;
  device.latency = std::chrono::milliseconds(400);
  const auto whole = names({});
  const result::Worths worths({{whole[0], std::chrono::milliseconds(1), 9}});
  RunOptions options;
  options.plan.worths = &worths;
  options.budget = std::chrono::seconds(30);
  const auto out = play(device, five_reads, options);
  CHECK(out.run.cases.front().verdict == Verdict::pass);
  CHECK(std::ranges::any_of(out.run.notes, [](const std::string& note) {
    return note.ends_with(
        "entries were not looked at, for the look at the device had a third of the --budget");
  }));
}

TEST_CASE("what happens now and then is found by repetition, and how often is told") {
  ScriptedDevice device;
  std::size_t asked = 0;
  RunOptions options;
  options.repeat = {.times = 6};
  device.before = failing_every(3, asked);
  const auto out = play(device, read_vendor, options);
  CHECK(out.only().verdict == Verdict::fail);
  CHECK(out.only().tried == "2 of 6 times fail");
}

TEST_CASE("a case that has failed is not repeated any more where that is all one wants to know") {
  ScriptedDevice device;
  std::size_t asked = 0;
  RunOptions options;
  options.repeat = {.times = 100, .until_fail = true};
  device.before = failing_every(3, asked);
  const auto out = play(device, read_vendor, options);
  CHECK(out.only().verdict == Verdict::fail);
  CHECK(out.only().tried.starts_with("1 of "));
  CHECK(asked < 10);
}

TEST_CASE("a case that is run once says nothing of repetitions") {
  ScriptedDevice device;
  CHECK(play(device, read_vendor).only().tried.empty());
}

TEST_CASE("the first failure ends a run that is to fail fast, and what it had changed is put back") {
  ScriptedDevice device;
  device.entries[0x100000] = {0};
  RunOptions options;
  options.fail_fast = true;
  const auto out = play(device, R"(
  - id: change
    title: t
    risk: config
    steps:
      - download: {object: 1017h:00, value: 1000}
        checks: T-MUST
        expect: abort any
  - id: behind
    title: t
    risk: config
    steps:
      - upload: {object: 1018h:01}
        checks: T-MUST
)",
                        options);
  REQUIRE(out.run.cases.size() >= 2);
  CHECK(out.run.cases[0].verdict == Verdict::fail);
  CHECK_FALSE(out.run.cases[1].finished);
  CHECK(out.run.aborted == "at the first failure");
  CHECK(device.entries.at(0x101700) == std::vector<std::uint8_t>{0, 0});
  CHECK(result::exit_code(out.run) == 1);
}
