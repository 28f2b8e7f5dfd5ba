// SPDX-License-Identifier: Apache-2.0
#include "reports/html/html.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "catch.hpp"
#include "fixture.hpp"
#include "page.hpp"
#include "reports/html/axis.hpp"
#include "reports/html/card.hpp"
#include "reports/html/markup.hpp"
#include "reports/tally.hpp"

using namespace conform;
using namespace conform::reports;
using namespace conform::reports::testing;
using namespace std::chrono_literals;
using result::RunResult;

namespace {

/// A run with everything that a page can show.
RunResult full_run() {
  RunResult run = testing::sample_run();
  const BusTime begin{1s};
  result::Measurement heartbeat{"heartbeat", "1017h = 100 ms", 100ms, 90ms, 110ms, 3, 99ms, 130ms, 110ms, {}};
  heartbeat.samples = {{begin, 99ms}, {begin + 1s, 101ms}, {begin + 2s, 130ms}};
  run.measurements.push_back(heartbeat);
  for (int i = 0; i < 300; ++i) {
    result::Measurement answer{
        "SDO answer", fmt::format("20{:02X}h:00", i), {}, {}, {}, 10, 300us, 1ms + i * 1us, 500us, {}};
    for (int k = 0; k < 10; ++k) answer.samples.push_back({begin + k * 10ms, 300us + k * 10us});
    run.measurements.push_back(answer);
  }
  run.load = {{begin, 1s, 100, 20ms}, {begin + 1s, 1s, 300, 60ms}};
  run.changes = {{{Index(0x1017), SubIndex(0)}, {0x64, 0x00}, run.cases[1].name(), true},
                 {{Index(0x1005), SubIndex(0)}, {0x80, 0, 0, 0}, "<i>", false}};
  run.compared = {{"4.1", "OD", "the device type is read", "passed", "", {run.cases[0].name()}},
                  {"4.9", "OD", "not here", "no counterpart", "nothing corresponds", {}}};
  run.cases[0].judgements[0].decided_by =
      result::DecidingStep{run.cases[0].position, "upload 1000h:00", "00020192h", std::size_t{7}};
  run.cases[5].wants = {{"object", "a TPDO with <mapping>"}};
  return run;
}

}  // namespace

TEST_CASE("A page is well-formed, its ids are unique and its links lead somewhere") {
  for (const auto& run :
       {full_run(), testing::hostile_run(testing::hostile_text()), testing::aborted_run(), RunResult{}}) {
    check_names(parsed(html_report(run)));
  }
}

TEST_CASE("A cause says which known mistakes it looks like") {
  const auto page = html_report(testing::sample_run());
  CHECK(contains(page, "<h4>Looks like one of these known defects of the reference node</h4>"));
  CHECK(contains(
      page, "<code>1003-nonzero-write-accepted</code>: 1003h:00 confirms any value, but keeps the history"));
  CHECK(contains(page, "(88 % alike)"));
  auto run = testing::sample_run();
  run.likenesses.clear();
  CHECK_FALSE(contains(html_report(run), "ooks like"));
}

TEST_CASE("The dictionary is a table of what is described, found and differing") {
  const auto document = parsed(html_report(testing::sample_run()));
  const auto whole =
      document.select_nodes("//section[@id='dictionary']//div[contains(@class,'whole')]//tbody/tr");
  REQUIRE(whole.size() == 4);
  const auto verdict = [&](int i) {
    return std::string(whole[static_cast<std::size_t>(i)].node().attribute("data-v").value());
  };
  CHECK(verdict(0) == "na");
  CHECK(verdict(1) == "fail");
  CHECK(verdict(2) == "warn");
  CHECK(verdict(3) == "fail");
  const auto errors = text_of(whole[1].node());
  CHECK(contains(errors, "OD-1003-06: confirmed"));
  CHECK(contains(errors, "not the default"));
  // Nobody described it; a finding tells of it.
  CHECK(contains(text_of(whole[2].node()), "not described"));
  const auto absent = text_of(whole[3].node());
  CHECK(contains(absent, "absent"));
  CHECK(contains(absent, "presence: abort 0602 0000h"));
  CHECK(contains(absent, "drive.eds:402"));
  const auto differs = document.select_nodes("//div[contains(@class,'differs')]//tbody/tr");
  CHECK(differs.size() == 3);
}

TEST_CASE("A long dictionary is folded, and ten thousand entries are a page that can be sent") {
  auto run = testing::sample_run();
  constexpr int entries = 10'000;
  for (int i = 0; i < entries; ++i) {
    auto entry = run.dictionary[0];
    entry.object = {Index(static_cast<std::uint16_t>(0x2000 + i / 200)),
                    SubIndex(static_cast<std::uint8_t>(i % 200))};
    run.dictionary.push_back(entry);
  }
  const auto page = html_report(run);
  CHECK(page.size() < 8'000'000);
  const auto document = parsed(page);
  CHECK(document.select_nodes("//section[@id='dictionary']//details//tbody/tr").size() == entries);
}

TEST_CASE("Headings of a page begin with one of the first level and skip none") {
  check_headings(parsed(html_report(full_run())));
}

TEST_CASE("Nothing on a page is fetched, and only our own style and script are obeyed") {
  check_alone(parsed(html_report(testing::hostile_run("<script>alert(1)</script><style>*{}</style>"))));
}

TEST_CASE("A cause links to its capture where the run has written one, and to nothing else") {
  const RunResult run = testing::sample_run();
  Beside beside{.path = "/out/report.html"};
  const auto links = [&] {
    std::vector<std::string> out;
    const auto document = parsed(html_report(run, beside));
    for (const auto& found : document.select_nodes("//a/@href")) {
      const std::string target = found.attribute().value();
      if (!target.starts_with('#')) out.push_back(target);
    }
    return out;
  };
  CHECK(links().empty());
  beside.captures = "/out/cap tures";
  const auto found = links();
  REQUIRE_FALSE(found.empty());
  CHECK(found.front().starts_with("cap%20tures/cause-01-"));
  CHECK(found.front().ends_with(".pcapng"));
  // Whatever the folder is called: a path and no scheme.
  beside.captures = "/out/javascript:alert(1)//";
  for (const auto& target : links()) CHECK(target.starts_with("javascript%3Aalert%281%29/"));
}

TEST_CASE("The numbers of the first screen add up, and a simulated fault is not taken for a product's") {
  RunResult run = testing::sample_run();
  run.requirements.push_back({"OD-TYP-11", "CiA 301", "optional", "Data types", "nobody decided it"});
  run.cases[0].requirements.push_back("OD-TYP-11");
  const auto total = sum(tally_by_area(run));
  REQUIRE(total.not_judged > 0);
  const auto document = parsed(html_report(run));
  const auto verdict = document.select_node("//div[contains(@class, 'verdict')]").node();
  std::size_t shown = 0;
  for (const auto& found : verdict.select_nodes("(ul[@class='counts'])[1]/li/b"))
    shown += std::stoul(found.node().text().get());
  CHECK(shown == total.counts.total() + total.not_judged);
  CHECK(contains(text_of(verdict), "not judged"));
  CHECK_FALSE(contains(text_of(verdict), "No product was tested"));
  run.properties.push_back({"simulation.defects", "1000-is-u16 1003-oldest-first"});
  CHECK(contains(text_of(parsed(html_report(run)).select_node("//div[contains(@class, 'verdict')]").node()),
                 "No product was tested: this is the simulated reference node with 2 known defects"));
}

TEST_CASE("Strings of a device stay text on a page") {
  const std::string hostile = "\"><img src=x onerror=alert(1)> '&amp; ]]> <!-- {{x}}";
  const std::string page = html_report(testing::hostile_run(hostile));
  CHECK_FALSE(contains(page, "<img"));
  const auto document = parsed(page);
  CHECK(document.select_nodes("//img").empty());
  CHECK(text_of(document.select_node("//h1").node()) == hostile);
}

TEST_CASE("No byte of a device reaches a page as a control character") {
  const std::string page = html_report(testing::hostile_run(testing::hostile_text()));
  CHECK_FALSE(has_control_characters(page));
  CHECK(contains(page, "\\x00\\x01\\x02"));
}

TEST_CASE("What passed names the step and the frame that decided it, counted as Wireshark counts") {
  const auto document = parsed(html_report(full_run()));
  const auto row = text_of(document.select_node("//section[@id='cases']//li[@data-v='pass']").node());
  CHECK(contains(row, "readable"));
  CHECK(contains(row, "OD-1000-01"));
  CHECK(contains(row, "upload 1000h:00 \xE2\x86\x92 00020192h, frame 8"));
}

TEST_CASE("A cause is told with the rule, what was expected, what came, the frames and how to repeat it") {
  const auto document = parsed(html_report(full_run()));
  const auto cause = document.select_node("//article[@id='cause-1']").node();
  const auto text = text_of(cause);
  for (const auto* part : {"OD-1003-06", "CiA 301 v4.2.0, 7.5.2.4", "abort 0609 0030h (invalid value)",
                           "confirmed", "60 03 10 00 00 00 00 00", "SDO download 1003h:00 confirmed",
                           "decided", "cia301/dictionary/1003-error-history.yaml:14:19"}) {
    INFO(part);
    CHECK(contains(text, part));
  }
  CHECK(cause.select_nodes(".//svg[@class='lanes']//path[@class='host']").size() == 2);
  CHECK(cause.select_nodes(".//svg[@class='lanes']//path[@class='dev']").size() == 3);
  CHECK(cause.select_nodes(".//svg[@class='lanes']//circle[@class='ring']").size() == 1);
}

TEST_CASE("Of two texts the part that differs is marked") {
  const auto document = parsed(html_report(full_run()));
  const auto mark = document.select_node("//mark").node();
  CHECK(text_of(mark) == "B");
  CHECK(text_of(mark.parent()) == "\"Conforming drive, variant B\"");
}

TEST_CASE("Causes, requirements and cases are linked to each other") {
  const auto document = parsed(html_report(full_run()));
  CHECK_FALSE(document.select_nodes("//article[@id='cause-1']//a[@href='#r-OD-1003-06']").empty());
  CHECK_FALSE(document.select_nodes("//article[@id='cause-1']//a[@href='#c2']").empty());
  CHECK_FALSE(document.select_nodes("//li[@id='r-OD-1003-06']//a[@href='#cause-1']").empty());
  CHECK_FALSE(document.select_nodes("//li[@id='r-OD-1003-06']//a[@href='#c2']").empty());
  CHECK_FALSE(document.select_nodes("//li[@id='c2']//a[@href='#cause-1']").empty());
  CHECK_FALSE(document.select_nodes("//li[@id='c2']//a[@href='#r-OD-1003-07']").empty());
}

TEST_CASE("The command that repeats a case names what the run was given") {
  RunResult run = testing::sample_run();
  const auto& one = run.cases[1];
  CHECK(
      html::repeat_command(run, one, "", "OD-1003-06") ==
      "canopen-conform run -i vcan0 -n 03h --seed 1 'cia301/dictionary/1003-error-history/non-zero-write[02h]'");
  run.properties = {
      {"can.interface", "simulated"}, {"simulation.defects", "a-b c-d"}, {"run.allowed", "motion"}};
  CHECK(html::repeat_command(run, one, "", "") ==
        "canopen-conform run --simulate --defect a-b --defect c-d --allow motion "
        "'cia301/dictionary/1003-error-history/non-zero-write[02h]'");
  result::CaseResult monitor;
  monitor.suite = "monitor";
  CHECK(
      html::repeat_command(run, monitor, run.cases[0].name(), "SDO-1").ends_with(" " + run.cases[0].name()));
  CHECK(html::repeat_command(run, monitor, "before the first case", "SDO-1").ends_with(" -r SDO-1"));
}

TEST_CASE("Measurements are drawn against their limits, and many of a kind together") {
  const auto document = parsed(html_report(full_run()));
  const auto section = document.select_node("//section[@id='measurements']").node();
  CHECK(section.select_nodes(".//path[@class='limit']").size() == 2);
  CHECK(section.select_nodes(".//path[@class='nominal']").size() == 1);
  CHECK(section.select_nodes(".//path[@class='outside']").size() == 1);
  CHECK(contains(text_of(section), "1 outside of the limits"));
  CHECK(section.select_nodes(".//svg[@class='plot']").size() == 3);  // heartbeat, all SDO answers, load
  CHECK(section.select_nodes(".//svg[@class='range']").size() == 200);
  CHECK(contains(text_of(section), "100 more, all of them faster"));
}

TEST_CASE("What a run does not hold leaves no empty section behind") {
  const auto document = parsed(html_report(testing::aborted_run()));
  for (const auto* id : {"compared", "measurements", "changes"})
    CHECK(document.select_nodes(fmt::format("//section[@id='{}']", id).c_str()).empty());
  CHECK(contains(text_of(document.select_node("//section[@id='summary']").node()), "nothing was ever heard"));
  CHECK(contains(text_of(document), "2026-11-21T23:55:01Z"));
}

TEST_CASE("A run on virtual time is called a simulation and given no date") {
  const std::string page = html_report(testing::sample_run());
  CHECK(contains(page, "simulation, on virtual time"));
  CHECK_FALSE(contains(page, "1970"));
}

TEST_CASE("A page of 5000 cases stays small enough for an e-mail") {
  RunResult run = testing::sample_run();
  const auto cases = run.cases;
  while (run.cases.size() < 5000) {
    // Nine of ten pass, as in a run against a device that is nearly right.
    const auto i = run.cases.size();
    auto one = i % 10 == 0 ? cases[i / 10 % cases.size()] : cases[0];
    one.instance = fmt::format("{}", i);
    if (!one.judgements.empty() && i % 10 != 0)
      one.judgements[0].decided_by = result::DecidingStep{one.position, "upload 1000h:00", "00020192h", i};
    run.cases.push_back(std::move(one));
  }
  const auto page = html_report(run);
  CHECK(page.size() < 6'000'000);
  // Read by the test in a browser.
  std::ofstream(CONFORM_BINARY_DIR "/report-5000.html", std::ios::binary) << page;
}

TEST_CASE("An axis marks round values, also of a range of nothing") {
  const html::Axis axis(0.2, 1.1, 0, 100);
  const auto ticks = axis.ticks(4);
  REQUIRE(ticks.size() == 5);
  CHECK(ticks.front() == Approx(0.2));
  CHECK(ticks.back() == Approx(1.0));
  CHECK(axis.at(0.2) == 0);
  CHECK(axis.at(5) == 100);
  CHECK(html::Axis(5, 5, 0, 100).at(5) == 50);
  CHECK_FALSE(html::Axis(0, 0, 0, 100).ticks(4).empty());
}
