// SPDX-License-Identifier: Apache-2.0
#include "cli/exploring/written_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <vector>

#include "base/files.hpp"
#include "explore/scenario_text.hpp"
#include "scenario/loader.hpp"

namespace conform::cli {
namespace {

namespace fs = std::filesystem;
using result::Verdict;

constexpr std::string_view no_show =
    "Played once in simulation, this scenario did not show what was found: the command above does.";

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

Result<result::RunResult> play(const std::string& file, const NodeSwitches& switches,
                               const device::Profile& profile, const scenario::Catalogue& catalogue) {
  const auto path = fs::absolute(file);
  const auto suite = scenario::load_suite(path.parent_path().string(), {path.filename().string()}, catalogue);
  if (!suite) return std::unexpected(suite.error());
  if (!suite->problems.empty())
    return fail("the scenarios cannot be played: " + suite->problems.front(), file);
  auto run = simulate(switches, profile, *suite, catalogue, {}, 1);
  if (!run) return std::unexpected(run.error());
  return std::move(run->result);
}

}  // namespace

std::string WrittenFindings::text() const {
  const auto all = shown + silent;
  auto out = fmt::format("{} {}, of which {} {} it again", all, all == 1 ? "scenario" : "scenarios", shown,
                         shown == 1 ? "shows" : "show");
  if (silent > 0) out += fmt::format("; {} {} not, as the file says", silent, silent == 1 ? "does" : "do");
  if (unjudged > 0)
    out += fmt::format("; {} without a known rule, or a step that could ask for it, {} in comments", unjudged,
                       unjudged == 1 ? "is" : "are");
  return out;
}

Result<WrittenFindings> write_findings(const std::string& file, std::span<const explore::Finding> findings,
                                       const explore::Vocabulary& words, const std::string& how,
                                       const NodeSwitches& switches, const device::Profile& profile,
                                       const scenario::Catalogue& catalogue) {
  if (auto done = write_file_atomically(file, explore::scenario_file(findings, words, how)); !done)
    return std::unexpected(done.error());
  WrittenFindings out;
  const auto is_played = [&words](const auto& each) { return explore::becomes_scenario(each, words); };
  out.unjudged = findings.size() - static_cast<std::size_t>(std::ranges::count_if(findings, is_played));
  if (out.unjudged == findings.size()) return out;
  const auto run = play(file, switches, profile, catalogue);
  if (!run) return std::unexpected(run.error());
  std::vector<std::string> remarks(findings.size());
  const auto stem = fs::path(file).stem().string();
  for (std::size_t i = 0; i < findings.size(); ++i) {
    if (!is_played(findings[i])) continue;
    if (shows(*run, fmt::format("{}/finding-{}", stem, i + 1), findings[i].assigned->requirement,
              catalogue)) {
      ++out.shown;
    } else {
      ++out.silent;
      remarks[i] = no_show;
    }
  }
  if (out.silent == 0) return out;
  if (auto done = write_file_atomically(file, explore::scenario_file(findings, words, how, remarks)); !done)
    return std::unexpected(done.error());
  return out;
}

}  // namespace conform::cli
