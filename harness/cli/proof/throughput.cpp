// SPDX-License-Identifier: Apache-2.0
#include "cli/proof/throughput.hpp"

#include <fmt/format.h>

#include <span>
#include <utility>

#include "base/random.hpp"
#include "base/text.hpp"
#include "can/frame_time.hpp"
#include "can/simulated_bus.hpp"
#include "device/profile.hpp"
#include "node/node.hpp"

namespace conform::cli {
namespace {

constexpr Multiplexer device_type{Index(0x1000), SubIndex(0)};
constexpr Multiplexer scratch_value{Index(0x2007), SubIndex(0)};
constexpr Multiplexer large_buffer{Index(0x2008), SubIndex(0)};

bool is_upload(TransferKind kind) {
  return kind == TransferKind::expedited_upload || kind == TransferKind::segmented_upload ||
         kind == TransferKind::block_upload;
}

bool is_block(TransferKind kind) {
  return kind == TransferKind::block_upload || kind == TransferKind::block_download;
}

bool is_expedited(TransferKind kind) {
  return kind == TransferKind::expedited_upload || kind == TransferKind::expedited_download;
}

// Content with as many stuff bits as arbitrary data have.
Bytes content(std::size_t size) {
  Bytes bytes(size);
  std::uint64_t state = 1;
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(next_random(state) >> 32U);
  return bytes;
}

canopen::SdoRequest request_of(TransferKind kind, const Bytes& data) {
  canopen::SdoRequest request;
  request.upload = is_upload(kind);
  request.object = kind == TransferKind::expedited_upload     ? device_type
                   : kind == TransferKind::expedited_download ? scratch_value
                                                              : large_buffer;
  request.block = is_block(kind);
  if (!request.upload) request.data = data;
  if (kind == TransferKind::segmented_download) request.mode = canopen::SdoDownload::Mode::segmented;
  return request;
}

Result<Bytes> transfer(engine::SdoChannel& channel, canopen::SdoRequest request) {
  const auto object = request.object;
  steps::SdoJob job;
  job.request = std::move(request);
  auto answers = channel.run(std::span(&job, 1));
  if (!answers) return std::unexpected(answers.error());
  auto& answer = answers->front();
  if (answer.kind != steps::SdoAnswer::Kind::confirmed) {
    return fail(fmt::format("a transfer of {} was not confirmed", conform::to_string(object)), answer.detail,
                "is the node at the other end a canopen-refnode?");
  }
  return std::move(answer.data);
}

/// Frames of the default channel from capture index `first` on.
void add_up(const engine::Recorder& recorder, std::size_t first, std::uint32_t bit_rate, Throughput& out) {
  const auto& frames = recorder.capture().frames();
  const auto time_of = [bit_rate](const can::Frame& frame) {
    return bit_rate == 0 ? Duration{}
                         : can::bit_time(can::frame_bits(frame) + can::intermission_bits, bit_rate);
  };
  for (auto i = first; i < frames.size(); ++i) {
    ++out.frames;
    out.busy += time_of(frames[i].frame);
  }
  const auto intermission = bit_rate == 0 ? Duration{} : can::bit_time(can::intermission_bits, bit_rate);
  out.elapsed =
      frames.back().time + intermission - (frames[first].time + intermission - time_of(frames[first].frame));
}

}  // namespace

std::string_view transfer_name(TransferKind kind) {
  switch (kind) {
    case TransferKind::expedited_upload: return "expedited upload";
    case TransferKind::expedited_download: return "expedited download";
    case TransferKind::segmented_upload: return "segmented upload";
    case TransferKind::segmented_download: return "segmented download";
    case TransferKind::block_upload: return "block upload";
    case TransferKind::block_download: return "block download";
  }
  return "";
}

Result<Throughput> measure(engine::Recorder& recorder, engine::SdoChannel& channel, TransferKind kind,
                           std::size_t amount) {
  const bool expedited = is_expedited(kind);
  const auto data = content(expedited ? 4 : amount);
  if (is_upload(kind) && !expedited) {
    // What is read is written before, the fastest way.
    if (auto done = transfer(channel, request_of(TransferKind::block_download, data)); !done)
      return std::unexpected(done.error());
  }
  const auto first = recorder.capture().size();
  Throughput out;
  out.transfers = expedited ? amount : 1;
  for (std::uint64_t i = 0; i < out.transfers; ++i) {
    auto got = transfer(channel, request_of(kind, data));
    if (!got) return std::unexpected(got.error());
    if (is_upload(kind) && !expedited && *got != data)
      return fail("the object read back is not what was written to it", std::string(transfer_name(kind)));
    out.bytes += expedited ? 4 : amount;
  }
  add_up(recorder, first, recorder.transport().info().bit_rate, out);
  return out;
}

Result<Throughput> measure_simulated(TransferKind kind, std::uint32_t bit_rate, std::size_t amount) {
  refnode::Options node_options;
  node_options.node_id = 5;
  auto node = refnode::Node::create(std::move(node_options));
  if (!node) return std::unexpected(node.error());
  can::SimulatedBus::Options bus_options;
  bus_options.bit_rate = bit_rate;
  can::SimulatedBus bus(bus_options);
  bus.attach(**node, "refnode");
  const auto profile = device::default_profile(NodeId(5));
  engine::Recorder recorder(bus.transport(), nullptr);
  engine::SdoChannel channel(recorder, profile.node, profile.sdo_timeout, profile.quiet_time);
  if (auto booted = recorder.wait_until(recorder.now() + std::chrono::milliseconds(100)); !booted)
    return std::unexpected(booted.error());
  return measure(recorder, channel, kind, amount);
}

}  // namespace conform::cli
