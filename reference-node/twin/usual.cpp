// SPDX-License-Identifier: Apache-2.0
#include "twin/usual.hpp"

#include "pdo/parameters.hpp"
#include "sdo/parameters.hpp"

namespace refnode {

namespace {

constexpr std::uint64_t not_valid = 0x8000'0000;
constexpr std::uint64_t no_remote_frame = 0x4000'0000;
constexpr std::uint16_t pdos_with_can_id = 4;  // the pre-defined connection set has no more

bool within(std::uint16_t index, std::uint16_t first, std::uint16_t last) {
  return index >= first && index <= last;
}

/// Its number, if the index is that of a communication parameter of this direction.
std::optional<std::uint16_t> pdo_number(std::uint16_t index, PdoDirection direction) {
  const std::uint16_t first = first_communication_index(direction);
  if (index < first || index >= first + pdos_of_a_direction) return std::nullopt;
  return static_cast<std::uint16_t>(index - first);
}

std::optional<std::uint64_t> usual_pdo_value(std::uint16_t number, std::uint8_t sub, std::uint64_t cob_id) {
  if (sub == 1) return number < pdos_with_can_id ? cob_id + 0x100U * number : not_valid;
  if (sub == 2) return 0xFF;  // event-driven, as the device profile says
  return std::nullopt;
}

}  // namespace

std::optional<std::uint64_t> usual_value(std::uint16_t index, std::uint8_t sub, std::uint8_t node_id) {
  switch (index) {
    case 0x1005: return 0x80;
    case 0x1012: return 0x100;
    case 0x1014: return 0x80U + node_id;
    case 0x1010:
    case 0x1011: return sub == 0 ? std::nullopt : std::optional<std::uint64_t>(1);  // on command
    case first_sdo_server:
      if (sub == 1) return 0x600U + node_id;
      if (sub == 2) return 0x580U + node_id;
      return std::nullopt;
    default: break;
  }
  if (within(index, first_sdo_server, last_sdo_client) && (sub == 1 || sub == 2)) return not_valid;
  if (const auto number = pdo_number(index, PdoDirection::receive))
    return usual_pdo_value(*number, sub, 0x200U + node_id);
  if (const auto number = pdo_number(index, PdoDirection::transmit))
    return usual_pdo_value(*number, sub, no_remote_frame + 0x180U + node_id);
  return std::nullopt;
}

bool is_pdo_communication(std::uint16_t index) {
  return pdo_number(index, PdoDirection::receive) || pdo_number(index, PdoDirection::transmit);
}

bool is_served_cob_id(std::uint16_t index, std::uint8_t sub) {
  if (index == 0x1005 || index == 0x1012 || index == 0x1014) return sub == 0;
  if (within(index, first_sdo_server + 1, last_sdo_server)) return sub == 1 || sub == 2;
  return is_pdo_communication(index) && sub == 1;
}

bool is_pdo_mapping(std::uint16_t index) {
  return within(index, 0x1600, 0x17FF) || within(index, 0x1A00, 0x1BFF);
}

bool sub_zero_is_highest(std::uint16_t index) { return index != 0x1003 && !is_pdo_mapping(index); }

}  // namespace refnode
