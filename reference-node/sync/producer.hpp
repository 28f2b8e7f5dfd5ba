// SPDX-License-Identifier: Apache-2.0
// Producer of SYNC (CiA 301, 7.2.5): bit 30 of 1005h switches it on, 1006h is its period, 1019h says whether
// it counts. It works in Pre-operational and Operational.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "cob-id/cob_id.hpp"
#include "device/device.hpp"
#include "device/raster.hpp"

namespace refnode {

struct SyncProducerChoices {
  bool first_at_once = false;    ///< the first SYNC when production begins, not a period later
  bool due_sync_stays = false;   ///< a new period counts from the next SYNC on, if that is not further away
  std::uint32_t resolution = 1;  ///< in microseconds: periods that are no multiple of it are refused
  AbortCode not_a_multiple = abort_code::invalid_value;
  std::uint32_t shortest = 0;  ///< in microseconds: shorter periods than this are refused, 0 aside
  AbortCode too_short = abort_code::value_too_low;
  std::uint32_t longest = 0xFFFFFFFF;  ///< in microseconds
  AbortCode too_long = abort_code::value_too_high;
  int jitter_percent = 0;  ///< late and early by turns
};

/// What makes production begin.
enum class SyncStart : std::uint8_t { bit_set, period_set, left_stopped, boot_up };

struct SyncProducerRules {
  /// 1006h counts in microseconds.
  Rule<Duration(std::int64_t value)> period;
  /// From the beginning of production to the first SYNC.
  Rule<Duration(Duration period)> first_after;
  /// While SYNC is produced a write of 1006h is the period from then on: the next SYNC is due within it.
  Rule<Duration(Duration present, Duration written)> new_period;
  Rule<BusTime(BusTime due, BusTime within_new_period)> due_after_change;
  /// The counter behind `last`, which is 0 before the first SYNC: 1 to the overflow value, and 1 again.
  Rule<std::uint8_t(std::uint8_t last, std::uint8_t overflow)> next_count;
  /// Counting begins with 1 whenever production begins (7.2.5.2.2, 7.5.2.5, 7.5.2.6).
  Rule<bool(SyncStart)> counts_anew;
  SyncProducerRules();
};

class SyncProducer {
 public:
  /// `cob_id_rules`: those of the consumer, with which it shares 1005h.
  SyncProducer(Device& device, const CobIdRules& cob_id_rules);
  SyncProducer(const SyncProducer&) = delete;
  SyncProducer& operator=(const SyncProducer&) = delete;

  SyncProducerChoices choices;
  SyncProducerRules rules;

  void bind();
  std::function<void(std::optional<std::uint8_t> counter)> on_sync;  ///< one has been sent

  void on_reset();
  void on_boot_up();
  void on_state_change(NmtState from);
  void on_time();
  [[nodiscard]] std::optional<BusTime> next_wakeup() const { return raster_.next(); }

 private:
  [[nodiscard]] Accepted check_period(ByteView bytes) const;
  /// Begins, goes on or ends, as 1005h, 1006h and the NMT state have it.
  void update(SyncStart occasion);
  void set_period(Duration written);
  void transmit();

  Device* device_;
  CobId cob_id_;
  Duration period_{};
  Raster raster_;
  std::uint8_t count_ = 0;  ///< of the last SYNC
};

}  // namespace refnode
