// SPDX-License-Identifier: Apache-2.0
#include "cli/doctor/heard.hpp"

#include <algorithm>

#include "base/bytes.hpp"
#include "can/error_frame.hpp"

namespace conform::cli {
namespace {

constexpr std::uint32_t nmt_id = 0x000, sync_id = 0x080, time_id = 0x100, lss_request_id = 0x7E5;
constexpr std::uint8_t toggle_bit = 0x80;

void note_error(Heard& heard, const can::Frame& frame) {
  const auto told = can::read_error_frame(frame);
  if (told.not_acknowledged) ++heard.not_acknowledged;
  if (told.violated) ++heard.violated;
  if (told.bus_off) ++heard.bus_off;
}

void note_error_control(HeardNode& node, const can::BusEvent& event) {
  const auto byte = event.frame.data[0];
  if (byte == 0) {
    ++node.boot_ups;
    node.last_beat.reset();
    return;
  }
  ++node.heartbeats;
  node.state = static_cast<std::uint8_t>(byte & ~toggle_bit);
  if (node.last_beat) {
    const auto period = event.time - *node.last_beat;
    node.longest_period = std::max(node.longest_period.value_or(period), period);
  }
  node.last_beat = event.time;
}

void note_sdo_response(HeardNode& node, const can::Frame& frame) {
  node.answers = true;
  // 1000h:00 by an expedited upload of four bytes.
  if (frame.size() == 8 && frame.data[0] == 0x43 && frame.data[1] == 0x00 && frame.data[2] == 0x10 &&
      frame.data[3] == 0)
    node.device_type = static_cast<std::uint32_t>(load_le(frame.bytes().subspan(4)));
}

}  // namespace

void note(Heard& heard, const can::BusEvent& event) {
  const auto& frame = event.frame;
  if (frame.error) return note_error(heard, frame);
  ++heard.frames;
  if (frame.extended) {
    ++heard.others;
    return;
  }
  switch (frame.id) {
    case nmt_id: ++heard.nmt_commands; return;
    case sync_id: ++heard.syncs; return;
    case time_id: ++heard.times; return;
    case lss_request_id: ++heard.lss_requests; return;
    default: break;
  }
  const auto number = static_cast<std::uint8_t>(frame.id & 0x7FU);
  const auto function = frame.id & 0x780U;
  if (number == 0 || (frame.remote && function != 0x700)) {
    ++heard.others;
    return;
  }
  switch (function) {
    case 0x080: ++heard.nodes[number].emcys; return;
    case 0x180:
    case 0x280:
    case 0x380:
    case 0x480: ++heard.nodes[number].pdos; return;
    case 0x580: return note_sdo_response(heard.nodes[number], frame);
    case 0x600: ++heard.sdo_requests; return;
    case 0x700:
      if (frame.remote) {
        ++heard.guard_requests;
      } else if (frame.size() == 1) {
        note_error_control(heard.nodes[number], event);
      } else {
        ++heard.others;
      }
      return;
    // 200h to 500h are received by nodes: whoever sends them is a master, or another node with linked PDOs.
    default: ++heard.others; return;
  }
}

Result<void> listen(can::Transport& transport, Duration time, const std::atomic<int>& stop, Heard& heard) {
  const auto begin = transport.now();
  const auto end = begin + time;
  constexpr Duration slice = std::chrono::milliseconds(100);
  while (transport.now() < end && stop.load() == 0) {
    auto event = transport.receive(std::min(end, transport.now() + slice));
    if (!event) return std::unexpected(event.error());
    if (*event && (*event)->direction == can::Direction::received) note(heard, **event);
  }
  heard.listened += transport.now() - begin;
  return {};
}

Result<void> ask_everybody(can::Transport& transport, Duration patience, const std::atomic<int>& stop,
                           Heard& heard) {
  for (std::uint16_t number = 1; number <= 127 && stop.load() == 0; ++number) {
    const auto request =
        can::data_frame(CanId(static_cast<std::uint16_t>(0x600 + number)), {0x40, 0x00, 0x10, 0, 0, 0, 0, 0});
    if (auto sent = transport.send(request); !sent) return sent;
    const auto end = transport.now() + patience;
    const auto is_answered = [&heard, number] {
      const auto found = heard.nodes.find(static_cast<std::uint8_t>(number));
      return found != heard.nodes.end() && found->second.answers;
    };
    while (transport.now() < end && !is_answered() && stop.load() == 0) {
      auto event = transport.receive(end);
      if (!event) return std::unexpected(event.error());
      if (*event && (*event)->direction == can::Direction::received) note(heard, **event);
    }
    // Nobody acknowledges: each further request would only wait behind this one.
    if (heard.not_acknowledged > 0 || heard.bus_off > 0) return {};
  }
  return {};
}

}  // namespace conform::cli
