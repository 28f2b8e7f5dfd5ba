// SPDX-License-Identifier: Apache-2.0
// A right device is never failed, whatever its description says: the suite against the twins of descriptions
// that nobody wrote. CONFORM_DRAWN_TWINS says how many are drawn (20).
#include <fmt/format.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "base/text.hpp"
#include "catch.hpp"
#include "cli/proof/processes.hpp"
#include "cli/proof/selftest.hpp"
#include "device/description.hpp"
#include "drawn_description.hpp"
#include "eds/read.hpp"
#include "shipped.hpp"

using namespace conform;
using result::Verdict;
namespace shipped = cli::shipped;

namespace {

std::size_t drawn() {
  const char* text = std::getenv("CONFORM_DRAWN_TWINS");  // NOLINT(concurrency-mt-unsafe): one thread
  return text == nullptr ? 20 : std::stoul(text);
}

/// Every judgement that is neither passed nor not applicable, a line each; what is wrong with the run itself.
std::string complaints(std::uint64_t seed) {
  auto file = eds::read(cli::draw_description(seed), "drawn.eds");
  if (!file) return file.error().text();
  auto description = device::describe(*file);
  if (!description) return description.error().text();
  const auto held = std::make_shared<const eds::EdsFile>(std::move(*file));
  auto profile = device::default_profile(NodeId(static_cast<std::uint8_t>(1 + seed * 37 % 99)));
  profile.description = held;
  device::add_description(profile, std::move(*description));
  profile.writes_described = true;
  const auto done = cli::simulate({.description = held}, profile, shipped::suites().suite,
                                  shipped::suites().catalogue, {}, seed);
  if (!done) return done.error().text();
  std::string out = done->result.aborted.value_or("");
  for (const auto& note : done->result.notes) out += "note: " + note + "\n";
  // Not for want of anything to judge.
  if (const auto passed = done->result.counts().pass; passed < 300)
    out += fmt::format("only {} passed\n", passed);
  for (const auto& each : done->result.cases) {
    if (each.verdict == Verdict::pass || each.verdict == Verdict::not_applicable) continue;
    out += fmt::format("{} in {}: {}\n", to_string(each.verdict), each.name(), each.reason);
    for (const auto& judgement : each.judgements) {
      for (const auto& finding : judgement.findings)
        out += fmt::format("  {} {}: {} -> {}\n", to_string(finding.verdict), judgement.requirement,
                           finding.step, finding.actual);
    }
  }
  return out;
}

}  // namespace

TEST_CASE("the same seed draws the same description, and every twentieth has 512 TPDOs") {
  CHECK(cli::draw_description(7) == cli::draw_description(7));
  CHECK(cli::draw_description(7) != cli::draw_description(8));
  CHECK(cli::draw_description(19).find("NrOfTXPDO=512") != std::string::npos);
}

TEST_CASE("twins of drawn descriptions pass all that concerns them") {
  const auto endings =
      cli::in_processes(drawn(), 0, {.seconds = 600}, [](std::size_t seed) { return complaints(seed); });
  for (std::size_t seed = 0; seed < endings.size(); ++seed) {
    INFO("description " << seed);
    CHECK(endings[seed].kind == cli::Ending::Kind::returned);
    CHECK(endings[seed].text == "");
  }
}
