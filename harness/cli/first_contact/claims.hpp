// SPDX-License-Identifier: Apache-2.0
// Which features a device shows at first sight, and which it may have besides.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/first_contact/acquaintance.hpp"

namespace conform::cli {

struct FoundClaim {
  std::string_view feature;  ///< word of device::features()
  std::string why;           ///< "1014h is there"
};

struct FoundClaims {
  std::vector<FoundClaim> shown;  ///< seen in the device: claimed
  std::vector<FoundClaim> open;   ///< for the user to say
};

/// What is shown is claimed: a later firmware that lacks it is failed. What could only be found out by
/// writing, or is a permission, stays open.
[[nodiscard]] FoundClaims claims_of(const Acquaintance& device);

}  // namespace conform::cli
