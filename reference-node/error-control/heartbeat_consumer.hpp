// SPDX-License-Identifier: Apache-2.0
// Heartbeat consumer (1016h; CiA 301, 7.2.8.3.2.2 and 7.5.2.19): whether other nodes are there.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "device/device.hpp"

namespace refnode {

/// What the boot-up message of a monitored node is to the consumer.
enum class BootUpOfProducer : std::uint8_t { heartbeat, new_start, loss };

struct HeartbeatConsumerChoices {
  BootUpOfProducer boot_up = BootUpOfProducer::heartbeat;
  AbortCode duplicate = abort_code::parameter_incompatible;  ///< a second entry for one node
  AbortCode reserved_bits = abort_code::invalid_value;
  std::optional<AbortCode> no_node;    ///< a node-ID that does not exist; nullopt: the entry is unused
  bool reserved_bits_cleared = false;  ///< taken, and read back as 00h
  bool errors_end_together = false;    ///< when the nodes of all entries that are used have been heard
};

// An entry of 1016h: bits 31-24 reserved, 23-16 node-ID, 15-0 heartbeat time.
[[nodiscard]] constexpr std::uint8_t monitored_node(std::uint64_t entry) {
  return static_cast<std::uint8_t>((entry >> 16U) & 0xFFU);
}
[[nodiscard]] constexpr std::int64_t monitored_time(std::uint64_t entry) {
  return static_cast<std::int64_t>(entry & 0xFFFFU);
}

struct HeartbeatConsumerRules {
  /// With time 0, and with a node-ID that no node can have, an entry is not used.
  Rule<bool(std::uint64_t entry)> used{[](std::uint64_t entry) {
    return monitored_time(entry) != 0 && monitored_node(entry) >= 1 && monitored_node(entry) <= 127;
  }};
  /// The heartbeat time counts in milliseconds.
  Rule<Duration(std::int64_t value)> time{
      [](std::int64_t value) -> Duration { return std::chrono::milliseconds(value); }};
  /// Behind a reset the monitoring waits for a heartbeat again.
  Rule<bool()> ends_with_reset{[] { return true; }};
  /// Whatever is written to an entry, what ran by its former value is over.
  Rule<bool(std::uint64_t entry)> ends_with_write{[](std::uint64_t) { return true; }};
};

class HeartbeatConsumer {
 public:
  explicit HeartbeatConsumer(Device& device) : device_(&device) {}
  HeartbeatConsumer(const HeartbeatConsumer&) = delete;
  HeartbeatConsumer& operator=(const HeartbeatConsumer&) = delete;

  HeartbeatConsumerChoices choices;
  HeartbeatConsumerRules rules;

  std::function<void()> on_loss;  ///< error behaviour: what the node does when a producer is lost

  /// 1016h
  void add_objects();
  /// Puts the service behind the entries of 1016h: as many nodes as there are can be monitored.
  void bind();

  /// Whether 1016h:`sub` may take this value.
  [[nodiscard]] Accepted check(std::uint8_t sub, ByteView bytes) const;
  /// 1016h:`sub` has been written: its monitoring starts anew with the next heartbeat.
  void on_written(std::uint8_t sub);
  void on_reset();
  /// A data frame of one byte on 701h..77Fh.
  void on_heartbeat(std::uint8_t node, std::uint8_t state);
  void on_time();
  /// When the node of 1016h:`sub` counts as lost. Empty until its first heartbeat, and after a loss.
  [[nodiscard]] std::optional<BusTime> due(std::uint8_t sub) const { return watches_[sub - 1U].due; }
  [[nodiscard]] std::optional<BusTime> next_wakeup() const;

 private:
  struct Watch {
    std::optional<BusTime> due;
    bool lost = false;
  };
  void lose(std::uint8_t sub);
  /// Ends the errors of losses, if each node that is monitored is there.
  void end_together();
  [[nodiscard]] std::uint8_t entries() const { return static_cast<std::uint8_t>(watches_.size()); }
  [[nodiscard]] std::uint64_t value_of(std::uint8_t sub) const {
    return device_->dictionary.number(0x1016, sub);
  }

  Device* device_;
  std::vector<Watch> watches_;  ///< of 1016h:01 and so on
};

}  // namespace refnode
