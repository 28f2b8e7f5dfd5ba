// SPDX-License-Identifier: Apache-2.0
#include "pdo/terms.hpp"

#include <chrono>
#include <utility>

namespace refnode {

namespace {

/// 0 when there is no placeholder of this index.
unsigned placeholder_bits(const PdoTerms& terms, std::uint16_t index) {
  if (terms.direction != PdoDirection::receive) return 0;
  if (index == 0 || index >= terms.placeholders.size() || !terms.placeholders.at(index)) return 0;
  const auto type = static_cast<DataType>(index);
  return type == DataType::boolean ? 1 : static_cast<unsigned>(fixed_size(type) * 8);
}

Accepted can_be_mapped(const ObjectDictionary& dictionary, const PdoTerms& terms, const Mapped& mapped) {
  const PdoChoices& choices = terms.choices;
  const unsigned placeholder = placeholder_bits(terms, mapped.index);
  if (mapped.sub == 0 && placeholder != 0) {
    if (mapped.bits != placeholder) return refuse(choices.wrong_length);
    return {};
  }
  const Entry* entry = dictionary.entry(mapped.index, mapped.sub);
  if (entry == nullptr) return refuse(choices.absent_object);
  const bool receive = terms.direction == PdoDirection::receive;
  const bool allowed = receive ? entry->rx_mappable : entry->tx_mappable;
  if (!allowed) return refuse(choices.unmappable_object);
  const bool one_bit = entry->type == DataType::boolean && mapped.bits == 1;
  if (mapped.bits != entry->value.size() * 8 && !one_bit) return refuse(choices.wrong_length);
  return {};
}

}  // namespace

// Index in bits 31-16, sub-index in bits 15-8, length in bits in bits 7-0.
Mapped Mapped::unpack(std::uint64_t value) {
  return {static_cast<std::uint16_t>(value >> 16U), static_cast<std::uint8_t>((value >> 8U) & 0xFFU),
          static_cast<std::uint8_t>(value & 0xFFU)};
}

PdoRules::PdoRules(Rule<Accepted(const Mapped&)>::Decision can_be_mapped)
    : mappable(std::move(can_be_mapped)),
      locked([](const PdoParameters&, PdoPart part, bool valid, bool enabled) {
        return valid || (part == PdoPart::mapped_object && enabled);
      }),
      inhibit_time([](const PdoParameters&, std::int64_t value) -> Duration {
        return std::chrono::microseconds(value * 100);
      }),
      event_timer([](const PdoParameters&, std::int64_t value) -> Duration {
        return std::chrono::milliseconds(value);
      }),
      mapping([](const PdoParameters&, const std::vector<Mapped>& counted) { return counted; }) {}

PdoTerms::PdoTerms(const ObjectDictionary& dictionary, PdoDirection of)
    : direction(of),
      cob_id_rules(of == PdoDirection::receive ? CobIdUse::rpdo : CobIdUse::tpdo),
      rules([this, &dictionary](const Mapped& mapped) { return can_be_mapped(dictionary, *this, mapped); }) {}

}  // namespace refnode
