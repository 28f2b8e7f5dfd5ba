// SPDX-License-Identifier: Apache-2.0
// Whether anybody but the device under test and ourselves is heard on the bus.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "base/strong.hpp"
#include "can/capture.hpp"

namespace conform::engine {

/// Follows the trace. A frame is somebody else's when it came on none of the CAN-IDs that the device was ever
/// seen to hold in a valid COB-ID (by an upload, or by a download that it confirmed), nor on those that its
/// node-ID gives it. So a device whose PDOs nobody described is taken for two: that keeps commands to all
/// nodes off a bus that may have others, and not the other way round.
class Others {
 public:
  explicit Others(NodeId node);

  /// Looks at what was recorded since the last call. The first of the foreign CAN-IDs in words: "707h,
  /// first 1.2 s after the beginning", and nullopt when there is none.
  [[nodiscard]] std::optional<std::string> heard(const can::Capture& capture);

 private:
  void learn(const can::CapturedFrame& captured);
  void learn_node_id(const can::CapturedFrame& captured);
  void take(Multiplexer object, std::uint32_t cob_id);

  NodeId node_;
  std::size_t looked_at_ = 0;
  std::set<std::uint32_t> own_;               ///< CAN-IDs on which the device may send
  std::optional<NodeId> given_;               ///< by an LSS command that waits for its confirmation
  std::set<std::uint32_t> lent_;              ///< CAN-IDs of node-IDs that LSS gave the device
  std::map<std::uint32_t, BusTime> strange_;  ///< others, with the time of the first frame
  std::optional<std::pair<Multiplexer, std::uint32_t>> asked_;  ///< a download that waits for its answer
};

}  // namespace conform::engine
