// SPDX-License-Identifier: Apache-2.0
// Starts of the device that nothing on the bus asked for.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "can/capture.hpp"
#include "monitor/follower.hpp"

namespace conform::monitor {

/// What a boot-up message is to the frames before it.
enum class Start : std::uint8_t {
  none,      ///< no boot-up message
  due,       ///< a reset explains it, or nothing was heard of the device before
  repeated,  ///< of the same start as the one before
  ordered,   ///< start, stop or pre-operational was commanded right before, and nothing else
  restart,   ///< nothing explains it
};

/// Tells the starts of a device apart. What the trace leaves open is `due`.
class Starts {
 public:
  [[nodiscard]] Start on_frame(const Observation& seen, const Follower& follower);
  /// Frames were lost: the reset that explains the next boot-up message may be among them.
  void on_loss() { lost_ = true; }

 private:
  [[nodiscard]] Start of_boot_up(const Observation& seen, const Follower& follower) const;

  bool lost_ = false;
  bool asked_since_order_ = false;         ///< an SDO request came after the last NMT command
  bool unanswered_ = false;                ///< ... or was open when that came
  bool request_open_ = false;              ///< an SDO request came since the device was last heard
  bool programmed_ = false;                ///< an SDO request about program control came since the last start
  bool readdressed_ = false;               ///< LSS configured a node-ID since the last start
  std::optional<BusTime> boot_up_before_;  ///< when the last frame of the device was a boot-up message
};

/// The frames that the host sent since the device was last heard before `restart`: what it may have fallen
/// over. As capture indices [first, last]; nothing where none came within `limit`.
struct Stimulus {
  std::size_t first = 0, last = 0;
};
[[nodiscard]] std::optional<Stimulus> stimulus_of(std::span<const can::CapturedFrame> frames,
                                                  std::size_t restart, NodeId node, Duration limit);

}  // namespace conform::monitor
