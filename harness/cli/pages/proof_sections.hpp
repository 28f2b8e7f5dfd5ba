// SPDX-License-Identifier: Apache-2.0
// The parts of the page of a proof, in their order: markup for one <section> each.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "cli/pages/proof_page.hpp"

namespace conform::cli {

/// Values of `data-v`.
namespace shown_kind {
inline constexpr std::string_view open = "open", look = "look", shown = "shown";
}

/// A proof, with what its parts look up in it.
class ProofBook {
 public:
  explicit ProofBook(const Proof& proof);

  [[nodiscard]] const Proof& proof() const { return proof_; }
  /// nullptr: blame was not asked for.
  [[nodiscard]] const Blame* blame_of(const std::string& defect) const;
  /// Requirements that the suite judges, in the order of the catalogue; true: a defect proves it.
  [[nodiscard]] const std::vector<std::pair<const scenario::Requirement*, bool>>& rules() const {
    return rules_;
  }
  /// Areas of the catalogue that have a rule or a defect, in its order.
  [[nodiscard]] const std::vector<std::string>& areas() const { return areas_; }
  /// Of the first requirement that it violates.
  [[nodiscard]] const std::string& area_of(const DefectVerdict& defect) const;
  [[nodiscard]] const std::vector<const DefectVerdict*>& proofs_of(const std::string& rule) const;
  /// Links; what the page does not hold is text.
  [[nodiscard]] std::string rule_link(const std::string& rule) const;
  [[nodiscard]] std::string rule_links(const std::vector<std::string>& rules) const;
  [[nodiscard]] std::string defect_link(const std::string& defect) const;

 private:
  const Proof& proof_;
  std::map<std::string, const Blame*> blames_;
  std::vector<std::pair<const scenario::Requirement*, bool>> rules_;
  std::map<std::string, std::size_t> rule_numbers_, defect_numbers_;
  std::vector<std::string> areas_;
  std::map<std::string, std::vector<const DefectVerdict*>> proofs_;
};

/// An element of a list that the filter can hide; `kind`: one of shown_kind; `id`: empty, or what links lead
/// to.
[[nodiscard]] std::string proof_row(std::string_view kind, const std::string& content,
                                    const std::string& id = {});

/// What stands in the place of a part that nobody asked for: the command that gives it.
[[nodiscard]] std::string not_asked(std::string_view command);

[[nodiscard]] std::string proof_summary(const ProofBook& book);
/// The kill matrix in numbers: rules and defects by area.
[[nodiscard]] std::string area_section(const ProofBook& book);
[[nodiscard]] std::string blame_section(const ProofBook& book);
[[nodiscard]] std::string variant_section(const ProofBook& book);
[[nodiscard]] std::string edit_section(const ProofBook& book);
[[nodiscard]] std::string mutant_section(const ProofBook& book);
[[nodiscard]] std::string throughput_section(const ProofBook& book);
/// A row for each defect: what it is, what it violates, what kills it and which requirement leads.
[[nodiscard]] std::string defect_section(const ProofBook& book);
/// A row for each requirement that is judged: by which defects it is proven.
[[nodiscard]] std::string rule_section(const ProofBook& book);

}  // namespace conform::cli
