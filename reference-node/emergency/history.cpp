// SPDX-License-Identifier: Apache-2.0
#include "emergency/history.hpp"

#include <algorithm>
#include <cstddef>

namespace refnode {

namespace {

constexpr std::uint16_t index = 0x1003;

// Bits 15-0 error code, bits 31-16 manufacturer: detail and source.
std::uint32_t field_of(std::uint16_t code, ErrorSource source, std::uint8_t detail) {
  return code | (static_cast<std::uint32_t>(detail) << 16U) | (static_cast<std::uint32_t>(source) << 24U);
}

}  // namespace

void ErrorHistory::add_objects() {
  ObjectDictionary& od = device_->dictionary;
  od.add_complex(index, "Pre-defined error field", ObjectKind::array);
  for (std::uint8_t sub = 1; sub <= fields; ++sub)
    od.add_sub(index, sub, integer_entry("Standard error field", DataType::unsigned32, Access::ro, 0));
  // Sub-index 00h of this array is the number of recorded errors and can be written to clear them.
  od.add_sub(index, 0, integer_entry("Number of errors", DataType::unsigned8, Access::rw, 0));
}

void ErrorHistory::bind() {
  ObjectDictionary& od = device_->dictionary;
  if (const auto history = od.objects().find(index); history != od.objects().end()) {
    for (auto& [sub, field] : history->second.entries) {
      if (sub != 0 && sub != 0xFF) read_by(field, [this, place = sub] { return read(place); });
    }
  }
  if (Entry* count = od.entry(index, 0)) {
    count->command = true;
    count->low.reset();  // of the numbers it shows, not of the 00h that can be written
    count->high.reset();
    read_by(*count, [this]() -> Upload { return Bytes{recorded()}; });
    count->check = [this](ByteView bytes) { return write_count(bytes); };
  }
}

void ErrorHistory::record(std::uint16_t code, ErrorSource source, std::uint8_t detail) {
  record_incomplete(code);
  errors_.front() = field_of(code, source, detail);
}

void ErrorHistory::record_incomplete(std::uint16_t code) {
  errors_.push_front(code);
  if (errors_.size() > choices.depth) errors_.pop_back();
}

void ErrorHistory::complete(std::uint16_t code, ErrorSource source, std::uint8_t detail) {
  const auto oldest = std::find(errors_.rbegin(), errors_.rend(), std::uint32_t{code});
  if (oldest != errors_.rend()) *oldest = field_of(code, source, detail);
}

std::uint8_t ErrorHistory::recorded() const {
  return static_cast<std::uint8_t>(std::min<std::size_t>(errors_.size(), 0xFE));
}

Upload ErrorHistory::read(std::uint8_t sub) const {
  if (sub > errors_.size()) return refuse(sub == 1 ? choices.nothing_recorded : choices.unused_field);
  return conform::to_le(errors_[sub - 1U], 4);
}

Accepted ErrorHistory::write_count(ByteView bytes) {
  if (conform::load_le(bytes) != 0) return refuse(abort_code::invalid_value);
  clear();
  return {};
}

}  // namespace refnode
