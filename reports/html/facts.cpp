// SPDX-License-Identifier: Apache-2.0
#include "reports/html/facts.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "reports/text_tools.hpp"

namespace conform::reports::html {
namespace {

using result::RunResult;

struct Label {
  std::string_view name, shown;
};
/// Properties by the names under which a reader knows them; others keep the names they have.
constexpr std::array labels{
    Label{"dut.node_id", "Node-ID"},
    Label{"dut.device_type", "Device type (1000h)"},
    Label{"dut.vendor_id", "Vendor-ID (1018h:01)"},
    Label{"dut.product_code", "Product code (1018h:02)"},
    Label{"dut.revision", "Revision (1018h:03)"},
    Label{"dut.serial", "Serial number (1018h:04)"},
    Label{"dut.name", "Device name (1008h)"},
    Label{"dut.hardware_version", "Hardware version (1009h)"},
    Label{"dut.software_version", "Software version (100Ah)"},
    Label{"dut.description", "Device description"},
    Label{"dut.description_digest", "SHA-256 of the description"},
    Label{"input.claims", "Features claimed"},
    Label{"input.profile", "Device profile, SHA-256"},
    Label{"input.waivers", "Waivers, SHA-256"},
    Label{"input.recording", "Recorded trace, SHA-256"},
    Label{"bundle.inputs", "SHA-256 of all that it was made of"},
    Label{"can.interface", "Interface"},
    Label{"can.driver", "Adapter, driver"},
    Label{"can.bit_rate", "Bit rate (bit/s)"},
    Label{"can.driver_version", "Version of the driver"},
    Label{"can.firmware", "Firmware of the adapter"},
    Label{"can.adapter", "Place of the adapter"},
    Label{"can.sample_point", "Sample point"},
    Label{"can.stamps", "Time stamps"},
    Label{"can.transmit_queue", "Transmit queue (frames)"},
    Label{"can.receive_buffer", "Receive buffer (bytes)"},
    Label{"can.state", "Controller before the run"},
    Label{"health.state", "Controller after the run"},
    Label{"health.error_frames", "Error frames"},
    Label{"health.frames_lost", "Frames that the host lost"},
    Label{"health.bus_offs", "Times bus-off"},
    Label{"health.full_transmit_queue", "Waits for the transmit queue"},
    Label{"health.late_frames", "Frames looked at late"},
    Label{"health.worst_lateness", "Latest look at a frame"},
    Label{"host.kernel", "Kernel of the host"},
    Label{"suite.digest", "Digest of the suite"},
    Label{"suite.own", "Own scenarios"},
    Label{"run.seed", "Seed"},
    Label{"run.shuffle", "Order of the cases drawn by"},
    Label{"run.allowed", "Highest risk allowed"},
    Label{"run.command", "Command"},
    Label{"simulation.defects", "Defects simulated"},
    Label{"simulation.variants", "Variants simulated"},
};

/// Where it stands: the device first, then the bus, then what was asked for; what is no property last.
std::ptrdiff_t rank(const std::string& name) {
  constexpr std::array<std::string_view, 8> order{"dut.",        "eds.", "can.",   "health.",
                                                  "simulation.", "run.", "suite.", "host."};
  const bool is_property = name.find('.') != std::string::npos;
  return std::ranges::find_if(order, [&](auto front) { return name.starts_with(front); }) - order.begin() +
         (is_property ? 0 : 1);
}

}  // namespace

std::vector<Fact> facts_of(const RunResult& run) {
  std::vector<Fact> out;
  for (const auto& property : run.properties) {
    const auto known = std::ranges::find(labels, property.name, &Label::name);
    const std::string label =
        known == labels.end() ? clip(prose(property.name), 100) : std::string(known->shown);
    out.push_back({property.name, label, property.value});
  }
  std::ranges::stable_sort(out, {}, [](const Fact& each) { return rank(each.name); });
  const bool simulated = run.started_utc_ns == 0;
  out.push_back({"tool", "Tool", run.tool});
  out.push_back({"host", "Host", run.host});
  out.push_back(
      {"started", "Started", simulated ? "simulation, on virtual time" : utc_timestamp(run.started_utc_ns)});
  out.push_back({"elapsed", "Bus time", brief_duration(run.elapsed)});
  out.push_back({"exit_code", "Exit code", std::to_string(result::exit_code(run))});
  return out;
}

std::vector<FactPair> facts_of(const RunResult& before, const RunResult& after) {
  std::vector<FactPair> out;
  for (auto& each : facts_of(before))
    out.push_back({std::move(each.name), std::move(each.label), std::move(each.value), {}});
  for (auto& each : facts_of(after)) {
    const auto found = std::ranges::find(out, each.name, &FactPair::name);
    if (found != out.end()) {
      found->after = std::move(each.value);
    } else {
      out.push_back({std::move(each.name), std::move(each.label), {}, std::move(each.value)});
    }
  }
  std::ranges::stable_sort(out, {}, [](const FactPair& each) { return rank(each.name); });
  return out;
}

}  // namespace conform::reports::html
