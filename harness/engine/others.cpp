// SPDX-License-Identifier: Apache-2.0
#include "engine/others.hpp"

#include <algorithm>
#include <chrono>

#include "base/text.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/lss.hpp"
#include "canopen/sdo_initiate.hpp"

namespace conform::engine {
namespace {

constexpr auto configure_node_id = static_cast<std::uint8_t>(canopen::LssCommand::configure_node_id);
constexpr std::uint32_t not_valid = 1U << 31U, generates = 1U << 30U, extended = 1U << 29U;

/// Whether the device may send on what the entry holds. With a CAN-ID of SYNC or TIME that is nobody's by
/// default it may although it was told not to.
bool sends_by(Multiplexer object, std::uint32_t cob_id) {
  const auto index = object.index.value();
  const auto sub = object.sub.value();
  if (index == 0x1005 || index == 0x1012) {
    const auto usual = index == 0x1005 ? canopen::sync_can_id : canopen::time_can_id;
    return (cob_id & generates) != 0 || (cob_id & 0x7FFU) != usual.value();
  }
  if ((cob_id & not_valid) != 0) return false;
  if (index == 0x1014) return sub == 0;
  if (index >= 0x1200 && index <= 0x127F) return sub == 2;
  if (index >= 0x1280 && index <= 0x12FF) return sub == 1;
  return index >= 0x1800 && index <= 0x19FF && sub == 1;
}

}  // namespace

Others::Others(NodeId node) : node_(node) {
  const auto set = canopen::connection_set(node);
  // LSS: the answer of a device that we asked.
  own_ = {set.sdo_response.value(), set.error_control.value(), set.emcy.value(),
          canopen::lss_response_can_id.value()};
  for (const auto id : set.tpdo) own_.insert(id.value());
}

void Others::take(Multiplexer object, std::uint32_t cob_id) {
  if (!sends_by(object, cob_id)) return;
  own_.insert(cob_id & ((cob_id & extended) != 0 ? 0x1FFF'FFFFU : 0x7FFU));
}

/// With the node-ID that LSS gives it the device sends on other CAN-IDs, for as long as the run asks it to.
void Others::learn_node_id(const can::CapturedFrame& captured) {
  const auto& bytes = captured.frame.bytes();
  if (captured.frame.is_data(canopen::lss_request_can_id)) {
    given_.reset();
    if (bytes[0] == configure_node_id && bytes[1] >= 1 && bytes[1] <= 0x7F) given_ = NodeId(bytes[1]);
  } else if (given_ && captured.frame.is_data(canopen::lss_response_can_id) &&
             bytes[0] == configure_node_id && bytes[1] == 0) {
    const auto set = canopen::connection_set(*given_);
    lent_.insert({set.sdo_response.value(), set.error_control.value(), set.emcy.value()});
    for (const auto id : set.tpdo) lent_.insert(id.value());
    given_.reset();
  }
}

void Others::learn(const can::CapturedFrame& captured) {
  const auto& frame = captured.frame;
  if (frame.size() != 8) return;
  learn_node_id(captured);
  const auto set = canopen::connection_set(node_);
  const bool request = captured.direction == can::Direction::transmitted && frame.is_data(set.sdo_request);
  const bool response = captured.direction == can::Direction::received && frame.is_data(set.sdo_response);
  if (!request && !response) return;
  const auto object = canopen::sdo_multiplexer(frame.bytes());
  const auto value = static_cast<std::uint32_t>(load_le(frame.bytes().subspan(4)));
  const auto specifier = frame.data[0] >> 5U;
  const bool expedited = (frame.data[0] & 2U) != 0;
  if (request) {
    asked_.reset();
    if (specifier == 1 && expedited) asked_.emplace(object, value);
  } else if (specifier == 2 && expedited) {
    take(object, value);
  } else if (specifier == 3 && asked_ && asked_->first == object) {
    take(object, asked_->second);
  }
}

std::optional<std::string> Others::heard(const can::Capture& capture) {
  const auto& frames = capture.frames();
  for (; looked_at_ < frames.size(); ++looked_at_) {
    const auto& captured = frames[looked_at_];
    learn(captured);
    // Who was heard there before is somebody else all the same.
    if (captured.direction == can::Direction::received && !captured.frame.error &&
        !lent_.contains(captured.frame.id))
      strange_.emplace(captured.frame.id, captured.time);
  }
  std::erase_if(strange_, [this](const auto& each) { return own_.contains(each.first); });
  if (strange_.empty()) return std::nullopt;
  const auto first = std::ranges::min_element(strange_, {}, [](const auto& each) { return each.second; });
  const auto after = std::chrono::round<std::chrono::milliseconds>(first->second - frames.front().time);
  std::string out = to_string(CanId(first->first)) + ", first " + to_string(after) + " after the beginning";
  if (strange_.size() > 1) out += ", and " + std::to_string(strange_.size() - 1) + " more CAN-IDs";
  return out;
}

}  // namespace conform::engine
