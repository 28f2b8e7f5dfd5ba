// SPDX-License-Identifier: Apache-2.0
#include "explore/own_affairs.hpp"

#include <algorithm>

#include "base/bytes.hpp"
#include "canopen/cob_id.hpp"

namespace conform::explore {
namespace {

constexpr std::size_t longest_number = 8;

std::uint32_t key_of(std::uint32_t id, bool extended) {
  return extended ? id | canopen::cob_id::extended_frame : id & 0x7FFU;
}

std::uint32_t key_of(std::uint32_t cob_id) {
  return key_of(cob_id & 0x1FFF'FFFFU, (cob_id & canopen::cob_id::extended_frame) != 0);
}

/// Of abort codes: not this value, or not now.
bool refuses_value(AbortCode code) {
  const auto value = code.value();
  return (value >= 0x0609'0030 && value <= 0x0609'0036) || value == 0x0606'0000 ||
         (value >= 0x0604'0042 && value <= 0x0604'0047) || (value >= 0x0800'0000 && value <= 0x0800'0024);
}

}  // namespace

OwnAffairs::OwnAffairs(const std::function<bool(Multiplexer)>& entries, NodeId node,
                       std::span<const std::uint32_t> cob_ids)
    : entries_(entries) {
  if (!entries_) return;
  const auto own = canopen::connection_set(node);
  for (const auto id : own.tpdo) may_use(id.value());
  may_use(canopen::time_can_id.value());
  emcy_can_ids_.insert(own.emcy.value());
  for (const auto cob_id : cob_ids) may_use(cob_id);
}

void OwnAffairs::may_use(std::uint32_t cob_id) { can_ids_.insert(key_of(cob_id)); }

void OwnAffairs::note(const Action& action) {
  if (!entries_) return;
  const auto given = [&](std::uint16_t index, std::uint8_t sub, ByteView value) {
    const bool tpdo = index >= 0x1800 && index <= 0x19FF && sub == 1;
    const bool time = index == 0x1012 && sub == 0;
    if (value.size() != 4) return;
    const auto cob_id = static_cast<std::uint32_t>(load_le(value));
    if (tpdo || time) may_use(cob_id);
    if (index == 0x1014 && sub == 0) emcy_can_ids_.insert(key_of(cob_id));
  };
  if (action.kind == Action::Kind::download)
    given(action.object.index.value(), action.object.sub.value(), action.data);
  // A single request may be an expedited download.
  const auto& bytes = action.frame.data;
  if (action.kind == Action::Kind::request && action.frame.size() == 8 && (bytes[0] & 0xE0U) == 0x20)
    given(static_cast<std::uint16_t>(bytes[1] | (bytes[2] << 8U)), bytes[3], ByteView(bytes).subspan(4));
}

bool OwnAffairs::excuse(const Action& action, const Answer& device, const Answer& model) const {
  if (!entries_ || model.kind != Answer::Kind::confirmed || !entries_(action.object)) return false;
  // Of a text or a DOMAIN the length, too.
  const auto open = [](const Answer& answer) { return answer.data.size() > longest_number; };
  if (action.kind == Action::Kind::upload)
    return device.kind == Answer::Kind::confirmed &&
           (device.data.size() == model.data.size() || open(device) || open(model));
  // What values an entry takes, and when, nobody has said.
  return action.kind == Action::Kind::download && device.kind == Answer::Kind::aborted &&
         refuses_value(device.code);
}

bool OwnAffairs::excuse(const can::Frame& device, const can::Frame& model) const {
  constexpr std::size_t told = 3;  // error code and error register
  return entries_ && emcy_can_ids_.contains(key_of(device.id, device.extended)) && device.size() == 8 &&
         model.size() == 8 && std::ranges::equal(device.bytes().first(told), model.bytes().first(told));
}

bool OwnAffairs::hold(const can::Frame& frame) const {
  return entries_ && can_ids_.contains(key_of(frame.id, frame.extended));
}

}  // namespace conform::explore
