// SPDX-License-Identifier: Apache-2.0
#include "engine/recover.hpp"

#include "base/text.hpp"
#include "canopen/nmt.hpp"
#include "engine/liveness.hpp"

namespace conform::engine {

namespace {

/// "save" (7.5.2.13).
const Bytes signature{'s', 'a', 'v', 'e'};

Result<void> store(RunSession& session, Multiplexer object, Recovery& out) {
  using Kind = steps::SdoAnswer::Kind;
  auto answer = session.download(object, signature, canopen::SdoDownload::Mode::automatic,
                                 session.profile().store_timeout);
  if (!answer) return std::unexpected(answer.error());
  if (answer->kind == Kind::confirmed) {
    out.stored.push_back(object);
  } else {
    out.not_stored.push_back(to_string(object) + ": " + answer->refusal());
  }
  return {};
}

/// What cannot be read now tells nothing.
Result<void> check_identity(RunSession& session, const Remains& remains, const std::string& interface) {
  using Kind = steps::SdoAnswer::Kind;
  for (const auto& [object, known] : remains.identity) {
    const auto answer = session.upload(object, std::nullopt);
    if (!answer) return std::unexpected(answer.error());
    if (answer->kind != Kind::confirmed || answer->data.size() != 4 || load_le(answer->data) == known)
      continue;
    return fail("this is another device: " + to_string(object) + " is " + hex_bytes(answer->data) +
                    ", and was " + hex_bytes(to_le(known, 4)) + " in the run that is to be recovered",
                interface, "nothing was written; recover where the device of that run is");
  }
  return {};
}

}  // namespace

Result<Recovery> recover(can::Transport& transport, const device::Profile& profile, Remains remains,
                         Observer& observer) {
  Recorder recorder(transport, nullptr);
  recorder.set_observer(observer);
  RunSession session(recorder, profile, device::dictionary_of(profile));
  session.begin_case(remains.store.empty() ? scenario::Risk::config : scenario::Risk::nvm);
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
  if (auto same = check_identity(session, remains, transport.info().name); !same)
    return std::unexpected(same.error());
  Recovery out;
  auto restored = restore(session, std::move(remains.changes));
  if (!restored) return std::unexpected(restored.error());
  out.values = std::move(*restored);
  // A value that is not what it was must not be made to last.
  if (!out.values.left.empty()) return out;
  for (const auto object : remains.store) {
    if (auto stored = store(session, object, out); !stored) return std::unexpected(stored.error());
  }
  return out;
}

}  // namespace conform::engine
