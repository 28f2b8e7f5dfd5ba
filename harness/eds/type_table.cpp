// SPDX-License-Identifier: Apache-2.0
#include "eds/type_table.hpp"

#include <algorithm>
#include <iterator>

namespace conform::eds {
namespace {

using enum TypeKind;
constexpr TypeInfo types[] = {
    {0x01, "BOOLEAN", 1, boolean},
    {0x02, "INTEGER8", 8, signed_integer},
    {0x03, "INTEGER16", 16, signed_integer},
    {0x04, "INTEGER32", 32, signed_integer},
    {0x05, "UNSIGNED8", 8, unsigned_integer},
    {0x06, "UNSIGNED16", 16, unsigned_integer},
    {0x07, "UNSIGNED32", 32, unsigned_integer},
    {0x08, "REAL32", 32, real},
    {0x09, "VISIBLE_STRING", 0, text},
    {0x0A, "OCTET_STRING", 0, octets},
    {0x0B, "UNICODE_STRING", 0, text},
    {0x0C, "TIME_OF_DAY", 48, time},
    {0x0D, "TIME_DIFFERENCE", 48, time},
    {0x0F, "DOMAIN", 0, domain},
    {0x10, "INTEGER24", 24, signed_integer},
    {0x11, "REAL64", 64, real},
    {0x12, "INTEGER40", 40, signed_integer},
    {0x13, "INTEGER48", 48, signed_integer},
    {0x14, "INTEGER56", 56, signed_integer},
    {0x15, "INTEGER64", 64, signed_integer},
    {0x16, "UNSIGNED24", 24, unsigned_integer},
    {0x18, "UNSIGNED40", 40, unsigned_integer},
    {0x19, "UNSIGNED48", 48, unsigned_integer},
    {0x1A, "UNSIGNED56", 56, unsigned_integer},
    {0x1B, "UNSIGNED64", 64, unsigned_integer},
    {0x20, "PDO_COMMUNICATION_PARAMETER", 0, record},
    {0x21, "PDO_MAPPING", 0, record},
    {0x22, "SDO_PARAMETER", 0, record},
    {0x23, "IDENTITY", 0, record},
    {0x24, "DEBUGGER_PAR", 0, record},
    {0x25, "COMMAND_PAR", 0, record},
};

}  // namespace

const TypeInfo* find_type(std::uint16_t code) {
  const auto* found = std::ranges::lower_bound(types, code, {}, &TypeInfo::code);
  return found != std::end(types) && found->code == code ? found : nullptr;
}

bool is_reserved_type(std::uint16_t code) {
  return find_type(code) == nullptr && (code < 0x40 || code > 0x25F);
}

}  // namespace conform::eds
