// SPDX-License-Identifier: Apache-2.0
// Monitors of NMT states, boot-up messages and heartbeats.
#include <fmt/format.h>

#include <optional>

#include "base/text.hpp"
#include "monitor/factories.hpp"
#include "monitor/restarts.hpp"
#include "monitor/sdo_server_frame.hpp"

namespace conform::monitor {
namespace {

using canopen::NmtCommand;
using Subject = Observation::Subject;
using result::Verdict;

/// A transfer from before that the server gives up: no answer to what came in Stopped.
bool gives_a_transfer_up(const Observation& seen) {
  const auto& answer = seen.answer;
  if (!answer.well_formed || (answer.to != SdoAnswer::To::itself && answer.to != SdoAnswer::To::unclear))
    return false;
  return server::is_abort(seen.frame()) && server::code_of(seen.frame()) == canopen::abort::timed_out;
}

class SdoStates final : public Monitor {
 public:
  using Monitor::Monitor;
  enum : std::size_t { stopped, before_boot_up };

  [[nodiscard]] bool rests_on_time(std::size_t requirement) const override { return requirement == stopped; }

  void on_frame(const Observation& seen, const Follower& follower) override {
    const auto& nmt = follower.nmt();
    const bool in_stopped = nmt.commanded(seen.time()) == canopen::NmtState::stopped;
    if (!in_stopped) {
      asked_in_stopped_ = false;
      if (seen.subject == Subject::sdo_request) unanswered_ = true;
      if (seen.subject == Subject::sdo_response) unanswered_ = false;
    }
    if (seen.boot_up()) {
      if (nmt.booting()) {
        if (early_ && early_reset_ == nmt.reset_index() && bad(before_boot_up)) {
          tell(std::move(*early_));
        } else {
          good(before_boot_up);
        }
      }
      early_.reset();
    } else if (seen.subject == Subject::sdo_request && in_stopped) {
      asked_in_stopped_ = true;
      quiet(stopped);
    } else if (seen.subject == Subject::sdo_response) {
      // The answer to a request from before may be on its way already.
      const bool older = (!asked_in_stopped_ || unanswered_) && seen.answer.to != SdoAnswer::To::stream;
      if (in_stopped) unanswered_ = false;
      const bool made_in_stopped = nmt.commanded_to_sender(seen.time()) == canopen::NmtState::stopped;
      if (made_in_stopped && !older && bad(stopped)) tell_in_stopped(seen);
      // Judged when the boot-up message comes: without it there was no reset.
      if (!nmt.booting() || nmt.overdue(seen.time()) || !nmt.is_newer(seen.time(), nmt.reset_at())) return;
      if (early_ && early_reset_ == nmt.reset_index()) return;
      early_reset_ = nmt.reset_index();
      early_ = Violation{before_boot_up,
                         Verdict::fail,
                         seen.index,
                         seen.frame(),
                         "an SDO response",
                         "silence",
                         "a reset was commanded and the boot-up message had not been sent"};
    }
  }
  void on_loss() override {
    early_.reset();
    unanswered_ = true;
  }

 private:
  void tell_in_stopped(const Observation& seen) {
    if (gives_a_transfer_up(seen)) {
      return tell(stopped, seen, "an abort 0504 0000h", "silence",
                  "the device was stopped, and a transfer from before has timed out", Verdict::warn);
    }
    tell(stopped, seen, "an SDO response", "silence", "the device was stopped and SDO is off in Stopped");
  }

  bool asked_in_stopped_ = false;
  bool unanswered_ = false;  ///< the last request that came before Stopped
  std::optional<Violation> early_;
  std::size_t early_reset_ = 0;
};

class NmtBootUp final : public Monitor {
 public:
  using Monitor::Monitor;
  enum : std::size_t { power_on, reset_node, reset_communication, form, silent, order };

  void on_frame(const Observation& seen, const Follower& follower) override {
    const auto& nmt = follower.nmt();
    const auto start = starts_.on_frame(seen, follower);
    if (seen.subject == Subject::nmt) {
      const auto& frame = seen.frame();
      const bool for_it = frame.size() == 2 && !frame.extended &&
                          (frame.data[1] == 0 || frame.data[1] == follower.facts().node.value());
      if (for_it && (frame.data[0] == 0x01 || frame.data[0] == 0x02 || frame.data[0] == 0x80)) quiet(order);
      return;
    }
    if (!seen.from_device()) return;
    if (seen.boot_up()) return boot_up(seen, follower, start);
    if (!nmt.booting()) return;
    if (nmt.overdue(seen.time())) {
      const auto requirement = of_reset(nmt);
      if (bad(requirement)) {
        tell(requirement, seen, "the device goes on without a boot-up message", "one boot-up message",
             fmt::format("{} was commanded more than {} before, in frame {}", to_string(*nmt.last_reset()),
                         to_string(follower.facts().boot_time), nmt.reset_index() + 1));
      }
      early_.reset();
      return;
    }
    // SDO responses are the other monitor's.
    if (seen.subject == Subject::sdo_response || !nmt.is_newer(seen.time(), nmt.reset_at())) return;
    if (early_ && early_reset_ == nmt.reset_index()) return;
    early_reset_ = nmt.reset_index();
    early_ = Violation{silent,
                       Verdict::fail,
                       seen.index,
                       seen.frame(),
                       "a frame before the boot-up message",
                       "silence",
                       "a reset was commanded and the boot-up message had not been sent"};
  }
  void on_loss() override {
    early_.reset();
    starts_.on_loss();
  }

 private:
  static std::size_t of_reset(const NmtState& nmt) {
    if (!nmt.last_reset()) return power_on;
    return *nmt.last_reset() == NmtCommand::reset_node ? reset_node : reset_communication;
  }

  void boot_up(const Observation& seen, const Follower& follower, Start start) {
    const auto& nmt = follower.nmt();
    const auto& frame = seen.frame();
    if (frame.dlc == 1 && frame.data[0] == 0) {
      good(form);
    } else if (bad(form)) {
      tell(form, seen, fmt::format("DLC {}, {}", frame.dlc, hex_bytes(frame.bytes())), "DLC 1, 00",
           "the boot-up message is one byte 00h");
    }
    if (nmt.booting()) {
      good(of_reset(nmt));
      if (early_ && early_reset_ == nmt.reset_index()) {
        if (bad(silent)) tell(std::move(*early_));
      } else {
        good(silent);
      }
    } else if (!seen.heard_before) {
      good(power_on);
    }
    early_.reset();
    if (start == Start::ordered && bad(order)) {
      tell(order, seen, "a boot-up message", "none",
           "the last command for the device was no reset, but start, stop or pre-operational");
    }
    if (start == Start::repeated && bad(of_reset(nmt))) {
      tell(of_reset(nmt), seen, "a second boot-up message", "one boot-up message per reset",
           "the device started once");
    }
  }

  Starts starts_;
  std::optional<Violation> early_;
  std::size_t early_reset_ = 0;
};

/// One start may be the plug that somebody pulled. Where the host knows that nobody did, or when it happens
/// again, it is the device.
class Restarts final : public Monitor {
 public:
  using Monitor::Monitor;

  void on_frame(const Observation& seen, const Follower& follower) override {
    const auto start = starts_.on_frame(seen, follower);
    if (start != Start::restart) {
      if (seen.from_device() && seen.heard_before) good(0);
      return;
    }
    ++restarts_;
    const bool certain = restarts_ > 1 && follower.facts().power_is_known;
    if (bad(0)) {
      tell(0, seen, "a boot-up message without a reset", "none: the device goes on",
           follower.facts().power_is_known
               ? "no reset was commanded: the device restarted by itself"
               : "no reset was commanded: the device restarted by itself, or its power was switched",
           Verdict::inconclusive);
    }
    if (certain) grade_all(Verdict::fail);
  }
  void on_loss() override { starts_.on_loss(); }

 private:
  Starts starts_;
  std::size_t restarts_ = 0;
};

class Heartbeat final : public Monitor {
 public:
  using Monitor::Monitor;
  enum : std::size_t { state, bit_7, form };

  [[nodiscard]] bool rests_on_time(std::size_t requirement) const override { return requirement == state; }

  [[nodiscard]] bool wants(Subject subject) const override { return subject == Subject::error_control; }
  void on_frame(const Observation& seen, const Follower& follower) override {
    // What answers a guarding request follows other rules.
    if (seen.subject != Subject::error_control || seen.guarded || seen.boot_up()) return;
    const auto& frame = seen.frame();
    if (frame.dlc == 1) {
      good(form);
    } else if (bad(form)) {
      tell(form, seen, fmt::format("DLC {}", frame.dlc), "DLC 1", "a heartbeat is one byte, the state");
    }
    if (frame.size() == 0) return;
    // Without a heartbeat time it is a guard reply, or should be.
    if ((frame.data[0] & 0x80U) == 0) {
      good(bit_7);
    } else if (!follower.entries().is_zero(0x1017, 0) && bad(bit_7)) {
      tell(bit_7, seen, hex(frame.data[0], 2), "bit 7 = 0", "bit 7 of a heartbeat is reserved");
    }
    judge_state(seen, follower, frame.data[0] & 0x7FU);
  }

 private:
  void judge_state(const Observation& seen, const Follower& follower, unsigned code) {
    using canopen::NmtState;
    const auto shown = canopen::nmt_state_at(static_cast<std::uint8_t>(code));
    if (!shown) {
      if (bad(state)) {
        tell(state, seen, fmt::format("state {}", hex(code, 2)), "04h, 05h or 7Fh",
             "the state is not defined");
      }
      return;
    }
    // From Operational a device may leave by itself, and from Pre-operational to Stopped (1029h).
    const auto commanded = follower.nmt().commanded_to_sender(seen.time());
    const bool wrong = (commanded == NmtState::stopped && shown != NmtState::stopped) ||
                       (commanded == NmtState::pre_operational && shown == NmtState::operational);
    if (!wrong) return good(state);
    if (!bad(state)) return;
    tell(state, seen, std::string(to_string(*shown)), std::string(to_string(*commanded)),
         fmt::format("the state was commanded more than {} before", to_string(follower.facts().nmt_time)));
  }
};

}  // namespace

std::unique_ptr<Monitor> make_sdo_states(const Rule& rule) { return std::make_unique<SdoStates>(rule); }
std::unique_ptr<Monitor> make_nmt_boot_up(const Rule& rule) { return std::make_unique<NmtBootUp>(rule); }
std::unique_ptr<Monitor> make_restarts(const Rule& rule) { return std::make_unique<Restarts>(rule); }
std::unique_ptr<Monitor> make_heartbeat(const Rule& rule) { return std::make_unique<Heartbeat>(rule); }

}  // namespace conform::monitor
