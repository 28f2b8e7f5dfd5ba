// SPDX-License-Identifier: Apache-2.0
// Failures that somebody answers for: which requirement, why, who, and until when.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/strong.hpp"
#include "yaml/diagnostic.hpp"
#include "yaml/fields.hpp"
#include "yaml/loader.hpp"

namespace conform::device {

struct Waiver {
  std::string requirement;        ///< "OD-1014-06"
  std::string case_name;          ///< pattern of cases; empty: every case of the requirement
  std::optional<Index> object{};  ///< only findings about it
  std::string reason;
  std::string owner, ticket;  ///< who answers for it, and where it is followed; may be empty
  std::optional<std::chrono::sys_days> expires{};  ///< the last day on which it holds; empty: for ever
  std::string place;                               ///< "waivers.yaml:7"
};

/// An item of `known_deviations` of a profile or of `waivers` of a file; what is wrong is reported at its
/// place.
[[nodiscard]] std::optional<Waiver> read_waiver(const yaml::Field& item);
/// The list; the same thing waived twice is reported.
[[nodiscard]] std::vector<Waiver> read_waivers(const yaml::Field& list);

struct WaiverDocument {
  std::vector<Waiver> waivers;
  yaml::Diagnostics diagnostics;  ///< ask has_errors() before using them
};
/// waivers.yaml. The Error is about the file as a whole (missing, too large, no YAML).
[[nodiscard]] Result<WaiverDocument> load_waiver_file(const std::string& path);

/// "2027-03-31"
[[nodiscard]] std::optional<std::chrono::sys_days> parse_date(std::string_view text);
[[nodiscard]] std::string to_string(std::chrono::sys_days day);

}  // namespace conform::device
