// SPDX-License-Identifier: Apache-2.0
// The rules of single objects, and what answers to uploads and downloads have in common.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>

#include "explore/assign.hpp"

namespace conform::explore {

/// The object of all of its kind whose rules are told: 1402h is 1400h, 1603h is 1600h.
[[nodiscard]] std::string area_of(std::uint16_t index);
/// What the rules of an object are about; an empty id: there is none for this entry.
enum class About : std::uint8_t {
  fixed,     ///< it cannot be written
  value,     ///< the value it has from power-on
  change,    ///< a write that must be possible
  refusal,   ///< a write that must be refused though the entry can be written
  keeping,   ///< what was written and confirmed is there
  presence,  ///< that it is there
  type,      ///< its data type
};
[[nodiscard]] std::string rule_of(About about, Multiplexer mux);

[[nodiscard]] bool is_one_of(AbortCode code, std::initializer_list<AbortCode> codes);
/// Of a length that does not fit.
[[nodiscard]] bool is_about_length(AbortCode code);
/// Of a value that is not among those the entry takes.
[[nodiscard]] bool is_about_value(AbortCode code);
/// Confirmed where it should be refused, or refused with a code; `tolerated` ones only strain the rule.
[[nodiscard]] std::optional<Assigned> refusal(const Evidence& evidence, std::string rule,
                                              std::initializer_list<AbortCode> tolerated);
[[nodiscard]] std::string by_transfer(const Action& action, std::string otherwise);
[[nodiscard]] bool is_array_or_record(const Vocabulary& words, Index index);
[[nodiscard]] std::string missing_sub_index(const Evidence& evidence, bool reading);
/// An entry that is described, and that the device says it does not have.
[[nodiscard]] std::string rule_of_presence(const Evidence& evidence);
/// What sub-index FFh says of its object, where that is not as it should be.
[[nodiscard]] std::string wrong_structure(Multiplexer mux, ByteView value);
/// The last byte that means nothing is another one: `came` is the answer that is due but for bytes that are
/// reserved.
[[nodiscard]] bool differs_in_reserved(ByteView came, ByteView due);
/// An object that the model does not have.
[[nodiscard]] std::optional<Assigned> absent(const Evidence& evidence, bool reading);

/// Another outcome of an upload; assign_reads.cpp.
[[nodiscard]] std::optional<Assigned> assign_upload(const Evidence& evidence);

}  // namespace conform::explore
