// SPDX-License-Identifier: Apache-2.0
// `lss-scan`: which LSS slaves without node-ID are on the bus, and node-IDs for them.
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <vector>

#include "base/text.hpp"
#include "can/interface_lock.hpp"
#include "can/simulated_bus.hpp"
#include "can/socketcan_transport.hpp"
#include "cli/commands/commands.hpp"
#include "cli/run/stop_signal.hpp"
#include "cli/run/terminal.hpp"
#include "engine/lss_survey.hpp"
#include "engine/recorder.hpp"
#include "node/node.hpp"
#include "parts/parts.hpp"

namespace conform::cli {
namespace {

Result<void> survey(can::Transport& transport, const LssScanCommand& options) {
  engine::Recorder recorder(transport, &stop_signal);
  const Duration timeout = std::chrono::milliseconds(options.timeout_ms);
  const auto found = engine::find_unconfigured(recorder, {.timeout = timeout});
  if (!found) return std::unexpected(found.error());
  print(found->empty()       ? std::string("no LSS slave without node-ID\n")
        : found->size() == 1 ? std::string("1 LSS slave without node-ID\n")
                             : fmt::format("{} LSS slaves without node-ID\n", found->size()));
  auto node = options.assign.value_or(0);
  for (const auto& address : *found) {
    auto line = fmt::format("vendor {}, product {}, revision {}, serial {}", hex(address[0], 8),
                            hex(address[1], 8), hex(address[2], 8), hex(address[3], 8));
    if (options.assign) {
      if (node > 127) return fail("there is no node-ID left for it: " + line);
      if (auto given =
              engine::give_node_id(recorder, address, NodeId(static_cast<std::uint8_t>(node)), timeout);
          !given)
        return std::unexpected(given.error());
      line += fmt::format(": node-ID {}", node++);
    }
    print(line + "\n");
  }
  return {};
}

/// Reference nodes without node-ID, with the serial numbers from 1 on.
Result<void> survey_simulated(const LssScanCommand& options) {
  can::SimulatedBus bus;
  std::vector<std::unique_ptr<refnode::Node>> nodes;
  for (std::uint32_t serial = 1; serial <= options.simulate; ++serial) {
    auto node = refnode::Node::create({.node_id = 255, .adjust = [serial](refnode::Parts& parts) {
                                         parts.device.dictionary.set_number(0x1018, 4, serial);
                                       }});
    if (!node) return std::unexpected(node.error());
    nodes.push_back(std::move(*node));
    bus.attach(*nodes.back(), fmt::format("reference node {}", serial));
  }
  return survey(bus.transport(), options);
}

Result<void> survey_interface(const LssScanCommand& options) {
  auto transport = can::SocketCanTransport::open(options.interface);
  if (!transport) return std::unexpected(transport.error());
  auto lock = can::InterfaceLock::take(options.interface);
  if (!lock) return std::unexpected(lock.error());
  note_stop_signals();
  return survey(**transport, options);
}

}  // namespace

int lss_scan_command(const LssScanCommand& options) {
  if ((options.simulate > 0) == !options.interface.empty())
    return report_error({"say where the slaves are",
                         {},
                         "--interface can0 for a bus, --simulate NUMBER for so many reference nodes"},
                        exit_usage);
  const auto done = options.simulate > 0 ? survey_simulated(options) : survey_interface(options);
  return done ? 0 : report_end(done.error(), exit_environment);
}

}  // namespace conform::cli
