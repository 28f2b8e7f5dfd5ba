// SPDX-License-Identifier: Apache-2.0
// `scan`: reads the dictionary of a device and writes a draft of its description.
#include <fmt/format.h>
#include <unistd.h>

#include <ctime>
#include <filesystem>

#include "base/files.hpp"
#include "base/text.hpp"
#include "can/interface_lock.hpp"
#include "can/simulated_bus.hpp"
#include "can/socketcan_transport.hpp"
#include "cli/commands/commands.hpp"
#include "cli/descriptions/draft_eds.hpp"
#include "cli/run/stop_signal.hpp"
#include "cli/run/terminal.hpp"
#include "device/profile.hpp"
#include "engine/discovery.hpp"
#include "engine/recorder.hpp"
#include "engine/run_session.hpp"
#include "engine/scan.hpp"
#include "node/node.hpp"

namespace conform::cli {
namespace {

/// Communication, manufacturer and standardised profile area; the rest is reserved or of network variables.
constexpr engine::IndexRange usual[] = {{0x1000, 0x1FFF}, {0x2000, 0x5FFF}, {0x6000, 0x9FFF}};

Result<engine::IndexRange> range_of(std::string_view text) {
  const auto range = parse_number_range(text);
  if (!range || range->high > 0xFFFF || range->low == 0)
    return fail("'" + std::string(text) + "' is no range of indices", {}, "--range 2000h..2FFFh");
  return engine::IndexRange{static_cast<std::uint16_t>(range->low), static_cast<std::uint16_t>(range->high)};
}

/// Reads through `transport` and makes the text.
Result<std::string> draft(can::Transport& transport, const ScanCommand& options,
                          std::span<const engine::IndexRange> ranges, const DraftInfo& info) {
  auto profile = device::default_profile(info.node);
  engine::Recorder recorder(transport, &stop_signal);
  engine::RunSession session(recorder, profile, device::dictionary_of(profile));
  const auto liveness = engine::probe(session, {});
  if (!liveness) return std::unexpected(liveness.error());
  if (!liveness->answers)
    return fail("node " + std::to_string(info.node.value()) + " does not answer", options.interface,
                "node-ID, bit rate, power?");
  const bool live = ::isatty(2) != 0;
  const auto progress = [&](Index index) {
    if (!live) return;
    fmt::print(stderr, "\r{} ...", to_string(index));
    std::fflush(stderr);
  };
  auto objects = engine::scan(session, ranges, progress);
  if (live) fmt::print(stderr, "\r\x1B[K");
  if (!objects) return std::unexpected(objects.error());
  std::size_t entries = 0;
  for (const auto& object : *objects) entries += object.entries.size();
  fmt::print(stderr, "{} objects with {} entries\n", objects->size(), entries);
  return draft_eds(*objects, info);
}

}  // namespace

int scan_command(const ScanCommand& options) {
  if (options.simulate == !options.interface.empty())
    return report_error(
        {"say where the device is", {}, "--interface can0 for a device, --simulate for the reference node"},
        exit_usage);
  if (!options.node && !options.simulate)
    return report_error({"the node-ID of the device is missing", {}, "--node 1..127"}, exit_usage);
  std::vector<engine::IndexRange> ranges;
  for (const auto& text : options.ranges) {
    const auto range = range_of(text);
    if (!range) return report_error(range.error(), exit_usage);
    ranges.push_back(*range);
  }
  if (ranges.empty()) ranges.assign(std::begin(usual), std::end(usual));

  DraftInfo info;
  info.node = NodeId(static_cast<std::uint8_t>(options.node.value_or(5)));
  info.file_name = options.output.empty() ? "" : std::filesystem::path(options.output).filename().string();
  Result<std::string> text = std::string();
  if (options.simulate) {
    auto node = refnode::Node::create({.node_id = info.node.value()});
    if (!node) return report_error(node.error(), exit_usage);
    can::SimulatedBus bus(can::SimulatedBus::Options{});
    bus.attach(**node, "reference node");
    text = draft(bus.transport(), options, ranges, info);
  } else {
    auto transport = can::SocketCanTransport::open(options.interface);
    if (!transport) return report_error(transport.error(), exit_environment);
    auto lock = can::InterfaceLock::take(options.interface);
    if (!lock) return report_error(lock.error(), exit_environment);
    note_stop_signals();
    info.bit_rate = (*transport)->info().bit_rate;
    info.made = std::time(nullptr);
    text = draft(**transport, options, ranges, info);
  }
  if (!text) return report_end(text.error(), exit_environment);
  if (options.output.empty()) {
    print(*text);
    return 0;
  }
  if (auto written = write_file_atomically(options.output, *text); !written)
    return report_error(written.error(), exit_environment);
  return 0;
}

}  // namespace conform::cli
