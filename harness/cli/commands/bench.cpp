// SPDX-License-Identifier: Apache-2.0
// `bench`: round trips per second through the whole harness, and the throughput of SDO transfers, for the
// tables of scripts/benchmark.
#include <fmt/format.h>

#include <atomic>
#include <chrono>

#include "can/socketcan_transport.hpp"
#include "cli/commands/commands.hpp"
#include "cli/proof/throughput.hpp"
#include "cli/run/terminal.hpp"
#include "engine/recorder.hpp"
#include "engine/run_session.hpp"

namespace conform::cli {
namespace {

constexpr TransferKind kinds[] = {TransferKind::expedited_upload, TransferKind::expedited_download,
                                  TransferKind::segmented_upload, TransferKind::segmented_download,
                                  TransferKind::block_upload,     TransferKind::block_download};

/// One line for scripts/benchmark: kind, transfers, bytes, frames, seconds, part of the limit.
void print_row(TransferKind kind, const Throughput& row) {
  print(fmt::format("{}\t{}\t{}\t{}\t{:.6f}\t{:.4f}\n", transfer_name(kind), row.transfers, row.bytes,
                    row.frames, row.seconds(), row.share_of_limit()));
}

/// Transfers when expedited; by segments a tenth of the bytes, which takes as long.
std::size_t amount_of(TransferKind kind, const BenchCommand& options) {
  switch (kind) {
    case TransferKind::expedited_upload:
    case TransferKind::expedited_download: return static_cast<std::size_t>(options.round_trips);
    case TransferKind::segmented_upload:
    case TransferKind::segmented_download: return static_cast<std::size_t>(options.bytes / 10);
    case TransferKind::block_upload:
    case TransferKind::block_download: break;
  }
  return static_cast<std::size_t>(options.bytes);
}

int simulated(const BenchCommand& options) {
  for (const auto kind : kinds) {
    const auto row = measure_simulated(kind, options.simulate, amount_of(kind, options));
    if (!row) return report_error(row.error(), exit_environment);
    print_row(kind, *row);
  }
  return 0;
}

}  // namespace

int bench_command(const BenchCommand& options) {
  if (options.simulate > 0) return simulated(options);
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
  if (options.bytes > 0) {
    engine::SdoChannel channel(recorder, profile.node, profile.sdo_timeout, profile.quiet_time);
    for (const auto kind : kinds) {
      const auto row = measure(recorder, channel, kind, amount_of(kind, options));
      if (!row) return report_error(row.error(), exit_environment);
      print_row(kind, *row);
    }
    return 0;
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
