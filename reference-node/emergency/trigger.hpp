// SPDX-License-Identifier: Apache-2.0
// 2F00h, of the manufacturer: errors of the application, raised and cleared from outside.
#pragma once

#include "device/device.hpp"
#include "emergency/emergency.hpp"

namespace refnode {

/// 01h raises the error of a code, 02h clears it (0000h: all), 03h tells how many errors there are.
void add_error_trigger(Device& device, const Emergency& emergency);

}  // namespace refnode
