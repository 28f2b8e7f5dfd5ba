// SPDX-License-Identifier: Apache-2.0
// The modules that are plugged into this (modular) device (1027h, CiA 301, 7.5.2.30). Which ones is fixed.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "device/device.hpp"

namespace refnode {

struct Module {
  std::uint16_t identifier;
  std::string_view name;
};

inline constexpr std::array<Module, 2> modules{
    {{0x0101, "Digital inputs and outputs"}, {0x0202, "Analog inputs and outputs"}}};

void add_module_list(Device& device);

}  // namespace refnode
