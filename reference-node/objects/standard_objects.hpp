// SPDX-License-Identifier: Apache-2.0
// Communication objects that belong to no service of their own: identity, names, default SDO.
#pragma once

#include "device/device.hpp"

namespace refnode {

void add_identity_objects(Device& device);

}  // namespace refnode
