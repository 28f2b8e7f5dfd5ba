// SPDX-License-Identifier: Apache-2.0
// `replay`: sends once more what the harness sent in a case, and tells where the answers are other ones.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "base/files.hpp"
#include "base/text.hpp"
#include "can/capture_marks.hpp"
#include "can/interface_lock.hpp"
#include "can/pcapng.hpp"
#include "can/simulated_bus.hpp"
#include "can/socketcan_transport.hpp"
#include "cli/commands/commands.hpp"
#include "cli/replay/differences.hpp"
#include "cli/replay/lss_state.hpp"
#include "cli/replay/permission.hpp"
#include "cli/replay/player.hpp"
#include "cli/replay/replay_text.hpp"
#include "cli/replay/section.hpp"
#include "cli/replay/stamps.hpp"
#include "cli/run/device_under_test.hpp"
#include "cli/run/judge.hpp"
#include "cli/run/run_reports.hpp"
#include "cli/run/shell.hpp"
#include "cli/run/stop_signal.hpp"
#include "cli/run/terminal.hpp"
#include "cli/suite_folder.hpp"
#include "node/powered_node.hpp"

namespace conform::cli {
namespace {

using Frames = std::span<const can::CapturedFrame>;

constexpr std::uint64_t largest_capture = std::uint64_t{1} << 30U;
constexpr std::uint32_t sdo_requests = 0x600, error_control = 0x700;

/// An error and the exit code it asks for.
struct Refusal {
  Error error;
  int code = exit_usage;
};

/// What is to be sent, to whom, and what came of it then.
struct Plan {
  Recording recording;
  Section section;
  KnownDevice device;
  steps::Tier allowed = steps::Tier::read_only;

  [[nodiscard]] Frames frames() const { return recording.capture.frames(); }
  [[nodiscard]] NodeId node() const { return device.profile.node; }
  [[nodiscard]] Side side() const { return {frames(), section.first, section.end, node()}; }
  /// What of the section may not be in the capture, or cannot be done as it was.
  [[nodiscard]] std::vector<std::string> notes(const Side& then) const {
    auto out = section.missing;
    if (recording.cut_off > 0 && section.end == frames().size())
      out.emplace_back("the capture ends in the middle of a frame, which is not sent");
    if (auto note = set_back_note(then); !note.empty()) out.push_back(std::move(note));
    return out;
  }
};

/// What came of it now.
struct Outcome {
  can::Capture capture;
  can::CaptureInfo info;
  Played played;
};

/// The node to whose SDO server most requests of the section went; nullopt: none did.
std::optional<NodeId> node_spoken_to(Frames frames, const Section& section) {
  std::array<std::size_t, 128> requests{};
  for (auto i = section.first; i < section.end; ++i) {
    const auto& frame = frames[i].frame;
    const bool sent = frames[i].direction == can::Direction::transmitted && !frame.remote && !frame.extended;
    if (sent && frame.id > sdo_requests && frame.id < sdo_requests + requests.size())
      ++requests.at(frame.id - sdo_requests);
  }
  const auto most = std::ranges::max_element(requests);
  if (*most == 0) return std::nullopt;
  return NodeId(static_cast<std::uint8_t>(most - requests.begin()));
}

std::optional<Error> mistake_in(const ReplayCommand& options) {
  if (options.simulate == !options.interface.empty()) return no_device_named();
  if (options.case_name.empty() == options.frames.empty())
    return Error{"say what is to be sent", {}, "--case ID as in the report, or --frames FIRST-LAST"};
  if (!options.simulate && !(options.defects.empty() && options.variants.empty()))
    return Error{"--defect and --variant belong to --simulate", {}, "on a real interface: canopen-refnode"};
  if (!options.allow.empty() && !steps::parse_tier(options.allow))
    return Error{"unknown risk tier '" + options.allow + "'", {}, "read-only, config, nvm or motion"};
  if (options.record.empty()) return std::nullopt;
  if (absolute(options.record) == absolute(options.capture))
    return Error{"the new capture would be written over the old one", options.record, {}};
  for (const auto& input : {options.device, options.eds}) {
    if (absolute(options.record) == absolute(input))
      return Error{"the new capture would be written over an input", options.record, {}};
  }
  return std::nullopt;
}

Result<Plan> plan_of(const ReplayCommand& options) {
  Plan out;
  auto content = read_file(options.capture, largest_capture);
  if (!content) return std::unexpected(content.error());
  auto recording = read_recording(*content, options.capture, {});
  if (!recording) return std::unexpected(recording.error());
  out.recording = std::move(*recording);
  auto section = options.frames.empty() ? section_of_case(out.frames(), options.case_name, options.capture)
                                        : section_of_numbers(out.frames(), options.frames, options.capture);
  if (!section) return std::unexpected(section.error());
  out.section = std::move(*section);
  const bool sends =
      std::ranges::any_of(out.frames().subspan(out.section.first, out.section.end - out.section.first),
                          [](const can::CapturedFrame& each) {
                            return each.direction == can::Direction::transmitted ||
                                   each.comment.contains(can::power_was_switched);
                          });
  if (!sends)
    return fail("nothing was sent in " + out.section.name + ", so there is nothing to replay",
                options.capture);
  auto root = find_suites(std::string());
  if (!root && options.simulate) return std::unexpected(root.error());
  const auto spoken_to = node_spoken_to(out.frames(), out.section);
  auto known =
      device_under_test({options.device, options.eds, options.node},
                        {options.simulate, options.variants, root ? *root : std::string()}, spoken_to);
  if (!known) return std::unexpected(known.error());
  out.device = std::move(*known);
  if (spoken_to && *spoken_to != out.node()) {
    return fail(fmt::format("{} speaks to node {}, and the device is node {}", out.section.name,
                            spoken_to->value(), out.node().value()),
                options.capture, "the frames go out as they are: give the device that node-ID");
  }
  return out;
}

/// What may be sent: as in `run`, everything where no machine can hang on the bus.
steps::Tier allowed_by(const ReplayCommand& options, bool is_virtual) {
  if (const auto wanted = steps::parse_tier(options.allow)) return *wanted;
  return is_virtual ? steps::Tier::motion : steps::Tier::read_only;
}

std::optional<Refusal> may_be_sent(Plan& plan, const ReplayCommand& options, bool is_virtual,
                                   bool has_power) {
  plan.allowed = allowed_by(options, is_virtual);
  auto& profile = plan.device.profile;
  profile.writes_described = plan.allowed == steps::Tier::motion && profile.safe_objects.empty();
  const auto then = plan.side();
  if (auto bounded = gaps_are_bounded(then); !bounded) return Refusal{bounded.error()};
  if (auto may = may_replay(then, profile, plan.allowed); !may) return Refusal{may.error()};
  if (auto known = lss_state_is_known(then, plan.node()); !known) return Refusal{known.error()};
  if (then.dialogue.power.empty() || has_power) return std::nullopt;
  return Refusal{{plan.section.name + " switches the power of the device",
                  {},
                  "give a device profile that says how (power_cycle)"}};
}

Result<Outcome> send_all(const Plan& plan, can::Transport& transport,
                         const std::function<Result<void>()>& power, bool boots) {
  const auto& profile = plan.device.profile;
  engine::Recorder recorder(transport, &stop_signal);
  if (boots) {
    const AnswerKind boot_up{AnswerKind::Of::reset, error_control + profile.node.value()};
    const auto booted = [&boot_up](const can::CapturedFrame& captured) {
      return is_answer(captured.frame, boot_up);
    };
    if (auto found = recorder.find(0, booted, recorder.now() + profile.boot_time); !found)
      return std::unexpected(found.error());
  }
  auto played = play(recorder, plan.side(), profile, power);
  if (!played) return std::unexpected(played.error());
  Outcome out;
  out.capture = std::move(recorder.capture());
  const auto info = transport.info();
  out.info.interface_name = info.name;
  out.info.epoch_ns = info.epoch_ns;
  out.played = *played;
  return out;
}

std::expected<Outcome, Refusal> on_simulation(Plan& plan, const ReplayCommand& options) {
  auto node = refnode::PoweredNode::create({.node_id = plan.node().value(),
                                            .defects = options.defects,
                                            .variants = options.variants,
                                            .description = plan.device.description});
  if (!node) return std::unexpected(Refusal{node.error()});
  if (auto refused = may_be_sent(plan, options, true, true)) return std::unexpected(*refused);
  can::SimulatedBus::Options bus_options;
  bus_options.seed = options.seed;
  can::SimulatedBus bus(bus_options);
  bus.attach(**node, "reference node");
  const auto power = [&bus, &node]() -> Result<void> {
    bus.unplug(**node);
    bus.attach(**node, "reference node");
    return {};
  };
  auto outcome = send_all(plan, bus.transport(), power, true);
  if (!outcome) return std::unexpected(Refusal{outcome.error(), exit_environment});
  return std::move(*outcome);
}

std::expected<Outcome, Refusal> on_interface(Plan& plan, const ReplayCommand& options) {
  auto transport = can::SocketCanTransport::open(options.interface);
  if (!transport) return std::unexpected(Refusal{transport.error(), exit_environment});
  const auto lock = can::InterfaceLock::take(options.interface);
  if (!lock) return std::unexpected(Refusal{lock.error(), exit_environment});
  const auto& switch_power = plan.device.profile.power_cycle;
  if (auto refused = may_be_sent(plan, options, (*transport)->info().is_virtual, !switch_power.empty()))
    return std::unexpected(*refused);
  note_stop_signals();
  constexpr Duration power_limit = std::chrono::seconds(60);
  auto outcome = send_all(plan, **transport, [&] { return run_shell(switch_power, power_limit); }, false);
  if (!outcome) return std::unexpected(Refusal{outcome.error(), exit_environment});
  return std::move(*outcome);
}

/// The frames of the new capture that are the device's answer to it all.
Side side_of(const Outcome& outcome, NodeId node) {
  const auto& played = outcome.played;
  Side out(outcome.capture.frames(), played.first, played.end, node);
  std::erase_if(out.dialogue.unasked, [&](std::size_t index) { return index >= played.recorded_end; });
  return out;
}

bool heard_something(const Side& side) {
  return std::ranges::any_of(side.frames.subspan(side.first, side.end - side.first),
                             [](const auto& captured) {
                               return captured.direction == can::Direction::received && !captured.frame.error;
                             });
}

}  // namespace

int replay_command(const ReplayCommand& options) {
  if (const auto mistake = mistake_in(options)) return report_error(*mistake, exit_usage);
  auto plan = plan_of(options);
  if (!plan) return report_error(plan.error(), exit_usage);
  if (!options.record.empty()) {
    // Tried before the first frame, and nothing of an earlier replay is left that looks like this one's.
    can::CaptureInfo begun;
    begun.tool = "canopen-conform " CONFORM_VERSION;
    begun.comment = "the replay has not ended";
    if (auto tried = write_file_atomically(options.record, can::write_pcapng({}, begun)); !tried)
      return report_error(tried.error(), exit_environment);
  }
  auto outcome = options.simulate ? on_simulation(*plan, options) : on_interface(*plan, options);
  if (!outcome) return report_end(outcome.error().error, outcome.error().code);
  const Side then = plan->side();
  auto notes = plan->notes(then);
  if (!options.record.empty()) {
    outcome->info.tool = "canopen-conform " CONFORM_VERSION;
    outcome->info.comment = "replay of " + plan->section.name;
    for (const auto& note : notes) outcome->info.comment += "; " + note;
    if (auto written =
            write_file_atomically(options.record, can::write_pcapng(outcome->capture, outcome->info));
        !written)
      return report_error(written.error(), exit_environment);
  }
  const Side now = side_of(*outcome, plan->node());
  if (heard_something(then) && !heard_something(now)) {
    return report_error({fmt::format("nothing was heard of node {}", plan->node().value()), options.interface,
                         "node-ID, bit rate, power?"},
                        exit_environment);
  }
  const auto comparison =
      compare_replay(then, now, plan->node(), outcome->played.skipped, outcome->played.aborts);
  if (!comparison) return report_error(comparison.error(), exit_environment);
  const reports::Style style{use_colour(options.color, 1), terminal_width(), 0};
  const auto frames = fmt::format("frames {} to {}", plan->section.first + 1, plan->section.end);
  print(fmt::format("{}{} of {}, sent to node {} on {}\n",
                    options.frames.empty() ? printable(plan->section.name) + ", " : std::string(), frames,
                    printable(options.capture), plan->node().value(),
                    printable(outcome->info.interface_name)));
  if (plan->recording.directions_inferred) {
    print(
        "the capture does not tell who sent a frame: NMT commands, SDO and LSS requests and remote frames are sent\n");
  }
  notes.insert(notes.end(), outcome->played.notes.begin(), outcome->played.notes.end());
  for (const auto& note : notes) print("note: " + note + "\n");
  print(replay_text(*comparison, then, now, style, options.quiet));
  print(replay_summary(*comparison) + "\n");
  if (!comparison->compares_something()) return exit_environment;
  return comparison->differs() ? 1 : 0;
}

}  // namespace conform::cli
