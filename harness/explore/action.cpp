// SPDX-License-Identifier: Apache-2.0
#include "explore/action.hpp"

#include <fmt/format.h>

#include "base/text.hpp"
#include "canopen/cob_id.hpp"

namespace conform::explore {
namespace {

std::string_view nmt_word(std::uint8_t command) {
  switch (command) {
    case 1: return "start";
    case 2: return "stop";
    case 0x80: return "pre-operational";
    case 0x81: return "reset node";
    case 0x82: return "reset communication";
    default: return "";
  }
}

bool is_nmt(const can::Frame& frame) { return frame.is_data(canopen::nmt_can_id); }

}  // namespace

std::string_view word_of(Transfer transfer) {
  switch (transfer) {
    case Transfer::automatic: return "automatic";
    case Transfer::expedited_unsized: return "expedited without size";
    case Transfer::segmented: return "segmented";
    case Transfer::segmented_unsized: return "segmented without size";
    case Transfer::block: return "block";
    case Transfer::block_unsized: return "block without size";
  }
  return "";
}

std::uint8_t Action::nmt_command(NodeId node) const {
  if (kind != Kind::frame || !is_nmt(frame) || frame.dlc != 2) return 0;
  return frame.data[1] == node.value() || frame.data[1] == 0 ? frame.data[0] : std::uint8_t{0};
}

Action upload(Multiplexer object, Transfer transfer) {
  return {.kind = Action::Kind::upload, .object = object, .transfer = transfer};
}

Action download(Multiplexer object, Bytes data, Transfer transfer) {
  return {.kind = Action::Kind::download, .object = object, .transfer = transfer, .data = std::move(data)};
}

Action frame(const can::Frame& frame) { return {.kind = Action::Kind::frame, .frame = frame}; }

Action request(const can::Frame& frame) { return {.kind = Action::Kind::request, .frame = frame}; }

Action nmt(NodeId node, std::uint8_t command) {
  return frame(can::data_frame(canopen::nmt_can_id, {command, node.value()}));
}

Action wait(Duration time) { return {.kind = Action::Kind::wait, .time = time}; }

std::string describe(const can::Frame& frame, NodeId node) {
  const auto id = frame.extended ? hex(frame.id, 8) : to_string(CanId(frame.id));
  if (frame.remote) {
    const bool guards = !frame.extended && frame.id == 0x700U + node.value();
    return fmt::format("{}{}", guards ? "guard request " : "remote frame ", id);
  }
  if (is_nmt(frame) && frame.dlc == 2) {
    const auto word = nmt_word(frame.data[0]);
    const auto to = frame.data[1] == node.value() ? std::string()
                    : frame.data[1] == 0          ? std::string(" to all")
                                                  : fmt::format(" to node {}", frame.data[1]);
    return word.empty() ? fmt::format("NMT command {}{}", hex(frame.data[0], 2), to)
                        : fmt::format("NMT {}{}", word, to);
  }
  return fmt::format("send {}{}{}", id, frame.size() > 0 ? " " : "", hex_bytes(frame.bytes()));
}

std::string describe(const Action& action, NodeId node) {
  switch (action.kind) {
    case Action::Kind::upload:
    case Action::Kind::download: {
      std::string out = fmt::format("{} {}", action.kind == Action::Kind::upload ? "upload" : "download",
                                    to_string(action.object));
      if (action.kind == Action::Kind::download) {
        constexpr std::size_t shown = 16;
        out += action.data.size() > shown ? fmt::format(" = {} bytes", action.data.size())
                                          : " = " + hex_bytes(action.data);
      }
      if (action.transfer != Transfer::automatic) out += fmt::format(", {}", word_of(action.transfer));
      if (!action.fault.empty()) out += ", " + action.fault;
      return out;
    }
    case Action::Kind::request: return "request " + hex_bytes(action.frame.bytes());
    case Action::Kind::frame: return describe(action.frame, node);
    case Action::Kind::power: return "power cycle";
    case Action::Kind::wait: return "wait " + to_string(action.time);
  }
  return "";
}

}  // namespace conform::explore
