// SPDX-License-Identifier: Apache-2.0
// The suite against every edit of every entry of the reference node's dictionary: an object that is absent,
// has another length, access or default must not go unnoticed, whatever the object is for.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "device/profile.hpp"
#include "scenario/catalogue.hpp"
#include "scenario/loader.hpp"

namespace conform::cli {

struct EditVerdict {
  std::string id;       ///< "edit:1017h:00:longer"
  std::string summary;  ///< "1017h:00 has a longer type"
  /// Requirements whose verdict became worse than on the conformant node, sorted; empty: the edit survives.
  std::vector<std::string> noticed_by;
};

struct EditMatrix {
  std::vector<EditVerdict> edits;  ///< in the order of the dictionary
  [[nodiscard]] std::vector<std::string> survivors() const;
};

/// Runs what judges the dictionary first and the whole suite only where that notices nothing. `jobs` threads,
/// 0: as many as there are cores; the result does not depend on it. `only`: ids, empty for all.
[[nodiscard]] Result<EditMatrix> edit_matrix(const device::Profile& profile, const scenario::Suite& suite,
                                             const scenario::Catalogue& catalogue, std::uint64_t seed,
                                             unsigned jobs, const std::vector<std::string>& only = {});

}  // namespace conform::cli
