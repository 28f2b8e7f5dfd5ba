// SPDX-License-Identifier: Apache-2.0
#include "cli/exploring/written_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <vector>

#include "base/files.hpp"
#include "base/text.hpp"
#include "explore/scenario_text.hpp"
#include "scenario/loader.hpp"

namespace conform::cli {
namespace {

namespace fs = std::filesystem;
using result::Verdict;

/// Each with a bus of another seed.
constexpr std::uint64_t times = 10;

bool is_told(Verdict verdict) { return verdict == Verdict::fail || verdict == Verdict::warn; }

/// By the scenario itself, or by a monitor: that one sees it in whatever the run does.
bool shows(const result::RunResult& run, const std::string& id, const std::string& requirement,
           const scenario::Catalogue& catalogue) {
  const auto wanted = catalogue.canonical(requirement);
  const auto is_about_it = [&](const result::Judgement& judgement) {
    return is_told(judgement.verdict) && catalogue.canonical(judgement.requirement) == wanted;
  };
  return std::ranges::any_of(run.cases, [&](const result::CaseResult& each) {
    const bool judges = each.id == id || each.suite == "monitor";
    return judges && std::ranges::any_of(each.judgements, is_about_it);
  });
}

Result<scenario::Suite> suite_of(const std::string& file, const scenario::Catalogue& catalogue) {
  const auto path = fs::absolute(file);
  auto suite = scenario::load_suite(path.parent_path().string(), {path.filename().string()}, catalogue);
  if (suite && !suite->problems.empty())
    return fail("the scenarios cannot be played: " + suite->problems.front(), file);
  return suite;
}

Result<std::vector<result::RunResult>> play(const scenario::Suite& suite, const NodeSwitches& switches,
                                            const device::Profile& profile,
                                            const scenario::Catalogue& catalogue) {
  std::vector<result::RunResult> out;
  for (std::uint64_t seed = 1; seed <= times; ++seed) {
    auto run = simulate(switches, profile, suite, catalogue, {}, seed);
    if (!run) return std::unexpected(run.error());
    out.push_back(std::move(run->result));
  }
  return out;
}

std::string with_verb(std::size_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

}  // namespace

std::string WrittenFindings::text() const {
  auto out = with_verb(shown, "scenario that shows it", "scenarios that show it") +
             fmt::format(" {} of {} times", times, times);
  std::vector<std::string> comments;
  if (silent > 0) comments.push_back(with_verb(silent, "that does not", "that do not"));
  if (unfair > 0) comments.push_back(fmt::format("{} that a right device fails, too", unfair));
  if (unjudged > 0)
    comments.push_back(fmt::format("{} without a known rule, or a step that could ask for it", unjudged));
  return comments.empty() ? out : out + "; in comments " + join(comments, ", ");
}

Result<WrittenFindings> write_findings(const std::string& file, std::span<const explore::Finding> findings,
                                       const explore::Vocabulary& words, const std::string& how,
                                       const NodeSwitches& switches, const NodeSwitches& right,
                                       const device::Profile& profile, const scenario::Catalogue& catalogue) {
  if (auto done = write_file_atomically(file, explore::scenario_file(findings, words, how)); !done)
    return std::unexpected(done.error());
  WrittenFindings out;
  const auto is_played = [&words](const auto& each) { return explore::becomes_scenario(each, words); };
  out.unjudged = findings.size() - static_cast<std::size_t>(std::ranges::count_if(findings, is_played));
  if (out.unjudged == findings.size()) return out;
  const auto suite = suite_of(file, catalogue);
  if (!suite) return std::unexpected(suite.error());
  const auto runs = play(*suite, switches, profile, catalogue);
  if (!runs) return std::unexpected(runs.error());
  const auto fair_runs = play(*suite, right, profile, catalogue);
  if (!fair_runs) return std::unexpected(fair_runs.error());
  std::vector<std::string> remarks(findings.size());
  const auto stem = fs::path(file).stem().string();
  for (std::size_t i = 0; i < findings.size(); ++i) {
    if (!is_played(findings[i])) continue;
    const auto is_shown_in = [&](const result::RunResult& run) {
      return shows(run, fmt::format("{}/finding-{}", stem, i + 1), findings[i].assigned->requirement,
                   catalogue);
    };
    const auto count = static_cast<std::size_t>(std::ranges::count_if(*runs, is_shown_in));
    if (std::ranges::any_of(*fair_runs, is_shown_in)) {
      ++out.unfair;
      remarks[i] = "A right device fails this one, too: it asks for what was right at that moment";
    } else if (count < runs->size()) {
      ++out.silent;
      remarks[i] = fmt::format(
          "Played {} times in simulation, this one showed {} what was found: the command above does", times,
          count == 0 ? "never" : fmt::format("{} times", count));
    } else {
      ++out.shown;
    }
  }
  if (out.silent + out.unfair == 0) return out;
  if (auto done = write_file_atomically(file, explore::scenario_file(findings, words, how, remarks)); !done)
    return std::unexpected(done.error());
  return out;
}

}  // namespace conform::cli
