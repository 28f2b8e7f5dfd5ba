// SPDX-License-Identifier: Apache-2.0
// Whether an interface sends what it takes. Without IFF_ECHO own frames come back before they were on the
// bus, and an adapter that stands still would leave a device blamed for what it was never asked. What such an
// interface has sent its counters tell.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/time.hpp"

namespace conform::can {

class TransmitWatch {
 public:
  /// `statistics`: the folder of the interface's counters, /sys/class/net/can0/statistics.
  explicit TransmitWatch(std::string statistics);

  /// A frame was handed over.
  void took(BusTime now);
  /// When to look whether what was handed over has left; nullopt: nothing is known to wait.
  [[nodiscard]] std::optional<BusTime> next_look() const;
  /// True: a frame has waited for longer than host_is_late, and still did at the look before.
  [[nodiscard]] bool stands_still(BusTime now);
  /// What waited is gone, as behind an outage.
  void forget();

 private:
  /// Frames that have left the interface, in whichever way; nullopt: it does not tell.
  [[nodiscard]] std::optional<std::uint64_t> gone() const;

  std::string statistics_;
  std::uint64_t taken_ = 0;  ///< what the counters show when everything that was handed over has left
  std::optional<std::uint64_t>
      waiting_;  ///< what they show when the frame has left that next_look() is about
  BusTime waits_since_{};
  /// As the first look found it that saw a frame wait too long.
  struct Standing {
    std::uint64_t gone, taken;
  };
  std::optional<Standing> standing_;
};

}  // namespace conform::can
