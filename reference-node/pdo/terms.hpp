// SPDX-License-Identifier: Apache-2.0
// What holds for the parameters of all PDOs of a direction: which objects can be mapped, what is locked when,
// in which units times count (CiA 301, 7.5.2.35 to 7.5.2.38).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cob-id/cob_id.hpp"
#include "device/device.hpp"

namespace refnode {

class PdoParameters;

enum class PdoDirection : std::uint8_t { receive, transmit };

// Transmission types: 00h-F0h synchronous, FCh and FDh on remote request (TPDO only), FEh and FFh
// event-driven; the rest is reserved.
inline constexpr std::uint8_t remote_synchronous_type = 0xFC;
inline constexpr std::uint8_t remote_event_driven_type = 0xFD;
[[nodiscard]] constexpr bool is_synchronous(std::uint64_t type) { return type <= 0xF0; }
[[nodiscard]] constexpr bool is_event_driven(std::uint64_t type) { return type >= 0xFE; }
[[nodiscard]] constexpr bool is_on_remote_request(std::uint64_t type) {
  return type == remote_synchronous_type || type == remote_event_driven_type;
}

/// An entry of a mapping parameter.
struct Mapped {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;
  std::uint8_t bits = 0;

  [[nodiscard]] static Mapped unpack(std::uint64_t value);
};

/// Codes and freedoms of the parameters of a PDO.
struct PdoChoices {
  AbortCode inhibit_locked = abort_code::invalid_value;
  AbortCode absent_object = abort_code::no_object;
  AbortCode unmappable_object = abort_code::not_mappable;
  AbortCode wrong_length = abort_code::not_mappable;
  AbortCode too_many = abort_code::mapping_too_long;  ///< a count beyond the entries there are
  AbortCode too_long = abort_code::mapping_too_long;  ///< more than 64 bits
  AbortCode out_of_order = abort_code::unsupported_access;
  bool checked_at_count = false;  ///< what is mapped is looked at when sub-index 00h is set
  bool synchronous_types = true;  ///< 00h-F0h, of which
  bool acyclic_type = true;       ///< 00h
  std::uint8_t most_syncs = 240;  ///< and 01h up to this one
  bool event_types = true;        ///< FEh, FFh
  bool remote_types = true;       ///< TPDO: FCh, FDh
  bool needs_mapping = false;     ///< without mapped objects bit 31 stays set, whatever is written
};

/// Parts of a PDO's parameters that cannot be changed at any time.
enum class PdoPart : std::uint8_t {
  inhibit_time,
  sync_start,
  mapping,       ///< sub-index 00h of the mapping parameter
  mapped_object  ///< every other sub-index of it
};

struct PdoRules {
  /// The object exists, it can be mapped in this direction, and it has this length. An RPDO can hold data
  /// types in place of objects: room for what is meant for other devices.
  Rule<Accepted(const Mapped&)> mappable;
  /// While the PDO is valid, none of them can be changed; mapped objects neither while the mapping is
  /// enabled: the procedure is PDO not valid, sub-index 00h := 00h, then the entries.
  Rule<bool(const PdoParameters&, PdoPart, bool valid, bool enabled)> locked;
  /// Sub-index 03h counts in 100 us.
  Rule<Duration(const PdoParameters&, std::int64_t value)> inhibit_time;
  /// Sub-index 05h counts in milliseconds.
  Rule<Duration(const PdoParameters&, std::int64_t value)> event_timer;
  /// The PDO carries what the entries name that sub-index 00h counts, in their order.
  Rule<std::vector<Mapped>(const PdoParameters&, const std::vector<Mapped>& counted)> mapping;

  explicit PdoRules(Rule<Accepted(const Mapped&)>::Decision can_be_mapped);
};

struct PdoTerms {
  PdoTerms(const ObjectDictionary& dictionary, PdoDirection direction);
  PdoTerms(const PdoTerms&) = delete;
  PdoTerms& operator=(const PdoTerms&) = delete;

  PdoDirection direction;
  PdoChoices choices;
  CobIdRules cob_id_rules;
  PdoRules rules;
  /// Which of the data types 0001h to 0007h an RPDO may hold in place of objects.
  std::array<bool, 8> placeholders{false, false, true, true, true, true, true, true};
};

}  // namespace refnode
