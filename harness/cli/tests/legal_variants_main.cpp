// SPDX-License-Identifier: Apache-2.0
// legal_variants: the whole suite against random combinations of legal variants of the reference node.
// The same seed gives the same combinations; each failure is printed as the options that repeat it.
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/files.hpp"
#include "base/text.hpp"
#include "can/candump_log.hpp"
#include "cli/proof/legal_variants.hpp"

namespace {

using namespace conform;
using Clock = std::chrono::steady_clock;

struct Settings {
  std::uint64_t seed = 1;
  std::uint64_t first = 0;
  std::optional<std::uint64_t> runs;
  std::optional<int> seconds;
  unsigned jobs = 1;
};

struct Tally {
  std::uint64_t runs = 0;
  std::uint64_t bad = 0;
};

void say(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
}

std::string told(const std::vector<cli::Complaint>& complaints) {
  std::string out;
  for (const auto& each : complaints) out += "  " + each.what + "\n" + each.details;
  return out;
}

/// Every `jobs`-th combination beginning with number `first`.
Tally work(const Settings& settings, std::uint64_t first, const cli::LoadedSuites& suites,
           const device::Profile& reference) {
  Tally tally;
  std::map<std::string, int> seen;  // the same mistake in other company is told once
  const auto end = Clock::now() + std::chrono::seconds(settings.seconds.value_or(0));
  for (std::uint64_t number = first;; number += settings.jobs) {
    if (settings.runs && number >= settings.first + *settings.runs) break;
    if (settings.seconds && Clock::now() >= end) break;
    const auto combination = cli::draw_combination(settings.seed, number);
    const auto complaints = cli::judge_combination(combination, suites, reference);
    ++tally.runs;
    if (!complaints) {
      ++tally.bad;
      say(fmt::format("{}: {}\n  legal_variants {}\n", number, complaints.error().text(),
                      combination.text()));
      continue;
    }
    if (complaints->empty()) continue;
    ++tally.bad;
    std::string out;
    for (const auto& each : *complaints) {
      if (seen[each.what]++ > 0) continue;
      const bool first_told = out.empty();
      out += fmt::format("{}: {}\n{}", number, each.what, each.details);
      // Shrinking takes dozens of runs, and what follows is mostly a consequence of the first.
      if (first_told)
        out += fmt::format("  least: legal_variants {}\n",
                           cli::shrink(combination, each.what, suites, reference).text());
    }
    if (!out.empty()) say(out + fmt::format("  drawn: legal_variants {}\n", combination.text()));
  }
  return tally;
}

/// One process per job: a run that crashes is seen, and nothing is shared.
Tally work_in_parallel(const Settings& settings, const cli::LoadedSuites& suites,
                       const device::Profile& reference) {
  Tally sum;
  int ends[2] = {-1, -1};
  if (::pipe(ends) != 0) return {0, 1};
  unsigned started = 0;
  for (unsigned job = 0; job < settings.jobs; ++job) {
    const pid_t child = ::fork();
    if (child < 0) break;
    if (child == 0) {
      const Tally tally = work(settings, settings.first + job, suites, reference);
      const bool sent = ::write(ends[1], &tally, sizeof tally) == static_cast<ssize_t>(sizeof tally);
      ::_exit(sent ? 0 : 1);
    }
    ++started;
  }
  ::close(ends[1]);
  Tally part;
  while (::read(ends[0], &part, sizeof part) == static_cast<ssize_t>(sizeof part)) {
    sum.runs += part.runs;
    sum.bad += part.bad;
  }
  ::close(ends[0]);
  if (started < settings.jobs) ++sum.bad;
  for (unsigned job = 0; job < started; ++job) {
    int status = 0;
    ::wait(&status);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
      say(fmt::format("a job ended with status {:#x}\n", static_cast<unsigned>(status)));
      ++sum.bad;
    }
  }
  return sum;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Runs the suite against random combinations of legal variants of the reference node."};
  Settings settings;
  cli::Combination one;
  std::string variants, suites_folder, candump;
  std::vector<std::string> only;
  bool undescribed = false, single = false, draw = false;
  app.add_option("--seed", settings.seed, "of the series of combinations")->capture_default_str();
  app.add_option("--first", settings.first, "number of the first combination")->capture_default_str();
  app.add_option("--runs", settings.runs, "how many combinations");
  app.add_option("--seconds", settings.seconds, "for how long");
  app.add_option("--jobs", settings.jobs, "processes")->check(CLI::Range(1, 64))->capture_default_str();
  app.add_option("--suites", suites_folder, "folder of the suites");
  app.add_flag("--draw", draw, "only prints combination --first");
  app.add_flag("--one", single, "one combination, that of the following options");
  app.add_option("--variants", variants, "ids, separated by commas");
  app.add_option("--node", one.node, "node-ID")->check(CLI::Range(1, 127));
  app.add_option("--bus-seed", one.seed, "seed of the bus");
  app.add_option("--bit-rate", one.bit_rate, "bit/s");
  app.add_flag("--undescribed", undescribed, "without a profile");
  app.add_flag("--neighbours", one.neighbours, "with other nodes on the bus");
  app.add_flag("--shuffled", one.shuffled, "the cases in a random order, drawn by the seed of the bus");
  app.add_flag("--switched", one.switched, "the power of the node can be switched");
  app.add_option("--candump", candump, "file for the frames; with one combination");
  app.add_option("cases", only, "only these cases; with one combination");
  CLI11_PARSE(app, argc, argv);

  if (draw) return say(cli::draw_combination(settings.seed, settings.first).text() + "\n"), 0;
  const auto root = cli::find_suites(suites_folder);
  if (!root) return say(root.error().text() + "\n"), 2;
  const auto suites = cli::load_suites(*root, false);
  if (!suites) return say(suites.error().text() + "\n"), 2;
  const auto reference = device::load_profile_file(*root + "/devices/reference-node.yaml");
  if (!reference) return say(reference.error().text() + "\n"), 2;

  if (single || !variants.empty() || (!settings.runs && !settings.seconds)) {
    for (const auto part : split(variants, ',')) {
      if (!part.empty()) one.variants.emplace_back(part);
    }
    one.described = !undescribed;
    can::Capture frames;
    const auto complaints = cli::judge_combination(one, *suites, reference->profile, only, &frames);
    if (!complaints) return say(complaints.error().text() + "\n"), 2;
    if (!candump.empty()) {
      const auto written = write_file_atomically(candump, can::write_candump_log(frames, {}));
      if (!written) return say(written.error().text() + "\n"), 2;
    }
    say(complaints->empty() ? "as it ought to be\n" : told(*complaints));
    return complaints->empty() ? 0 : 1;
  }
  const Tally tally = work_in_parallel(settings, *suites, reference->profile);
  say(fmt::format("{} combinations of legal variants, {} with a false verdict (seed {})\n", tally.runs,
                  tally.bad, settings.seed));
  return tally.bad == 0 && tally.runs > 0 ? 0 : 1;
}
