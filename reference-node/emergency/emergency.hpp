// SPDX-License-Identifier: Apache-2.0
// Errors of the device: the error register 1001h and the EMCY producer (1014h, 1015h), CiA 301, 7.2.7 and
// 7.5.2.2. What services tell of errors comes here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "cob-id/cob_id.hpp"
#include "device/device.hpp"
#include "emergency/history.hpp"

namespace refnode {

struct EmergencyChoices {
  bool register_generic_only = false;  ///< no other bit than 0
  bool error_reset_for_each = false;   ///< EMCY 0000h also while other errors remain
  bool dropped_in_stopped = false;     ///< not made up for afterwards
  /// The error register of an EMCY and the upper half of its field in 1003h are those of that moment.
  bool completed_when_sent = false;
  /// An EMCY more than so many is lost, which is an error of its own; 0: never.
  std::size_t overflow_told_from = 0;
  bool only_signalled_recorded = false;  ///< in 1003h: nothing of Stopped, or where 1014h is not valid
  bool error_resets_recorded = false;    ///< EMCY 0000h has its field in 1003h, too
  bool inhibited_from_setting = false;   ///< the first EMCY waits, too, from boot-up or the write of 1015h on
  Duration error_reset_delay{};          ///< EMCY 0000h waits so long, or until the next error
};

/// What may happen while an EMCY waits for the inhibit time.
enum class WhileWaiting : std::uint8_t {
  state_change,
  inhibit_time_written,
  reset_communication,
  reset_node
};

struct EmergencyRules {
  /// Table 54: the bits of the error register that an error sets.
  Rule<std::uint8_t(std::uint16_t code)> register_bits;
  /// 1015h counts in 100 us.
  Rule<Duration(std::int64_t value)> inhibit_time;
  /// 7.3.2.2.5: of the EMCYs of Stopped only the latest is made up for, if any.
  Rule<bool()> only_latest_of_stopped;
  /// 7.5.2.18: what waits is sent in the end; a reset begins with nothing (7.3.2.2).
  Rule<bool(WhileWaiting)> kept_waiting;
  /// 7.2.7.1: what waits is sent in the order in which it happened, the end of the errors behind them.
  Rule<bool()> oldest_first;
  EmergencyRules();
};

class Emergency {
 public:
  /// From now on `device.errors` leads here.
  explicit Emergency(Device& device);
  Emergency(const Emergency&) = delete;
  Emergency& operator=(const Emergency&) = delete;

  EmergencyChoices choices;
  EmergencyRules rules;
  CobIdRules cob_id_rules{CobIdUse::emergency};
  ErrorHistory history;

  /// 1001h, 1003h, 1014h, 1015h.
  void add_objects();
  /// Puts the service behind those of these objects that exist.
  void bind();

  /// The value of 1001h.
  [[nodiscard]] std::uint8_t error_register() const;
  [[nodiscard]] const std::vector<ErrorCause>& active() const { return causes_; }

  /// Communication (and, with reset node, all) causes and everything unsent are forgotten.
  void on_reset(bool whole_node);
  void on_state_change();
  /// The boot-up message has been sent.
  void on_boot_up() { begin_inhibiting(); }
  void on_time();
  [[nodiscard]] std::optional<BusTime> next_wakeup() const;

 private:
  struct Message {
    std::uint16_t code;
    std::uint8_t error_register;
    std::uint8_t detail;
    ErrorSource source;
    BusTime due{};  ///< not before, unless another message follows
  };
  void raise(const ErrorCause& cause, std::uint8_t detail);
  void clear(const ErrorCause& cause);
  void record(std::uint16_t code, ErrorSource source, std::uint8_t detail);
  void report(const Message& message);
  void flush();
  [[nodiscard]] bool full() const;
  void tell_of_overflow();
  [[nodiscard]] std::optional<BusTime> waits_until() const;
  void begin_inhibiting();
  void keep_or_drop(WhileWaiting occasion);
  void transmit(const Message& message);
  [[nodiscard]] Duration inhibit_time() const;

  Device* device_;
  CobId cob_id_;
  std::vector<ErrorCause> causes_;
  std::deque<Message> pending_;  ///< waiting for the inhibit time or for the end of Stopped
  std::optional<BusTime> inhibited_until_;
  bool reported_ = false;  ///< the bus has heard of an error since the last error reset
  bool lost_ = false;      ///< an EMCY, and nobody has been told so far
};

}  // namespace refnode
