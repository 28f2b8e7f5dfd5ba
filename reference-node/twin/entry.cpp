// SPDX-License-Identifier: Apache-2.0
#include "twin/entry.hpp"

#include <algorithm>
#include <bit>
#include <optional>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "eds/type_table.hpp"
#include "twin/twin.hpp"
#include "twin/usual.hpp"
#include "twin/value.hpp"

namespace refnode {

namespace eds = conform::eds;

namespace {

bool is_variable(DataType type) {
  return type == DataType::visible_string || type == DataType::octet_string ||
         type == DataType::unicode_string || type == DataType::domain;
}
bool is_integer(DataType type) { return is_signed_integer(type) || is_unsigned_integer(type); }
bool is_real(DataType type) { return type == DataType::real32 || type == DataType::real64; }

std::optional<DataType> known_type(std::uint16_t code) {
  const auto type = static_cast<DataType>(code);
  if (fixed_size(type) != 0 || is_variable(type)) return type;
  return std::nullopt;
}

std::string_view name_of(DataType type) {
  const auto* info = eds::find_type(static_cast<std::uint16_t>(type));
  return info == nullptr ? "the data type" : info->name;
}

std::string quoted(const eds::Field& field) {
  return fmt::format("'{}'", conform::printable(eds::shortened(field.text)));
}

eds::Position place_of(const eds::Field& field, const eds::Entry& entry) {
  return field.present ? field.at : entry.at;
}

bool is_array(const eds::Object& object) {
  return eds::object_code(object.entry) == eds::ObjectCode::array || !object.compact_sub_obj.empty();
}

/// `a` < `b`; 64-bit unsigned limits are kept as the same bits of a signed number.
template <typename Value>
bool below(DataType type, Value a, Value b) {
  if constexpr (std::is_same_v<Value, std::int64_t>) {
    if (type == DataType::unsigned64) return static_cast<std::uint64_t>(a) < static_cast<std::uint64_t>(b);
  }
  return a < b;
}

/// What is nearest to 0 inside the limits.
template <typename Value>
Value nearest_to_zero(DataType type, const std::optional<Value>& low, const std::optional<Value>& high) {
  if (low && below(type, Value{}, *low)) return *low;
  if (high && below(type, *high, Value{})) return *high;
  return Value{};
}

}  // namespace

void TwinEntryMaker::remark(const Job& job, eds::Position at, std::string_view topic, std::string_view text) {
  // As many places as remarks are kept are remembered; beyond that one more repetition only counts.
  if (remarked_.size() < TwinRemarks::most && !remarked_.emplace(at, std::string(topic)).second) return;
  const conform::Multiplexer mux{conform::Index(job.index), conform::SubIndex(job.sub)};
  remarks_->add(at, fmt::format("{}: {}", conform::to_string(mux), text));
}

void TwinEntryMaker::set_type(const Job& job, Entry& entry) {
  const eds::Field& field = job.from.data_type;
  if (const auto code = eds::data_type(job.from)) {
    if (const auto type = known_type(*code)) {
      entry.type = *type;
      return;
    }
  } else if (field.empty()) {
    const auto inherited = eds::data_type(job.object.entry);
    const auto type = inherited ? known_type(*inherited) : std::nullopt;
    if (eds::object_code(job.from) == eds::ObjectCode::domain && !job.from.object_type.empty()) {
      entry.type = DataType::domain;
      return;
    }
    if (job.is_sub && job.sub != 0 && is_array(job.object) && type) {
      entry.type = *type;
      return;
    }
    entry.type = job.is_sub && job.sub == 0 ? DataType::unsigned8 : DataType::unsigned32;
    remark(job, place_of(field, job.from), "type",
           fmt::format("no data type is given; it is served as {}", name_of(entry.type)));
    return;
  }
  entry.type = job.is_sub && job.sub == 0 ? DataType::unsigned8 : DataType::unsigned32;
  remark(
      job, place_of(field, job.from), "type",
      fmt::format("the data type {} is not known; it is served as {}", quoted(field), name_of(entry.type)));
}

void TwinEntryMaker::set_access(const Job& job, Entry& entry) {
  auto access = eds::access(job.from);
  if (!access && job.from.access_type.empty() && job.is_sub && job.sub != 0 && is_array(job.object))
    access = eds::access(job.object.entry);
  if (!access) {
    remark(job, place_of(job.from.access_type, job.from), "access",
           job.from.access_type.empty()
               ? "no access is given; it is served as ro"
               : fmt::format("the access {} is not known; it is served as ro", quoted(job.from.access_type)));
  }
  const eds::Access described = access.value_or(eds::Access::ro);
  switch (described) {
    case eds::Access::constant: entry.access = Access::constant; break;
    case eds::Access::ro: entry.access = Access::ro; break;
    case eds::Access::wo: entry.access = Access::wo; break;
    case eds::Access::rw:
    case eds::Access::rwr:
    case eds::Access::rww: entry.access = Access::rw; break;
  }
  // rww and rwr are words for objects in a PDO: they say it alone where PDOMapping is left out.
  const bool implied =
      job.from.pdo_mapping.empty() && (described == eds::Access::rww || described == eds::Access::rwr);
  const eds::PdoMapping mapping = implied ? eds::PdoMapping::yes : eds::pdo_mapping(job.from);
  const bool both = mapping == eds::PdoMapping::yes;
  entry.rx_mappable = mapping == eds::PdoMapping::rpdo_only ||
                      (both && eds::can_be_written(described) && described != eds::Access::rwr);
  entry.tx_mappable = mapping == eds::PdoMapping::tpdo_only ||
                      (both && eds::can_be_read(described) && described != eds::Access::rww);
}

template <typename Value, typename Read>
void TwinEntryMaker::take_limits(const Job& job, DataType type, const Read& read, std::optional<Value>& low,
                                 std::optional<Value>& high) {
  const auto take = [&](const eds::Field& field, std::string_view name) -> std::optional<Value> {
    if (field.empty()) return std::nullopt;
    const std::optional<Value> value = read(field.text);
    if (!value) {
      remark(job, field.at, name,
             fmt::format("{} {} is no value of the data type and is ignored", name, quoted(field)));
    }
    return value;
  };
  const auto lowest = take(job.from.low_limit, "LowLimit");
  const auto highest = take(job.from.high_limit, "HighLimit");
  if (lowest && highest && below(type, *highest, *lowest)) {
    remark(job, job.from.low_limit.at, "limits", "LowLimit is above HighLimit; both are ignored");
    return;
  }
  if (lowest) low = lowest;
  if (highest) high = highest;
}

void TwinEntryMaker::set_limits(const Job& job, Entry& entry) {
  if (is_integer(entry.type)) {
    take_limits<std::int64_t>(
        job, entry.type, [&](std::string_view text) { return read_integer(text, entry.type, node_id_); },
        entry.low, entry.high);
  } else if (is_real(entry.type)) {
    take_limits<double>(
        job, entry.type, [&](std::string_view text) { return read_real(text, entry.type); }, entry.low_real,
        entry.high_real);
  } else {
    for (const auto* field : {&job.from.low_limit, &job.from.high_limit}) {
      if (!field->empty())
        remark(job, field->at, "limits",
               fmt::format("{} has no order: the limit is ignored", name_of(entry.type)));
    }
  }
}

Bytes TwinEntryMaker::silent_value(const Job& job, const Entry& entry) const {
  const std::size_t size = fixed_size(entry.type);
  if (is_real(entry.type)) {
    const double value = nearest_to_zero(entry.type, entry.low_real, entry.high_real);
    if (entry.type == DataType::real64) return conform::to_le(std::bit_cast<std::uint64_t>(value), size);
    return conform::to_le(std::bit_cast<std::uint32_t>(static_cast<float>(value)), size);
  }
  if (!is_integer(entry.type)) return Bytes(size, 0);
  if (job.is_sub && job.sub == 0 && sub_zero_is_highest(job.index)) {
    std::uint8_t highest = 0;
    for (const auto& other : job.object.subs) {
      if (other.sub.value() != 0xFF) highest = other.sub.value();
    }
    return conform::to_le(highest, size);
  }
  if (const auto identity = identity_value(job, entry.type)) return conform::to_le(*identity, size);
  if (const auto usual = usual_value(job.index, job.sub, node_id_)) return conform::to_le(*usual, size);
  return conform::to_le(static_cast<std::uint64_t>(nearest_to_zero(entry.type, entry.low, entry.high)), size);
}

std::optional<std::uint64_t> TwinEntryMaker::identity_value(const Job& job, DataType type) const {
  constexpr std::uint16_t identity = 0x1018;
  if (job.index != identity || job.sub < 1 || job.sub > 3) return std::nullopt;
  const eds::Field* fields[] = {&info_->vendor_number, &info_->product_number, &info_->revision_number};
  const auto value = eds::number_of(*fields[job.sub - 1]);
  const bool fits = value && (fixed_size(type) == 8 || *value >> (8 * fixed_size(type)) == 0);
  return fits ? value : std::nullopt;
}

void TwinEntryMaker::set_value(const Job& job, Entry& entry) {
  const bool configured = !job.from.parameter_value.empty();
  const eds::Field& field = configured ? job.from.parameter_value : job.from.default_value;
  std::optional<Bytes> value;
  if (!field.empty()) {
    value = read_value(field.text, entry.type, node_id_);
    if (!value && is_variable(entry.type)) {
      value = Bytes(field.text.begin(), field.text.end());
      remark(job, field.at, "value",
             fmt::format("{} is not made of pairs of digits; its characters are served", quoted(field)));
    }
  }
  const bool understood = value.has_value();
  entry.value = understood ? std::move(*value) : silent_value(job, entry);
  // Whether another node-ID makes another value of it.
  if (is_integer(entry.type)) {
    const auto other = static_cast<std::uint8_t>(node_id_ ^ 1U);
    entry.adds_node_id =
        understood ? read_value(field.text, entry.type, other) != entry.value
                   : usual_value(job.index, job.sub, other) != usual_value(job.index, job.sub, node_id_);
  }
  if (!field.empty() && !understood) {
    remark(job, field.at, "value",
           fmt::format("{} is no value of {}; it starts with {}", quoted(field), name_of(entry.type),
                       conform::hex_bytes(entry.value)));
  }
  if (entry.value.size() > most_twin_value) {
    entry.value.resize(most_twin_value);
    remark(job, field.at, "length", fmt::format("the value is cut to {} bytes", most_twin_value));
  }
  entry.default_value = entry.value;
  look_at_service(job, entry, place_of(field, job.from));
}

void TwinEntryMaker::look_at_service(const Job& job, const Entry& entry, eds::Position at) {
  constexpr std::uint64_t not_valid = 0x8000'0000;
  constexpr std::uint64_t extended_id = 0x2000'0000;
  constexpr std::uint64_t can_id = 0x7FF;
  if (is_served_cob_id(job.index, job.sub) && is_integer(entry.type)) {
    const bool in_use = job.index == 0x1005 || ((entry.number() & not_valid) != 0) == (job.index == 0x1012);
    if (in_use && (entry.number() & extended_id) != 0) {
      if (!is_pdo_communication(job.index))
        remark(job, at, "cob-id", "29-bit identifiers are not served: the communication object stays silent");
    } else if (in_use && (entry.number() & can_id) == 0) {
      remark(job, at, "cob-id", "CAN-ID 000h is that of NMT: the communication object stays silent");
    }
  }
  if (is_pdo_mapping(job.index) && job.sub == 0 && is_integer(entry.type) && entry.number() >= 0xFE)
    remark(job, at, "mapping", "multiplexed PDOs are not served: the PDO stays silent");
}

Entry TwinEntryMaker::make(const eds::Object& object, std::uint8_t sub, const eds::Entry& from, bool is_sub) {
  const Job job{object, from, object.index.value(), sub, is_sub};
  Entry entry;
  entry.name = from.parameter_name.text;
  set_type(job, entry);
  set_access(job, entry);
  if (entry.type == DataType::boolean) {
    entry.low = 0;
    entry.high = 1;
  }
  set_limits(job, entry);
  set_value(job, entry);
  if (is_variable(entry.type)) {
    const bool writable = entry.access == Access::rw || entry.access == Access::wo || entry.rx_mappable;
    entry.max_size = std::max(entry.value.size(), writable ? twin_text_capacity : std::size_t{0});
  }
  // A program or a log is no parameter.
  if (entry.type == DataType::domain) entry.storable = false;
  return entry;
}

}  // namespace refnode
