// SPDX-License-Identifier: Apache-2.0
// Which scenarios a run takes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scenario/catalogue.hpp"
#include "scenario/scenario.hpp"

namespace conform::scenario {

/// Patterns match whole ids or any leading path: "cia301/dictionary", "cia301/*/1003*",
/// "*/non-zero-write[02h]".
struct Selection {
  std::vector<std::string> patterns;      ///< empty: all
  std::vector<std::string> requirements;  ///< ids or prefixes ending in *: empty: all
  std::vector<std::string> excludes;

  [[nodiscard]] bool takes(const Scenario& scenario, std::string_view instance,
                           const Catalogue& catalogue) const;
  /// False: takes() is false for every instance of the scenario.
  [[nodiscard]] bool takes_any_of(const Scenario& scenario, const Catalogue& catalogue) const;
  /// Monitors ("monitor/sdo-toggle") watch whatever runs: patterns choose among them only when one is about
  /// them.
  [[nodiscard]] bool takes_monitor(std::string_view id, const std::vector<std::string>& decides,
                                   const Catalogue& catalogue) const;

 private:
  [[nodiscard]] bool wants_one_of(const std::vector<std::string>& decides, const Catalogue& catalogue) const;
};

/// '*' any characters, '?' one; a pattern without them also matches as a leading path.
[[nodiscard]] bool matches_pattern(std::string_view pattern, std::string_view id);

}  // namespace conform::scenario
