// SPDX-License-Identifier: Apache-2.0
// Shared by the profile and its reader: the durations as one table.
#pragma once

#include <span>
#include <string_view>

#include "device/profile.hpp"

namespace conform::device {

struct DurationField {
  std::string_view key;     ///< in the file, and in scenarios as $profile.<key>
  std::string_view symbol;  ///< in conversations: T_BOOT
  Duration Profile::* member;
};
[[nodiscard]] std::span<const DurationField> duration_fields();

}  // namespace conform::device
