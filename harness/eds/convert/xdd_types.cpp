// SPDX-License-Identifier: Apache-2.0
#include "eds/convert/xdd_types.hpp"

#include <algorithm>
#include <iterator>

namespace conform::eds {
namespace {

constexpr XddType types[] = {
    {"BOOL", 0x01},   {"SINT", 0x02},    {"INT", 0x03},       {"DINT", 0x04},  {"LINT", 0x15},
    {"USINT", 0x05},  {"UINT", 0x06},    {"UDINT", 0x07},     {"ULINT", 0x1B}, {"BYTE", 0x05},
    {"WORD", 0x06},   {"DWORD", 0x07},   {"LWORD", 0x1B},     {"REAL", 0x08},  {"LREAL", 0x11},
    {"STRING", 0x09}, {"WSTRING", 0x0B}, {"BITSTRING", 0x0A}, {"CHAR", 0x05},
};

}  // namespace

std::span<const XddType> xdd_types() { return types; }

std::string_view xdd_type_of(std::uint16_t data_type) {
  const auto* found = std::ranges::find(types, data_type, &XddType::data_type);
  return found == std::end(types) ? std::string_view() : found->element;
}

bool parameter_can_say(const Entry& entry) {
  const auto type = data_type(entry);
  return type && !xdd_type_of(*type).empty() && entry.low_limit.empty() == entry.high_limit.empty();
}

ObjectList list_of(Index index) {
  const auto value = index.value();
  if (value == 0x1000 || value == 0x1001 || value == 0x1018) return ObjectList::mandatory;
  return value >= 0x2000 && value <= 0x5FFF ? ObjectList::manufacturer : ObjectList::optional;
}

}  // namespace conform::eds
