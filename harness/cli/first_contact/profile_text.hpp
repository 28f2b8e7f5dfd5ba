// SPDX-License-Identifier: Apache-2.0
// A device profile to begin with, with comments that say what each part is for and where it comes from.
#pragma once

#include <string>

#include "cli/first_contact/acquaintance.hpp"

namespace conform::cli {

struct ProfileWords {
  std::string interface;  ///< empty: not written
  std::string how;        ///< how the device was looked at: "on can0, which only read"
};

/// YAML. A line that begins with '#' and no blank, or with "#  -", is a suggestion: without the '#' it is
/// part of the profile.
[[nodiscard]] std::string profile_text(const Acquaintance& device, const ProfileWords& words);

}  // namespace conform::cli
