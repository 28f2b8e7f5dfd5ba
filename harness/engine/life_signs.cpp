// SPDX-License-Identifier: Apache-2.0
#include "engine/life_signs.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "canopen/cob_id.hpp"
#include "canopen/nmt.hpp"
#include "engine/run_session.hpp"

namespace conform::engine {
namespace {

/// Twice within the shortest time that scenarios let a device watch for, 100 ms.
constexpr Duration often = std::chrono::milliseconds(40);
/// Eight nodes are watched at most; on a slow bus their heartbeats are not to take all of it.
constexpr Duration for_each_node = std::chrono::milliseconds(20);

bool has_changed(const RunSession& session, Index index) {
  return std::ranges::any_of(session.journal(),
                             [index](const Change& change) { return change.object.index == index; });
}

/// The last right one of each node that the case has played.
std::map<NodeId, can::Frame> heartbeats_of_case(const RunSession& session) {
  std::map<NodeId, can::Frame> out;
  const auto& frames = session.capture().frames();
  for (auto i = session.first_frame(); i < frames.size(); ++i) {
    const auto& frame = frames[i].frame;
    const bool plain = frame.size() == 1 && !frame.extended && !frame.error;
    if (frames[i].direction != can::Direction::transmitted || !plain) continue;
    if (frame.id <= 0x700 || frame.id > 0x77F) continue;
    const NodeId node(static_cast<std::uint8_t>(frame.id - 0x700));
    const auto told = canopen::decode_error_control(frame, node);
    if (told && told->state && !told->is_boot_up()) out[node] = frame;
  }
  return out;
}

void keep_up(RunSession& session, const can::Frame& frame, Duration every) {
  if (session.recorder().is_produced(frame)) return;
  steps::Production sign{"life sign " + std::to_string(frame.id), frame, every, {}};
  sign.keeps_time = false;
  sign.life_sign = true;
  session.recorder().produce(std::move(sign));
}

}  // namespace

void keep_up_life_signs(RunSession& session) {
  if (has_changed(session, Index(0x1016))) {
    const auto heartbeats = heartbeats_of_case(session);
    const Duration every =
        std::max<Duration>(often, for_each_node * static_cast<Duration::rep>(heartbeats.size()));
    for (const auto& [node, frame] : heartbeats) keep_up(session, frame, every);
  }
  const bool life_time_changed = has_changed(session, Index(0x100C)) || has_changed(session, Index(0x100D));
  if (life_time_changed && session.has_guarded(session.first_frame())) {
    const auto id = canopen::connection_set(session.node()).error_control;
    keep_up(session, can::remote_frame(id, 1), often);
  }
}

Result<void> await_last_guard_reply(RunSession& session, std::size_t from) {
  constexpr Duration longest = std::chrono::milliseconds(100), margin = std::chrono::milliseconds(5);
  const auto id = canopen::connection_set(session.node()).error_control.value();
  std::optional<BusTime> open, last;
  Duration slowest{};
  const auto& frames = session.capture().frames();
  for (auto i = from; i < frames.size(); ++i) {
    const auto& frame = frames[i].frame;
    if (frame.extended || frame.error || frame.id != id) continue;
    if (frames[i].direction == can::Direction::transmitted) {
      if (frame.remote) last = open = frames[i].time;
    } else if (open) {
      slowest = std::max<Duration>(slowest, frames[i].time - *std::exchange(open, std::nullopt));
    }
  }
  if (!last) return {};
  return session.wait_until(*last + std::min(slowest, longest) + margin);
}

}  // namespace conform::engine
