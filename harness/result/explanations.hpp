// SPDX-License-Identifier: Apache-2.0
// Which finding of a run explains which: the one nearer to the fault, where a rule that the other rests on is
// broken. One link of what docs/decisions/0002-one-cause-one-finding.md calls a cause.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "result/run_result.hpp"

namespace conform::result {

/// A finding and where it stands.
struct Place {
  const CaseResult* owner = nullptr;
  const Finding* finding = nullptr;
  Verdict verdict = Verdict::fail;  ///< the cap of the requirement's level applied

  [[nodiscard]] bool is_monitor() const { return owner->suite == "monitor"; }
  /// The part of the device that it is about.
  [[nodiscard]] std::string part() const;
  /// A scenario blames the form of a frame that no monitor complains about: something else came in its place.
  bool formless = false;
};

/// The frame that decided, among the evidence; nullptr: none did.
[[nodiscard]] const EvidenceFrame* decisive_frame(const Finding& finding);

/// Whether an answer of the SDO server, or that there was none, decided it.
[[nodiscard]] bool is_seen_through_sdo(const Finding& finding);

class Explanations {
 public:
  /// Marks the places that are formless.
  explicit Explanations(std::vector<Place>& places);

  /// How often one has to ask for the reason of the finding until there is none: 0 for a fault itself.
  [[nodiscard]] std::size_t steps(std::size_t place) const { return chain(place).size() - 1; }
  /// The finding that explains `place` in the end; itself where nothing does.
  [[nodiscard]] std::size_t root(std::size_t place) const { return chain(place).back(); }

 private:
  [[nodiscard]] std::vector<std::size_t> chain(std::size_t place) const;
  [[nodiscard]] std::optional<std::string> explained_by(const Place& place) const;
  /// Whether `ground` is broken so that it can explain `place`.
  [[nodiscard]] bool explains(std::string_view ground, const Place& place) const;
  [[nodiscard]] bool shows_in_such_an_answer(std::string_view requirement, const Finding& finding) const;
  [[nodiscard]] std::optional<std::string> first_that_explains(std::string_view grounds,
                                                               const Place& place) const;
  [[nodiscard]] std::optional<std::string> by_relation(const Place& place) const;
  [[nodiscard]] bool is_fault(std::string_view requirement) const;
  [[nodiscard]] std::optional<std::string> by_the_answer(const Place& place) const;
  [[nodiscard]] std::optional<std::string> by_the_transfer(const Place& place) const;
  [[nodiscard]] std::optional<std::string> met_in_its_place(const Place& place) const;
  void note_single_objects();

  const std::vector<Place>& places_;
  std::map<std::string, std::vector<std::size_t>, std::less<>> broken_;  ///< places by requirement
  std::map<std::string, std::set<std::string>, std::less<>> parts_;      ///< where each shows, if soundly
  std::map<Index, std::vector<std::string>> own_rules_;                  ///< broken ones of an object
  /// SDO rules that are broken about one object only, of which a rule of its own is broken as well.
  std::map<std::string, std::string, std::less<>> single_;
  std::vector<std::optional<std::size_t>> reason_;
};

}  // namespace conform::result
