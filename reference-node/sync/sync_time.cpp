// SPDX-License-Identifier: Apache-2.0
#include "sync/sync_time.hpp"

namespace refnode {

SyncConsumer::SyncConsumer(Device& device, Emergency& emergency)
    : device_(&device), emergency_(&emergency), cob_id_(device, CobIdUse::sync, 0x1005, 0, 0x00000080) {}

void SyncConsumer::add_objects() {
  ObjectDictionary& od = device_->dictionary;
  od.add_variable(0x1005, integer_entry("COB-ID SYNC message", DataType::unsigned32, Access::rw, 0x80));
  // Neither supervises the SYNC here: the period and the window are kept for the application to read.
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
  const SyncCounterFaults& fault = device_->behaviour.sync_counter;
  if (value == overflow()) return {};
  const bool reserved = value == 1 || value > 240;
  if (reserved && !fault.reserved_accepted) return refuse(device_->choices.counter_reserved);
  const bool running = device_->dictionary.number(0x1006, 0) != 0;
  if (fault.change_refused || (running && !fault.change_while_running_accepted))
    return refuse(device_->choices.counter_locked);
  return {};
}

std::uint64_t SyncConsumer::overflow() const { return device_->dictionary.number(0x1019, 0); }

bool SyncConsumer::on_frame(const Frame& frame) {
  if (!cob_id_.valid() || frame.id != cob_id_.can_id()) return false;
  // Only with a counter (1019h) does a SYNC have data; one of another length is reported and used all the
  // same.
  const std::size_t size = overflow() > 1 ? 1 : 0;
  const ErrorCause wrong_length{0x8240, Emergency::sync_source, 0};
  if (frame.size() != size) {
    const bool reported =
        !device_->behaviour.sync_length_not_reported && device_->choices.wrong_sync_reported;
    if (reported) emergency_->raise(wrong_length, frame.size());
    if (!device_->choices.wrong_sync_used) return true;
  } else if (device_->behaviour.sync_without_data_reported) {
    emergency_->raise(wrong_length, frame.size());
  } else {
    emergency_->clear(wrong_length);
  }
  const bool counted = size != 0 && frame.size() == size;
  if (on_sync) on_sync(counted ? std::optional(frame.data[0]) : std::nullopt);
  return true;
}

TimeConsumer::TimeConsumer(Device& device)
    : device_(&device), cob_id_(device, CobIdUse::time, 0x1012, 0, 0x00000100) {}

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
    if (!device_->behaviour.time_reserved_bits_kept) time->value[3] &= 0x0FU;
  }
  return true;
}

}  // namespace refnode
