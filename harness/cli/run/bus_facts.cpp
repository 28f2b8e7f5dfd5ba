// SPDX-License-Identifier: Apache-2.0
#include "cli/run/bus_facts.hpp"

#include <sys/utsname.h>

#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "can/adapter.hpp"
#include "can/socketcan_interface.hpp"

namespace conform::cli {
namespace {

using Properties = std::vector<result::Property>;

void add(Properties& to, const char* name, std::string value) {
  if (!value.empty()) to.push_back({name, std::move(value)});
}

/// "error-active, 0 transmit and 0 receive errors"; empty where there is no controller.
std::string state_of(const can::InterfaceFacts& facts) {
  if (facts.state.empty()) return {};
  if (!facts.errors) return facts.state;
  return fmt::format("{}, error counters: transmit {}, receive {}", facts.state, facts.errors->transmit,
                     facts.errors->receive);
}

}  // namespace

Properties bus_properties(const can::TransportInfo& info) {
  Properties out;
  add(out, "can.interface", info.name);
  add(out, "can.driver", info.driver);
  const auto adapter = can::adapter_facts(info.name);
  add(out, "can.driver_version", adapter.version);
  add(out, "can.firmware", adapter.firmware);
  add(out, "can.adapter", adapter.bus);
  if (info.bit_rate > 0) add(out, "can.bit_rate", std::to_string(info.bit_rate));
  const auto facts = can::interface_facts(info.name);
  if (facts && facts->sample_point > 0)
    add(out, "can.sample_point", fmt::format("{}.{} %", facts->sample_point / 10, facts->sample_point % 10));
  add(out, "can.stamps",
      fmt::format("kernel, own frames {} they were on the bus{}",
                  info.confirms_transmission ? "after" : "before",
                  adapter.has_hardware_clock ? "; the adapter's clock is not used" : ""));
  if (facts && facts->queue_length > 0) add(out, "can.transmit_queue", std::to_string(facts->queue_length));
  add(out, "can.receive_buffer", std::to_string(info.receive_buffer));
  if (facts) add(out, "can.state", state_of(*facts));
  return out;
}

Properties health_properties(const can::TransportInfo& info, const can::BusHealth& health) {
  Properties out;
  if (const auto facts = can::interface_facts(info.name)) add(out, "health.state", state_of(*facts));
  add(out, "health.error_frames", std::to_string(health.error_frames));
  add(out, "health.frames_lost", std::to_string(health.frames_dropped));
  add(out, "health.bus_offs", std::to_string(health.bus_offs));
  add(out, "health.full_transmit_queue", std::to_string(health.transmit_retries));
  add(out, "health.late_frames", std::to_string(health.late_frames));
  add(out, "health.worst_lateness", to_string(health.worst_lateness));
  return out;
}

Properties host_properties() {
  Properties out;
  utsname host{};
  if (::uname(&host) == 0)
    add(out, "host.kernel", fmt::format("{} {} {}", host.sysname, host.release, host.machine));
  return out;
}

}  // namespace conform::cli
