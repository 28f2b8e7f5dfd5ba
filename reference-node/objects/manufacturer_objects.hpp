// SPDX-License-Identifier: Apache-2.0
// The manufacturer objects (2000h-5FFFh): one entry of every type and access, and the error trigger 2F00h.
#pragma once

#include "device/device.hpp"
#include "emergency/emergency.hpp"

namespace refnode {

void add_sample_objects(Device& device);
/// 2F00h:01 raises an error of the application by its emergency error code, 2F00h:02 clears it (0: all).
void add_error_trigger(Device& device, Emergency& emergency);

}  // namespace refnode
