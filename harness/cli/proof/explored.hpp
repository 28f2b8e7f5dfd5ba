// SPDX-License-Identifier: Apache-2.0
// Exploration of the reference node: what is needed for it, and the proof of what it finds by itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "cli/proof/selftest.hpp"
#include "device/profile.hpp"
#include "explore/explorer.hpp"
#include "scenario/catalogue.hpp"

namespace conform::cli {

/// A simulated device and its model, and what to say to them.
struct Explorable {
  explore::Vocabulary words;
  explore::Bench bench;
  explore::Offer offer;  ///< of SearchOptions
};
/// Fails where the node cannot be made. `adapted`: variants that the model has, too.
[[nodiscard]] Result<Explorable> explorable_of(const device::Profile& profile, const NodeSwitches& device,
                                               const std::vector<std::string>& adapted);

/// How a node with one fault is searched for it: the model is that of `right`, and flakiness is not asked
/// about.
[[nodiscard]] explore::SearchOptions search_for_one_fault(const Explorable& right, std::uint64_t seed,
                                                          std::size_t actions);
/// What only strains the rule of a monitor may be a monitor that was led astray: it does not count.
[[nodiscard]] bool counts_as_found(const explore::Finding& finding);

/// "boots in 200 ms (boot-up-200ms)": a choice of SearchResult::chosen in words.
[[nodiscard]] std::string summary_of_choice(std::string_view id);

/// "FAIL", "WARN" or "DIFF". What only a recommended or optional rule forbids is never a failure.
[[nodiscard]] std::string word_of(const explore::Finding& finding, const scenario::Catalogue& catalogue);

struct FoundCounts {
  std::size_t fail = 0, warn = 0, open = 0;
};
[[nodiscard]] FoundCounts count_words(const explore::SearchResult& result,
                                      const scenario::Catalogue& catalogue);

/// How the search fares against one defect, without any scenario.
struct DefectFound {
  std::string id;
  bool found = false;               ///< something was found
  bool named = false;               ///< and one of the findings names a requirement that the defect violates
  std::size_t actions = 0;          ///< until then, or in all
  std::size_t shortest = 0;         ///< actions of the conversation that decided, 0: nothing was found
  std::vector<std::string> said{};  ///< what the findings named
};
/// And against one set of legal variants.
struct VariantFound {
  std::vector<std::string> variants;
  std::size_t episodes = 0;
  std::size_t learnt = 0;             ///< choices that the model was told of on the way
  std::vector<std::string> blamed{};  ///< false findings, a line each
};

struct ExploreProof {
  std::vector<DefectFound> defects;
  std::vector<VariantFound> variants;
  [[nodiscard]] std::size_t found() const;
  [[nodiscard]] std::size_t named() const;
  [[nodiscard]] std::size_t falsely_blamed() const;
  [[nodiscard]] double median_length() const;
};

struct ExploreProofOptions {
  std::uint64_t seed = 1;
  std::vector<std::string> only{};      ///< defects; empty: all
  std::vector<std::string> variants{};  ///< only these legal variants, and no defects but those of `only`
  std::size_t combinations = 0;         ///< so many random legal devices, and no defects
  std::size_t actions = 20'000;         ///< for each defect and each legal device
  unsigned jobs = 0;
};
[[nodiscard]] Result<ExploreProof> prove_exploration(const device::Profile& profile,
                                                     const scenario::Catalogue& catalogue,
                                                     const ExploreProofOptions& options);

/// The shares, and what was missed and wrongly blamed; `verbose`: also what was named instead.
[[nodiscard]] std::string exploration_words(const ExploreProof& proof, bool verbose);

}  // namespace conform::cli
