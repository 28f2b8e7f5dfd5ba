// SPDX-License-Identifier: Apache-2.0
#include "monitor/restarts.hpp"

#include <chrono>
#include <utility>

#include "canopen/cob_id.hpp"
#include "canopen/lss.hpp"

namespace conform::monitor {
namespace {

using Subject = Observation::Subject;

// Two boot-up messages so close together, and nothing between them, are one start told twice.
constexpr Duration one_start = std::chrono::milliseconds(100);
// A boot-up message so soon after start, stop or pre-operational is taken for its effect.
constexpr Duration effect_of_order = std::chrono::milliseconds(500);

/// A download to program control (CiA 302-3): to start a program is to start the device.
bool starts_program(const can::Frame& frame) {
  return !frame.remote && frame.dlc == 8 && frame.data[0] >> 5U == 1 &&
         multiplexer_of(frame).index == Index(0x1F51);
}

/// Another node-ID by LSS (CiA 305): older slaves start with it when they leave the configuration state, and
/// so does every slave that had none.
bool changes_node_id(const can::Frame& frame) {
  return frame.dlc == 8 && frame.data[0] == static_cast<std::uint8_t>(canopen::LssCommand::configure_node_id);
}

}  // namespace

Start Starts::on_frame(const Observation& seen, const Follower& follower) {
  if (seen.subject == Subject::nmt) {
    asked_since_order_ = false;
    unanswered_ = request_open_;
  } else if (seen.subject == Subject::sdo_request) {
    asked_since_order_ = request_open_ = true;
    programmed_ = programmed_ || starts_program(seen.frame());
  } else if (seen.subject == Subject::lss_request) {
    readdressed_ = readdressed_ || changes_node_id(seen.frame());
  }
  if (!seen.from_device()) return Start::none;
  if (std::exchange(request_open_, false)) boot_up_before_.reset();
  if (!seen.boot_up()) {
    boot_up_before_.reset();
    return Start::none;
  }
  const auto out = of_boot_up(seen, follower);
  boot_up_before_ = seen.time();
  lost_ = programmed_ = readdressed_ = false;
  return out;
}

Start Starts::of_boot_up(const Observation& seen, const Follower& follower) const {
  const auto& nmt = follower.nmt();
  const auto& facts = follower.facts();
  if (nmt.booting() || (nmt.resets() > 0 && seen.time() <= nmt.reset_at() + facts.boot_time))
    return Start::due;
  if (lost_ || programmed_ || readdressed_ || !seen.heard_before) return Start::due;
  // A download may have made it restart, and so may a request that it did not answer.
  if (!asked_since_order_ && !unanswered_ && nmt.ordered_at() &&
      seen.time() <= *nmt.ordered_at() + effect_of_order)
    return Start::ordered;
  if (boot_up_before_ && seen.time() <= *boot_up_before_ + one_start) return Start::repeated;
  return Start::restart;
}

std::optional<Stimulus> stimulus_of(std::span<const can::CapturedFrame> frames, std::size_t restart,
                                    NodeId node, Duration limit) {
  const auto set = canopen::connection_set(node);
  std::optional<Stimulus> out;
  for (auto i = restart; i > 0; --i) {
    const auto& captured = frames[i - 1];
    const auto& frame = captured.frame;
    if (captured.time + limit < frames[restart].time) break;
    if (captured.direction == can::Direction::transmitted) {
      out = Stimulus{i - 1, out ? out->last : i - 1};
    } else if (frame.is_data(set.sdo_response) || frame.is_data(set.error_control) ||
               frame.is_data(set.emcy)) {
      break;
    }
  }
  return out;
}

}  // namespace conform::monitor
