// SPDX-License-Identifier: Apache-2.0
// What help and man pages tell beside the options, command by command.
#pragma once

#include "usage/manual.hpp"

namespace conform::cli {

/// Of canopen-conform. Every command that is not hidden has a page.
[[nodiscard]] usage::Manual manual();

/// The pages of single commands: of those that need a device, or its place; and of the others.
[[nodiscard]] std::vector<usage::CommandPage> device_pages();
[[nodiscard]] std::vector<usage::CommandPage> other_pages();

}  // namespace conform::cli
