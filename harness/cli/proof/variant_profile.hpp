// SPDX-License-Identifier: Apache-2.0
// The device profile of the reference node with legal variants switched on.
#pragma once

#include <string>
#include <vector>

#include "device/profile.hpp"
#include "dictionary/object_dictionary.hpp"

namespace conform::cli {

/// What the maker of such a device would write: the profile of the node by default, `reference`, without what
/// is gone, and with the access and the defaults that `dictionary` holds. `variants`: ids; what they lack and
/// gain is not claimed, or is.
[[nodiscard]] device::Profile profile_of_variants(const device::Profile& reference,
                                                  const refnode::ObjectDictionary& dictionary,
                                                  const std::vector<std::string>& variants);

}  // namespace conform::cli
