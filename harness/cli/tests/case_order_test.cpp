// SPDX-License-Identifier: Apache-2.0
// A verdict must not depend on what ran before it: the suite in its own order, in random orders, and each
// scenario alone say the same of a device. CONFORM_ORDER_SEEDS says how many orders are drawn (20).
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "catch.hpp"
#include "cli/proof/processes.hpp"
#include "cli/proof/selftest.hpp"
#include "monitor/watch.hpp"
#include "shipped.hpp"

using namespace conform;
namespace shipped = cli::shipped;

namespace {

/// "OD-1003-06 in cia301/dictionary/..." to its verdict; the verdict of the case itself stands at its name.
using Verdicts = std::map<std::string, std::string>;

/// Whether there is an error in a field, or the reply to a command, is a matter of what was done before.
bool reads_what_is_left(const result::CaseResult& each) {
  if (each.id.ends_with("1023-1026-operating-system/reply")) return true;
  constexpr std::array objects = {"1003h:", "1023h:", "1025h:", "1026h:"};
  return each.id.ends_with("access-rights/read-only-refuses") &&
         std::ranges::any_of(objects, [&](const char* object) { return each.instance.starts_with(object); });
}

Verdicts verdicts_of(const result::RunResult& run) {
  Verdicts out;
  if (run.aborted) out["the run"] = *run.aborted;
  for (const auto& note : run.notes) out["note: " + note] = "";
  for (const auto& each : run.cases) {
    if (reads_what_is_left(each)) continue;
    // What watches the bus has to judge what the order happens to show it.
    const bool watches = each.id.starts_with(monitor::suite_name);
    const auto word = [watches](result::Verdict verdict) {
      return std::string(watches && verdict == result::Verdict::pass
                             ? to_string(result::Verdict::not_applicable)
                             : to_string(verdict));
    };
    out[each.name()] = word(each.verdict);
    if (each.verdict == result::Verdict::inconclusive || each.verdict == result::Verdict::error)
      out[each.name()] += ": " + each.reason;
    for (const auto& judgement : each.judgements)
      out[judgement.requirement + " in " + each.name()] = word(judgement.verdict);
  }
  return out;
}

Verdicts verdicts(const engine::PlanOptions& plan) {
  engine::RunOptions options;
  options.plan = plan;
  const auto done = cli::simulate({}, shipped::reference(), shipped::suites().suite,
                                  shipped::suites().catalogue, options, 1);
  return done ? verdicts_of(done->result) : Verdicts{{"the run", done.error().text()}};
}

/// Lines that tell where `some` says otherwise than `whole`, at most ten.
std::string differences(const Verdicts& whole, const Verdicts& some) {
  std::vector<std::string> lines;
  for (const auto& [name, verdict] : some) {
    const auto there = whole.find(name);
    const std::string other = there == whole.end() ? "nothing" : there->second;
    if (other != verdict) lines.push_back(fmt::format("{}: {}, in the own order {}", name, verdict, other));
  }
  if (lines.size() > 10) {
    const auto more = lines.size() - 10;
    lines.resize(10);
    lines.push_back(fmt::format("and {} more", more));
  }
  return join(lines, "\n");
}

const Verdicts& in_own_order() {
  static const Verdicts out = verdicts({});
  return out;
}

}  // namespace

TEST_CASE("all cases in a random order give the verdicts of the own order") {
  const auto& whole = in_own_order();
  const auto endings = cli::in_processes(
      shipped::how_many("CONFORM_ORDER_SEEDS", 20), 0, {.seconds = 120}, [&whole](std::size_t number) {
        engine::PlanOptions plan;
        plan.shuffle = number + 1;
        const auto some = verdicts(plan);
        auto text = differences(whole, some);
        if (some.size() != whole.size())
          text += fmt::format("\n{} verdicts, in the own order {}", some.size(), whole.size());
        return text;
      });
  for (std::size_t number = 0; number < endings.size(); ++number) {
    INFO("canopen-conform run --simulate --shuffle=" << number + 1);
    CHECK(endings[number].kind == cli::Ending::Kind::returned);
    CHECK(endings[number].text == "");
  }
}

TEST_CASE("each scenario alone gives the verdicts that it has among all others") {
  const auto& whole = in_own_order();
  std::vector<std::string> ids;
  for (const auto& file : shipped::suites().suite.files) {
    for (const auto& scenario : file.scenarios) ids.push_back(scenario.id);
  }
  const auto endings = cli::in_processes(ids.size(), 0, {.seconds = 120}, [&](std::size_t number) {
    engine::PlanOptions plan;
    plan.order = {ids[number]};
    return differences(whole, verdicts(plan));
  });
  for (std::size_t number = 0; number < endings.size(); ++number) {
    INFO("canopen-conform run --simulate " << ids[number]);
    CHECK(endings[number].kind == cli::Ending::Kind::returned);
    CHECK(endings[number].text == "");
  }
}
