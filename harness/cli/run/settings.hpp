// SPDX-License-Identifier: Apache-2.0
// Where the options of a run come from: command line, environment, device profile, default, in this order.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace conform::cli {

/// The value of one option, and who says so.
struct Setting {
  std::string option;              ///< without dashes; "select" for what is named without option
  std::vector<std::string> words;  ///< empty: the default
  std::string origin;              ///< "command line", "CANOPEN_CONFORM_ALLOW", "device.yaml:12"; "default"
};

struct MergedLine {
  std::vector<std::string> words;  ///< the command line, with what the others add
  /// The same without what the device profile adds: who has the profile can do it again.
  std::vector<std::string> told;
  std::vector<Setting> settings;  ///< in the order of the options; empty for other commands than `run`
  bool profile_found = false;     ///< nobody named a device, and the folder has a profile
};

/// The profile that is used where nothing says which device is meant.
inline constexpr const char* found_profile = "device.yaml";

/// The variable that stands for an option of a run: "all-objects" -> "CANOPEN_CONFORM_ALL_OBJECTS".
[[nodiscard]] std::string variable_of(std::string_view option);

/// A variable of the environment; nullptr: not there.
using Environment = std::function<const char*(const std::string& name)>;

/// What of it is wrong the parser tells, as if it stood on the command line. Where two options exclude each
/// other the nearer one counts.
[[nodiscard]] MergedLine merge_settings(std::span<char* const> arguments, const Environment& environment);

/// Of an error message about options: which of them are not from the command line, as lines. Empty: none.
[[nodiscard]] std::string origins_in(std::string_view message, const MergedLine& line);

/// A line for each option: value and origin.
[[nodiscard]] std::string config_table(const MergedLine& line);

}  // namespace conform::cli
