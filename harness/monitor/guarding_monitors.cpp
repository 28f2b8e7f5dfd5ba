// SPDX-License-Identifier: Apache-2.0
// The monitor of node guarding. Boot-up message, heartbeat and guard reply have one CAN-ID: only where 1017h
// is known to be 0 everything else than the boot-up message is a reply.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/text.hpp"
#include "monitor/factories.hpp"

namespace conform::monitor {
namespace {

using Subject = Observation::Subject;

class Guarding final : public Monitor {
 public:
  using Monitor::Monitor;
  enum : std::size_t { asked, heartbeat_off, first_toggle, toggle, form, state, beside_heartbeat };

  [[nodiscard]] bool wants(Subject subject) const override {
    return subject == Subject::remote || subject == Subject::nmt || subject == Subject::error_control;
  }
  void on_frame(const Observation& seen, const Follower& follower) override {
    if (seen.subject == Subject::remote && !seen.frame().extended &&
        seen.frame().id == 0x700U + follower.facts().node.value()) {
      requests_ = std::min(requests_ + 1, most_open);
      requested_at_ = seen.time();
    } else if (seen.subject == Subject::nmt && follower.nmt().booting()) {
      wanted_.reset();
    } else if (seen.boot_up()) {
      wanted_ = false;
      fresh_ = true;
    } else if (seen.subject == Subject::error_control) {
      status(seen, follower);
    }
  }
  void on_loss() override {
    wanted_.reset();
    requests_ = most_open;
  }

 private:
  void status(const Observation& seen, const Follower& follower) {
    const auto& entries = follower.entries();
    const auto* time = entries.known(0x1017, 0);
    const bool off = entries.is_zero(0x1017, 0);
    const bool settled = time == nullptr || follower.nmt().is_newer(seen.time(), time->since);
    const auto open = std::exchange(requests_, std::max(requests_ - 1, 0));
    const auto& frame = seen.frame();
    if (!settled || (time == nullptr && !off)) {
      wanted_.reset();
      return;
    }
    const bool bit_7 = frame.size() > 0 && (frame.data[0] & 0x80U) != 0;
    if (!off) {
      wanted_.reset();
      if (open == 0) return;  // told by the monitor of heartbeats
      if (!bit_7) return good(beside_heartbeat);
      if (bad(beside_heartbeat))
        tell(beside_heartbeat, seen, hex(frame.data[0], 2), "bit 7 = 0",
             fmt::format("1017h holds {}: while there is a heartbeat guarding is off", time->value));
      return;
    }
    if (follower.nmt().booting()) return;  // told by the monitor of boot-up messages
    if (time != nullptr && time->since > replied_at_ && time->by_write) wanted_.reset();
    replied_at_ = seen.time();
    const bool guarded = requested_at_ && seen.time() <= *requested_at_ + guarded_for;
    const auto unasked = guarded || time == nullptr ? asked : heartbeat_off;
    if (open > 0) {
      good(asked);
    } else if (bad(unasked)) {
      tell(unasked, seen, "the state", "silence", "1017h is 0, and no guard request is open");
    }
    judge_form(seen);
    judge_toggle(seen, bit_7);
  }

  void judge_form(const Observation& seen) {
    const auto& frame = seen.frame();
    if (frame.dlc == 1) {
      good(form);
    } else if (bad(form)) {
      tell(form, seen, fmt::format("DLC {}", frame.dlc), "DLC 1", "a guard reply is one byte");
    }
    if (frame.size() == 0) return;
    const auto code = static_cast<std::uint8_t>(frame.data[0] & 0x7FU);
    if (canopen::nmt_state_at(code)) {
      good(state);
    } else if (bad(state)) {
      tell(state, seen, fmt::format("state {}", hex(code, 2)), "04h, 05h or 7Fh", "the state is not defined");
    }
  }

  void judge_toggle(const Observation& seen, bool got) {
    const auto wanted = std::exchange(wanted_, !got);
    const auto requirement = std::exchange(fresh_, false) ? first_toggle : toggle;
    if (!wanted) return;
    if (got == *wanted) return good(requirement);
    if (!bad(requirement)) return;
    tell(requirement, seen, fmt::format("toggle bit {}", int{got}),
         fmt::format("toggle bit {}", int{*wanted}),
         requirement == toggle ? "it alternates with every reply"
                               : "it begins with 0 after the boot-up message");
  }

  static constexpr int most_open = 64;
  static constexpr Duration guarded_for = std::chrono::seconds(5);
  int requests_ = most_open;    ///< that may still be answered; those before the trace, too
  std::optional<bool> wanted_;  ///< the next toggle bit
  bool fresh_ = false;          ///< no reply since the boot-up message
  BusTime replied_at_{};
  std::optional<BusTime> requested_at_;
};

}  // namespace

std::unique_ptr<Monitor> make_guarding(const Rule& rule) { return std::make_unique<Guarding>(rule); }

}  // namespace conform::monitor
