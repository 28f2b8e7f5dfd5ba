// SPDX-License-Identifier: Apache-2.0
// The manufacturer objects (2000h-5FFFh): one entry of every type and access.
#pragma once

#include "device/device.hpp"

namespace refnode {

void add_sample_objects(Device& device);

}  // namespace refnode
