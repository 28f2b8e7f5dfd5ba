// SPDX-License-Identifier: Apache-2.0
// `init`: writes a device profile to begin with, from a first look at the device.
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "base/files.hpp"
#include "base/shell_word.hpp"
#include "base/text.hpp"
#include "can/interface_lock.hpp"
#include "can/simulated_bus.hpp"
#include "can/socketcan_transport.hpp"
#include "cli/commands/commands.hpp"
#include "cli/doctor/heard.hpp"
#include "cli/first_contact/acquaintance.hpp"
#include "cli/first_contact/claims.hpp"
#include "cli/first_contact/profile_text.hpp"
#include "cli/first_contact/scan_ranges.hpp"
#include "cli/run/stop_signal.hpp"
#include "cli/run/terminal.hpp"
#include "device/profile.hpp"
#include "engine/recorder.hpp"
#include "engine/run_session.hpp"
#include "node/node.hpp"

namespace conform::cli {
namespace {

constexpr NodeId simulated_node{5};

/// The only node that is there; reads only.
Result<NodeId> only_node(can::Transport& transport, const std::string& interface) {
  constexpr Duration answer_time = std::chrono::milliseconds(50);
  Heard heard;
  if (auto done = ask_everybody(transport, answer_time, stop_signal, heard); !done)
    return std::unexpected(done.error());
  std::vector<std::string> ids;
  for (const auto& [id, node] : heard.nodes) {
    if (node.answers) ids.push_back(std::to_string(id));
  }
  if (ids.size() == 1) return NodeId(static_cast<std::uint8_t>(std::stoul(ids.front())));
  if (ids.empty())
    return fail("no device answers", interface, "canopen-conform doctor -i " + interface + " tells why");
  return fail("several devices answer: " + join(ids, ", "), interface, "--node " + ids.front());
}

Result<Acquaintance> look(can::Transport& transport, NodeId node, FirstLook how) {
  const auto profile = device::default_profile(node);
  engine::Recorder recorder(transport, &stop_signal);
  engine::RunSession session(recorder, profile, device::dictionary_of(profile));
  session.allow(how.allow);
  const bool live = ::isatty(2) != 0;
  how.progress = [live](Index index) {
    if (!live) return;
    fmt::print(stderr, "\r{} ...", to_string(index));
    std::fflush(stderr);
  };
  auto out = get_to_know(session, how);
  if (live) fmt::print(stderr, "\r\x1B[K");
  return out;
}

Result<Acquaintance> look_at_simulated(NodeId node_id, const FirstLook& how) {
  auto node = refnode::Node::create({.node_id = node_id.value()});
  if (!node) return std::unexpected(node.error());
  can::SimulatedBus bus(can::SimulatedBus::Options{});
  bus.attach(**node, "reference node");
  return look(bus.transport(), node_id, how);
}

void tell(const Acquaintance& device, const InitCommand& options, bool reset) {
  std::size_t entries = 0;
  for (const auto& object : device.objects) entries += object.entries.size();
  const auto claims = claims_of(device);
  std::string out =
      fmt::format("{}: node {}, {} objects with {} entries, {} features claimed\n", options.output,
                  device.node.value(), device.objects.size(), entries, claims.shown.size());
  if (reset) {
    out += device.boot_time
               ? fmt::format("boot-up message {} after a reset; the device is in Pre-operational now\n",
                             to_string(*device.boot_time))
               : std::string(
                     "no boot-up message came after a reset within 15 s: boot_time is to be filled in\n");
  }
  const auto where = options.output == "device.yaml" && !options.simulate
                         ? std::string()
                         : " --device " + shell_word(options.output);
  out += fmt::format("\nA first run, which only reads\n  canopen-conform run{}{} --allow read-only\n",
                     options.simulate ? " --simulate" : "", where);
  print(out);
}

}  // namespace

int init_command(const InitCommand& options) {
  if (options.simulate == !options.interface.empty()) return report_error(no_device_named(), exit_usage);
  const bool to_stdout = options.output == "-";
  std::error_code ignored;
  if (!to_stdout && !options.force && std::filesystem::exists(options.output, ignored))
    return report_error(
        {"there is a file already", options.output, "--force writes over it, -o FILE another"}, exit_usage);
  FirstLook how;
  auto ranges = scan_ranges(options.ranges);
  if (!ranges) return report_error(ranges.error(), exit_usage);
  how.ranges = std::move(*ranges);
  how.allow = steps::parse_tier(options.allow).value_or(steps::Tier::read_only);

  std::optional<NodeId> node;
  if (options.node) node = NodeId(static_cast<std::uint8_t>(*options.node));
  Result<Acquaintance> device;
  ProfileWords words;
  if (options.simulate) {
    words.how = "of the reference node on a simulated bus";
    device = look_at_simulated(node.value_or(simulated_node), how);
  } else {
    auto transport = can::SocketCanTransport::open(options.interface);
    if (!transport) return report_error(transport.error(), exit_environment);
    auto lock = can::InterfaceLock::take(options.interface);
    if (!lock) return report_error(lock.error(), exit_environment);
    note_stop_signals();
    words.interface = options.interface;
    words.how = "on " + options.interface;
    if (!node) {
      auto found = only_node(**transport, options.interface);
      if (!found) return report_end(found.error(), exit_environment);
      node = *found;
    }
    device = look(**transport, *node, how);
  }
  if (!device) return report_end(device.error(), exit_environment);
  const bool reset = how.allow >= steps::Tier::config;
  words.how += reset ? "; the device was reset for it" : "; nothing was written to the device";
  const auto text = profile_text(*device, words);
  if (to_stdout) {
    print(text);
    return 0;
  }
  if (auto written = write_file_atomically(options.output, text); !written)
    return report_error(written.error(), exit_environment);
  tell(*device, options, reset);
  return 0;
}

}  // namespace conform::cli
