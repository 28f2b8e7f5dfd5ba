// SPDX-License-Identifier: Apache-2.0
#include "storage/configuration_stamp.hpp"

namespace refnode {

namespace {

constexpr std::uint16_t stamp_index = 0x1020;
constexpr std::uint8_t subs[] = {1, 2};  // days since 1984-01-01, milliseconds since midnight

Multiplexer entry_of(std::uint8_t sub) { return {conform::Index(stamp_index), conform::SubIndex(sub)}; }

void clear_in(Images& images) {
  const auto image = images.find(Group::communication);
  if (image == images.end()) return;
  for (const std::uint8_t sub : subs) {
    if (const auto value = image->second.find(entry_of(sub)); value != image->second.end())
      value->second.assign(value->second.size(), 0);
  }
}

// What the entry holds after a reset when these images are in the memory.
Bytes boot_up_value(const Images& images, Group group, Multiplexer mux, const ObjectDictionary& dictionary) {
  if (const auto image = images.find(group); image != images.end()) {
    if (const auto value = image->second.find(mux); value != image->second.end()) return value->second;
  }
  const Entry* entry = dictionary.entry(mux.index.value(), mux.sub.value());
  return entry == nullptr ? Bytes{} : entry->default_value;
}

bool same_after_reset(const Images& one, const Images& other, const ObjectDictionary& dictionary) {
  const auto covers = [&](const Images& images) {
    for (const auto& [group, image] : images) {
      for (const auto& [mux, value] : image) {
        if (mux.index == conform::Index(stamp_index)) continue;
        if (boot_up_value(one, group, mux, dictionary) != boot_up_value(other, group, mux, dictionary))
          return false;
      }
    }
    return true;
  };
  return covers(one) && covers(other);
}

}  // namespace

StampRules::StampRules(const ObjectDictionary& dictionary)
    : same_configuration([od = &dictionary](const Images& former, const Images& images) {
        return same_after_reset(former, images, *od);
      }) {}

void ConfigurationStamp::add_objects() {
  ObjectDictionary& od = device_->dictionary;
  od.add_complex(stamp_index, "Verify configuration", ObjectKind::array);
  constexpr const char* names[] = {"Configuration date", "Configuration time"};
  for (const std::uint8_t sub : subs)
    od.add_sub(stamp_index, sub, integer_entry(names[sub - 1], DataType::unsigned32, Access::rw, 0));
}

void ConfigurationStamp::bind() {
  for (const std::uint8_t sub : subs) {
    if (Entry* entry = device_->dictionary.entry(stamp_index, sub))
      entry->written = [this] { renewed_ = true; };
  }
}

bool ConfigurationStamp::before_storing(const Images& former, Images& images, bool stamp_is_stored) const {
  if (rules.same_configuration(former, images)) return false;
  if (renewed_ && stamp_is_stored) return false;
  clear_in(images);
  return !renewed_;
}

void ConfigurationStamp::before_restoring(const Images& former, Images& images) const {
  if (!rules.same_configuration(former, images)) clear_in(images);
}

void ConfigurationStamp::after_storing(bool clear, bool stamp_is_stored) {
  if (clear) {
    for (const std::uint8_t sub : subs) device_->dictionary.set_number(stamp_index, sub, 0);
  }
  if (stamp_is_stored) renewed_ = false;
}

}  // namespace refnode
