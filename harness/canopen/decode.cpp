// SPDX-License-Identifier: Apache-2.0
#include "canopen/decode.hpp"

#include <fmt/format.h>

#include "base/text.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/emcy.hpp"
#include "canopen/nmt.hpp"

namespace conform::canopen {
namespace {

std::string nmt_text(const can::Frame& frame) {
  if (frame.dlc != 2) return fmt::format("NMT command with DLC {} instead of 2", frame.dlc);
  const auto command = nmt_command_at(frame.data[0]);
  const std::string words =
      command ? std::string(to_string(*command)) : fmt::format("command {}", hex(frame.data[0], 2));
  const std::string target = frame.data[1] == 0 ? "all nodes" : fmt::format("node {}", frame.data[1]);
  return fmt::format("NMT {} -> {}", words, target);
}

std::string error_control_text(const can::Frame& frame, NodeId node) {
  const auto message = decode_error_control(frame, node);
  const std::string of = fmt::format(" of node {}", node.value());
  if (!message) return fmt::format("error control{} without data", of);
  std::string text;
  if (message->is_boot_up()) {
    text = fmt::format("boot-up{}", of);
  } else if (message->state) {
    text = fmt::format("heartbeat{}: {}", of, to_string(*message->state));
  } else {
    text = fmt::format("heartbeat{}: undefined state {}", of, hex(message->code, 2));
  }
  if (message->toggle) text += ", toggle 1";
  if (frame.dlc != 1) text += fmt::format(", DLC {}", frame.dlc);
  return text;
}

std::string emcy_text(const can::Frame& frame) {
  const auto emcy = decode_emcy(frame.bytes());
  if (!emcy) return fmt::format("EMCY with DLC {} instead of 8", frame.dlc);
  return fmt::format("EMCY {}, error register {}", hex(emcy->code, 4), hex(emcy->error_register, 2));
}

std::string sync_text(const can::Frame& frame) {
  if (frame.dlc == 0) return "SYNC";
  if (frame.dlc == 1) return fmt::format("SYNC, counter {}", frame.data[0]);
  return fmt::format("SYNC with DLC {}", frame.dlc);
}

std::string lss_text(std::string_view direction, const can::Frame& frame) {
  return fmt::format("LSS {} {}", direction,
                     frame.size() > 0 ? hex(frame.data[0], 2) : std::string("without data"));
}

int number_of(const std::map<int, CanId>& pdos, CanId id) {
  for (const auto& [number, pdo] : pdos) {
    if (pdo == id) return number;
  }
  return 0;
}

void assign(std::map<int, CanId>& pdos, int number, std::optional<CanId> id) {
  if (id) {
    pdos[number] = *id;
  } else {
    pdos.erase(number);
  }
}

}  // namespace

Decoder::Decoder(NodeId node) : node_(node) { reset(); }

void Decoder::reset() {
  const ConnectionSet set = connection_set(node_);
  emcy_ = set.emcy;
  sync_ = sync_can_id;
  time_ = time_can_id;
  tpdo_.clear();
  rpdo_.clear();
  for (int i = 0; i < 4; ++i) {
    tpdo_[i + 1] = set.tpdo[i];
    rpdo_[i + 1] = set.rpdo[i];
  }
  sdo_.reset();
}

void Decoder::set_tpdo_can_id(int number, std::optional<CanId> id) { assign(tpdo_, number, id); }
void Decoder::set_rpdo_can_id(int number, std::optional<CanId> id) { assign(rpdo_, number, id); }

std::string Decoder::remote(CanId id) const {
  const std::uint32_t value = id.value();
  if (value > 0x700 && value <= 0x77F) return fmt::format("guarding request to node {}", value - 0x700);
  if (const int number = number_of(tpdo_, id); number != 0)
    return fmt::format("remote request for TPDO {}", number);
  return fmt::format("remote frame {}", to_string(id));
}

/// Frames that only the device may send.
std::optional<std::string> Decoder::from_device(const can::Frame& frame, CanId id) {
  const std::uint32_t n = node_.value();
  if (id.value() == 0x580 + n) return sdo_.response(frame.bytes());
  if (id.value() == 0x700 + n) return error_control_text(frame, node_);
  if (id == emcy_) return emcy_text(frame);
  if (const int number = number_of(tpdo_, id); number != 0) return fmt::format("TPDO {}", number);
  return std::nullopt;
}

std::string Decoder::meaning(const can::Frame& frame, can::Direction direction) {
  if (frame.error) return "error frame";
  const CanId id{frame.id};
  // Moved COB-IDs with 29 bits are not followed: the maps hold base frames only.
  if (frame.extended) return fmt::format("29-bit CAN-ID {}{}", to_string(id), frame.remote ? ", remote" : "");
  if (frame.remote) return remote(id);
  const std::uint32_t value = frame.id;
  if (id == nmt_can_id) return nmt_text(frame);
  if (auto text = from_device(frame, id)) {
    if (direction == can::Direction::transmitted) *text += " (sent by the tester)";
    return *std::move(text);
  }
  if (value == 0x600U + node_.value()) return sdo_.request(frame.bytes());
  if (id == sync_) return sync_text(frame);
  if (id == time_) return frame.dlc == 6 ? "TIME" : fmt::format("TIME with DLC {} instead of 6", frame.dlc);
  if (const int number = number_of(rpdo_, id); number != 0) return fmt::format("RPDO {}", number);
  if (value > 0x700 && value <= 0x77F)
    return error_control_text(frame, NodeId{static_cast<std::uint8_t>(value - 0x700)});
  if (id == lss_request_can_id) return lss_text("request", frame);
  if (id == lss_response_can_id) return lss_text("response", frame);
  return fmt::format("CAN-ID {}", to_string(id));
}

}  // namespace conform::canopen
