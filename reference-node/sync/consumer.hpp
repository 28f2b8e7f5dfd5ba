// SPDX-License-Identifier: Apache-2.0
// Consumer of SYNC (1005h, 1019h; CiA 301, 7.2.5).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "cob-id/cob_id.hpp"
#include "device/device.hpp"

namespace refnode {

struct SyncChoices {
  bool wrong_length_reported = true;  ///< EMCY 8240h
  bool wrong_length_used = true;
  AbortCode counter_reserved = abort_code::invalid_value;  ///< the values 1 and 241-255 of 1019h
  AbortCode counter_locked = abort_code::device_state;     ///< a change of 1019h while 1006h is not 0
};

struct SyncConsumerRules {
  /// With an overflow value above 1 a SYNC has one byte, otherwise none.
  Rule<std::size_t(std::uint64_t overflow)> length{
      [](std::uint64_t overflow) -> std::size_t { return overflow > 1 ? 1 : 0; }};
  /// What the counter says does not matter: it is for the TPDOs that wait for their SYNC start value.
  Rule<bool(std::uint8_t counter, std::uint64_t overflow)> obeyed{
      [](std::uint8_t, std::uint64_t) { return true; }};
};

class SyncConsumer {
 public:
  explicit SyncConsumer(Device& device);
  SyncConsumer(const SyncConsumer&) = delete;
  SyncConsumer& operator=(const SyncConsumer&) = delete;

  SyncChoices choices;
  SyncConsumerRules rules;
  CobIdRules cob_id_rules{CobIdUse::sync};

  /// 1005h, 1006h, 1007h, 1019h.
  void add_objects();
  void bind();

  std::function<void(std::optional<std::uint8_t> counter)> on_sync;

  /// True when the frame was a SYNC.
  bool on_frame(const Frame& frame);

 private:
  [[nodiscard]] Accepted check_overflow(ByteView bytes) const;
  [[nodiscard]] std::uint64_t overflow() const;

  Device* device_;
  CobId cob_id_;
};

}  // namespace refnode
