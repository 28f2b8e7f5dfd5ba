// SPDX-License-Identifier: Apache-2.0
// Errors of the device: the error register 1001h, the EMCY producer (1014h, 1015h) and the history 1003h
// (CiA 301, 7.2.7, 7.5.2.2, 7.5.2.4).
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "cob-id/cob_id_rules.hpp"
#include "device/device.hpp"

namespace refnode {

/// What is wrong, by whom it was found, and which one of several alike.
struct ErrorCause {
  std::uint16_t code = 0;
  std::uint8_t source = 0;
  std::uint16_t instance = 0;
  friend bool operator==(const ErrorCause&, const ErrorCause&) = default;
};

class Emergency {
 public:
  static constexpr std::uint8_t application_source = 0;
  static constexpr std::uint8_t heartbeat_source = 1;
  static constexpr std::uint8_t rpdo_source = 2;
  static constexpr std::uint8_t sync_source = 3;
  static constexpr std::uint8_t guarding_source = 4;
  static constexpr std::uint8_t history_depth = 8;

  explicit Emergency(Device& device);

  /// 1001h, 1003h, 1014h, 1015h.
  void add_objects();
  /// Puts the service behind those of these objects that exist.
  void bind();

  /// Whether a code belongs to a class of CiA 301, table 26.
  [[nodiscard]] static bool known_class(std::uint16_t code);

  /// Nothing happens when the cause is active already. `detail` is the first manufacturer byte and, with the
  /// source, the upper half of the history entry.
  void raise(const ErrorCause& cause, std::uint8_t detail = 0);
  void clear(const ErrorCause& cause);
  /// All causes of this source; nullopt: of every source.
  void clear_all(std::optional<std::uint8_t> source);
  [[nodiscard]] std::uint8_t error_register() const;
  [[nodiscard]] std::size_t active() const { return causes_.size(); }

  // 1003h
  [[nodiscard]] std::uint8_t recorded() const;
  [[nodiscard]] Upload read_history(std::uint8_t sub) const;
  [[nodiscard]] Accepted write_history_count(ByteView bytes);

  /// Communication (and, with reset node, all) causes and everything unsent are forgotten.
  void on_reset(bool whole_node);
  void on_state_change();
  void on_time();
  [[nodiscard]] std::optional<BusTime> next_wakeup() const;

 private:
  struct Message {
    std::uint16_t code;
    std::uint8_t error_register;
    std::uint8_t detail;
    std::uint8_t source;
  };
  void record(std::uint16_t code, std::uint8_t source, std::uint8_t detail);
  void report(const Message& message);
  void flush();
  void transmit(const Message& message);
  [[nodiscard]] Duration inhibit_time() const;

  Device* device_;
  CobIdRules cob_id_;
  std::vector<ErrorCause> causes_;
  std::deque<std::uint32_t> history_;  ///< newest first
  std::deque<Message> pending_;        ///< waiting for the inhibit time or for the end of Stopped
  std::optional<BusTime> inhibited_until_;
  bool raised_ = false;    ///< since power-on; used by a defect only
  bool reported_ = false;  ///< the bus has heard of an error since the last error reset
};

}  // namespace refnode
