// SPDX-License-Identifier: Apache-2.0
// What a frame means, in the words of the console and of capture comments, seen from the bus of one device under test.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "base/strong.hpp"
#include "can/frame.hpp"
#include "can/transport.hpp"

namespace conform::canopen {

/// Fed with all frames in order; keeps only what is needed to name segments (the open SDO transfer).
class Decoder {
 public:
  explicit Decoder(NodeId node);

  /// "SDO upload request 1003h:00", "heartbeat of node 5: pre-operational", "CAN-ID 6A0h: 01 02"; never empty.
  [[nodiscard]] std::string meaning(const can::Frame& frame, can::Direction direction);

  /// COB-IDs that were moved away from the pre-defined connection set; nullopt: the service is switched off.
  void set_emcy_can_id(std::optional<CanId> id);
  void set_sync_can_id(std::optional<CanId> id);
  void set_time_can_id(std::optional<CanId> id);
  /// `number` 1..512.
  void set_tpdo_can_id(int number, std::optional<CanId> id);
  void set_rpdo_can_id(int number, std::optional<CanId> id);
  /// Back to the pre-defined connection set (after a reset of the device).
  void reset();

 private:
  [[nodiscard]] std::string sdo_request(const can::Frame& frame);
  [[nodiscard]] std::string sdo_response(const can::Frame& frame);
  [[nodiscard]] std::string by_service(const can::Frame& frame);

  NodeId node_;
  std::optional<CanId> emcy_, sync_, time_;
  std::map<int, CanId> tpdo_, rpdo_;
  std::optional<Multiplexer> open_;  ///< object of the running SDO transfer
};

}  // namespace conform::canopen
