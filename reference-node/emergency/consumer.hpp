// SPDX-License-Identifier: Apache-2.0
// Emergencies of other nodes (1028h, CiA 301, 7.5.2.31): the sub-index is the node-ID of the producer.
#pragma once

#include <vector>

#include "cob-id/cob_id.hpp"
#include "device/device.hpp"

namespace refnode {

class EmergencyConsumer {
 public:
  static constexpr std::uint8_t producers = 4;  ///< the last one cannot be changed

  explicit EmergencyConsumer(Device& device) : device_(&device) {}
  EmergencyConsumer(const EmergencyConsumer&) = delete;
  EmergencyConsumer& operator=(const EmergencyConsumer&) = delete;

  CobIdRules cob_id_rules{CobIdUse::emergency_consumer};

  /// 1028h, and 2F11h that shows the latest message.
  void add_objects();
  /// Puts the rules of COB-IDs behind every entry of 1028h there is.
  void bind();

  /// Takes the message over into 2F11h; true when the frame was an emergency to be consumed.
  bool on_frame(const Frame& frame);

 private:
  Device* device_;
  std::vector<CobId> cob_ids_;
};

}  // namespace refnode
