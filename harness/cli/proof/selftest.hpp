// SPDX-License-Identifier: Apache-2.0
// The suite proves itself: every defect of the reference node must spoil the expectation of a requirement it
// violates.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "can/capture.hpp"
#include "can/simulated_bus.hpp"
#include "defects/defect.hpp"
#include "device/profile.hpp"
#include "eds/eds.hpp"
#include "engine/engine.hpp"
#include "node/powered_node.hpp"
#include "result/patterns.hpp"
#include "result/run_result.hpp"
#include "scenario/catalogue.hpp"
#include "scenario/loader.hpp"

namespace conform::cli {

/// One run of the suite against a reference node on a simulated bus.
struct SimulatedRun {
  result::RunResult result;
  can::Capture capture;
};
/// Ids of the reference node's defects and legal variants, and the device it is to be; empty: itself.
struct NodeSwitches {
  std::vector<std::string> defects{};
  std::vector<std::string> variants{};
  std::shared_ptr<const eds::EdsFile> description{};
};
/// The run can switch the power of this node, which is attached to this bus; all three outlive the run.
void give_power_switch(engine::RunOptions& options, can::SimulatedBus& bus, refnode::PoweredNode& node);

[[nodiscard]] Result<SimulatedRun> simulate(const NodeSwitches& switches, const device::Profile& profile,
                                            const scenario::Suite& suite,
                                            const scenario::Catalogue& catalogue, engine::RunOptions options,
                                            std::uint64_t seed);

/// What one defect did.
struct DefectVerdict {
  std::string id;
  std::string summary;
  std::vector<std::string> violates;  ///< canonical ids
  std::vector<std::string>
      killed_by;  ///< violated requirements whose verdict became worse, as "OD-1003-06 fail in ..."
  std::vector<std::string> proves;      ///< the ids of killed_by, sorted
  std::vector<std::string> bystanders;  ///< requirements it does not list whose verdict became worse
  std::vector<std::string> unknown;     ///< ids it lists that the catalogue does not have
};

/// Whom the run of the whole suite against one defect blames: there should be one cause, and a rule that the
/// defect violates.
struct Blame {
  std::string defect;
  std::vector<std::string> violates;  ///< canonical ids
  std::vector<std::string> causes;    ///< primary requirement of each cause, failures first
  std::vector<std::string> about;     ///< in the same order, a line for a reader
  std::set<std::string> parts;        ///< of the device, that the findings are about
  std::set<std::string> broken;       ///< requirements that the run found broken
  bool right = false;                 ///< the first one's is a requirement that the defect violates
  result::Pattern pattern;            ///< how the first one shows; without a lead where there is none
  std::set<std::string>
      seen_in;  ///< names of the cases that told of it, by themselves or while a monitor watched
  /// Defects that the causes are said to look like, by the patterns that were known before.
  std::vector<std::string> named;

  [[nodiscard]] bool single_and_right() const { return causes.size() == 1 && right; }
  [[nodiscard]] bool is_recognised() const;
};

/// What the run against two defects shows, which alone show different parts of the device.
struct PairBlame {
  std::string first, second;
  std::vector<std::string> about;  ///< the causes, a line each
  /// A defect is hidden where no rule that it breaks is found broken but those that the other one alone shows
  /// broken as well. It is swallowed where one is, and no cause of its own tells it.
  bool hidden = false, swallowed = false;
};

struct KillMatrix {
  result::RunResult conformant;
  std::vector<DefectVerdict> defects;
  std::vector<Blame> blames;          ///< where asked for
  std::vector<PairBlame> pairs;       ///< where asked for
  std::vector<std::string> unproven;  ///< requirements the suite judges and no defect proves, sorted
  std::vector<std::string> proven;

  /// The conformant node passes everything without a warning, and no defect survives.
  [[nodiscard]] bool ok() const;
  [[nodiscard]] std::vector<std::string> survivors() const;
};

struct KillOptions {
  std::uint64_t seed = 1;
  std::vector<std::string> only;  ///< defect ids, empty for all
  /// The whole suite for every defect, to see its bystanders; otherwise what judges a requirement it
  /// violates.
  bool whole = false;
  bool blame = false;     ///< also the blame of each defect: whole runs, and minutes instead of seconds
  std::size_t pairs = 0;  ///< and of so many pairs of them
  std::vector<result::Pattern> known{};  ///< with blame: whether these name each defect
  unsigned jobs =
      0;  ///< threads, 0: as many as the machine has cores. The result is the same with any number.
};
/// The defects of these ids; of none: all.
[[nodiscard]] std::vector<const refnode::Defect*> chosen_rows(const std::vector<std::string>& only);

[[nodiscard]] Result<KillMatrix> kill_matrix(const device::Profile& profile, const scenario::Suite& suite,
                                             const scenario::Catalogue& catalogue,
                                             const KillOptions& options);

/// Whom a run against each defect blames, in their order, without the kill matrix.
[[nodiscard]] Result<std::vector<Blame>> blames_of_defects(const device::Profile& profile,
                                                           const scenario::Suite& suite,
                                                           const scenario::Catalogue& catalogue,
                                                           const KillOptions& options);
/// How each of them shows, for suites/patterns.
[[nodiscard]] std::vector<result::Pattern> patterns_of(const std::vector<Blame>& blames);

}  // namespace conform::cli
