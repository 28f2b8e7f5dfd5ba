// SPDX-License-Identifier: Apache-2.0
// Traffic of one RPDO (CiA 301, 7.2.2): in Operational only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "device/device.hpp"
#include "pdo/parameters.hpp"

namespace refnode {

struct ReceivePdoChoices {
  bool too_long_reported = false;  ///< EMCY 8220h
  bool judged_at_sync = false;     ///< the length of a synchronous one, with the SYNC
};

struct ReceivePdoRules {
  /// Bit 31 of the COB-ID says whether the PDO exists and is used.
  Rule<bool(const PdoParameters&)> valid;
  /// With fewer bytes than are mapped the PDO is not processed, of more bytes the first are used (7.5.2.36).
  Rule<bool(const PdoParameters&, std::size_t received, std::size_t mapped)> processed;
  /// Data of the types 00h to F0h become valid with the next SYNC, those of the others at once.
  Rule<bool(const PdoParameters&)> waits_for_sync;
  /// Of several before one SYNC the last one counts. `waiting`: what came before, if anything.
  Rule<Bytes(const PdoParameters&, const std::optional<Bytes>& waiting, const Bytes& received)> kept_for_sync;
  /// With the SYNC the mapped objects get what their PDO brought.
  Rule<Bytes(const PdoParameters&, const Bytes& waiting)> taken_at_sync;
  /// Every synchronous type waits for one SYNC, whatever its number. `syncs`: since the data came.
  Rule<bool(const PdoParameters&, std::uint32_t syncs)> due_at_sync;
  /// The deadline is watched from the first RPDO on, not from the start of Operational.
  Rule<bool(const PdoParameters&)> watched_from_start;
  ReceivePdoRules();
};

/// What holds for all RPDOs.
struct ReceivePdoTerms {
  explicit ReceivePdoTerms(const ObjectDictionary& dictionary)
      : parameters(dictionary, PdoDirection::receive) {}

  PdoTerms parameters;
  ReceivePdoChoices choices;
  ReceivePdoRules rules;
  /// Whether a synchronous RPDO that comes now is in the synchronous window (1007h).
  std::function<bool()> in_window{[] { return true; }};
};

class ReceivePdo {
 public:
  /// `number` 0 is that of 1400h. `terms` outlive the PDO.
  ReceivePdo(Device& device, const ReceivePdoTerms& terms, std::uint16_t number);

  std::function<void()> on_applied;  ///< all mapped objects of a PDO have their new values

  [[nodiscard]] bool applying() const { return applying_; }
  /// True when the frame carries this PDO.
  bool on_frame(const Frame& frame);
  void on_sync();
  /// Buffered data and the deadline end with a state change or reset.
  void on_state_change();
  void on_time();

 private:
  void apply(const Bytes& data);
  void judge_length(std::size_t received);
  /// The communication parameters or the mapping have changed.
  void forget();
  void start_deadline();
  [[nodiscard]] ErrorCause cause(std::uint16_t code) const {
    return {code, ErrorSource::rpdo, static_cast<std::uint16_t>(number_ + 1)};
  }

  Device* device_;
  const ReceivePdoTerms* terms_;
  std::uint16_t number_;
  PdoParameters parameters_;
  bool applying_ = false;
  std::optional<Bytes> buffered_;        ///< synchronous types: waiting for the SYNC
  std::uint32_t syncs_ = 0;              ///< since then
  std::optional<std::size_t> unjudged_;  ///< length of what came last, to be judged with the SYNC
  Alarms::Alarm deadline_;               ///< event timer, armed by the first RPDO
};

}  // namespace refnode
