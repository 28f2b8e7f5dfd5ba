// SPDX-License-Identifier: Apache-2.0
// What a model cannot know of a real device: its inputs, its clock, which values its application takes. None
// of that is held against it.
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <span>

#include "base/strong.hpp"
#include "can/frame.hpp"
#include "explore/side.hpp"

namespace conform::explore {

class OwnAffairs {
 public:
  /// `entries`: whose values they are; empty: nothing is the device's own affair. `cob_ids`: of its TPDOs and
  /// of TIME, beside the pre-defined ones.
  OwnAffairs(const std::function<bool(Multiplexer)>& entries, NodeId node,
             std::span<const std::uint32_t> cob_ids);

  /// An action that may give a TPDO or TIME another CAN-ID.
  void note(const Action& action);
  /// Whether the two answers differ by nothing else.
  [[nodiscard]] bool excuse(const Action& action, const Answer& device, const Answer& model) const;
  /// Two EMCYs that differ by nothing but what is the manufacturer's (bytes 3 to 7; 7.2.7.3.1).
  [[nodiscard]] bool excuse(const can::Frame& device, const can::Frame& model) const;
  /// A TPDO or TIME: what it holds, and when an event sends it.
  [[nodiscard]] bool hold(const can::Frame& frame) const;

 private:
  void may_use(std::uint32_t cob_id);

  const std::function<bool(Multiplexer)>& entries_;
  std::set<std::uint32_t> can_ids_;       ///< with the format in bit 29
  std::set<std::uint32_t> emcy_can_ids_;  ///< alike
};

}  // namespace conform::explore
