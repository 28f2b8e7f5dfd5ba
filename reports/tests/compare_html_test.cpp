// SPDX-License-Identifier: Apache-2.0
#include <string>

#include <fmt/format.h>

#include "catch.hpp"
#include "comparison.hpp"
#include "fixture.hpp"
#include "page.hpp"
#include "reports/compare.hpp"
#include "reports/html/difference.hpp"

using namespace conform;
using namespace conform::reports;
using namespace conform::reports::testing;

namespace {

const CompareOptions names{false, "old.json", "new.json"};

std::string page_of(const Pair& pair, const CompareOptions& options = names) {
  return compare_html(result::compare(pair.before, pair.after), options);
}

}  // namespace

TEST_CASE("A page of a comparison is well-formed, alone, and its links lead somewhere") {
  for (const auto& pair : {sample_pair("motor 2"), sample_pair(hostile_text()), same_pair(), Pair{},
                           Pair{sample_run(), aborted_run()}}) {
    const auto document = parsed(page_of(pair));
    check_names(document);
    check_headings(document);
    check_alone(document);
  }
}

TEST_CASE("What got worse stands first, with its evidence") {
  const auto document = parsed(page_of(sample_pair("motor 2")));
  const auto summary = text_of(document, "//section[@id='summary']");
  CHECK(contains(summary, "Worse"));
  CHECK(contains(summary, "1 new failure."));
  CHECK(contains(summary, "Exit code 1"));
  const auto cause = text_of(document, "//article[@id='new-1']");
  for (const auto* part : {"OD-1003-06", "Expected", "Actual", "abort 0609 0030h", "60 03 10 00 00 00 00 00",
                           "canopen-conform run"}) {
    INFO(part);
    CHECK(contains(cause, part));
  }
  CHECK_FALSE(document.select_nodes("//article[@id='gone-1'][@data-v='better']").empty());
}

TEST_CASE("Runs that are the same are said to be, and nothing else is there") {
  const auto document = parsed(page_of(same_pair()));
  CHECK(contains(text_of(document, "//section[@id='summary']"), "No difference"));
  CHECK(document.select_nodes("//section").size() == 1);
}

TEST_CASE("A new warning is worse only where that was asked for") {
  auto pair = same_pair();
  for (auto& one : pair.before.cases) {
    if (one.verdict != result::Verdict::warn) continue;
    one.verdict = result::Verdict::pass;
    for (auto& judgement : one.judgements) {
      judgement.verdict = result::Verdict::pass;
      judgement.findings.clear();
    }
  }
  CHECK(contains(text_of(parsed(page_of(pair)), "//section[@id='summary']"), "Not worse"));
  const auto strict = parsed(page_of(pair, {true, "a", "b"}));
  CHECK(contains(text_of(strict, "//section[@id='summary']"), "Exit code 1"));
}

TEST_CASE("Both runs stand side by side, and what differs is said in words") {
  const auto document = parsed(page_of(sample_pair("2.01")));
  const auto row =
      document.select_node("//table[@class='both']//tr[th[starts-with(., 'Software version')]]").node();
  CHECK(text_of(row) == "Software version (100Ah) differs1.002.01");
  CHECK(contains(text_of(document, "//table[@class='both']"), "old.jsonnew.json"));
}

TEST_CASE("Every kind of difference has its section") {
  const auto document = parsed(page_of(sample_pair("motor 2")));
  const auto holds = [&](const char* where, std::string_view part) {
    INFO(where << ": " << text_of(document, where));
    CHECK(contains(text_of(document, where), part));
  };
  holds("//section[@id='turned']", "was pass");
  holds("//section[@id='turned']", "OD-1010-01");
  holds("//section[@id='turned']", "No longer judged");
  holds("//section[@id='turned']", "Now judged as well");
  holds("//section[@id='answers']", "abort 0601 0002h");
  holds("//section[@id='answers']", "2000h:02");
  holds("//section[@id='dictionary']", "Communication profile (1000h-1FFFh)");
  holds("//section[@id='dictionary']", "2000h:0305 0009 00");
  holds("//section[@id='dictionary']", "2003h:050005h(not there)");
  holds("//section[@id='summary']", "1cause is new");
  holds("//section[@id='dictionary']", "may be a value of the process");
  holds("//section[@id='times']",
        "SDO answer, all of them: median 5.0 ms, was 2.0 ms. longer in 100 % of all pairs");
  holds("//section[@id='left-out']", "OD-9999-01");
  CHECK(document.select_nodes("//section[@id='times']//svg").size() == 2);
  // Every row can be filtered by the boxes that there are.
  for (const auto& found : document.select_nodes("//@data-v"))
    CHECK_FALSE(document.select_nodes(fmt::format("//input[@value='{}']", found.attribute().value()).c_str())
                    .empty());
}

TEST_CASE("Strings of two devices stay text on a page of their comparison") {
  const std::string hostile = "\"><img src=x onerror=alert(1)> '&amp; ]]> <!-- {{x}}";
  const auto page = page_of(sample_pair(hostile), {false, hostile, "x"});
  CHECK_FALSE(contains(page, "<img"));
  CHECK(contains(text_of(parsed(page), "//section[@id='dictionary']"), hostile));
  CHECK_FALSE(has_control_characters(page_of(sample_pair(hostile_text()), {false, hostile_text(), "x"})));
}

TEST_CASE("Of two texts what differs is marked, in whole characters") {
  const auto both = html::difference("abort 0609 0030h", "abort 0609 0031h", 100);
  CHECK(both.before == "abort 0609 003<mark>0</mark>h");
  CHECK(both.after == "abort 0609 003<mark>1</mark>h");
  CHECK(html::difference("same", "same", 100).before == "same");
  CHECK(html::difference("00h", "FFh", 100).after == "FFh");
  CHECK(contains(html::difference("", "x", 100).before, "(not there)"));
  // The bytes of these two begin alike.
  CHECK(html::difference("name \xC3\xA4", "name \xC3\xB6", 100).after == "name <mark>\xC3\xB6</mark>");
  const auto lengthy = html::difference(std::string(900, '=') + "a", std::string(900, '=') + "b", 100);
  CHECK(lengthy.after.ends_with("<mark>b</mark>"));
  CHECK(lengthy.after.size() < 100);
  CHECK(html::difference("a < b", "a < c", 100).after == "a &lt; <mark>c</mark>");
}
