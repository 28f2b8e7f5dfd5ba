// SPDX-License-Identifier: Apache-2.0
// The NMT state of the device as far as the trace settles it: what was commanded, and since when.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/time.hpp"
#include "can/frame.hpp"
#include "canopen/nmt.hpp"
#include "monitor/facts.hpp"

namespace conform::monitor {

class NmtState {
 public:
  explicit NmtState(const Facts& facts) : facts_(facts) {}

  /// The device sends a frame.
  void spoke(BusTime time);
  /// The device was asked something that it answers with `can_id`, and has answered. Who answers what came at
  /// `asked` has nothing in its queue from before that goes first on the bus: a pause let it ask and be
  /// heard.
  void answered(BusTime asked, std::uint32_t can_id);
  /// The frame that is looked at from now on.
  void look_at(std::uint32_t can_id) { goes_before_answers_ = can_id < answers_with_; }
  /// Any frame, whoever sends it: frames without a pause keep the bus from the device, or are its own queue.
  void bus_was_taken(BusTime time);
  /// A frame with the identifier 0.
  void command(const can::Frame& frame, BusTime time, std::size_t index);
  void boot_up(BusTime time);
  /// A node-ID is configured by LSS (CiA 305): a device that starts with it hears no command to the old one.
  void readdressed();
  /// A boot-up message with a node-ID that LSS gave it: it has started there.
  void moved();
  /// The device spoke T_BOOT after a reset and had sent no boot-up message: it was not reset.
  void reset_had_no_effect();
  /// Frames were lost.
  void lose_track();

  /// The state that was commanded last, from T_NMT after the command on; absent after resets, after commands
  /// that fell into the boot time, and after frames that are no proper commands.
  [[nodiscard]] std::optional<canopen::NmtState> commanded(BusTime now) const {
    return commanded_ && now > commanded_at_ + facts_.nmt_time ? commanded_ : std::nullopt;
  }
  /// The same for what the device sends at `now`.
  [[nodiscard]] std::optional<canopen::NmtState> commanded_to_sender(BusTime now) const {
    return commanded_ && is_newer(now, commanded_at_) ? commanded_ : std::nullopt;
  }
  /// Whether what the device sends at `now` was made more than T_NMT after a command: not in the queue since
  /// then, behind the segments of a block.
  [[nodiscard]] bool is_newer(BusTime now, BusTime command) const {
    return made_since(now) > command + facts_.nmt_time;
  }
  /// The earliest time at which what the device sends at `now`, the frame that is looked at, may have been
  /// made.
  [[nodiscard]] BusTime made_since(BusTime now) const {
    const auto unhindered = now <= taken_at_ + pause_of_none ? std::min(now, taken_since_) : now;
    const auto since = now <= spoke_at_ + longest_frame ? std::min(unhindered, queue_began_) : unhindered;
    return goes_before_answers_ ? std::max(since, answered_since_) : since;
  }
  /// A reset was commanded and the boot-up message has not come.
  [[nodiscard]] bool booting() const { return booting_; }
  /// ... although T_BOOT is over.
  [[nodiscard]] bool overdue(BusTime now) const { return booting_ && now > reset_at_ + facts_.boot_time; }
  [[nodiscard]] std::size_t resets() const { return resets_; }  ///< boot-up messages that may still come
  [[nodiscard]] std::optional<canopen::NmtCommand> last_reset() const { return last_reset_; }
  [[nodiscard]] BusTime reset_at() const { return reset_at_; }
  [[nodiscard]] std::size_t reset_index() const { return reset_index_; }
  /// The last command that was no reset: start, stop or pre-operational.
  [[nodiscard]] std::optional<BusTime> ordered_at() const { return ordered_at_; }

 private:
  /// Longer than a frame takes at 10 kbit/s: who has frames waiting pauses for less.
  static constexpr Duration longest_frame = std::chrono::milliseconds{15};
  /// Between frames that leave no room for another one, at 125 kbit/s and more.
  static constexpr Duration pause_of_none = std::chrono::microseconds{1200};

  Facts facts_;
  BusTime spoke_at_{}, queue_began_{};  ///< the last frame, and the first of those that came in one go
  BusTime taken_at_{}, taken_since_{};  ///< the same of all frames that left no room for another one
  BusTime answered_since_{};            ///< when the request came that was answered last
  std::uint32_t answers_with_ = 0;
  bool goes_before_answers_ = false;
  std::optional<canopen::NmtState> commanded_;
  BusTime commanded_at_{};
  std::optional<BusTime> booted_at_, ordered_at_;
  bool booting_ = false;
  bool readdressed_ = false;  ///< until the next boot-up message with the node-ID that it is known by
  bool moved_ = false;        ///< ... and it has started with the other one
  std::size_t resets_ = 0;
  std::optional<canopen::NmtCommand> last_reset_;
  BusTime reset_at_{};
  std::size_t reset_index_ = 0;
};

}  // namespace conform::monitor
