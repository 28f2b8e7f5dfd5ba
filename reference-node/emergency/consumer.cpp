// SPDX-License-Identifier: Apache-2.0
#include "emergency/consumer.hpp"

namespace refnode {

namespace {

constexpr std::uint32_t not_valid = 0x80000000;

}  // namespace

void EmergencyConsumer::add_objects() {
  ObjectDictionary& od = device_->dictionary;
  od.add_complex(0x1028, "Emergency consumer", ObjectKind::array);
  for (std::uint8_t sub = 1; sub <= producers; ++sub) {
    const bool fixed = sub == producers;
    od.add_sub(0x1028, sub,
               integer_entry("Emergency consumer", DataType::unsigned32,
                             fixed ? Access::constant : Access::rw, fixed ? 0x80U + sub : not_valid));
  }
  od.add_variable(0x2F11, integer_entry("Last emergency received", DataType::unsigned64, Access::ro, 0));
}

void EmergencyConsumer::bind() {
  const auto& objects = device_->dictionary.objects();
  const auto found = objects.find(0x1028);
  if (found == objects.end()) return;
  for (const auto& [sub, entry] : found->second.entries) {
    if (sub == 0 || sub == 0xFF || entry.type != DataType::unsigned32) continue;
    cob_ids_.emplace_back(*device_, cob_id_rules, 0x1028, sub, not_valid).bind();
  }
}

bool EmergencyConsumer::on_frame(const Frame& frame) {
  for (const CobId& cob_id : cob_ids_) {
    if (!cob_id.valid() || frame.id != cob_id.can_id()) continue;
    if (frame.size() != 8) return true;
    if (Entry* last = device_->described ? nullptr : device_->dictionary.entry(0x2F11, 0))
      last->value.assign(frame.data.begin(), frame.data.begin() + 8);
    return true;
  }
  return false;
}

}  // namespace refnode
