// SPDX-License-Identifier: Apache-2.0
#include "dictionary/object_dictionary.hpp"

#include <algorithm>
#include <bit>

#include "base/check.hpp"

namespace refnode {

std::size_t fixed_size(DataType type) {
  switch (type) {
    case DataType::boolean:
    case DataType::integer8:
    case DataType::unsigned8: return 1;
    case DataType::integer16:
    case DataType::unsigned16: return 2;
    case DataType::integer24:
    case DataType::unsigned24: return 3;
    case DataType::integer32:
    case DataType::unsigned32:
    case DataType::real32: return 4;
    case DataType::integer40:
    case DataType::unsigned40: return 5;
    case DataType::integer48:
    case DataType::unsigned48:
    case DataType::time_of_day:
    case DataType::time_difference: return 6;
    case DataType::integer56:
    case DataType::unsigned56: return 7;
    case DataType::integer64:
    case DataType::unsigned64:
    case DataType::real64: return 8;
    case DataType::visible_string:
    case DataType::octet_string:
    case DataType::unicode_string:
    case DataType::domain: return 0;
  }
  return 0;
}

bool is_signed_integer(DataType type) {
  switch (type) {
    case DataType::integer8:
    case DataType::integer16:
    case DataType::integer24:
    case DataType::integer32:
    case DataType::integer40:
    case DataType::integer48:
    case DataType::integer56:
    case DataType::integer64: return true;
    default: return false;
  }
}

bool is_unsigned_integer(DataType type) {
  switch (type) {
    case DataType::boolean:
    case DataType::unsigned8:
    case DataType::unsigned16:
    case DataType::unsigned24:
    case DataType::unsigned32:
    case DataType::unsigned40:
    case DataType::unsigned48:
    case DataType::unsigned56:
    case DataType::unsigned64: return true;
    default: return false;
  }
}

Entry integer_entry(std::string name, DataType type, Access access, std::uint64_t value) {
  Entry entry;
  entry.name = std::move(name);
  entry.type = type;
  entry.access = access;
  entry.value = conform::to_le(value, fixed_size(type));
  entry.default_value = entry.value;
  if (type == DataType::boolean) {
    entry.low = 0;
    entry.high = 1;
  }
  return entry;
}

Entry cob_id_entry(std::string name, Access access, std::uint32_t base, std::uint8_t node_id) {
  Entry entry = integer_entry(std::move(name), DataType::unsigned32, access, base + node_id);
  entry.adds_node_id = true;
  return entry;
}

Entry bytes_entry(std::string name, DataType type, Access access, Bytes value, std::size_t max_size) {
  Entry entry;
  entry.name = std::move(name);
  entry.type = type;
  entry.access = access;
  entry.max_size = std::max(max_size, value.size());
  entry.value = std::move(value);
  entry.default_value = entry.value;
  return entry;
}

Entry text_entry(std::string name, Access access, std::string_view text, std::size_t max_size) {
  return bytes_entry(std::move(name), DataType::visible_string, access, Bytes(text.begin(), text.end()),
                     max_size);
}

void read_by(Entry& entry, std::function<Upload()> read) {
  entry.read = [size = fixed_size(entry.type), read = std::move(read)]() -> Upload {
    Upload value = read();
    if (value && size != 0) value->resize(size);
    return value;
  };
}

ObjectDictionary::ObjectDictionary()
    : upload([this](Multiplexer mux) { return read(mux); }),
      may_download(
          [this](Multiplexer mux, std::optional<std::size_t> size) { return check_writable(mux, size); }),
      download([this](Multiplexer mux, ByteView bytes) { return write(mux, bytes); }) {}

Entry& ObjectDictionary::add_variable(std::uint16_t index, Entry entry) {
  CONFORM_CHECK(!objects_.contains(index));
  Object& object = objects_[index];
  object.name = entry.name;
  return object.entries.try_emplace(0, std::move(entry)).first->second;
}

Object& ObjectDictionary::add_complex(std::uint16_t index, std::string name, ObjectKind kind) {
  CONFORM_CHECK(!objects_.contains(index));
  Object& object = objects_[index];
  object.name = std::move(name);
  object.kind = kind;
  object.entries.try_emplace(
      0, integer_entry("Highest sub-index supported", DataType::unsigned8, Access::constant, 0));
  return object;
}

Entry& ObjectDictionary::add_sub(std::uint16_t index, std::uint8_t sub, Entry entry) {
  const auto object = objects_.find(index);
  CONFORM_CHECK(object != objects_.end());
  auto& entries = object->second.entries;
  if (const auto first = entries.find(0); first != entries.end()) {
    auto& highest = first->second;
    if (highest.access == Access::constant && highest.number() < sub)
      highest.value = highest.default_value = Bytes{sub};
  }
  return entries.insert_or_assign(entries.end(), sub, std::move(entry))->second;
}

void ObjectDictionary::remove_sub(std::uint16_t index, std::uint8_t sub) {
  if (const auto found = objects_.find(index); found != objects_.end()) found->second.entries.erase(sub);
}

void ObjectDictionary::change_node_id(std::uint8_t from, std::uint8_t to) {
  if (from == to) return;
  for (auto& [index, object] : objects_) {
    for (auto& [sub, entry] : object.entries) {
      if (!entry.adds_node_id) continue;
      const std::uint64_t base = conform::load_le(entry.default_value) - from;
      entry.default_value = conform::to_le(base + to, entry.default_value.size());
      if (entry.access != Access::rw && entry.access != Access::wo) entry.value = entry.default_value;
    }
  }
}

Entry* ObjectDictionary::entry(std::uint16_t index, std::uint8_t sub) {
  const auto object = objects_.find(index);
  if (object == objects_.end()) return nullptr;
  const auto found = object->second.entries.find(sub);
  return found == object->second.entries.end() ? nullptr : &found->second;
}

const Entry* ObjectDictionary::entry(std::uint16_t index, std::uint8_t sub) const {
  const auto object = objects_.find(index);
  if (object == objects_.end()) return nullptr;
  const auto found = object->second.entries.find(sub);
  return found == object->second.entries.end() ? nullptr : &found->second;
}

std::uint64_t ObjectDictionary::number(std::uint16_t index, std::uint8_t sub, std::uint64_t otherwise) const {
  const Entry* found = entry(index, sub);
  return found == nullptr ? otherwise : found->number();
}

void ObjectDictionary::set_number(std::uint16_t index, std::uint8_t sub, std::uint64_t value) {
  if (Entry* found = entry(index, sub); found != nullptr) conform::store_le(found->value, value);
}

Accepted ObjectDictionary::check_exists(Multiplexer mux) const {
  const auto object = objects_.find(mux.index.value());
  if (object == objects_.end()) return refuse(abort_code::no_object);
  if (!object->second.entries.contains(mux.sub.value())) return refuse(abort_code::no_sub_index);
  return {};
}

Upload ObjectDictionary::read(Multiplexer mux) const {
  if (const auto exists = check_exists(mux); !exists) return refuse(exists.error());
  const Entry& found = *entry(mux.index.value(), mux.sub.value());
  if (found.access == Access::wo) return refuse(abort_code::write_only);
  return found.read ? found.read() : Upload(found.value);
}

Accepted ObjectDictionary::check_size(const Entry& found, std::size_t size) const {
  const std::size_t fixed = fixed_size(found.type);
  if (fixed == 0) {
    if (size > found.max_size) return refuse(choices.value_too_long);
    // UNICODE_STRING is made of 16-bit characters.
    if (found.type == DataType::unicode_string && size % 2 != 0) return refuse(abort_code::length_mismatch);
    return {};
  }
  if (size > fixed) return refuse(choices.value_too_long);
  if (size < fixed) return refuse(choices.value_too_short);
  return {};
}

template <typename Value>
Accepted ObjectDictionary::compare(Value value, const std::optional<Value>& low,
                                   const std::optional<Value>& high) const {
  if (high && value > *high) return refuse(choices.value_above_limit);
  if (low && value < *low) return refuse(choices.value_below_limit);
  return {};
}

Accepted ObjectDictionary::check_limits(const Entry& found, ByteView bytes) const {
  const std::uint64_t raw = conform::load_le(bytes);
  switch (found.type) {
    case DataType::real32:
      return compare<double>(std::bit_cast<float>(static_cast<std::uint32_t>(raw)), found.low_real,
                             found.high_real);
    case DataType::real64: return compare(std::bit_cast<double>(raw), found.low_real, found.high_real);
    case DataType::unsigned64: {
      const auto bits = [](std::int64_t limit) { return static_cast<std::uint64_t>(limit); };
      return compare(raw, found.low.transform(bits), found.high.transform(bits));
    }
    default: break;
  }
  if (!found.low && !found.high) return {};
  std::int64_t value = static_cast<std::int64_t>(raw);
  if (is_signed_integer(found.type) && bytes.size() < 8) {
    const std::int64_t sign = std::int64_t{1} << (bytes.size() * 8 - 1);
    value = (value ^ sign) - sign;
  }
  return compare(value, found.low, found.high);
}

Accepted ObjectDictionary::check_writable(Multiplexer mux, std::optional<std::size_t> size) const {
  if (const auto exists = check_exists(mux); !exists) return exists;
  const Entry& found = *entry(mux.index.value(), mux.sub.value());
  if (found.access == Access::ro || found.access == Access::constant) return refuse(abort_code::read_only);
  if (size) return check_size(found, *size);
  return {};
}

Accepted ObjectDictionary::write(Multiplexer mux, ByteView bytes) {
  if (const auto granted = check_writable(mux, bytes.size()); !granted) return granted;
  Entry& found = *entry(mux.index.value(), mux.sub.value());
  if (const auto within = check_limits(found, bytes); !within) return within;
  if (found.check) {
    if (const auto accepted = found.check(bytes); !accepted) return accepted;
  }
  if (!found.command) found.value.assign(bytes.begin(), bytes.end());
  if (found.written) found.written();
  if (on_download) on_download(mux);
  return {};
}

std::size_t ObjectDictionary::capacity(Multiplexer mux) const {
  const Entry* found = entry(mux.index.value(), mux.sub.value());
  if (found == nullptr) return 0;
  const std::size_t fixed = fixed_size(found->type);
  return fixed != 0 ? fixed : found->max_size;
}

}  // namespace refnode
