// SPDX-License-Identifier: Apache-2.0
// Communication and mapping parameters of one PDO (14xxh/16xxh or 18xxh/1Axxh) and the rules for changing
// them (CiA 301, 7.5.2.35 to 7.5.2.38).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "cob-id/cob_id.hpp"
#include "device/device.hpp"
#include "pdo/terms.hpp"

namespace refnode {

inline constexpr std::uint16_t pdos_of_a_direction = 512;
/// 1400h, 1800h: the communication parameter of the first PDO.
[[nodiscard]] constexpr std::uint16_t first_communication_index(PdoDirection direction) {
  return direction == PdoDirection::receive ? 0x1400 : 0x1800;
}

/// Adds both parameters of a PDO; `number` 0 is the first one of its direction, `mapping` are the default
/// entries, of eight there can be.
void add_pdo_objects(ObjectDictionary& dictionary, PdoDirection direction, std::uint16_t number,
                     std::uint32_t cob_id, std::uint8_t node_id, const std::vector<std::uint32_t>& mapping);

class PdoParameters {
 public:
  /// Puts the rules behind the entries there are. `number` 0 is the first PDO of its direction. `terms`
  /// outlive the parameters.
  PdoParameters(Device& device, const PdoTerms& terms, std::uint16_t number);
  PdoParameters(const PdoParameters&) = delete;  // the entries point here
  PdoParameters& operator=(const PdoParameters&) = delete;

  std::function<void()> on_changed;  ///< a communication parameter or the number of mapped objects

  /// 0 is the first PDO of its direction.
  [[nodiscard]] std::uint16_t number() const { return number_; }
  [[nodiscard]] const CobId& cob_id() const { return cob_id_; }
  [[nodiscard]] std::uint8_t transmission_type() const;
  [[nodiscard]] Duration inhibit_time() const;
  [[nodiscard]] Duration event_timer() const;
  [[nodiscard]] std::uint64_t sync_start() const;

  /// The active mapping; empty when sub-index 00h is 00h, and of a multiplexed PDO.
  [[nodiscard]] std::vector<Mapped> mapping() const;
  /// Its length in bytes, at most eight.
  [[nodiscard]] std::size_t mapped_size() const;

 private:
  void bind_communication();
  void bind_mapping();
  void changed() const;
  [[nodiscard]] Accepted check_type(ByteView bytes) const;
  [[nodiscard]] Accepted check_inhibit_time(ByteView bytes) const;
  [[nodiscard]] Accepted check_sync_start(ByteView bytes) const;
  [[nodiscard]] Accepted check_mapping_count(ByteView bytes) const;
  [[nodiscard]] Accepted check_mapping_entry(std::uint8_t sub, ByteView bytes) const;
  [[nodiscard]] bool locked(PdoPart part) const;

  Device* device_;
  const PdoTerms* terms_;
  std::uint16_t number_;
  std::uint16_t communication_;  ///< index of the communication parameter
  std::uint16_t mapping_;        ///< index of the mapping parameter
  CobId cob_id_;
  std::uint8_t mapping_entries_ = 0;  ///< highest sub-index that can hold a mapped object
  bool multiplexed_ = false;          ///< described as such; its service is not known here
};

}  // namespace refnode
