// SPDX-License-Identifier: Apache-2.0
// Which objects show that a device has a feature, wherever they were found: in its description or in itself.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace conform::device {

/// One of these objects (CiA 301, 7.5.2) is enough.
struct FeatureObjects {
  std::string_view feature;
  std::uint16_t first, last;

  [[nodiscard]] constexpr bool holds(std::uint16_t index) const { return index >= first && index <= last; }
};

/// Without the features that an object alone does not prove (whether block transfers are offered), or of
/// which its value tells.
[[nodiscard]] std::span<const FeatureObjects> features_of_objects();

}  // namespace conform::device
