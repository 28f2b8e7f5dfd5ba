// SPDX-License-Identifier: Apache-2.0
#include "cli/doctor/diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "base/text.hpp"
#include "canopen/nmt.hpp"

namespace conform::cli {
namespace {

using Kind = Advice::Kind;

constexpr std::uint32_t short_queue = 100;

std::string rate_of(const can::InterfaceFacts& facts) {
  if (facts.bit_rate == 0) return {};
  std::string out = facts.bit_rate % 1000 == 0 ? fmt::format("{} kbit/s", facts.bit_rate / 1000)
                                               : fmt::format("{} bit/s", facts.bit_rate);
  if (facts.sample_point > 0)
    out += fmt::format(", sample point {}.{} %", facts.sample_point / 10, facts.sample_point % 10);
  return out;
}

std::string other_rate_command(const can::InterfaceFacts& facts) {
  return fmt::format("sudo ip link set {0} down && sudo ip link set {0} up type can bitrate {1}", facts.name,
                     facts.bit_rate == 125000 ? 500000 : 125000);
}

std::string state_word(std::uint8_t state) {
  const auto known = canopen::nmt_state_at(state);
  return known ? std::string(canopen::to_string(*known))
               : fmt::format("state {:02X}h, which there is not", state);
}

}  // namespace

std::vector<Advice> about_interface(const can::InterfaceFacts& facts) {
  std::vector<Advice> out;
  const auto rate = rate_of(facts);
  out.push_back({Kind::good, "up, " + (rate.empty() ? "" : rate + ", ") + "driver " + facts.driver, {}});
  if (!facts.routed_to.empty())
    out.push_back({Kind::note, "a gateway passes frames on to " + facts.routed_to,
                   "what is sent here reaches a real bus: --allow says how far a run may go"});
  if (!facts.state.empty()) {
    const bool well = facts.state == "error-active";
    out.push_back({well ? Kind::good : Kind::note, "the controller is " + facts.state,
                   well ? std::string() : "errors are or were frequent: wiring, termination, bit rate?"});
  }
  if (!facts.is_virtual && facts.queue_length > 0 && facts.queue_length < short_queue)
    out.push_back({Kind::note, fmt::format("the transmit queue holds {} frames", facts.queue_length),
                   fmt::format("sudo ip link set {} txqueuelen 1000", facts.name)});
  if (!facts.echo && !facts.is_virtual)
    out.push_back({Kind::note, "the driver returns own frames before they were on the bus",
                   "times that begin with a frame of ours are too long by its wait for the bus"});
  return out;
}

std::vector<Advice> about_bus(const can::InterfaceFacts& facts, const Heard& heard, bool asked) {
  std::vector<Advice> out;
  if (heard.bus_off > 0)
    out.push_back({Kind::bad, "the controller went bus-off",
                   "check wiring, termination and bit rate, then: sudo ip link set " + facts.name +
                       " type can restart"});
  if (heard.not_acknowledged > 0)
    out.push_back(
        {Kind::bad, "nobody acknowledges what is sent",
         "no other node is on the bus, or none has power, or all have another bit rate, or a wire is open"});
  if (heard.violated > 0 && heard.frames == 0) {
    out.push_back(
        {Kind::bad, fmt::format("{} frames were destroyed and none was right", heard.violated),
         facts.bit_rate == 0 ? "wiring, termination?" : "another bit rate? " + other_rate_command(facts)});
  } else if (heard.violated > 0) {
    out.push_back(
        {Kind::bad,
         fmt::format("{} of {} frames were destroyed", heard.violated, heard.violated + heard.frames),
         "termination at both ends (60 ohm between CAN-H and CAN-L), a node with another bit rate or sample "
         "point, stubs too long?"});
  }
  if (heard.frames == 0 && !heard.is_disturbed()) {
    out.push_back(
        {asked ? Kind::bad : Kind::note,
         fmt::format("nothing was heard for {}{}",
                     to_string(std::chrono::floor<std::chrono::milliseconds>(heard.listened)),
                     asked ? ", and nobody answered" : ""),
         asked ? "power, wiring, bit rate, node-ID? A device without node-ID: canopen-conform lss-scan"
               : "a device may be silent until it is asked: doctor --ask reads 1000h of every node-ID"});
  }
  if (heard.nmt_commands + heard.guard_requests + heard.lss_requests + heard.sdo_requests > 0) {
    std::vector<std::string> what;
    if (heard.nmt_commands > 0) what.push_back(fmt::format("NMT commands ({})", heard.nmt_commands));
    if (heard.sdo_requests > 0) what.push_back(fmt::format("SDO requests ({})", heard.sdo_requests));
    if (heard.guard_requests > 0) what.push_back(fmt::format("guard requests ({})", heard.guard_requests));
    if (heard.lss_requests > 0) what.push_back(fmt::format("LSS requests ({})", heard.lss_requests));
    out.push_back({Kind::note, "a master or another tool is on the bus: " + join(what, ", "),
                   "it and a run would disturb each other: stop it for the run"});
  }
  if (heard.syncs > 0)
    out.push_back({Kind::note, fmt::format("somebody produces SYNC ({} heard)", heard.syncs), {}});
  if (heard.times > 0)
    out.push_back({Kind::note, fmt::format("somebody produces TIME ({} heard)", heard.times), {}});
  if (heard.others > 0)
    out.push_back(
        {Kind::note,
         fmt::format("{} frames belong to no service of the pre-defined connection set", heard.others),
         {}});
  return out;
}

std::vector<std::string> node_lines(const Heard& heard) {
  std::vector<std::string> out;
  for (const auto& [number, node] : heard.nodes) {
    std::vector<std::string> what;
    if (node.boot_ups > 0) what.push_back("boot-up message");
    if (node.state)
      what.push_back((node.longest_period ? "heartbeat each " + to_string(*node.longest_period) + ", " : "") +
                     state_word(*node.state));
    if (node.emcys > 0) what.emplace_back("EMCY");
    if (node.pdos > 0) what.emplace_back("PDOs");
    if (node.device_type) {
      what.push_back("1000h = " + hex(*node.device_type, 8));
    } else if (node.answers) {
      what.emplace_back("SDO responses");
    }
    out.push_back(fmt::format("node {:<4} {}", number, join(what, "; ")));
  }
  return out;
}

bool is_usable(const std::vector<Advice>& advice) {
  return std::ranges::none_of(advice, [](const Advice& each) { return each.kind == Kind::bad; });
}

}  // namespace conform::cli
