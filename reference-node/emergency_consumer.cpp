// SPDX-License-Identifier: Apache-2.0
#include "emergency_consumer.hpp"

namespace refnode {

namespace {

constexpr std::uint32_t not_valid = 0x80000000;

}  // namespace

EmergencyConsumer::EmergencyConsumer(Device& device) : device_(&device) {
  ObjectDictionary& od = device.dictionary;
  od.add_complex(0x1028, "Emergency consumer", ObjectKind::array);
  for (std::uint8_t sub = 1; sub <= producers; ++sub) {
    const bool fixed = sub == producers;
    const std::uint32_t value = fixed ? 0x80U + sub : not_valid;
    cob_ids_.emplace_back(device, CobIdUse::emergency_consumer, 0x1028, sub, value);
    Entry entry = cob_ids_.back().entry("Emergency consumer");
    if (fixed) entry.access = Access::constant;
    od.add_sub(0x1028, sub, std::move(entry));
  }
  od.add_variable(0x2F11, integer_entry("Last emergency received", DataType::unsigned64, Access::ro, 0));
}

bool EmergencyConsumer::on_frame(const Frame& frame) {
  for (const CobIdRules& cob_id : cob_ids_) {
    if (!cob_id.valid() || frame.id != cob_id.can_id()) continue;
    if (frame.size() != 8) return true;
    if (Entry* last = device_->dictionary.entry(0x2F11, 0))
      last->value.assign(frame.data.begin(), frame.data.begin() + 8);
    return true;
  }
  return false;
}

}  // namespace refnode
