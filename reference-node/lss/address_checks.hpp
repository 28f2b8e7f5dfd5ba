// SPDX-License-Identifier: Apache-2.0
// Whether the LSS address that a master names, part by part, is that of the slave (CiA 305: switch state
// selective, identify remote slave, fastscan).
#pragma once

#include <array>
#include <cstdint>

#include "rules/rule.hpp"

namespace refnode {

/// Vendor-ID, product code, revision number, serial number.
using LssAddress = std::array<std::uint32_t, 4>;

struct LssAddressRules {
  /// One part of a switch state selective.
  Rule<bool(std::uint32_t named, std::uint32_t own)> is_own;
  /// Vendor-ID and product code are named, of the others a range with both ends.
  Rule<bool(std::uint32_t low, std::uint32_t own, std::uint32_t high)> in_range;
  /// Fastscan compares the bits from `lowest` up to 31.
  Rule<bool(std::uint32_t named, std::uint32_t own, std::uint8_t lowest)> upper_bits_equal;
  /// The part that a fastscan has come to.
  Rule<bool(std::uint8_t named, std::uint8_t expected)> is_next_part;
  /// What comes in a sequence has to be what follows next; the first one may come any time.
  Rule<bool(std::uint8_t step, std::uint8_t expected)> in_order;
  LssAddressRules();
};

/// The four frames of a switch state selective.
class SelectiveAddress {
 public:
  /// True: this was the last part, and all were right. `any_order`: they need not follow each other.
  bool take(std::uint8_t part, std::uint32_t named, const LssAddress& own, const LssAddressRules& rules,
            bool any_order);
  void forget() {
    next_ = 0;
    matched_ = 0;
  }

 private:
  std::uint8_t next_ = 0;
  unsigned matched_ = 0;  ///< bit by part
};

/// The six frames of an identify remote slave: vendor-ID, product code, lowest and highest revision number,
/// lowest and highest serial number.
class IdentityRange {
 public:
  static constexpr std::uint8_t frames = 6;
  bool take(std::uint8_t step, std::uint32_t named, const LssAddress& own, const LssAddressRules& rules);
  void forget() { next_ = 0; }

 private:
  std::uint8_t next_ = 0;
  std::array<std::uint32_t, frames> named_{};
};

/// The frames of a fastscan, of one slave's view.
class Fastscan {
 public:
  static constexpr std::uint8_t begin = 0x80;
  enum class Result : std::uint8_t { silent, match, found };
  Result take(std::uint32_t named, std::uint8_t bit_check, std::uint8_t part, std::uint8_t next,
              const LssAddress& own, const LssAddressRules& rules);
  void forget() { expected_ = 0; }

 private:
  std::uint8_t expected_ = 0;
};

}  // namespace refnode
