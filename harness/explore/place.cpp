// SPDX-License-Identifier: Apache-2.0
#include "explore/place.hpp"

#include <chrono>
#include <utility>

namespace conform::explore {
namespace {

can::SimulatedBus::Options options_of(std::uint64_t seed) {
  can::SimulatedBus::Options out;
  out.seed = seed;
  return out;
}

}  // namespace

SimulatedPlace::SimulatedPlace(std::unique_ptr<can::Participant> device, std::uint64_t seed)
    : device_(std::move(device)), bus_(options_of(seed)) {}

Result<void> SimulatedPlace::start() {
  bus_.attach(*device_, "device");
  return {};
}

Result<void> SimulatedPlace::switch_power() {
  bus_.unplug(*device_);
  bus_.attach(*device_, "device");
  return {};
}

Duration SimulatedPlace::longest_boot() const { return std::chrono::milliseconds(5500); }

}  // namespace conform::explore
