// SPDX-License-Identifier: Apache-2.0
#include "cli/proof/mutants.hpp"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <ctime>
#include <random>
#include <utility>

#include "cli/proof/selftest.hpp"

namespace conform::cli {

using result::Verdict;

namespace {

/// Stands for a requirement in the verdicts of a run that could not go on.
constexpr std::string_view the_run = "the run";

}  // namespace

std::string_view fate_name(Fate fate) {
  switch (fate) {
    case Fate::survived: return "survived";
    case Fate::not_reached: return "not reached";
    case Fate::noticed: return "noticed";
    case Fate::crashed: return "crashed";
    case Fate::hung: return "hung";
    case Fate::killed: return "killed";
  }
  return "";
}

std::string difference(const Verdicts& good, const Verdicts& mutant) {
  std::string noticed, ended;
  const auto words = [](const auto& key, std::string_view verdict) {
    return key.first + " " + std::string(verdict) + " in " + key.second;
  };
  for (const auto& [key, verdict] : mutant) {
    const auto before = good.find(key);
    if (before != good.end() && before->second == verdict) continue;
    if (verdict == Verdict::fail) return "!" + words(key, "fail");
    if (key.first == the_run) ended = "~" + key.second;
    if (noticed.empty()) noticed = words(key, to_string(verdict));
  }
  for (const auto& [key, verdict] : good) {
    if (noticed.empty() && !mutant.contains(key)) noticed = words(key, "not judged");
  }
  return ended.empty() ? noticed : ended;
}

MutantFate fate_of(const Mutant& mutant, const Ending& ending) {
  MutantFate out{.mutant = &mutant, .how = ending.text};
  switch (ending.kind) {
    case Ending::Kind::crashed: out.fate = Fate::crashed; break;
    case Ending::Kind::hung:
    case Ending::Kind::out_of_memory: out.fate = Fate::hung; break;
    case Ending::Kind::returned:
      if (ending.text.starts_with('!')) {
        out.fate = Fate::killed;
        out.how.erase(0, 1);
      } else if (ending.text.starts_with('~')) {
        out.fate = Fate::hung;
        out.how.erase(0, 1);
      } else {
        out.fate = ending.text.empty() ? Fate::survived : Fate::noticed;
      }
      break;
  }
  return out;
}

Result<const MutantBuild*> mutants_of_program() {
  const auto* build = mutant_build();
  if (build == nullptr)
    return fail("this program has no mutants", {},
                "cmake --build --preset release --target canopen-conform-mutants; then "
                "build/release/bin/canopen-conform-mutants");
  return build;
}

bool is_named(const Mutant& mutant, const std::vector<std::string>& by) {
  return std::ranges::any_of(by, [&](const std::string& name) {
    return name == std::to_string(mutant.number) || name == mutant.room() || name == mutant.file;
  });
}

std::vector<const Mutant*> chosen(std::span<const Mutant> mutants, const MutantOptions& options) {
  std::vector<const Mutant*> out;
  for (const auto& mutant : mutants) {
    if (options.only.empty() || is_named(mutant, options.only)) out.push_back(&mutant);
  }
  if (options.sample == 0 || options.sample >= out.size()) return out;
  // The generator's numbers and this way to use them are the same everywhere; std::sample's are not.
  std::mt19937_64 random(options.seed);
  for (std::size_t i = 0; i < options.sample; ++i) std::swap(out[i], out[i + random() % (out.size() - i)]);
  out.resize(options.sample);
  std::ranges::sort(out, {}, &Mutant::number);
  return out;
}

namespace {

/// Ends a run that has shown enough: a failure, and after it a case that passed, so that the device lived and
/// the failure is not taken back.
class Enough : public engine::Observer {
 public:
  void case_ended(const result::RunResult& run, std::size_t index) override {
    const auto verdict = run.cases[index].verdict;
    if (failed_ && verdict == Verdict::pass) stop_ = SIGTERM;
    failed_ = failed_ || verdict == Verdict::fail;
  }
  [[nodiscard]] const std::atomic<int>& stop() const { return stop_; }

 private:
  bool failed_ = false;
  std::atomic<int> stop_ = 0;
};

/// Runs of the suite, or of the scenarios that take long alone.
class Trial {
 public:
  Trial(const device::Profile& profile, const scenario::Suite& suite, const scenario::Catalogue& catalogue,
        std::uint64_t seed, bool slow)
      : profile_(profile), suite_(suite), catalogue_(catalogue), seed_(seed) {
    options_.plan.slow = slow;
    if (!slow) return;
    for (const auto& file : suite.files) {
      for (const auto& scenario : file.scenarios) {
        if (scenario.slow) options_.plan.selection.patterns.push_back(scenario.id);
      }
    }
  }

  /// The verdicts of a run to its end.
  [[nodiscard]] Result<Verdicts> run() const { return run(options_); }

  /// What differs from the verdicts of the node as it should be.
  [[nodiscard]] std::string difference_from(const Verdicts& good) const {
    Enough enough;
    auto options = options_;
    options.observer = &enough;
    options.stop = &enough.stop();
    auto verdicts = run(options);
    if (!verdicts) return verdicts.error().what;
    auto out = difference(good, *verdicts);
    if (enough.stop() == 0 || out.starts_with('!')) return out;
    verdicts = run(options_);
    return verdicts ? difference(good, *verdicts) : verdicts.error().what;
  }

 private:
  [[nodiscard]] Result<Verdicts> run(const engine::RunOptions& options) const {
    auto run = simulate({}, profile_, suite_, catalogue_, options, seed_);
    if (!run) return std::unexpected(run.error());
    auto out = verdicts_of(run->result);
    if (run->result.aborted) out[{std::string(the_run), *run->result.aborted}] = Verdict::error;
    return out;
  }

  const device::Profile& profile_;
  const scenario::Suite& suite_;
  const scenario::Catalogue& catalogue_;
  std::uint64_t seed_;
  engine::RunOptions options_;
};

/// Seconds of processor time this process has used.
double used_seconds() { return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC); }

/// A mutant that takes ten times as long as the node itself hangs.
ProcessLimits limits_after(double seconds) {
  ProcessLimits out;
  out.seconds = 3 + static_cast<unsigned>(10 * seconds);
  return out;
}

}  // namespace

Result<std::vector<MutantFate>> run_mutants(const MutantBuild& build, const device::Profile& profile,
                                            const scenario::Suite& suite,
                                            const scenario::Catalogue& catalogue,
                                            const MutantOptions& options) {
  std::vector<MutantFate> out;
  for (const auto* mutant : chosen(build.mutants, options)) out.push_back({.mutant = mutant});
  std::size_t done = 0;
  for (const bool slow : {false, true}) {
    if (slow && !options.slow) break;
    const Trial trial(profile, suite, catalogue, options.seed, slow);
    build.turn_on(0);
    const double before = used_seconds();
    const auto good = trial.run();
    if (!good) return std::unexpected(good.error());
    // What this run does not come to, no run with a mutant comes to: until its place it does what this one
    // did.
    std::vector<MutantFate*> to_run;
    for (auto& each : out) {
      if (each.fate == Fate::survived || each.fate == Fate::not_reached) {
        if (build.reached(each.mutant->number))
          to_run.push_back(&each);
        else
          each.fate = Fate::not_reached;
      }
    }
    const auto limits = limits_after(used_seconds() - before);
    done = 0;
    const auto endings = in_processes(
        to_run.size(), options.jobs, limits,
        [&](std::size_t i) {
          build.turn_on(to_run[i]->mutant->number);
          return trial.difference_from(*good);
        },
        [&](std::size_t) {
          if (options.progress) options.progress(++done, to_run.size());
        });
    for (std::size_t i = 0; i < to_run.size(); ++i) *to_run[i] = fate_of(*to_run[i]->mutant, endings[i]);
  }
  return out;
}

}  // namespace conform::cli
