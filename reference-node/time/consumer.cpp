// SPDX-License-Identifier: Apache-2.0
#include "time/consumer.hpp"

namespace refnode {

TimeConsumer::TimeConsumer(Device& device)
    : device_(&device), cob_id_(device, cob_id_rules, 0x1012, 0, 0x00000100) {}

void TimeConsumer::add_objects() {
  ObjectDictionary& od = device_->dictionary;
  od.add_variable(0x1012, integer_entry("COB-ID time stamp object", DataType::unsigned32, Access::rw, 0x100));
  od.add_variable(0x2F10, bytes_entry("Last time received", DataType::time_of_day, Access::ro, Bytes(6, 0)));
}

bool TimeConsumer::on_frame(const Frame& frame) {
  if (!cob_id_.valid() || frame.id != cob_id_.can_id()) return false;
  if (frame.size() != 6) return true;
  // Bits 27-0 milliseconds since midnight, 31-28 reserved, 47-32 days since 1984-01-01.
  Entry* time = device_->dictionary.entry(0x2F10, 0);
  if (time != nullptr && !device_->described) {
    time->value.assign(frame.data.begin(), frame.data.begin() + 6);
    time->value[3] &= 0x0FU;
  }
  if (on_time_of_day) {
    const std::uint64_t value = conform::load_le(frame.bytes());
    on_time_of_day(static_cast<std::uint32_t>(value & 0x0FFFFFFFU), static_cast<std::uint16_t>(value >> 32U));
  }
  return true;
}

}  // namespace refnode
