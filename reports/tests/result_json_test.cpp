// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "fixture.hpp"
#include "reports/junit.hpp"
#include "reports/result_json.hpp"

using namespace conform;
using namespace conform::reports;

namespace {

result::RunResult measured_run() {
  auto run = testing::sample_run();
  run.measurements = {
      {.kind = "heartbeat",
       .of = "1017h = 100 ms",
       .nominal = Duration(100),
       .least = Duration(90),
       .most = Duration(110),
       .count = 2,
       .shortest = Duration(99),
       .longest = Duration(101),
       .mean = Duration(100),
       .samples = {{BusTime(Duration(5)), Duration(99)}, {BusTime(Duration(105)), Duration(101)}}}};
  run.load = {{.from = BusTime(Duration(0)), .span = Duration(1000), .frames = 7, .busy = Duration(300)}};
  run.changes = {
      {.object = {Index(0x1017), SubIndex(0)}, .before = {0xE8, 3}, .during = "a", .put_back = true}};
  return run;
}

}  // namespace

TEST_CASE("A result comes back from its document as it was, and makes the same reports") {
  for (const auto& run :
       {measured_run(), testing::hostile_run(testing::hostile_text()), testing::aborted_run()}) {
    const auto text = result_json(run);
    REQUIRE(is_result_json(text));
    const auto back = read_result_json(text, "result.json");
    REQUIRE(back);
    CHECK(result_json(*back) == text);
    CHECK(junit(*back, {}) == junit(run, {}));
  }
}

TEST_CASE("A result says which requirements passed, and in which cases") {
  const auto document = nlohmann::json::parse(result_json(measured_run()));
  bool passed = false;
  for (const auto& one : document.at("requirements")) {
    if (one.at("verdict") != "pass") continue;
    passed = true;
    CHECK_FALSE(one.at("cases").empty());
    CHECK_FALSE(one.at("clause").empty());
  }
  CHECK(passed);
  CHECK(document.at("summary").at("exit_code") == 1);
  CHECK(document.at("causes").at(0).at("verdict") == "fail");
}

TEST_CASE("A result says of each entry what differs, and of a cause what it looks like") {
  const auto document = nlohmann::json::parse(result_json(measured_run()));
  const auto& entries = document.at("dictionary");
  REQUIRE(entries.size() == 3);
  CHECK_FALSE(entries[0].contains("differs"));
  CHECK(entries[1].at("differs")[0].at("requirement") == "OD-1003-06");
  CHECK(entries[1].at("differs")[0].at("aspect") == "rule");
  CHECK(entries[2].at("differs")[0].at("aspect") == "presence");
  CHECK_FALSE(entries[2].at("differs")[0].contains("requirement"));
  CHECK(document.at("causes")[0].at("looks_like")[0].at("defect") == "1003-nonzero-write-accepted");
}

TEST_CASE("What is no result, or one of a later version, is refused with the reason") {
  const auto refused = [](std::string_view text) {
    const auto read = read_result_json(text, "r.json");
    REQUIRE_FALSE(read);
    CHECK(read.error().where == "r.json");
    return read.error().what;
  };
  CHECK(refused("") == "is not a result: it does not begin with canopen_conform_result");
  CHECK(refused("{\"journal\":2}") == "is not a result: it does not begin with canopen_conform_result");
  CHECK(refused("{\"canopen_conform_result\":99}") == "is a result that this version cannot read");
  CHECK(refused("{\"canopen_conform_result\":1").starts_with("is not a result: "));
  CHECK(refused("{\"canopen_conform_result\":1}").starts_with("is not a result: "));
  CHECK(refused(R"({"canopen_conform_result":1,"requirements":[],"measurements":[],"cases":7,"run":{}})")
            .starts_with("is not a result: "));
}
