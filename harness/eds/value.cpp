// SPDX-License-Identifier: Apache-2.0
#include "eds/value.hpp"

#include <bit>
#include <string>

#include "base/text.hpp"
#include "eds/type_table.hpp"

namespace conform::eds {
namespace {

std::uint64_t mask_of(const TypeInfo* type) {
  const auto bits = type == nullptr ? 0U : type->bits;
  return bits == 0 || bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1U;
}

/// The bits of a number in the length of the type, without the node-ID.
std::uint64_t bits_of(const Number& number, std::uint64_t mask) {
  return (number.negative ? ~number.magnitude + 1U : number.magnitude) & mask;
}

bool same_number(const Number& a, const Number& b, std::uint64_t mask, std::optional<std::uint8_t> node) {
  const auto difference = (bits_of(a, mask) - bits_of(b, mask)) & mask;
  if (a.node_id == b.node_id) return difference == 0;
  // a + node == b, or a == b + node
  const auto wanted = a.node_id ? (~difference + 1U) & mask : difference;
  return node ? wanted == *node : wanted >= 1 && wanted <= 127;
}

/// A decimal number, or the bits of one in hexadecimal.
std::optional<double> real_of(const Field& field, const TypeInfo& type) {
  if (const auto value = parse_real(field.text)) return value;
  const auto number = parse_number(field.text);
  if (!number || number->node_id || number->base != NumberBase::hexadecimal) return std::nullopt;
  if (type.bits == 64) return std::bit_cast<double>(number->magnitude);
  return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(number->magnitude)));
}

/// Hexadecimal digits alone, in one spelling.
std::string digits_of(const Field& field) {
  auto out = lower(field.text);
  std::erase(out, ' ');
  return out.starts_with("0x") ? out.substr(2) : out;
}

}  // namespace

bool same_value(const Field& a, const Field& b, std::optional<std::uint16_t> type,
                std::optional<std::uint8_t> node) {
  if (a.text == b.text) return true;
  const auto* info = type ? find_type(*type) : nullptr;
  const auto kind = info == nullptr ? TypeKind::unsigned_integer : info->kind;
  if (kind == TypeKind::text) return false;
  if (kind == TypeKind::octets || kind == TypeKind::domain) return digits_of(a) == digits_of(b);
  if (kind == TypeKind::real) {
    const auto left = real_of(a, *info);
    const auto right = real_of(b, *info);
    if (!left || !right) return false;
    return info->bits == 64 ? *left == *right : static_cast<float>(*left) == static_cast<float>(*right);
  }
  if (kind == TypeKind::boolean) {
    const auto left = flag_of(a);
    return left && left == flag_of(b);
  }
  const auto left = parse_number(a.text);
  const auto right = parse_number(b.text);
  return left && right && same_number(*left, *right, mask_of(info), node);
}

std::optional<std::uint8_t> configured_node(const EdsFile& file) {
  const auto node = number_of(file.commissioning.node_id);
  if (!node || *node < 1 || *node > 127) return std::nullopt;
  return static_cast<std::uint8_t>(*node);
}

}  // namespace conform::eds
