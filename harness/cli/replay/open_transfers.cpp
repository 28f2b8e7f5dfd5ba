// SPDX-License-Identifier: Apache-2.0
#include "cli/replay/open_transfers.hpp"

#include "canopen/nmt.hpp"
#include "canopen/sdo_initiate.hpp"

namespace conform::cli {
namespace {

constexpr std::uint32_t requests = 0x600, responses = 0x580, error_control = 0x700, nodes = 127;
constexpr std::uint8_t abort = 0x80;
constexpr std::uint8_t number_bits = 0x7F, last_bit = 0x80;

/// The node of a frame with one of these CAN-IDs; 0: it is none.
std::uint32_t node_of(const can::Frame& frame, std::uint32_t base) {
  const bool is =
      !frame.error && !frame.extended && !frame.remote && frame.id > base && frame.id <= base + nodes;
  return is ? frame.id - base : 0;
}

bool resets(const can::Frame& frame, std::uint8_t& node) {
  if (frame.error || frame.extended || frame.remote || frame.id != 0 || frame.size() != 2) return false;
  const auto command = canopen::nmt_command_at(frame.data[0]);
  node = frame.data[1];
  return command && canopen::is_reset(*command);
}

unsigned specifier_of(const can::Frame& frame) { return frame.data[0] >> 5U; }

}  // namespace

void OpenTransfers::sent(const can::Frame& frame) {
  if (std::uint8_t reset = 0; resets(frame, reset)) {
    if (reset == 0) {
      channels_.clear();
    } else {
      channels_.erase(reset);
    }
    return;
  }
  const auto node = node_of(frame, requests);
  if (node == 0 || frame.size() < 4) return;
  const auto command = frame.data[0];
  if (command == abort) {
    channels_.erase(node);
    return;
  }
  const auto found = channels_.find(node);
  auto* const open = found == channels_.end() ? nullptr : &found->second;
  if (open != nullptr && open->kind == Kind::block_download && open->streams) {
    open->number = command & number_bits;
    open->last_segment = (command & last_bit) != 0;
    return;
  }
  const auto begin = [&](Kind kind) {
    channels_[node] = {.kind = kind, .object = canopen::sdo_multiplexer(frame.bytes())};
    return &channels_[node];
  };
  const auto low = command & 0x03U;
  switch (specifier_of(frame)) {
    case 0:  // a segment of a download
      if (open != nullptr) open->answer_ends = (command & 0x01U) != 0;
      return;
    case 1: begin(Kind::download)->answer_ends = (command & 0x02U) != 0; return;
    case 2: begin(Kind::upload); return;
    case 5:
      if (low == 0) {
        begin(Kind::block_upload);
      } else if (low == 1) {
        channels_.erase(node);
      } else if (open != nullptr) {
        open->streams = true;
      }
      return;
    case 6:
      if ((command & 0x01U) == 0) {
        begin(Kind::block_download);
      } else if (open != nullptr) {
        open->answer_ends = true;
      }
      return;
    default: return;
  }
}

void OpenTransfers::received(const can::Frame& frame) {
  if (const auto booted = node_of(frame, error_control); booted != 0) {
    if (frame.size() == 1 && frame.data[0] == 0) channels_.erase(booted);
    return;
  }
  const auto node = node_of(frame, responses);
  const auto open = channels_.find(node);
  if (node == 0 || open == channels_.end() || frame.size() == 0) return;
  if (frame.data[0] == abort) {
    channels_.erase(open);
    return;
  }
  answer(channels_, open, frame);
}

void OpenTransfers::answer(std::map<std::uint32_t, Channel>& channels,
                           std::map<std::uint32_t, Channel>::iterator open, const can::Frame& frame) {
  auto& channel = open->second;
  const auto command = frame.data[0];
  const auto specifier = specifier_of(frame);
  bool ends = false;
  switch (channel.kind) {
    case Kind::upload:
      // A segment that is the last, or an expedited answer.
      ends = (specifier == 0 && (command & 0x01U) != 0) || (specifier == 2 && (command & 0x02U) != 0);
      break;
    case Kind::download: ends = channel.answer_ends && (specifier == 1 || specifier == 3); break;
    case Kind::block_upload:
      // The server may answer as if it had been asked for an upload without blocks.
      if (channel.streams || specifier != 2) break;
      channel.kind = Kind::upload;
      ends = (command & 0x02U) != 0;
      break;
    case Kind::block_download:
      if (specifier != 5) break;
      ends = (command & 0x03U) == 1;
      if ((command & 0x03U) == 0) channel.streams = true;
      if ((command & 0x03U) == 2)
        channel.streams = !channel.last_segment || frame.size() < 2 || frame.data[1] != channel.number;
      channel.last_segment = false;
      break;
  }
  if (ends) channels.erase(open);
}

std::vector<OpenTransfers::Transfer> OpenTransfers::all() const {
  std::vector<Transfer> out;
  for (const auto& [node, channel] : channels_) out.push_back({CanId(requests + node), channel.object});
  return out;
}

bool OpenTransfers::takes_segments(std::uint32_t request) const {
  const auto found = channels_.find(request - requests);
  return found != channels_.end() && found->second.kind == Kind::block_download && found->second.streams;
}

}  // namespace conform::cli
