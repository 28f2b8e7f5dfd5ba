// SPDX-License-Identifier: Apache-2.0
// What all services of the node share: identity, state, time, dictionary, the way in and out, and whom to
// tell of errors.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <utility>

#include "base/strong.hpp"
#include "device/alarms.hpp"
#include "device/errors.hpp"
#include "device/inbox.hpp"
#include "device/outbox.hpp"
#include "device/states.hpp"
#include "dictionary/object_dictionary.hpp"
#include "rules/rule.hpp"

namespace refnode {

struct Device {
  explicit Device(std::uint8_t id) : node_id(id) {}
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  std::uint8_t node_id;
  ObjectDictionary dictionary;
  Inbox inbox;
  Outbox outbox;
  Errors errors;
  Alarms pdo_alarms;  ///< event timers, deadlines and inhibit times
  Rule<bool(Service, NmtState)> works{works_in};
  /// The dictionary is that of a device description (twin.hpp): of what this node has beyond the standard
  /// nothing is there.
  bool described = false;
  NmtState state = NmtState::initialising;
  BusTime now{};

  /// The value of a time parameter. It has 16 bits; a description may give it more, but no timer needs them.
  [[nodiscard]] std::int64_t time_value(std::uint16_t index, std::uint8_t sub) const {
    constexpr std::uint64_t most = 0xFFFF'FFFF;
    return static_cast<std::int64_t>(std::min(dictionary.number(index, sub), most));
  }

  /// Whether a service works in the present state.
  [[nodiscard]] bool works_now(Service service) const { return works(service, state); }

  /// Sends one frame of a service other than SDO.
  void send(Service service, const Frame& frame) {
    outbox.send(FilterContext{service, node_id, state, nullptr}, {Outgoing{frame, {}}}, now);
  }
};

/// Makes `first` the earlier of both; a time that is missing is never.
inline void keep_earlier(std::optional<BusTime>& first, const std::optional<BusTime>& time) {
  if (time && (!first || *time < *first)) first = time;
}

/// The earliest of some wake-up times.
[[nodiscard]] inline std::optional<BusTime> earliest(std::initializer_list<std::optional<BusTime>> times) {
  std::optional<BusTime> first;
  for (const auto& time : times) keep_earlier(first, time);
  return first;
}

}  // namespace refnode
