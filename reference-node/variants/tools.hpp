// SPDX-License-Identifier: Apache-2.0
// The vocabulary of the variant tables, so that a row is one statement. Every edit leaves alone what is not
// there.
#pragma once

#include <cstdint>
#include <initializer_list>

#include "variants/variant.hpp"

namespace refnode::variant {

using How = std::function<void(Parts&)>;

[[nodiscard]] How absent(std::initializer_list<std::uint16_t> indices);
/// Sub-indices first..FEh go; sub-index 00h tells the highest one that stays.
[[nodiscard]] How absent_from(std::uint16_t index, std::uint8_t first);
/// One sub-index goes, sub-index 00h stays: a gap.
[[nodiscard]] How gap(std::uint16_t index, std::uint8_t sub);
[[nodiscard]] How access(std::uint16_t index, std::uint8_t sub, Access access);
/// Every sub-index of the object, those of another access than `from` left alone.
[[nodiscard]] How access_all(std::uint16_t index, Access from, Access to);
/// One more condition for the values of an entry, asked before those it has.
[[nodiscard]] How also_checked(std::uint16_t index, std::uint8_t sub,
                               std::function<Accepted(const Parts&, ByteView)> condition);
/// Value after power-on.
[[nodiscard]] How preset(std::uint16_t index, std::uint8_t sub, std::uint64_t value);
[[nodiscard]] How preset_with_node_id(std::uint16_t index, std::uint8_t sub, std::uint64_t value);
[[nodiscard]] How text(std::uint16_t index, std::string_view value);
[[nodiscard]] How both(How first, How second);
/// What the service sends leaves so much later, and not at all where a command has ended the state for it.
[[nodiscard]] How late(Service service, Duration by);
/// The parameters of RPDOs and of TPDOs.
[[nodiscard]] How choose_of_pdos(void (*change)(PdoChoices&));

}  // namespace refnode::variant
