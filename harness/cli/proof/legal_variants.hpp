// SPDX-License-Identifier: Apache-2.0
// The other half of the proof: the whole suite against nodes that are different and right. Whatever legal
// variants are combined, no requirement may fail, nothing may stay inconclusive, and only what the catalogue
// tolerates warns.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "can/capture.hpp"
#include "cli/suite_folder.hpp"
#include "device/profile.hpp"
#include "result/run_result.hpp"

namespace conform::cli {

/// One node on one bus.
struct Combination {
  std::vector<std::string> variants;
  int node = 1;
  bool described = true;    ///< with a profile that says what the node is; else the default profile
  bool neighbours = false;  ///< other nodes talk on the bus
  std::uint32_t bit_rate = 500'000;
  std::uint64_t seed = 1;  ///< of the bus and of the plan
  bool shuffled = false;   ///< the cases in a random order, drawn by the seed
  bool switched = false;   ///< the power of the node can be switched

  /// As options of the program legal_variants.
  [[nodiscard]] std::string text() const;
};

/// A run against such a server takes hours on the bus: each alone is in the tests, and in combinations it is
/// rare and without the millions of frames that others would send meanwhile.
[[nodiscard]] bool takes_hours(std::string_view variant);

/// Requirements that may warn with these variants: the catalogue says so.
[[nodiscard]] std::set<std::string> may_warn_with(const std::vector<std::string>& variants,
                                                  const scenario::Catalogue& catalogue);

/// The combination number `number` of the series that `seed` begins.
[[nodiscard]] Combination draw_combination(std::uint64_t seed, std::uint64_t number);

/// What is wrong with a verdict.
struct Complaint {
  std::string what;  ///< "fail OD-1003-06 in cia301/...", the same for the same mistake
  std::string details;
};

/// Whatever of a run is not as it is with a right device: no case but passed and not applicable ones,
/// warnings of these requirements apart, and no remark.
[[nodiscard]] std::vector<Complaint> complaints_of(const result::RunResult& run,
                                                   const std::set<std::string>& may_warn);

/// Runs the suite; empty when all verdicts are as they ought to be. `reference` is the profile of the node by
/// default; the profile used is made from it and from the node's own dictionary. `only`: patterns of cases;
/// `frames`: where to put the trace.
[[nodiscard]] Result<std::vector<Complaint>> judge_combination(const Combination& combination,
                                                               const LoadedSuites& suites,
                                                               const device::Profile& reference,
                                                               const std::vector<std::string>& only = {},
                                                               can::Capture* frames = nullptr);

/// One legal variant by itself.
struct VariantVerdict {
  std::string id, summary;
  std::string legal;                  ///< why it is: clause, or requirements that name this way
  std::vector<Complaint> complaints;  ///< empty: nothing is held against it
};
/// The whole suite against each legal variant alone, in the order of the tables; `jobs` threads, 0: as many
/// as there are cores.
[[nodiscard]] Result<std::vector<VariantVerdict>> variants_alone(const LoadedSuites& suites,
                                                                 const device::Profile& reference,
                                                                 std::uint64_t seed, unsigned jobs);

/// Leaves out whatever is not needed for a complaint `what`.
[[nodiscard]] Combination shrink(Combination combination, const std::string& what, const LoadedSuites& suites,
                                 const device::Profile& reference);

}  // namespace conform::cli
