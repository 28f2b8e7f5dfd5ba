// SPDX-License-Identifier: Apache-2.0
#include "sync/consumer.hpp"

namespace refnode {

SyncConsumer::SyncConsumer(Device& device)
    : device_(&device), cob_id_(device, cob_id_rules, 0x1005, 0, 0x00000080) {}

void SyncConsumer::add_objects() {
  ObjectDictionary& od = device_->dictionary;
  od.add_variable(0x1005, integer_entry("COB-ID SYNC message", DataType::unsigned32, Access::rw, 0x80));
  od.add_variable(0x1006, integer_entry("Communication cycle period", DataType::unsigned32, Access::rw, 0));
  od.add_variable(0x1007, integer_entry("Synchronous window length", DataType::unsigned32, Access::rw, 0));
  od.add_variable(0x1019,
                  integer_entry("Synchronous counter overflow value", DataType::unsigned8, Access::rw, 0));
}

void SyncConsumer::bind() {
  cob_id_.bind();
  if (Entry* counter = device_->dictionary.entry(0x1019, 0))
    counter->check = [this](ByteView bytes) { return check_overflow(bytes); };
}

// 0: SYNC without data; 2 to 240: SYNC with a counter of one byte. While the period is not 0 the counter may
// be running.
Accepted SyncConsumer::check_overflow(ByteView bytes) const {
  const std::uint64_t value = conform::load_le(bytes);
  if (value == overflow()) return {};
  if (value == 1 || value > 240) return refuse(choices.counter_reserved);
  if (device_->dictionary.number(0x1006, 0) != 0) return refuse(choices.counter_locked);
  return {};
}

std::uint64_t SyncConsumer::overflow() const { return device_->dictionary.number(0x1019, 0); }

bool SyncConsumer::on_frame(const Frame& frame) {
  if (!cob_id_.valid() || frame.id != cob_id_.can_id()) return false;
  // Only with a counter (1019h) does a SYNC have data; one of another length is reported and used all the
  // same.
  const std::size_t size = rules.length(overflow());
  const ErrorCause wrong_length{0x8240, ErrorSource::sync, 0};
  if (frame.size() != size) {
    if (choices.wrong_length_reported) device_->errors.raise(wrong_length, frame.size());
    if (!choices.wrong_length_used) return true;
  } else {
    device_->errors.clear(wrong_length);
  }
  const bool counted = size != 0 && frame.size() == size;
  if (counted && !rules.obeyed(frame.data[0], overflow())) return true;
  if (on_sync) on_sync(counted ? std::optional(frame.data[0]) : std::nullopt);
  return true;
}

}  // namespace refnode
