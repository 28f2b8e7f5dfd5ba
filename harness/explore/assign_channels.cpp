// SPDX-License-Identifier: Apache-2.0
// What came on the channels of additional SDO servers, or by what was said there on the default one.
#include <algorithm>

#include "canopen/cob_id.hpp"
#include "explore/assign_objects.hpp"

namespace conform::explore {
namespace {

using What = Difference::What;
using Kind = Answer::Kind;

constexpr std::uint16_t first_server = 0x1201, last_server = 0x127F;

bool is_channel(const Action& action, std::uint8_t sub) {
  const auto index = action.object.index.value();
  return action.kind == Action::Kind::download && index >= first_server && index <= last_server &&
         action.object.sub == SubIndex(sub) && action.data.size() == 4;
}

std::uint32_t cob_id_of(const Action& action) { return static_cast<std::uint32_t>(load_le(action.data)); }

/// A CAN-ID that the conversation has given to requests (sub-index 01h) or answers (02h).
bool is_given(const Evidence& evidence, std::uint32_t id, std::uint8_t sub) {
  return evidence.some([&](const Action& each) {
    return is_channel(each, sub) && (cob_id_of(each) & canopen::cob_id::base_id_mask) == id;
  });
}

/// Requests on the channel, and near it: who does not look at all bits hears those, too.
bool asks(const Evidence& evidence, const Action& action) {
  if (action.kind != Action::Kind::frame || action.frame.extended || action.frame.remote) return false;
  // No channel is among NMT, SYNC, EMCY and TIME; one that is switched off may name any CAN-ID.
  if (action.frame.id <= canopen::time_can_id.value()) return false;
  return evidence.some([&](const Action& each) {
    const auto id = cob_id_of(each) & canopen::cob_id::base_id_mask;
    return is_channel(each, 1) && ((id ^ action.frame.id) & ~0xFU) == 0;
  });
}

bool writes_there(const Evidence& evidence) {
  return evidence.some([&](const Action& each) {
    return asks(evidence, each) && each.frame.size() > 0 && each.frame.data[0] >> 5U == 1;
  });
}

/// Something was asked on the default channel, too, beside what opens the other one.
bool is_interleaved(const Evidence& evidence) {
  bool asked = false;
  for (const auto& each : evidence.conversation) {
    if (asks(evidence, each)) asked = true;
    if (asked && each.is_transfer() && !is_channel(each, 1) && !is_channel(each, 2)) return true;
  }
  return false;
}

std::optional<Assigned> surplus(const Evidence& evidence) {
  const auto& last = evidence.last();
  if (evidence.commanded()) return violates("SDO-MUL-05");
  if (asks(evidence, last) && !is_given(evidence, last.frame.id, 1)) return violates("SDO-MUL-01");
  // Behind the last write, both have to be valid.
  const auto active = [&](std::uint8_t sub) {
    bool out = false;
    for (const auto& each : evidence.conversation) {
      if (is_channel(each, sub)) out = (cob_id_of(each) & canopen::cob_id::bit31) == 0;
    }
    return out;
  };
  if (!active(1) || !active(2)) return violates("OD-1201-04");
  return violates(is_interleaved(evidence) ? "SDO-MUL-04" : "SDO-MUL-01");
}

}  // namespace

bool is_on_channel(const Evidence& evidence) { return is_given(evidence, evidence.difference().came.id, 2); }

bool talks_of_channels(const Evidence& evidence) {
  return evidence.some([&](const Action& each) { return asks(evidence, each); });
}

std::optional<Assigned> assign_channel_frame(const Evidence& evidence) {
  const auto& difference = evidence.difference();
  const auto own = canopen::connection_set(evidence.words.node);
  const auto& frame = difference.what == What::missing ? difference.due : difference.came;
  if (frame.id == own.sdo_response.value())
    return asks(evidence, evidence.last()) ? violates("SDO-MUL-01") : std::nullopt;
  if (!is_given(evidence, frame.id, 2)) return std::nullopt;
  if (difference.what == What::surplus) return surplus(evidence);
  if (difference.what == What::other_data &&
      differs_in_reserved(difference.came.bytes(), difference.due.bytes()))
    return violates("SDO-GEN-05");
  if (is_interleaved(evidence)) return violates("SDO-MUL-04");
  if (difference.what == What::missing) return violates("SDO-MUL-01");
  return asks(evidence, evidence.last())
             ? assign_single_upload(evidence, difference.came.bytes(), difference.due.bytes())
             : std::nullopt;
}

std::optional<Assigned> assign_beside_channel(const Evidence& evidence) {
  if (writes_there(evidence)) return std::nullopt;
  return violates("SDO-MUL-04");
}

}  // namespace conform::explore
