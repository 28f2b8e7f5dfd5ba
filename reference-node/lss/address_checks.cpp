// SPDX-License-Identifier: Apache-2.0
#include "lss/address_checks.hpp"

namespace refnode {

LssAddressRules::LssAddressRules()
    : is_own([](std::uint32_t named, std::uint32_t own) { return named == own; }),
      in_range(
          [](std::uint32_t low, std::uint32_t own, std::uint32_t high) { return low <= own && own <= high; }),
      upper_bits_equal([](std::uint32_t named, std::uint32_t own, std::uint8_t lowest) {
        return ((named ^ own) >> lowest) == 0;
      }),
      is_next_part([](std::uint8_t named, std::uint8_t expected) { return named == expected; }),
      in_order([](std::uint8_t step, std::uint8_t expected) { return step == expected; }) {}

bool SelectiveAddress::take(std::uint8_t part, std::uint32_t named, const LssAddress& own,
                            const LssAddressRules& rules, bool any_order) {
  if (part == 0 && !any_order) forget();
  const bool right = rules.is_own(named, own[part]);
  if (!any_order && (!right || !rules.in_order(part, next_))) {
    // Nothing but a vendor-ID begins again.
    next_ = static_cast<std::uint8_t>(own.size());
    matched_ = 0;
    return false;
  }
  ++next_;
  const unsigned bit = 1U << part;
  matched_ = right ? matched_ | bit : matched_ & ~bit;
  const bool complete = any_order ? matched_ == 0xFU : part + 1U == own.size();
  if (complete) forget();
  return complete;
}

bool IdentityRange::take(std::uint8_t step, std::uint32_t named, const LssAddress& own,
                         const LssAddressRules& rules) {
  if (step == 0) forget();
  if (!rules.in_order(step, next_)) {
    next_ = frames;
    return false;
  }
  named_[step] = named;
  ++next_;
  if (step + 1 != frames) return false;
  forget();
  return rules.is_own(named_[0], own[0]) && rules.is_own(named_[1], own[1]) &&
         rules.in_range(named_[2], own[2], named_[3]) && rules.in_range(named_[4], own[3], named_[5]);
}

Fastscan::Result Fastscan::take(std::uint32_t named, std::uint8_t bit_check, std::uint8_t part,
                                std::uint8_t next, const LssAddress& own, const LssAddressRules& rules) {
  if (bit_check == begin) {
    forget();
    return Result::match;
  }
  constexpr std::uint8_t highest_bit = 31;
  if (bit_check > highest_bit || part >= own.size() || !rules.is_next_part(part, expected_))
    return Result::silent;
  if (!rules.upper_bits_equal(named, own[part], bit_check)) return Result::silent;
  expected_ = next;
  // The whole of the last part matched: the master says so by going back to an earlier one.
  const bool found = bit_check == 0 && next < part;
  if (found) forget();
  return found ? Result::found : Result::match;
}

}  // namespace refnode
