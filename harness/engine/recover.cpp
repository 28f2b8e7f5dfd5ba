// SPDX-License-Identifier: Apache-2.0
#include "engine/recover.hpp"

#include "canopen/nmt.hpp"
#include "engine/liveness.hpp"

namespace conform::engine {

Result<RestoreReport> recover(can::Transport& transport, const device::Profile& profile,
                              std::vector<Change> changes, Observer& observer) {
  Recorder recorder(transport, nullptr);
  recorder.set_observer(observer);
  RunSession session(recorder, profile, device::dictionary_of(profile));
  session.begin_case(scenario::Risk::config);
  // A transfer may be open, and its answer still on its way.
  session.sdo_channel_dirty();
  const auto liveness = probe(session, Means{.may_command = true});
  if (!liveness) return std::unexpected(liveness.error());
  if (!liveness->answers) {
    return fail("node " + std::to_string(profile.node.value()) + " does not answer", transport.info().name,
                "node-ID, bit rate, power?");
  }
  if (auto idle = session.channel().make_idle(); !idle) return std::unexpected(idle.error());
  if (auto sent = session.command(canopen::NmtCommand::pre_operational); !sent)
    return std::unexpected(sent.error());
  if (auto waited = session.wait_until(session.now() + profile.nmt_time); !waited)
    return std::unexpected(waited.error());
  return restore(session, std::move(changes));
}

}  // namespace conform::engine
