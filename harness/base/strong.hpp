// SPDX-License-Identifier: Apache-2.0
// Strong types for the numbers that can be swapped by mistake. They carry no rule of any protocol.
#pragma once

#include <compare>
#include <cstdint>

namespace conform {

/// An integer with a name of its own: comparable and printable, but not convertible to its neighbours.
template <typename Tag, typename Rep>
class Strong {
 public:
  using rep = Rep;
  constexpr Strong() = default;
  constexpr explicit Strong(Rep value) : value_(value) {}
  [[nodiscard]] constexpr Rep value() const { return value_; }
  friend constexpr auto operator<=>(const Strong&, const Strong&) = default;

 private:
  Rep value_{};
};

using NodeId = Strong<struct NodeIdTag, std::uint8_t>;  ///< 1..127
using CanId = Strong<struct CanIdTag, std::uint32_t>;   ///< identifier on the wire, 11 or 29 bit
using CobId = Strong<struct CobIdTag, std::uint32_t>;   ///< value of a COB-ID entry, control bits included
using Index = Strong<struct IndexTag, std::uint16_t>;   ///< index of an object
using SubIndex = Strong<struct SubIndexTag, std::uint8_t>;     ///< sub-index of an object
using AbortCode = Strong<struct AbortCodeTag, std::uint32_t>;  ///< SDO abort code

/// Index and sub-index: what an SDO initiate addresses.
struct Multiplexer {
  Index index;
  SubIndex sub;
  friend constexpr auto operator<=>(const Multiplexer&, const Multiplexer&) = default;
};

}  // namespace conform
