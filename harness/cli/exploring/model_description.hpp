// SPDX-License-Identifier: Apache-2.0
// The description whose twin is the model of a real device: the one that is given, or one drafted from what
// the device shows, with the values that the device begins with.
#pragma once

#include <memory>

#include "base/error.hpp"
#include "cli/exploring/live_device.hpp"
#include "device/profile.hpp"
#include "eds/eds.hpp"

namespace conform::cli {

/// `given`: nullptr where there is none. Access and type of an entry are those of the profile where it claims
/// the entry.
[[nodiscard]] Result<std::shared_ptr<const eds::EdsFile>> model_description(const LiveDevice& device,
                                                                            const device::Profile& profile,
                                                                            const eds::EdsFile* given);

}  // namespace conform::cli
