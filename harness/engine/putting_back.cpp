// SPDX-License-Identifier: Apache-2.0
#include "engine/putting_back.hpp"

#include <algorithm>
#include <utility>

#include "base/text.hpp"
#include "engine/baseline.hpp"
#include "engine/discovery.hpp"
#include "engine/life_signs.hpp"
#include "engine/restore.hpp"

namespace conform::engine {
namespace {

/// In bytes: from here on an upload in segments is more than a glance.
constexpr std::size_t takes_long = 64;

/// A device that answers no more is not asked for hundreds of values, each of which would take a time-out.
class Deaf {
 public:
  /// Of one value after the other. True: the rest is not worth asking for.
  [[nodiscard]] bool after(const steps::SdoAnswer& answer) {
    using Kind = steps::SdoAnswer::Kind;
    in_a_row_ = answer.kind == Kind::confirmed || answer.kind == Kind::aborted ? 0 : in_a_row_ + 1;
    return in_a_row_ == 4;
  }

 private:
  int in_a_row_ = 0;
};

}  // namespace

Result<void> PuttingBack::look(std::optional<BusTime> until) {
  auto values = snapshot(run_.session, until);
  if (!values) return std::unexpected(values.error());
  snapshot_ = std::move(*values);
  const bool whole = !until || run_.session.now() < *until;
  run_.session.note_defaults(whole ? what_is_no_default(run_.session.known(), snapshot_)
                                   : "not all values were looked at, so factory defaults may not be active");
  auto stores = stores_by_itself();
  if (!stores) return std::unexpected(stores.error());
  stores_by_itself_ = *stores;
  return {};
}

/// Bit 1 of 1010h:01 to 7Fh (CiA 301, 7.5.2.13), or the profile says so.
Result<bool> PuttingBack::stores_by_itself() {
  if (run_.profile.claimed("autonomous storing")) return true;
  for (const auto& entry : run_.session.known().object(Index(0x1010))) {
    if (entry.mux.sub == SubIndex(0) || entry.mux.sub > SubIndex(0x7F)) continue;
    const auto held = run_.session.peek(entry.mux);
    if (!held) return std::unexpected(held.error());
    if (confirmed(*held) && (load_le(held->data) & 2U) != 0) return true;
  }
  return false;
}

Result<void> PuttingBack::after_case(const result::CaseResult& result) {
  // What is asked from here on nobody would answer in Stopped (7.3.2.2.4), and each wait takes seconds.
  if (run_.session.is_stopped() && run_.may(scenario::Risk::config)) {
    if (auto ready = enter_pre_operational(run_); !ready) return ready;
  }
  if (auto done = put_back(result); !done) return done;
  run_.recorder.stop_producing("");
  if (run_.session.was_guarded()) {
    if (auto quiet = await_last_guard_reply(run_.session, result.first_frame); !quiet) return quiet;
  }
  return end_life_guarding();
}

/// With the life time that the device has by itself, the first guard request of a case has begun a watch that
/// nobody feeds any more: its event would come into a later case, or after the run. Only a reset takes back
/// that there was a request (7.2.8.3.2.2: life guarding begins with the first one).
Result<void> PuttingBack::end_life_guarding() {
  if (!run_.session.was_guarded() || !run_.may(scenario::Risk::config)) return {};
  for (const auto index : {Index(0x100C), Index(0x100D)}) {
    const auto held = run_.session.peek({index, SubIndex(0)});
    if (!held) return std::unexpected(held.error());
    if (!confirmed(*held) || load_le(held->data) == 0) return {};
  }
  const StopHeld still(run_.recorder);
  auto booted = reset(run_, canopen::NmtCommand::reset_communication);
  if (!booted) return std::unexpected(booted.error());
  if (auto ready = enter_pre_operational(run_); !ready) return ready;
  note_left(what_returned());
  return {};
}

Result<void> PuttingBack::put_back(const result::CaseResult& result) {
  auto changes = take_changes();
  if (changes.empty()) return {};
  pending_ = changes;
  // A stop request waits until everything is back: half a restore is the worst of all.
  const StopHeld held(run_.recorder);
  if (auto ready = enter_pre_operational(run_); !ready) return ready;
  auto report = restore(run_.session, changes);
  if (!report) return std::unexpected(report.error());
  if (!report->left.empty() && run_.may(scenario::Risk::config)) {
    // What cannot be written back is lost with a reset, unless it was stored.
    auto booted = reset(run_, canopen::NmtCommand::reset_node);
    if (!booted) return std::unexpected(booted.error());
    if (auto ready = enter_pre_operational(run_); !ready) return ready;
    report = restore(run_.session, std::move(changes));
    if (!report) return std::unexpected(report.error());
  }
  pending_.clear();
  for (const auto& left : report->left) run_.note(result.name() + ": could not be put back: " + left);
  if (!report->left.empty()) run_.session.note_left_changed();
  return {};
}

void PuttingBack::give_up(const std::string& why) {
  for (const auto& change : take_changes()) {
    run_.note("not put back, " + why + ": " + to_string(change.object) + " was " + hex_bytes(change.before));
  }
}

void PuttingBack::after_resets() {
  if (run_.session.resets() == resets_looked_at_) return;
  resets_looked_at_ = run_.session.resets();
  // Restored by a test, where what was found is said to be the default: it is to be so for the tests that
  // follow.
  const auto restored = run_.session.take_restored();
  if (!stores_by_itself_ && restored.empty()) return;
  const StopHeld held(run_.recorder);
  note_left(what_returned(restored));
}

void PuttingBack::after_fault(const std::function<Result<void>()>& clean_up, bool bus_is_back) {
  auto& recorder = run_.recorder;
  recorder.stop_producing("");
  const bool usable =
      bus_is_back ||
      (recorder.fault() && (recorder.fault()->what == stopped || recorder.fault()->what == flooded));
  if (!usable) return give_up("the bus or the device is gone");
  recorder.clear_fault();
  const StopHeld held(recorder);
  // An open transfer is ended, also where nothing was changed.
  run_.session.sdo_channel_dirty();
  const auto note = [&](const std::string& what, const Error& error) {
    if (!bus_is_back) run_.note(what + ": " + error.text());  // else there is another call
  };
  if (auto idle = run_.session.channel().make_idle(); !idle)
    note("the SDO channel may not be idle", idle.error());
  // What is stored in the device only the scenario can put back.
  if (clean_up) {
    if (auto done = clean_up(); !done) note("the cleanup of the stopped case did not end", done.error());
  }
  // First the state: in Stopped no SDO would be answered.
  if (!bus_is_back || !recorder.fault()) leave_in_pre_operational();
  pending_ = take_changes();
  auto report = restore(run_.session, pending_);
  recorder.stop_producing("");
  if (!report) return note("values may not have been put back", report.error());
  pending_.clear();
  note_left(report->left);
  note_left(what_returned());
  if (auto ended = end_life_guarding(); !ended) note("life guarding may still watch", ended.error());
}

void PuttingBack::finish() {
  {
    const StopHeld held(run_.recorder);
    leave_in_pre_operational();
    look_for_unknown_tpdos();
    // What is left shows in the comparison that follows.
    if (run_.may(scenario::Risk::config)) (void)what_returned();
  }
  // The same entries, whatever has been learnt about access in between.
  Deaf deaf;
  for (const auto& [object, before] : snapshot_) {
    const auto found = run_.session.peek(object);
    if (!found) return;
    if (deaf.after(*found))
      return run_.note(
          "from " + to_string(object) +
          " on the values were not compared with those before the run: the device answers no more");
    if (!confirmed(*found)) {
      run_.note(to_string(object) + " could be read before the run and cannot any more");
    } else if (found->data != before) {
      run_.note(to_string(object) + " was " + hex_bytes(before) + " before the run and is " +
                hex_bytes(found->data));
    }
  }
}

/// Frames of 29 bits may be TPDOs that no description tells of, and that no case has looked at: their COB-IDs
/// explain them.
void PuttingBack::look_for_unknown_tpdos() {
  constexpr std::uint16_t first = 0x1800, last = 0x19FF;
  const auto& follower = run_.live.watch().follower();
  // They may as well be another node's.
  const auto until = run_.recorder.now() + std::chrono::seconds(10);
  Deaf deaf;
  for (std::uint16_t index = first; index <= last && run_.recorder.now() < until; ++index) {
    run_.live.follow(run_.recorder.capture().frames());
    if (!follower.has_unknown_extended()) return;
    const auto found = run_.session.peek({Index(index), SubIndex(1)});
    if (!found || deaf.after(*found)) return;
  }
}

/// The journal of a case; that its entries were written is remembered: a reset may bring back what was
/// written.
std::vector<Change> PuttingBack::take_changes() {
  auto changes = std::exchange(pending_, {});
  for (auto& change : run_.session.take_journal()) {
    written_.insert(change.object);
    // What it held before the first of its changes.
    if (std::ranges::find(changes, change.object, &Change::object) == changes.end())
      changes.push_back(std::move(change));
  }
  return changes;
}

/// Puts right what a reset has brought back; gives what could not be. What the run never wrote is left alone
/// otherwise: the device changed it. What was written and is right behind a reset of the node is stored as it
/// was, or not at all: no later reset brings another value, until it is written again. A long value takes its
/// time to be read: that a restore changed one that nobody wrote would show at the end of the run.
/// A restore is looked behind once: it changes the same values each time.
std::vector<std::string> PuttingBack::what_returned(const std::set<SubIndex>& restored) {
  const bool may_have_changed_any = !std::ranges::includes(looked_at_behind_, restored);
  std::vector<Change> returned;
  Deaf deaf;
  for (const auto& [object, before] : snapshot_) {
    const bool may_be_other =
        written_.contains(object) || (may_have_changed_any && before.size() <= takes_long);
    if (!may_be_other) continue;
    const auto found = run_.session.peek(object);
    if (!found || deaf.after(*found)) return {};
    if (!confirmed(*found)) continue;
    if (found->data != before) {
      returned.push_back({object, before});
      written_.insert(object);
    } else if (run_.session.reset_was_of_node() && !run_.session.was_written_since_reset(object)) {
      written_.erase(object);
    }
  }
  looked_at_behind_.insert(restored.begin(), restored.end());
  if (returned.empty()) return {};
  auto report = restore(run_.session, std::move(returned));
  // An environment that failed shows in the next step of the run.
  return report ? std::move(report->left) : std::vector<std::string>{};
}

/// Says once of each value that it could not be put back.
void PuttingBack::note_left(const std::vector<std::string>& left) {
  for (const auto& each : left) {
    run_.session.note_left_changed();
    if (left_.insert(each).second) run_.note("could not be put back: " + each);
  }
}

/// The state a device is left in; that it could not be commanded is said, not judged.
void PuttingBack::leave_in_pre_operational() {
  if (!run_.may(scenario::Risk::config)) return;
  if (auto done = enter_pre_operational(run_); !done)
    run_.note("the device may not be in Pre-operational: " + done.error().text());
}

}  // namespace conform::engine
