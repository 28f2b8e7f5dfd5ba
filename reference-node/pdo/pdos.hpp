// SPDX-License-Identifier: Apache-2.0
// All PDOs of the node: as many as the dictionary has communication parameters.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>

#include "device/device.hpp"
#include "pdo/receive_pdo.hpp"
#include "pdo/transmit_pdo.hpp"

namespace refnode {

class Pdos {
 public:
  explicit Pdos(Device& device) : rpdo(device.dictionary), tpdo(device.dictionary), device_(&device) {}
  Pdos(const Pdos&) = delete;
  Pdos& operator=(const Pdos&) = delete;

  ReceivePdoTerms rpdo;
  TransmitPdoTerms tpdo;

  /// The node's own: the four RPDOs and four TPDOs of the pre-defined connection set (7.3.5).
  void add_objects();
  /// Puts the service behind every communication parameter there is.
  void bind();

  /// An object that may be mapped has a new value. The values of one RPDO change together: they are one event
  /// of a TPDO.
  void on_application_change();
  void on_frame(const Frame& frame);
  void on_remote(const Frame& frame);
  void on_sync(std::optional<std::uint8_t> counter);
  /// A reset or another state: what was buffered is gone, the TPDOs start anew.
  void on_state_change();
  void on_boot_up();
  void on_time();
  [[nodiscard]] std::optional<BusTime> next_wakeup() const { return device_->pdo_alarms.next(); }

 private:
  Device* device_;
  std::deque<ReceivePdo> receive_;  // PDOs do not move: their entries point to them
  std::deque<TransmitPdo> transmit_;
};

}  // namespace refnode
