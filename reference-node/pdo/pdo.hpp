// SPDX-License-Identifier: Apache-2.0
// Traffic of one RPDO, of one TPDO (CiA 301, 7.2.2): in Operational only.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "device/device.hpp"
#include "pdo/parameters.hpp"

namespace refnode {

class ReceivePdo {
 public:
  /// `number` 0 is that of 1400h.
  ReceivePdo(Device& device, const CobIdRules& cob_id_rules, std::uint16_t number);

  std::function<void()> on_applied;  ///< all mapped objects of a PDO have their new values

  [[nodiscard]] bool applying() const { return applying_; }
  /// True when the frame carries this PDO.
  bool on_frame(const Frame& frame);
  void on_sync();
  /// Buffered data and the deadline end with a state change or reset.
  void on_state_change();
  void on_time();
  [[nodiscard]] std::optional<BusTime> next_wakeup() const { return deadline_; }

 private:
  void apply(const Bytes& data);
  [[nodiscard]] ErrorCause cause(std::uint16_t code) const {
    return {code, ErrorSource::rpdo, static_cast<std::uint16_t>(number_ + 1)};
  }

  Device* device_;
  std::uint16_t number_;
  PdoParameters parameters_;
  bool applying_ = false;
  std::optional<Bytes> buffered_;    ///< synchronous types: waiting for the SYNC
  std::optional<BusTime> deadline_;  ///< event timer, armed by the first RPDO
};

class TransmitPdo {
 public:
  /// `number` 0 is that of 1800h.
  TransmitPdo(Device& device, const CobIdRules& cob_id_rules, std::uint16_t number);

  /// Something mapped may have changed.
  void on_application_change();
  /// `counter`: of a SYNC that has one.
  void on_sync(std::optional<std::uint8_t> counter);
  /// True when the remote frame asks for this PDO.
  bool on_remote(const Frame& frame);
  void on_state_change();
  void on_time();
  [[nodiscard]] std::optional<BusTime> next_wakeup() const;

 private:
  [[nodiscard]] Bytes content() const;
  [[nodiscard]] bool event_driven() const { return parameters_.transmission_type() >= 0xFE; }
  [[nodiscard]] bool enabled() const;
  void transmit(const Bytes& data);
  void start_event_timer();
  void restart();

  Device* device_;
  PdoParameters parameters_;
  Bytes reported_;             ///< content of the last TPDO, or at the start of Operational
  Bytes sampled_;              ///< type FCh: content at the last SYNC
  bool event_ = false;         ///< type 00h, or an event waiting for the inhibit time
  std::uint32_t syncs_ = 0;    ///< SYNCs since the last TPDO
  bool awaits_start_ = false;  ///< for the SYNC whose counter is the SYNC start value
  std::optional<BusTime> timer_;
  std::optional<BusTime> inhibited_until_;
};

}  // namespace refnode
