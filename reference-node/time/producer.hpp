// SPDX-License-Identifier: Apache-2.0
// Producer of TIME (1012h bit 30; CiA 301, 7.2.6): the time of day of a clock that runs from power-on and
// goes on from a time that was received. It works in Pre-operational and Operational.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "cob-id/cob_id.hpp"
#include "device/device.hpp"
#include "device/raster.hpp"

namespace refnode {

/// TIME_OF_DAY (7.1.6.5).
struct TimeOfDay {
  std::uint32_t milliseconds = 0;  ///< after midnight
  std::uint16_t days = 0;          ///< since 1984-01-01
};

struct TimeProducerChoices {
  Duration period = std::chrono::milliseconds(200);  ///< CiA 301 has no object for it
  bool first_at_once = false;                        ///< the first message when bit 30 is set
  bool goes_on_from_received = true;                 ///< a TIME message that is consumed sets the clock
  /// The time of day at which a clock that is not kept begins, with every production anew.
  std::optional<std::chrono::milliseconds> begins_at{};
};

struct TimeProducerRules {
  /// The time of day, so long after midnight of day 0.
  Rule<TimeOfDay(std::chrono::milliseconds since_epoch)> time_of_day;
  TimeProducerRules();
};

class TimeProducer {
 public:
  /// `cob_id_rules`: those of the consumer, with which it shares 1012h.
  TimeProducer(Device& device, const CobIdRules& cob_id_rules);
  TimeProducer(const TimeProducer&) = delete;
  TimeProducer& operator=(const TimeProducer&) = delete;

  TimeProducerChoices choices;
  TimeProducerRules rules;

  void bind();
  /// A TIME message has been consumed.
  void set_clock(TimeOfDay time);

  void on_reset() { raster_.stop(); }
  /// Boot-up or another NMT state.
  void update();
  void on_time();
  [[nodiscard]] std::optional<BusTime> next_wakeup() const { return raster_.next(); }

 private:
  void transmit();

  Device* device_;
  CobId cob_id_;
  std::chrono::milliseconds set_to_;  ///< after midnight of day 0
  BusTime set_at_{};
  Raster raster_;
};

}  // namespace refnode
