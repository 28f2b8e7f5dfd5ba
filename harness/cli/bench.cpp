// SPDX-License-Identifier: Apache-2.0
// `bench`: round trips per second through the whole harness, for the ratio scripts/benchmark prints.
#include <fmt/format.h>

#include <atomic>
#include <chrono>

#include "can/socketcan_transport.hpp"
#include "cli/commands.hpp"
#include "cli/terminal.hpp"
#include "engine/recorder.hpp"
#include "engine/run_session.hpp"

namespace conform::cli {

int bench_command(const BenchCommand& options) {
  auto transport = can::SocketCanTransport::open(options.interface);
  if (!transport) return report_error(transport.error(), exit_environment);
  const auto profile = device::default_profile(NodeId(static_cast<std::uint8_t>(options.node)));
  const std::atomic<int> stop{0};  // as in a run: waits are cut short so that a stop request is heard
  engine::Recorder recorder(**transport, &stop);
  engine::RunSession session(recorder, profile, device::dictionary_of(profile));
  // A node that has just started hears nothing before its boot-up message.
  for (int tries = 0;; ++tries) {
    auto answer = session.upload({Index(0x1000), SubIndex(0)}, std::chrono::milliseconds(20));
    if (!answer) return report_error(answer.error(), exit_environment);
    if (answer->kind == steps::SdoAnswer::Kind::confirmed) break;
    if (tries == 50)
      return report_error({"the node does not answer", options.interface, "start canopen-refnode first"},
                          exit_environment);
  }
  const auto begin = std::chrono::steady_clock::now();
  for (std::uint64_t i = 0; i < options.round_trips; ++i) {
    auto answer = session.upload({Index(0x1000), SubIndex(0)}, std::nullopt);
    if (!answer) return report_error(answer.error(), exit_environment);
    if (answer->kind != steps::SdoAnswer::Kind::confirmed) {
      return report_error({"the node stopped answering", options.interface, {}}, exit_environment);
    }
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  print(fmt::format("{:.0f}\n", static_cast<double>(options.round_trips) / elapsed.count()));
  return 0;
}

}  // namespace conform::cli
