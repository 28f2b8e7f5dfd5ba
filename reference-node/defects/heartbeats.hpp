// SPDX-License-Identifier: Apache-2.0
// What the tables of heartbeat defects ask of a frame and of 1016h.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "defects/hooks.hpp"

namespace refnode::defect {

using Written = std::function<void()>;

inline HeartbeatProducerRules& of_producer(Parts& parts) { return parts.producer.rules; }
inline HeartbeatConsumerRules& of_consumer(Parts& parts) { return parts.consumer.rules; }

inline bool is_heartbeat(const Frame& frame) {
  return frame.id >= 0x701 && frame.id <= 0x77F && frame.size() == 1 && !frame.extended && !frame.remote;
}
inline std::uint8_t producer_of(const Frame& frame) { return static_cast<std::uint8_t>(frame.id - 0x700U); }

inline std::uint8_t consumer_entries(const Parts& parts) {
  return static_cast<std::uint8_t>(parts.device.dictionary.number(0x1016, 0));
}
/// The node that 1016h:`sub` names, if it is monitored.
inline std::optional<std::uint8_t> node_at(Parts& parts, std::uint8_t sub) {
  const std::uint64_t entry = parts.device.dictionary.number(0x1016, sub);
  return parts.consumer.rules.used(entry) ? std::optional(monitored_node(entry)) : std::nullopt;
}

}  // namespace refnode::defect
