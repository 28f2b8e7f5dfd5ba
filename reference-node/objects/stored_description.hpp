// SPDX-License-Identifier: Apache-2.0
// The device description inside the device (1021h, 1022h, CiA 301, 7.5.2.24 and 7.5.2.25).
#pragma once

#include <string>

#include "device/device.hpp"

namespace refnode {

/// `text` gives what 1021h holds.
void add_stored_description(Device& device,
                            std::string (*text)(const ObjectDictionary&, std::uint8_t node_id));

}  // namespace refnode
