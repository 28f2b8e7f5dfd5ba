// SPDX-License-Identifier: Apache-2.0
#include "result/run_result.hpp"

#include <csignal>

#include "catch.hpp"

using namespace conform;
using namespace conform::result;

namespace {

RunResult run_of(std::initializer_list<Verdict> verdicts) {
  RunResult run;
  for (const Verdict verdict : verdicts) {
    CaseResult one;
    one.verdict = verdict;
    run.cases.push_back(one);
  }
  return run;
}

}  // namespace

TEST_CASE("Verdicts have one spelling each") {
  CHECK(to_string(Verdict::pass) == "pass");
  CHECK(to_string(Verdict::warn) == "warn");
  CHECK(to_string(Verdict::fail) == "fail");
  CHECK(to_string(Verdict::inconclusive) == "inconclusive");
  CHECK(to_string(Verdict::not_applicable) == "not_applicable");
  CHECK(to_string(Verdict::error) == "error");
}

TEST_CASE("A failure is the worst of all verdicts") {
  CHECK(worst(Verdict::fail, Verdict::error) == Verdict::fail);
  CHECK(worst(Verdict::inconclusive, Verdict::warn) == Verdict::inconclusive);
  CHECK(worst(Verdict::not_applicable, Verdict::pass) == Verdict::pass);
}

TEST_CASE("A planned case that never ran counts as an error") {
  RunResult run;
  run.cases.emplace_back();
  CHECK(run.counts().error == 1);
  CHECK(exit_code(run) == 3);
}

TEST_CASE("Counts add up to the number of cases") {
  const RunResult run = run_of({Verdict::pass, Verdict::pass, Verdict::warn, Verdict::fail,
                                Verdict::inconclusive, Verdict::not_applicable, Verdict::error});
  const Counts counts = run.counts();
  CHECK(counts.pass == 2);
  CHECK(counts.warn == 1);
  CHECK(counts.fail == 1);
  CHECK(counts.inconclusive == 1);
  CHECK(counts.not_applicable == 1);
  CHECK(counts.error == 1);
  CHECK(counts.total() == run.cases.size());
}

TEST_CASE("Passes and warnings alone give exit code 0") {
  CHECK(exit_code(run_of({Verdict::pass})) == 0);
  CHECK(exit_code(run_of({Verdict::warn, Verdict::not_applicable})) == 0);
}

TEST_CASE("A failure gives exit code 1 whatever else happened") {
  RunResult run = run_of({Verdict::error, Verdict::inconclusive, Verdict::fail, Verdict::not_applicable});
  CHECK(exit_code(run) == 1);
  run.aborted = "the interface vanished";
  CHECK(exit_code(run) == 1);
}

TEST_CASE("Nothing selected or nothing applicable gives exit code 2") {
  CHECK(exit_code(RunResult{}) == 2);
  CHECK(exit_code(run_of({Verdict::not_applicable, Verdict::not_applicable})) == 2);
}

TEST_CASE("Without a failure an inconclusive or erroneous case gives exit code 3") {
  CHECK(exit_code(run_of({Verdict::pass, Verdict::inconclusive})) == 3);
  CHECK(exit_code(run_of({Verdict::pass, Verdict::error})) == 3);
  CHECK(exit_code(run_of({Verdict::not_applicable, Verdict::error})) == 3);
}

TEST_CASE("A run that stopped early is never green") {
  RunResult run = run_of({Verdict::pass});
  run.aborted = "the interface vanished";
  CHECK(exit_code(run) == 3);
  run.cases.clear();
  CHECK(exit_code(run) == 3);
}

TEST_CASE("A run ended by a signal reports the signal") {
  RunResult run = run_of({Verdict::fail});
  run.signal = SIGINT;
  CHECK(exit_code(run) == 130);
  run.signal = SIGTERM;
  CHECK(exit_code(run) == 143);
}

TEST_CASE("A requirement is found by its id") {
  RunResult run;
  run.requirements.push_back(
      {"OD-1003-06", "CiA 301 v4.2.0, 7.5.2.4", "mandatory", "Error history", "Clearing."});
  REQUIRE(run.requirement("OD-1003-06") != nullptr);
  CHECK(run.requirement("OD-1003-06")->clause == "CiA 301 v4.2.0, 7.5.2.4");
  CHECK(run.requirement("OD-1003-07") == nullptr);
}

TEST_CASE("The name of a case shows the instance where there is one") {
  CaseResult one;
  one.id = "cia301/sdo/write";
  CHECK(one.name() == "cia301/sdo/write");
  one.instance = "02h";
  CHECK(one.name() == "cia301/sdo/write[02h]");
}
