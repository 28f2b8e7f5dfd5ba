// SPDX-License-Identifier: Apache-2.0
#include "eds/same_value.hpp"

#include <bit>
#include <string>

#include "base/text.hpp"
#include "eds/ini_file.hpp"
#include "eds/number.hpp"
#include "eds/type_table.hpp"

namespace conform::eds {
namespace {

constexpr std::uint64_t lowest_node = 1, highest_node = 127;

struct Integer {
  std::uint64_t bits = 0;  ///< two's complement in 64 bits
  bool node_id = false;
  friend constexpr bool operator==(const Integer&, const Integer&) = default;
};

/// As many low bits as the type has are what counts: -1 and 0xFF are the same INTEGER8.
std::optional<Integer> integer(std::string_view text, unsigned bits) {
  const auto number = parse_number(text);
  if (!number) return std::nullopt;
  auto value = number->negative ? ~number->magnitude + 1 : number->magnitude;
  // Beyond the range of the type nothing is cut off: 0x1FF is not FFh.
  const bool fits = bits < 64 && number->magnitude < (std::uint64_t{1} << bits);
  if (bits != 0 && fits) value &= (std::uint64_t{1} << bits) - 1;
  return Integer{value, number->node_id};
}

std::optional<double> real(std::string_view text, unsigned bits) {
  if (const auto decimal = parse_real(text)) return bits == 32 ? static_cast<float>(*decimal) : *decimal;
  const auto number = parse_number(text);
  if (!number || number->node_id || number->negative || number->base != NumberBase::hexadecimal)
    return std::nullopt;
  if (bits != 32) return std::bit_cast<double>(number->magnitude);
  if (number->magnitude > 0xFFFFFFFFU) return std::nullopt;
  return std::bit_cast<float>(static_cast<std::uint32_t>(number->magnitude));
}

std::string without_blanks(std::string_view text) {
  std::string out = lower(text);
  std::erase_if(out, [](char c) { return c == ' ' || c == '\t'; });
  return out;
}

template <typename Value>
bool same(std::string_view a, std::string_view b, const std::optional<Value>& x,
          const std::optional<Value>& y) {
  return x && y ? *x == *y : trim(a) == trim(b);
}

std::optional<std::uint64_t> flag(std::string_view text) {
  const auto word = without_comment(text);
  if (word.empty() || same_word(word, "false") || same_word(word, "no")) return 0;
  if (same_word(word, "true") || same_word(word, "yes")) return 1;
  const auto number = parse_number(word);
  if (!number || number->negative || number->node_id) return std::nullopt;
  return number->magnitude;
}

}  // namespace

bool same_value(std::string_view a, std::string_view b, std::optional<std::uint16_t> data_type) {
  if (a == b) return true;
  const auto* type = data_type ? find_type(*data_type) : nullptr;
  if (type == nullptr) return same_number(a, b);
  switch (type->kind) {
    case TypeKind::boolean: return !a.empty() && !b.empty() && same_flag(a, b);
    case TypeKind::real: return same(a, b, real(a, type->bits), real(b, type->bits));
    case TypeKind::text: return false;
    case TypeKind::octets:
    case TypeKind::domain: return without_blanks(a) == without_blanks(b);
    case TypeKind::signed_integer:
    case TypeKind::unsigned_integer: return same(a, b, integer(a, type->bits), integer(b, type->bits));
    case TypeKind::time:
    case TypeKind::record: return same_number(a, b);
  }
  return false;
}

bool same_number(std::string_view a, std::string_view b) {
  return a == b || same(a, b, integer(a, 0), integer(b, 0));
}

bool may_be_same_value(const Field& a, const Field& b, std::optional<std::uint16_t> data_type,
                       std::optional<std::uint8_t> node) {
  if (same_value(a.text, b.text, data_type)) return true;
  const auto* type = data_type ? find_type(*data_type) : nullptr;
  const bool is_integer =
      type == nullptr || type->kind == TypeKind::signed_integer || type->kind == TypeKind::unsigned_integer;
  const auto x = integer(a.text, type == nullptr ? 0 : type->bits);
  const auto y = integer(b.text, type == nullptr ? 0 : type->bits);
  if (!is_integer || !x || !y || x->node_id == y->node_id) return false;
  const auto wanted = x->node_id ? y->bits - x->bits : x->bits - y->bits;
  return node ? wanted == *node : wanted >= lowest_node && wanted <= highest_node;
}

std::optional<std::uint8_t> configured_node(const EdsFile& file) {
  const auto node = number_of(file.commissioning.node_id);
  if (!node || *node < lowest_node || *node > highest_node) return std::nullopt;
  return static_cast<std::uint8_t>(*node);
}

bool same_flag(std::string_view a, std::string_view b) { return same(a, b, flag(a), flag(b)); }

}  // namespace conform::eds
