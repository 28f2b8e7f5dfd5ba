// SPDX-License-Identifier: Apache-2.0
// Which part of a device a requirement or an object is about, and how near to the frame on the bus it lies:
// what findings are grouped by.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "base/strong.hpp"

namespace conform::result {

/// A part of the device that can be wrong by itself.
struct Service {
  std::string_view name;  ///< "heartbeat producer": what a reader calls it
  /// 0: frames as such; 1: SDO frames; higher: what is seen through the lower ones only. When two rules are
  /// broken at once, the one nearer to the frame explains the other.
  int depth = 0;
};

/// Of the services that are what a device does with SDO frames; whatever else is seen, is seen through them.
inline constexpr int deepest_of_sdo = 3;
/// What shows in so many parts of a device at once is one fault, and not one of each part.
inline constexpr std::size_t many_parts = 3;

/// Of a requirement, by its family ("EC-HBP-02"). nullptr: a rule about entries in general ("OD-ACC-01"),
/// which belongs to the service of the entry that broke it.
[[nodiscard]] const Service* service_of_requirement(std::string_view requirement);
/// Of an object of the dictionary; objects of profiles and manufacturers are one service.
[[nodiscard]] const Service& service_of_object(Index index);
/// The object that a rule is of: 1017h of "OD-1017-05".
[[nodiscard]] std::optional<Index> object_of_requirement(std::string_view requirement);
/// Depth of the rule: that of its service, or of rules about entries in general.
[[nodiscard]] int depth_of_requirement(std::string_view requirement);

}  // namespace conform::result
