// SPDX-License-Identifier: Apache-2.0
#include "cli/run/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>

#include "base/text.hpp"
#include "base/text_bytes.hpp"
#include "can/candump_log.hpp"
#include "can/capture_marks.hpp"
#include "can/pcapng.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/decode.hpp"
#include "canopen/nmt.hpp"
#include "engine/monitor_cases.hpp"
#include "monitor/stopwatch.hpp"
#include "reports/text_tools.hpp"
#include "steps/timing.hpp"

namespace conform::cli {
namespace {

using can::Direction;

/// By the pre-defined connection set: what only clients and masters send. Everything else may be the
/// device's.
bool is_sent_to_devices(const can::Frame& frame) {
  if (frame.remote) return true;
  if (frame.extended) return false;
  return frame.id == 0 || (frame.id >= 0x600 && frame.id <= 0x67F) ||
         frame.id == canopen::lss_request_can_id.value();
}

/// What can only come from that node.
std::size_t frames_of(NodeId node, std::span<const can::CapturedFrame> frames) {
  const auto set = canopen::connection_set(node);
  return static_cast<std::size_t>(std::ranges::count_if(frames, [&](const can::CapturedFrame& each) {
    return each.direction == Direction::received &&
           (each.frame.is_data(set.sdo_response) || each.frame.is_data(set.error_control));
  }));
}

/// Where a file does not tell who sent what, the host may have sent in the name of the node, as tests of
/// heartbeat consumers do. What answers can only be the node: an SDO or guarding request, or a reset.
bool answers_in(std::span<const can::CapturedFrame> frames, const device::Profile& profile) {
  const auto set = canopen::connection_set(profile.node);
  std::optional<BusTime> asked, guarded, reset;
  const auto soon = [](std::optional<BusTime> since, BusTime now, Duration limit) {
    return since && now <= *since + limit;
  };
  return std::ranges::any_of(frames, [&](const can::CapturedFrame& each) {
    const auto& frame = each.frame;
    if (frame.error || frame.extended) return false;
    if (frame.is_data(set.sdo_request)) asked = each.time;
    if (frame.remote && frame.id == set.error_control.value()) guarded = each.time;
    if (frame.id == 0 && frame.size() == 2 && frame.data[0] >= 0x81 && frame.data[1] == profile.node.value())
      reset = each.time;
    if (frame.is_data(set.sdo_response)) return soon(asked, each.time, profile.server_timeout);
    if (!frame.is_data(set.error_control)) return false;
    return soon(guarded, each.time, steps::guard_patience(profile.nmt_time)) ||
           (canopen::is_boot_up(frame, profile.node) && soon(reset, each.time, profile.boot_time));
  });
}

/// "; heard were the nodes 1, 3"
std::string others_in(std::span<const can::CapturedFrame> frames) {
  std::vector<std::string> heard;
  for (std::uint8_t node = 1; node <= 127 && heard.size() < 8; ++node) {
    if (frames_of(NodeId(node), frames) > 0) heard.push_back(std::to_string(node));
  }
  if (heard.empty()) return "";
  return (heard.size() == 1 ? "; heard was node " : "; heard were the nodes ") + join(heard, ", ");
}

/// Where the capture says that the power of the device was switched.
std::vector<monitor::Loss> switches_of_power(std::span<const can::CapturedFrame> frames) {
  std::vector<monitor::Loss> out;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].comment.contains(can::power_was_switched)) out.push_back({i, i});
  }
  return out;
}

Recording with_directions(can::LoadedCapture loaded) {
  Recording out;
  out.info = std::move(loaded.info);
  out.cut_off = loaded.cut_off;
  const auto& frames = loaded.capture.frames();
  const bool marked = std::ranges::any_of(
      frames, [](const can::CapturedFrame& each) { return each.direction == Direction::transmitted; });
  if (marked) {
    out.capture = std::move(loaded.capture);
    return out;
  }
  out.directions_inferred = true;
  for (auto frame : frames) {
    if (!frame.frame.error && is_sent_to_devices(frame.frame)) frame.direction = Direction::transmitted;
    out.capture.add(std::move(frame));
  }
  return out;
}

}  // namespace

Result<Recording> read_recording(std::string_view content, const std::string& where, std::string_view only) {
  if (content.empty()) return fail("the file is empty", where, "a pcapng file or a candump log (candump -l)");
  constexpr std::string_view section_header = "\x0A\x0D\x0D\x0A";
  if (content.starts_with(section_header)) {
    auto loaded = can::read_pcapng(bytes_of(content), where, only);
    if (!loaded) return std::unexpected(loaded.error());
    return with_directions(std::move(*loaded));
  }
  for (const std::string_view magic :
       {"\xD4\xC3\xB2\xA1", "\xA1\xB2\xC3\xD4", "\x4D\x3C\xB2\xA1", "\xA1\xB2\x3C\x4D"}) {
    if (content.starts_with(magic))
      return fail("this is a pcap file of the old format", where, "editcap -F pcapng OLD NEW converts it");
  }
  auto loaded = can::read_candump_log(content, where, only);
  if (!loaded) return std::unexpected(loaded.error());
  return with_directions(std::move(*loaded));
}

result::RunResult judge(const Recording& recording, const device::Profile& profile,
                        const scenario::Catalogue& catalogue, const JudgeOptions& options) {
  result::RunResult out;
  out.device = profile.name.empty() ? "node " + std::to_string(profile.node.value()) : profile.name;
  const auto& frames = recording.capture.frames();
  if (!frames.empty()) out.elapsed = frames.back().time - frames.front().time;
  const auto chosen = engine::chosen_monitors(options.selection, catalogue);
  engine::plan_monitors(chosen, catalogue, out);
  engine::describe_requirements(catalogue, out);
  out.properties.push_back({"dut.node_id", std::to_string(profile.node.value())});
  out.properties.push_back({"capture.frames", std::to_string(frames.size())});
  const auto set = canopen::connection_set(profile.node);
  out.properties.push_back({"capture.frames_of_device", std::to_string(frames_of(profile.node, frames))});
  out.properties.push_back(
      {"capture.directions", recording.directions_inferred ? "inferred from CAN-IDs" : "as recorded"});
  if (recording.directions_inferred) {
    out.notes.push_back(fmt::format(
        "the capture does not tell who sent a frame: NMT commands, SDO requests and remote frames are taken as sent to the "
        "device, {} and {} as sent by it",
        to_string(set.sdo_response), to_string(set.error_control)));
  }
  if (recording.cut_off > 0) {
    out.notes.push_back(fmt::format("the capture ends in the middle of a frame: its last {} are left out",
                                    reports::counted(recording.cut_off, "byte")));
  }
  if (frames_of(profile.node, frames) == 0) {
    out.aborted = fmt::format("nothing was heard of node {}{}", profile.node.value(), others_in(frames));
    return out;
  }
  engine::Waivers waivers(profile.waivers, catalogue, options.today);
  auto facts = engine::facts_of(profile);
  facts.senders_are_known = !recording.directions_inferred;
  engine::judge_trace(frames, {chosen, profile, catalogue, waivers, options.strict}, facts,
                      switches_of_power(frames), out);
  out.measurements = monitor::measure(frames, facts, switches_of_power(frames));
  out.load = monitor::load_of(frames, 0);
  if (recording.directions_inferred && !answers_in(frames, profile)) {
    const auto why = fmt::format(
        "nothing shows that node {} itself was there: no frame answers a request, and the capture does not tell who sent",
        profile.node.value());
    engine::withdraw_all(out.cases, why);
    out.notes.push_back(why + "; candump -x and pcapng files tell it");
  }
  return out;
}

}  // namespace conform::cli
