// SPDX-License-Identifier: Apache-2.0
// The requirement catalogue (suites/requirements): what every id means, and which ids are two names of one
// rule.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "result/run_result.hpp"
#include "yaml/diagnostic.hpp"
#include "yaml/node.hpp"

namespace conform::scenario {

struct Requirement {
  std::string id;
  std::string clause;
  std::string object;   ///< may be empty
  std::string level;    ///< mandatory, conditional, optional, recommended
  std::string applies;  ///< empty: always
  std::string statement;
  std::string passes, warns, fails;
  std::vector<std::string> same_as;
  std::vector<std::string> cct;
  std::string risk;
  std::string note;
  std::string proof;  ///< "", "manual", "reference node only"
  std::string proof_reason;
  std::string not_judged;  ///< why no scenario decides it, where that is meant to stay so
  std::string planned;     ///< which scenarios will decide it, where none does yet
  std::string area;
  std::string file;  ///< what messages call it
  std::string path;  ///< where it was read from
  int line = 0;

  /// Whether the rule names a crash or restart of the device among its failures: "crash", "loss of service",
  /// a reset or a boot-up message under `fails`, "no boot-up" under `passes`.
  [[nodiscard]] bool forbids_restart() const;
  [[nodiscard]] result::RequirementInfo info() const { return {id, clause, level, area, statement}; }
};

/// Reads one file of requirements. All mistakes are in `diagnostics`, ids given twice in the file included.
[[nodiscard]] std::vector<Requirement> load_requirements(const yaml::Node& root,
                                                         yaml::Diagnostics& diagnostics,
                                                         const std::string& path);

class Catalogue {
 public:
  /// Reads every *.yaml below `<suites>/requirements`, and below `<folder>/requirements` of those that have
  /// one. Mistakes go to `problems`, one rendered text per file.
  static Result<Catalogue> load(const std::string& suites, std::vector<std::string>& problems,
                                bool colour = false, const std::vector<std::string>& more = {});

  /// By its own id or by an alias (same_as).
  [[nodiscard]] const Requirement* find(std::string_view id) const;
  [[nodiscard]] std::optional<std::string> canonical(std::string_view id) const;
  [[nodiscard]] const std::vector<Requirement>& all() const { return requirements_; }  ///< in file order
  [[nodiscard]] std::vector<std::string_view> ids() const;  ///< own ids and aliases, sorted

 private:
  /// `prefix` stands before the names of the files in messages and reports.
  Result<void> add_folder(const std::string& folder, const std::string& prefix,
                          std::vector<std::string>& problems, bool colour);

  std::vector<Requirement> requirements_;
  std::map<std::string, std::size_t, std::less<>> index_;
};

}  // namespace conform::scenario
