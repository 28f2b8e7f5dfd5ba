// SPDX-License-Identifier: Apache-2.0
#include "engine/waivers.hpp"

#include <chrono>

#include "catch.hpp"

using namespace conform;
using namespace conform::engine;
using result::Verdict;

namespace {

const auto today = *device::parse_date("2027-03-31");

result::CaseResult failed(const std::string& id, std::optional<Index> object = {}) {
  result::CaseResult out;
  out.id = id;
  out.verdict = Verdict::fail;
  out.judgements.resize(2);
  out.judgements[0].requirement = "OD-1014-06";
  out.judgements[0].verdict = Verdict::fail;
  auto& finding = out.judgements[0].findings.emplace_back();
  finding.requirement = "OD-1014-06";
  finding.reason = "it took it";
  finding.object = object;
  out.judgements[1].requirement = "OD-1003-06";
  return out;
}

struct Bench {
  explicit Bench(std::vector<device::Waiver> all) : list(std::move(all)), waivers(list, catalogue(), today) {}

  Verdict after(result::CaseResult one) {
    waivers.apply(one);
    run.cases.push_back(one);
    return one.verdict;
  }
  [[nodiscard]] std::vector<result::WaiverUse> uses(bool strict = false) const {
    return waivers.uses(run, [](std::string_view pattern) { return pattern != "gone"; }, strict);
  }

  static const scenario::Catalogue& catalogue() {
    static const auto loaded = load();
    return loaded;
  }
  static scenario::Catalogue load() {
    std::vector<std::string> problems;
    auto loaded = scenario::Catalogue::load(CONFORM_SOURCE_DIR "/suites", problems);
    REQUIRE(loaded);
    return std::move(*loaded);
  }
  std::vector<device::Waiver> list;
  Waivers waivers;
  result::RunResult run;
};

device::Waiver waiver(std::string requirement = "OD-1014-06") {
  return {.requirement = std::move(requirement),
          .case_name = {},
          .reason = "mended in 2.2",
          .owner = {},
          .ticket = {},
          .place = {}};
}

}  // namespace

TEST_CASE("A failure that is waived is waived, and says why") {
  auto with_all = waiver();
  with_all.owner = "drives team";
  with_all.ticket = "FW-12";
  with_all.expires = today;
  Bench bench({with_all});
  CHECK(bench.after(failed("a")) == Verdict::waived);
  const auto& judgement = bench.run.cases[0].judgements[0];
  CHECK(judgement.verdict == Verdict::waived);
  CHECK(judgement.waived == "mended in 2.2 (FW-12, drives team, until 2027-03-31)");
  CHECK(judgement.findings[0].verdict == Verdict::waived);
  CHECK(judgement.findings[0].reason == "it took it; waived: " + judgement.waived);
  const auto use = bench.uses().at(0);
  CHECK(use.state == "used");
  CHECK(use.verdict == Verdict::waived);
  CHECK(use.cases == std::vector<std::string>{"a"});
}

TEST_CASE("A waiver that has expired covers nothing") {
  auto old = waiver();
  old.expires = today - std::chrono::days(1);
  Bench bench({old});
  CHECK(bench.after(failed("a")) == Verdict::fail);
  CHECK(bench.run.cases[0].judgements[0].findings[0].reason ==
        "it took it; it was waived until 2027-03-30: mended in 2.2");
  CHECK(bench.uses().at(0).state == "expired");
  CHECK(bench.uses().at(0).verdict == Verdict::fail);
}

TEST_CASE("A waiver covers its case and its object only") {
  auto narrow = waiver();
  narrow.case_name = "a";
  narrow.object = Index(0x1014);
  Bench bench({narrow});
  CHECK(bench.after(failed("a", Index(0x1014))) == Verdict::waived);
  CHECK(bench.after(failed("a", Index(0x1028))) == Verdict::fail);
  CHECK(bench.after(failed("b", Index(0x1014))) == Verdict::fail);
  auto two = failed("a", Index(0x1014));
  two.judgements[0].findings.push_back(failed("a", Index(0x1028)).judgements[0].findings[0]);
  CHECK(bench.after(two) == Verdict::fail);
}

TEST_CASE("Whatever else fails in the case stays a failure") {
  Bench bench({waiver()});
  auto two = failed("a");
  two.judgements[1].verdict = Verdict::fail;
  CHECK(bench.after(two) == Verdict::fail);
  CHECK(bench.run.cases[0].judgements[0].verdict == Verdict::waived);
}

TEST_CASE("A waiver that is not needed any more, or names nothing, asks for a look") {
  auto gone = waiver();
  gone.case_name = "gone";
  Bench bench({waiver("OD-1003-06"), waiver("OD-9999-99"), gone, waiver("OD-1000-01")});
  CHECK(bench.after(failed("a")) == Verdict::fail);
  const auto uses = bench.uses();
  CHECK(uses[0].state == "not needed any more: nothing that it covers failed");
  CHECK(uses[0].verdict == Verdict::warn);
  CHECK(uses[1].state == "there is no such requirement");
  CHECK(uses[1].verdict == Verdict::warn);
  CHECK(uses[2].state == "there is no such case");
  // What was not selected says nothing.
  CHECK(uses[3].state == "what it covers was not judged");
  CHECK(uses[3].verdict == Verdict::not_applicable);
  const auto strict = bench.uses(true);
  CHECK(strict[0].verdict == Verdict::fail);
  CHECK(strict[1].verdict == Verdict::fail);
  CHECK(strict[3].verdict == Verdict::not_applicable);
}
