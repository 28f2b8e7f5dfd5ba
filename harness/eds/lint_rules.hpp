// SPDX-License-Identifier: Apache-2.0
// What the files lint_*.cpp share: each holds the rules of one group and the function that applies them.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "eds/lint.hpp"

namespace conform::eds {

/// What is looked at: the file and its dictionary in full (expand.hpp).
struct Subject {
  const EdsFile& file;
  const std::vector<Object>& objects;
  std::string expansion_fault;  ///< why `objects` lacks what is implied, or empty
  Position expansion_at;
  std::optional<std::uint8_t> node = {};  ///< of a configuration
};

class Findings {
 public:
  void add(const Rule& rule, Position at, std::string message, std::string hint = {});
  /// Those of another group of rules, which has no rule with these in common.
  void join(Findings other);
  [[nodiscard]] LintReport finish();

 private:
  LintReport report_;
  std::map<const Rule*, std::size_t> counts_;
  std::set<std::tuple<Position, const Rule*, std::string>> known_;
};

/// What a rule makes of something that the reader remarked.
struct RemarkRow {
  Deviation what;
  const Rule* rule;
  std::string_view message;  ///< {} is the text in question
  std::string_view hint;

  [[nodiscard]] std::string text_of(const Remark& remark) const;
};
/// nullptr: no row is about it.
[[nodiscard]] const RemarkRow* row_of(std::span<const RemarkRow> rows, const Remark& remark);

struct Group {
  RuleGroup table;
  void (*check)(const Subject& subject, Findings& findings);
};

extern const Group structure_rules;
extern const Group number_rules;
extern const Group value_rules;
extern const Group info_rules;
extern const Group list_rules;
extern const Group object_rules;
extern const Group predefined_rules;
extern const Group sub_object_rules;
extern const Group compact_rules;
extern const Group pdo_rules;
extern const Group mapping_rules;
extern const Group identity_rules;
extern const Group module_rules;
extern const Group presence_rules;
extern const Group cob_id_rules;
extern const Group entry_rules;
extern const Group xdd_rules;

/// "[1018]" or "[1018sub1]": a section as the standard spells it.
[[nodiscard]] std::string section_name(Index index, std::optional<SubIndex> sub = {});

/// The place of a field, or of what should contain it.
[[nodiscard]] inline Position place_of(const Field& field, Position otherwise) {
  return field.at.known() ? field.at : otherwise;
}

/// The first entry that is not numbered in a row from 1 on, in whatever order they stand; nullptr when all
/// are. A number that is there twice has a finding of its own.
[[nodiscard]] const NumberedField* first_out_of_row(const NumberedList& list);

/// Where an entry stands in the dictionary.
struct Spot {
  enum class Kind : std::uint8_t { of_the_device, fixed, extension };

  const Object& object;
  std::optional<SubIndex> sub;  ///< nothing: the section of the object itself
  const Entry& entry;
  Kind kind = Kind::of_the_device;
  std::uint64_t module = 0;  ///< that brings it
  [[nodiscard]] std::string name() const;
  /// The entry has a value of its own, and is not only the head of a structure.
  [[nodiscard]] bool has_value() const { return sub.has_value() || !is_structured(object); }
};

/// Everything that sections of objects and sub-objects describe: those of the device in ascending order, then
/// those of each module.
void each_described(const Subject& subject, const std::function<void(const Spot&)>& look);

/// The number that an entry has at power-on: ParameterValue of a DCF before DefaultValue.
[[nodiscard]] const Field& effective_value(const Entry& entry);

/// A COB-ID: a number, or a formula of the node-ID; nothing where the text is neither.
[[nodiscard]] std::optional<Number> cob_id_of(const Field& field);

inline bool between(Index index, unsigned first, unsigned last) {
  return index.value() >= first && index.value() <= last;
}
inline bool is_communication_parameter(Index index) {
  return between(index, 0x1400, 0x15FF) || between(index, 0x1800, 0x19FF);
}
inline bool is_mapping_parameter(Index index) {
  return between(index, 0x1600, 0x17FF) || between(index, 0x1A00, 0x1BFF);
}
/// Modules add objects and PDOs that the file of the coupler only announces.
inline bool is_modular(const EdsFile& file) {
  return number_of(file.supported_modules.count).value_or(0) > 0 || !file.modules.empty();
}

}  // namespace conform::eds
