// SPDX-License-Identifier: Apache-2.0
// What all services of the node share: identity, state, time, dictionary and the way out.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <utility>

#include "base/strong.hpp"
#include "behaviour.hpp"
#include "choices.hpp"
#include "object_dictionary.hpp"
#include "outbox.hpp"

namespace refnode {

struct Device {
  explicit Device(std::uint8_t id) : node_id(id), dictionary(behaviour, choices) {}
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  std::uint8_t node_id;
  Behaviour behaviour;
  Choices choices;
  ObjectDictionary dictionary;
  Outbox outbox;
  NmtState state = NmtState::initialising;
  BusTime now{};

  /// Sends one frame of a service other than SDO.
  void send(Service service, const Frame& frame) {
    outbox.send(FilterContext{service, node_id, state, nullptr}, {Outgoing{frame, {}}}, now);
  }
};

/// The earliest of some wake-up times.
[[nodiscard]] inline std::optional<BusTime> earliest(std::initializer_list<std::optional<BusTime>> times) {
  std::optional<BusTime> first;
  for (const auto& time : times) {
    if (time && (!first || *time < *first)) first = time;
  }
  return first;
}

}  // namespace refnode
