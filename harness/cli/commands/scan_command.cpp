// SPDX-License-Identifier: Apache-2.0
// `scan`: reads the dictionary of a device, and writes a draft of its description or compares it with one.
#include <fmt/format.h>
#include <unistd.h>

#include <ctime>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/files.hpp"
#include "base/text.hpp"
#include "can/interface_lock.hpp"
#include "can/simulated_bus.hpp"
#include "can/socketcan_transport.hpp"
#include "cli/commands/commands.hpp"
#include "cli/descriptions/draft_eds.hpp"
#include "cli/descriptions/scan_compare.hpp"
#include "cli/first_contact/scan_ranges.hpp"
#include "cli/run/stop_signal.hpp"
#include "cli/run/terminal.hpp"
#include "device/description.hpp"
#include "device/profile.hpp"
#include "eds/read.hpp"
#include "engine/discovery.hpp"
#include "engine/recorder.hpp"
#include "engine/run_session.hpp"
#include "engine/scan.hpp"
#include "node/node.hpp"
#include "steps/tier.hpp"

namespace conform::cli {
namespace {

/// The description to compare with.
struct Compared {
  eds::EdsFile file;
  device::Description description;
};

Result<Compared> compared_with(const std::string& path) {
  auto file = eds::read_file(path);
  if (!file) return std::unexpected(file.error());
  auto description = device::describe(*file);
  if (!description) return std::unexpected(description.error());
  return Compared{std::move(*file), std::move(*description)};
}

Result<std::vector<engine::ScannedObject>> scan(can::Transport& transport, const ScanCommand& options,
                                                engine::ScanOptions& what, NodeId node) {
  auto profile = device::default_profile(node);
  engine::Recorder recorder(transport, &stop_signal);
  engine::RunSession session(recorder, profile, device::dictionary_of(profile));
  const auto liveness = engine::probe(session, {});
  if (!liveness) return std::unexpected(liveness.error());
  if (!liveness->answers)
    return fail("node " + std::to_string(node.value()) + " does not answer", options.interface,
                "node-ID, bit rate, power?");
  const bool live = ::isatty(2) != 0;
  what.progress = [live](Index index) {
    if (!live) return;
    fmt::print(stderr, "\r{} ...", to_string(index));
    std::fflush(stderr);
  };
  auto objects = engine::scan(session, what);
  if (live) fmt::print(stderr, "\r\x1B[K");
  if (!objects) return std::unexpected(objects.error());
  std::size_t entries = 0;
  for (const auto& object : *objects) entries += object.entries.size();
  fmt::print(stderr, "{} objects with {} entries\n", objects->size(), entries);
  return objects;
}

Result<std::unique_ptr<refnode::Node>> simulated_node(const std::string& twin, NodeId node_id) {
  refnode::Options options{.node_id = node_id.value()};
  if (!twin.empty()) {
    auto file = eds::read_file(twin);
    if (!file) return std::unexpected(file.error());
    options.description = std::make_shared<const eds::EdsFile>(std::move(*file));
  }
  return refnode::Node::create(std::move(options));
}

}  // namespace

int scan_command(const ScanCommand& options) {
  if (options.simulate == !options.interface.empty()) return report_error(no_device_named(), exit_usage);
  if (!options.node && !options.simulate)
    return report_error({"the node-ID of the device is missing", {}, "--node 1..127"}, exit_usage);
  engine::ScanOptions what;
  auto ranges = scan_ranges(options.ranges);
  if (!ranges) return report_error(ranges.error(), exit_usage);
  what.ranges = std::move(*ranges);
  what.allow = steps::parse_tier(options.allow).value_or(steps::Tier::read_only);

  std::optional<Compared> compared;
  if (!options.compare.empty()) {
    auto read = compared_with(options.compare);
    if (!read) return report_error(read.error(), exit_usage);
    compared = std::move(*read);
    what.skip = not_to_be_scanned(compared->description);
    what.also = to_be_scanned(compared->description, what.ranges);
  }

  DraftInfo info;
  info.node = NodeId(static_cast<std::uint8_t>(options.node.value_or(5)));
  info.file_name = options.output.empty() ? "" : std::filesystem::path(options.output).filename().string();
  info.access_tried = what.allow > steps::Tier::read_only;
  Result<std::vector<engine::ScannedObject>> objects;
  if (options.simulate) {
    auto node = simulated_node(options.twin, info.node);
    if (!node) return report_error(node.error(), exit_usage);
    can::SimulatedBus bus(can::SimulatedBus::Options{});
    bus.attach(**node, "reference node");
    info.bit_rate = bus.transport().info().bit_rate;
    objects = scan(bus.transport(), options, what, info.node);
  } else {
    auto transport = can::SocketCanTransport::open(options.interface);
    if (!transport) return report_error(transport.error(), exit_environment);
    auto lock = can::InterfaceLock::take(options.interface);
    if (!lock) return report_error(lock.error(), exit_environment);
    note_stop_signals();
    info.bit_rate = (*transport)->info().bit_rate;
    info.made = std::time(nullptr);
    objects = scan(**transport, options, what, info.node);
  }
  if (!objects) return report_end(objects.error(), exit_environment);
  if (!options.output.empty()) {
    if (auto written = write_file_atomically(options.output, draft_eds(*objects, info)); !written)
      return report_error(written.error(), exit_environment);
  } else if (!compared) {
    print(draft_eds(*objects, info));
  }
  if (!compared) return 0;
  const auto differences = compare_scan(*objects, what, compared->file, compared->description, info.node);
  print(options.format == "json" ? scan_differences_json(differences, options.compare)
                                 : scan_differences_text(differences));
  return differences.empty() ? 0 : 1;
}

}  // namespace conform::cli
