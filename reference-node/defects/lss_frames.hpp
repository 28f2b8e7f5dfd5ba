// SPDX-License-Identifier: Apache-2.0
// What the tables of LSS defects ask of a frame, and the rules that they change (CiA 305).
#pragma once

#include <cstdint>

#include "defects/hooks.hpp"

namespace refnode::defect::lss {

constexpr std::uint32_t request_id = 0x7E5;
constexpr std::uint32_t answer_id = 0x7E4;

inline LssRules& of_lss(Parts& parts) { return parts.lss.rules; }
inline LssAddressRules& of_address(Parts& parts) { return parts.lss.address_rules; }

inline bool is_request(const Frame& frame) {
  return frame.id == request_id && !frame.extended && !frame.remote && frame.size() == 8;
}
inline bool is_request(const Frame& frame, std::uint8_t specifier) {
  return is_request(frame) && frame.data[0] == specifier;
}

}  // namespace refnode::defect::lss
