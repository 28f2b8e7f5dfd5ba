// SPDX-License-Identifier: Apache-2.0
// What a device lives on the bus is judged by what it does: rules that used to pass, or to be left out,
// because nothing came. Each is run against the node with a variant that takes one way only, and with a
// defect that none of the ways may hide.
#include <algorithm>
#include <set>

#include "catch.hpp"
#include "cli/proof/selftest.hpp"
#include "cli/proof/variant_profile.hpp"
#include "device/profile.hpp"
#include "node/node.hpp"
#include "shipped.hpp"

using namespace conform;
namespace shipped = cli::shipped;
using result::Verdict;

namespace {

device::Profile profile_with(const std::vector<std::string>& variants) {
  auto node = refnode::Node::create({.node_id = shipped::reference().node.value(), .variants = variants});
  REQUIRE(node.has_value());
  return cli::profile_of_variants(shipped::reference(), (*node)->dictionary(), variants);
}

struct Device {
  std::vector<std::string> variants, defects;
};

/// The worst verdict of every requirement that was judged; the others are not in it.
std::map<std::string, Verdict> judged(const Device& device, const std::vector<std::string>& requirements) {
  engine::RunOptions options;
  options.plan.selection.requirements = requirements;
  const auto run =
      cli::simulate({.defects = device.defects, .variants = device.variants}, profile_with(device.variants),
                    shipped::suites().suite, shipped::suites().catalogue, options, 1);
  REQUIRE(run.has_value());
  std::map<std::string, Verdict> out;
  for (const auto& each : run->result.cases) {
    if (each.name().starts_with("monitor/")) continue;
    for (const auto& judgement : each.judgements) {
      if (std::ranges::find(requirements, judgement.requirement) == requirements.end()) continue;
      if (judgement.verdict == Verdict::not_applicable) continue;
      auto& verdict = out.try_emplace(judgement.requirement, judgement.verdict).first->second;
      verdict = result::worst(verdict, judgement.verdict);
    }
  }
  return out;
}

Verdict verdict_of(const Device& device, const std::string& requirement) {
  const auto out = judged(device, {requirement});
  const auto found = out.find(requirement);
  return found == out.end() ? Verdict::not_applicable : found->second;
}

}  // namespace

// All of these had passed on the preparing steps of scenarios that then said "not applicable".
TEST_CASE("a TPDO that knows events only is judged by its event timer, and not where SYNC is the matter") {
  const Device device{{"tpdo-event-driven-only"}, {}};
  for (const std::string rule : {"PDO-TX-02", "PDO-TX-08", "OD-1800-09", "OD-1800-11", "OD-1800-14"}) {
    INFO(rule);
    CHECK(verdict_of(device, rule) == Verdict::pass);
  }
  for (const std::string rule : {"PDO-TX-05", "PDO-TX-06", "PDO-TX-07", "PDO-TX-19", "PDO-TX-20",
                                 "SYNC-CON-01", "SYNC-CON-03", "SYNC-CON-09"}) {
    INFO(rule);
    CHECK(verdict_of(device, rule) == Verdict::not_applicable);
  }
}

TEST_CASE("a TPDO that knows SYNC only is judged by it, and not where events are the matter") {
  const Device device{{"tpdo-synchronous-only"}, {}};
  for (const std::string rule : {"PDO-TX-02", "PDO-TX-05", "PDO-TX-06", "PDO-TX-07", "OD-1800-09",
                                 "OD-1800-11", "OD-1800-14", "SYNC-CON-03", "SYNC-CON-09"}) {
    INFO(rule);
    CHECK(verdict_of(device, rule) == Verdict::pass);
  }
  for (const std::string rule : {"PDO-TX-08", "PDO-TX-09", "PDO-TX-12", "PDO-TX-19"}) {
    INFO(rule);
    CHECK(verdict_of(device, rule) == Verdict::not_applicable);
  }
}

TEST_CASE("what a TPDO may not do is found whichever way it is sent") {
  CHECK(verdict_of({{"tpdo-synchronous-only"}, {"1800-tpdo-in-pre-operational"}}, "PDO-TX-02") ==
        Verdict::fail);
  CHECK(verdict_of({{"tpdo-event-driven-only"}, {"1800-tpdo-in-pre-operational"}}, "PDO-TX-02") ==
        Verdict::fail);
  CHECK(verdict_of({{"tpdo-event-driven-only"}, {"1800-event-timer-ignores-valid-bit"}}, "OD-1800-09") ==
        Verdict::fail);
  CHECK(verdict_of({{}, {"1800-event-timer-ignores-valid-bit"}}, "OD-1800-09") == Verdict::fail);
}

TEST_CASE("an RPDO that knows SYNC only is judged by it") {
  const Device device{{"rpdo-synchronous-only"}, {}};
  for (const std::string rule :
       {"PDO-RX-02", "PDO-RX-06", "PDO-RX-07", "PDO-RX-13", "OD-1400-09", "OD-1400-11"}) {
    INFO(rule);
    CHECK(verdict_of(device, rule) == Verdict::pass);
  }
  CHECK(verdict_of(device, "PDO-RX-01") == Verdict::not_applicable);
  CHECK(verdict_of({{"rpdo-synchronous-only"}, {"rpdo-processed-in-preop"}}, "PDO-RX-02") == Verdict::fail);
}

TEST_CASE("an RPDO that takes nothing over passes no rule about what must not be taken over") {
  const Device device{{}, {"1600-data-not-applied"}};
  for (const std::string rule : {"PDO-RX-02", "PDO-RX-06", "PDO-RX-13"}) {
    INFO(rule);
    CHECK(verdict_of(device, rule) == Verdict::inconclusive);
  }
  CHECK(verdict_of(device, "PDO-RX-01") == Verdict::fail);
  CHECK(verdict_of(device, "OD-1400-09") == Verdict::fail);
}

TEST_CASE(
    "a device that never sends its changes fails where they are known to be events, and is warned elsewhere") {
  CHECK(verdict_of({{}, {"tpdo-change-ignored"}}, "PDO-TX-08") == Verdict::fail);
  CHECK(verdict_of({{}, {"tpdo-change-ignored"}}, "PDO-TX-07") == Verdict::fail);
  CHECK(verdict_of({{"tpdo-change-no-event"}, {}}, "PDO-TX-08") == Verdict::warn);
  CHECK(verdict_of({{"tpdo-change-no-event"}, {}}, "PDO-TX-07") == Verdict::warn);
}

TEST_CASE("TPDOs that are missing fail, although their latency is only a recommendation") {
  CHECK(verdict_of({{}, {"1800-cyclic-ratio-wrong"}}, "SYNC-CON-09") == Verdict::fail);
}

TEST_CASE("a SYNC that is right and reported as wrong is found, although it is reported once only") {
  CHECK(verdict_of({{}, {"sync-right-length-reported"}}, "SYNC-CON-03") == Verdict::fail);
}

TEST_CASE("a heartbeat that dies does not keep its period") {
  CHECK(verdict_of({{}, {"heartbeat-ends-after-6s"}}, "EC-HBP-01") == Verdict::fail);
}

TEST_CASE("an emergency message that is lost in the inhibit time is missed") {
  CHECK(verdict_of({{}, {"emcy-lost-while-inhibited"}}, "EMCY-INH-01") == Verdict::fail);
}

TEST_CASE("an error that never shows is no message of another form, nor an entry that is missing") {
  // The default trigger is a heartbeat that stays away; here nobody watches it.
  auto profile = device::default_profile(NodeId(1));
  engine::RunOptions options;
  options.plan.selection.requirements = {"OD-1001-05", "EMCY-FMT-01", "EMCY-FMT-04", "OD-1003-10",
                                         "OD-1014-07"};
  const auto run = cli::simulate({.defects = {"1016-timeout-not-detected"}}, profile, shipped::suites().suite,
                                 shipped::suites().catalogue, options, 1);
  REQUIRE(run.has_value());
  for (const auto& each : run->result.cases) {
    for (const auto& judgement : each.judgements) {
      INFO(each.name() << ": " << judgement.requirement);
      CHECK(judgement.verdict != Verdict::fail);
    }
  }
}

TEST_CASE("a device without boot-up message has none of a wrong form") {
  CHECK(verdict_of({{}, {"no-bootup"}}, "NMT-BOOT-04") != Verdict::fail);
}

TEST_CASE("a device that starts by itself obeys its resets") {
  const Device defect{{}, {"starts-in-operational"}};
  for (const std::string rule :
       {"NMT-FSA-07", "NMT-FSA-08", "NMT-FSA-09", "NMT-FSA-10", "NMT-FSA-11", "NMT-FSA-12"}) {
    INFO(rule);
    CHECK(verdict_of(defect, rule) == Verdict::pass);
    CHECK(verdict_of({{"self-starting"}, {}}, rule) == Verdict::pass);
  }
  CHECK(verdict_of(defect, "NMT-BOOT-07") == Verdict::fail);
  CHECK(verdict_of(defect, "EC-HBP-05") == Verdict::pass);
  CHECK(verdict_of({{"self-starting"}, {}}, "NMT-BOOT-07") == Verdict::not_applicable);
}
