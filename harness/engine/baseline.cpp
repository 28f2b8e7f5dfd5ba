// SPDX-License-Identifier: Apache-2.0
#include "engine/baseline.hpp"

#include "canopen/cob_id.hpp"
#include "engine/liveness.hpp"

namespace conform::engine {
namespace {

/// What asks the device and changes nothing in it: the engine's own way to Pre-operational, and requests of
/// SDO uploads.
bool only_asks(const can::Frame& frame, NodeId node) {
  const auto set = canopen::connection_set(node);
  if (frame.is_data(CanId(0)))
    return canopen::nmt_command_at(frame.data[0]) == canopen::NmtCommand::pre_operational;
  if (!frame.is_data(set.sdo_request) || frame.size() != 8) return false;
  // Client command specifiers of 7.2.4.3: upload, segment of an upload, abort, block upload.
  const auto specifier = frame.data[0] >> 5U;
  return specifier == 2 || specifier == 3 || specifier == 4 || specifier == 5;
}

/// As the reset has left it: one case that only looks needs no reset behind another such case.
bool is_fresh(RunContext& run, scenario::Fresh wanted) {
  if (!run.latest_reset || (wanted == scenario::Fresh::node && !run.latest_reset->of_node)) return false;
  const auto& frames = run.recorder.capture().frames();
  const auto restarted = is_boot_up_of(run.profile.node);
  for (auto& seen = run.latest_reset->seen; seen < frames.size(); ++seen) {
    const bool ours = frames[seen].direction == can::Direction::transmitted;
    if (ours ? only_asks(frames[seen].frame, run.profile.node) : !restarted(frames[seen])) continue;
    run.latest_reset.reset();
    return false;
  }
  return true;
}

}  // namespace

Result<void> enter_pre_operational(RunContext& run) {
  auto& session = run.session;
  if (!session.take_state_changed()) return {};
  // A device that is still booting would not hear the command, nor answer what comes next.
  const auto reset = session.take_reset();
  if (reset) {
    auto booted = run.recorder.find(*reset + 1, is_boot_up_of(run.profile.node),
                                    run.recorder.capture().frames()[*reset].time + run.profile.boot_time);
    if (!booted) return std::unexpected(booted.error());
  }
  auto sent = session.command(canopen::NmtCommand::pre_operational);
  if (!sent) return sent;
  (void)session.take_state_changed();
  // What follows a boot-up, an EMCY 0000h perhaps, is not to come into the case: a heartbeat that shows the
  // state ends the wait for T_NMT behind other commands only.
  if (!reset) return session.await_state();
  if (auto waited = session.wait_until(session.now() + run.profile.nmt_time); !waited) return waited;
  // So soon behind its boot-up it may have missed the command: without another one nobody could tell later on
  // in which state it has to be.
  sent = session.command(canopen::NmtCommand::pre_operational);
  (void)session.take_state_changed();
  return sent;
}

Result<bool> reset(RunContext& run, canopen::NmtCommand command) {
  const auto from = run.recorder.capture().size();
  auto sent = run.session.command(command);
  if (!sent) return std::unexpected(sent.error());
  auto booted =
      run.recorder.find(from, is_boot_up_of(run.profile.node), run.recorder.now() + run.profile.boot_time);
  if (!booted) return std::unexpected(booted.error());
  run.latest_reset.reset();
  if (*booted) run.latest_reset = {**booted + 1, command == canopen::NmtCommand::reset_node};
  return booted->has_value();
}

Result<void> reach_baseline(RunContext& run, const scenario::Scenario& scenario) {
  if (auto idle = run.session.channel().make_idle(); !idle) return idle;
  if (!run.may(scenario::Risk::config)) return {};
  if (scenario.fresh != scenario::Fresh::none && !is_fresh(run, scenario.fresh)) {
    auto done =
        reset(run, scenario.fresh == scenario::Fresh::node ? canopen::NmtCommand::reset_node
                                                           : canopen::NmtCommand::reset_communication);
    if (!done) return std::unexpected(done.error());
  }
  return enter_pre_operational(run);
}

}  // namespace conform::engine
