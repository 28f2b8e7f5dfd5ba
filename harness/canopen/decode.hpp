// SPDX-License-Identifier: Apache-2.0
// What a frame means, in the words of the console and of capture comments, seen from the bus of one device
// under test.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "base/strong.hpp"
#include "can/frame.hpp"
#include "can/transport.hpp"
#include "canopen/sdo_listener.hpp"

namespace conform::canopen {

/// Fed with all frames in order; keeps only what is needed to name segments (the open SDO transfer).
class Decoder {
 public:
  explicit Decoder(NodeId node);

  /// "SDO upload request 1003h:00", "heartbeat of node 5: pre-operational", "TPDO 1", "CAN-ID 6A0h"; never
  /// empty. `direction` is seen from the harness: what it sends with an identifier of the device is named as
  /// such.
  [[nodiscard]] std::string meaning(const can::Frame& frame, can::Direction direction);

  /// COB-IDs that were moved away from the pre-defined connection set; nullopt: the service is switched off.
  void set_emcy_can_id(std::optional<CanId> id) { emcy_ = id; }
  void set_sync_can_id(std::optional<CanId> id) { sync_ = id; }
  void set_time_can_id(std::optional<CanId> id) { time_ = id; }
  /// `number` 1..512.
  void set_tpdo_can_id(int number, std::optional<CanId> id);
  void set_rpdo_can_id(int number, std::optional<CanId> id);
  /// Back to the pre-defined connection set (after a reset of the device).
  void reset();

 private:
  [[nodiscard]] std::string remote(CanId id) const;
  [[nodiscard]] std::optional<std::string> from_device(const can::Frame& frame, CanId id);

  NodeId node_;
  std::optional<CanId> emcy_, sync_, time_;
  std::map<int, CanId> tpdo_, rpdo_;
  SdoListener sdo_;
};

}  // namespace conform::canopen
