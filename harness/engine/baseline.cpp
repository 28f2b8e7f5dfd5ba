// SPDX-License-Identifier: Apache-2.0
#include "engine/baseline.hpp"

#include "engine/liveness.hpp"

namespace conform::engine {

Result<void> enter_pre_operational(RunContext& run) {
  auto& session = run.session;
  if (!session.take_state_changed()) return {};
  // A device that is still booting would not hear the command, nor answer what comes next.
  if (const auto reset = session.take_reset()) {
    auto booted = run.recorder.find(*reset + 1, is_boot_up_of(run.profile.node),
                                    run.recorder.capture().frames()[*reset].time + run.profile.boot_time);
    if (!booted) return std::unexpected(booted.error());
  }
  auto sent = session.command(canopen::NmtCommand::pre_operational);
  if (!sent) return sent;
  (void)session.take_state_changed();
  return session.wait_until(session.now() + run.profile.nmt_time);
}

Result<bool> reset(RunContext& run, canopen::NmtCommand command) {
  const auto from = run.recorder.capture().size();
  auto sent = run.session.command(command);
  if (!sent) return std::unexpected(sent.error());
  auto booted =
      run.recorder.find(from, is_boot_up_of(run.profile.node), run.recorder.now() + run.profile.boot_time);
  if (!booted) return std::unexpected(booted.error());
  return booted->has_value();
}

Result<void> reach_baseline(RunContext& run, const scenario::Scenario& scenario) {
  if (auto idle = run.session.channel().make_idle(); !idle) return idle;
  if (!run.may(scenario::Risk::config)) return {};
  if (scenario.fresh != scenario::Fresh::none) {
    auto done =
        reset(run, scenario.fresh == scenario::Fresh::node ? canopen::NmtCommand::reset_node
                                                           : canopen::NmtCommand::reset_communication);
    if (!done) return std::unexpected(done.error());
  }
  return enter_pre_operational(run);
}

}  // namespace conform::engine
