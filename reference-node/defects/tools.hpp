// SPDX-License-Identifier: Apache-2.0
// The vocabulary of the defect tables: small makers of edits, filters and switches, so that a row is one
// statement.
#pragma once

#include <cstdint>
#include <utility>

#include "defects/defect.hpp"

namespace refnode::defect {

/// Puts the rows of a part behind those of a table.
void append(DefectTable& rows, DefectTable part);

// Dictionary edits.
[[nodiscard]] DictionaryEdit absent(std::uint16_t index);
[[nodiscard]] DictionaryEdit absent_sub(std::uint16_t index, std::uint8_t sub);
[[nodiscard]] DictionaryEdit access(std::uint16_t index, std::uint8_t sub, Access access);
/// Another integer type; the value is kept, cut or padded.
[[nodiscard]] DictionaryEdit type(std::uint16_t index, std::uint8_t sub, DataType type);
[[nodiscard]] DictionaryEdit preset(std::uint16_t index, std::uint8_t sub, std::uint64_t value);
/// The value plus something that depends on the node-ID.
[[nodiscard]] DictionaryEdit preset_with_node_id(std::uint16_t index, std::uint8_t sub, std::uint64_t value);
[[nodiscard]] DictionaryEdit bytes(std::uint16_t index, std::uint8_t sub, Bytes value);
/// Adds a variable, or a sub-index to an existing object.
[[nodiscard]] DictionaryEdit extra(std::uint16_t index, std::uint8_t sub, Entry entry);
/// Writes are confirmed and forgotten.
[[nodiscard]] DictionaryEdit not_stored(std::uint16_t index, std::uint8_t sub);
/// Changes every entry of the dictionary.
[[nodiscard]] DictionaryEdit everywhere(void (*change)(Entry&));
[[nodiscard]] DictionaryEdit both(DictionaryEdit first, DictionaryEdit second);

// Filters on SDO responses. A condition looks at the exchange.
using Condition = bool (*)(const SdoExchange&);
using Range = std::pair<std::uint16_t, std::uint16_t>;

/// The abort `wrong` in place of `right`, in answers about indices of `range` (both ends included).
[[nodiscard]] Filter wrong_abort(AbortCode right, AbortCode wrong, Range range = {0x0000, 0xFFFF});
[[nodiscard]] Filter wrong_abort_at(Multiplexer mux, AbortCode right, AbortCode wrong);
/// No response where `when` holds.
[[nodiscard]] Filter silent(Condition when);
/// Command byte and data instead of those of the response where `when` holds; bytes 1-3 stay.
[[nodiscard]] Filter respond(Condition when, std::uint8_t command, std::uint32_t data);
/// Changes the eight bytes of a response where `when` holds.
[[nodiscard]] Filter patch(Condition when,
                           void (*change)(const SdoExchange&, std::array<std::uint8_t, 8>& data));
/// Changes every frame of a service other than SDO.
[[nodiscard]] Filter reshape(Service service, void (*change)(const FilterContext&, Frame&));
/// Drops the frames of a service in one state.
[[nodiscard]] Filter mute(Service service, NmtState state);
/// Sends every frame of a service twice.
[[nodiscard]] Filter repeat(Service service);

[[nodiscard]] constexpr Multiplexer mux(std::uint16_t index, std::uint8_t sub) {
  return {conform::Index(index), conform::SubIndex(sub)};
}

}  // namespace refnode::defect
