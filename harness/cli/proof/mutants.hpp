// SPDX-License-Identifier: Apache-2.0
// The suite against small mistakes at every place of the reference node: what nobody thought of making a
// defect.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cli/proof/mutant_build.hpp"
#include "cli/proof/processes.hpp"
#include "cli/proof/verdicts.hpp"
#include "device/profile.hpp"
#include "scenario/catalogue.hpp"
#include "scenario/loader.hpp"

namespace conform::cli {

/// What became of a mutant, the worst first.
enum class Fate : unsigned char {
  survived,     ///< every verdict is that of the conformant node
  not_reached,  ///< no run comes to its place
  noticed,      ///< some verdict is another, but none is a failure
  crashed,
  hung,   ///< or took more memory than there is, or let the run go no further (it lets no time pass, or is
          ///< mute)
  killed  ///< a requirement failed that the conformant node keeps
};
/// Not to_string, which would hide those of conform from who is in this namespace.
[[nodiscard]] std::string_view fate_name(Fate fate);

struct MutantFate {
  const Mutant* mutant = nullptr;
  Fate fate = Fate::survived;
  std::string how{};        ///< "OD-1003-06 in cia301/...", "SIGSEGV"
  std::string explained{};  ///< of one that survived or was not reached, or that no rule forbids: why
};

/// Which verdicts differ, in words that begin with '!' where a requirement fails, else with '~' where the run
/// came to an end before its time; empty: none.
[[nodiscard]] std::string difference(const Verdicts& good, const Verdicts& mutant);
/// What a run that ended so makes of the mutant; its text is a difference().
[[nodiscard]] MutantFate fate_of(const Mutant& mutant, const Ending& ending);

struct MutantOptions {
  std::uint64_t seed = 1;
  std::vector<std::string> only{};  ///< numbers, rooms, or files; empty: all
  std::size_t sample = 0;           ///< so many of them, drawn by the seed; 0: all
  unsigned jobs = 0;                ///< processes at a time, 0: as many as the machine has cores
  bool slow = true;  ///< also the scenarios that take long, against those that survive the others
  std::function<void(std::size_t done, std::size_t of)> progress{};
};

/// Runs the suite against mutants of `build`; the fates are in the order of their numbers.
[[nodiscard]] Result<std::vector<MutantFate>> run_mutants(const MutantBuild& build,
                                                          const device::Profile& profile,
                                                          const scenario::Suite& suite,
                                                          const scenario::Catalogue& catalogue,
                                                          const MutantOptions& options);

/// The mutants of this program; an error in every program but canopen-conform-mutants.
[[nodiscard]] Result<const MutantBuild*> mutants_of_program();

/// By a number, a room or a file.
[[nodiscard]] bool is_named(const Mutant& mutant, const std::vector<std::string>& by);

/// The mutants that `only` names, or a sample of them.
[[nodiscard]] std::vector<const Mutant*> chosen(std::span<const Mutant> mutants,
                                                const MutantOptions& options);

}  // namespace conform::cli
