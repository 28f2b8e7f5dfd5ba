// SPDX-License-Identifier: Apache-2.0
// The sub-command `explore`: options in, exit code out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace conform::cli {

struct ExploreCommand {
  bool simulate = false;
  std::string interface;              ///< of a device on a bus
  std::string allow;                  ///< risk tier; empty: by interface
  std::string journal;                ///< file; empty: at its usual place
  std::vector<std::string> defects;   ///< of the simulated reference node
  std::vector<std::string> variants;  ///< legal ones, of the same node; the model has them, too
  std::vector<std::string> suites;
  std::optional<std::uint32_t> node;
  std::string device, eds;  ///< profile and description of the device
  std::uint64_t seed = 1;
  std::string time;                    ///< how long; empty: as many actions, or ten seconds
  std::optional<std::size_t> actions;  ///< how many
  std::size_t most_findings = 20;      ///< after which the search ends
  std::string write;                   ///< file for the findings as scenarios; empty: none
  std::string corpus;                  ///< folder of conversations that are kept; empty: none
  bool strict = false;                 ///< findings without a known rule are not passed over
  bool quiet = false;                  ///< print only the summary
  bool prove = false;  ///< against every defect and legal variant of the reference node, or `defects`
  std::vector<std::string> mutants;  ///< with prove: numbers, rooms, files or "open"; nothing else is proven
  std::size_t combinations = 0;      ///< with prove: so many random legal devices instead
  bool verbose = false;              ///< with prove: what was named instead
  unsigned jobs = 0;                 ///< with prove: threads; 0: the machine's cores
};
/// 0: no violated requirement; 1: there is one; exit_environment: with `strict`, something else differs.
[[nodiscard]] int explore_command(const ExploreCommand& options);

}  // namespace conform::cli
