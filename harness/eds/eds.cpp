// SPDX-License-Identifier: Apache-2.0
#include "eds/eds.hpp"

#include <algorithm>

#include "eds/ini_file.hpp"

namespace conform::eds {

std::string_view to_string(Format format) {
  switch (format) {
    case Format::eds: return "EDS";
    case Format::dcf: return "DCF";
    case Format::xdd: return "XDD";
    case Format::xdc: return "XDC";
  }
  return "EDS";
}

const Entry* Object::find(SubIndex sub) const {
  const auto found = std::ranges::lower_bound(subs, sub, {}, &SubObject::sub);
  return found != subs.end() && found->sub == sub ? &found->entry : nullptr;
}

const Object* find_object(const std::vector<Object>& objects, Index index) {
  const auto found = std::ranges::lower_bound(objects, index, {}, &Object::index);
  return found != objects.end() && found->index == index ? &*found : nullptr;
}

const Object* EdsFile::find(Index index) const { return find_object(objects, index); }

const Entry* EdsFile::find(Multiplexer mux) const {
  const auto* object = find(mux.index);
  if (object == nullptr) return nullptr;
  if (const auto* sub = object->find(mux.sub)) return sub;
  return mux.sub == SubIndex(0) && !is_structured(*object) ? &object->entry : nullptr;
}

std::optional<std::uint64_t> number_of(const Field& field) {
  const auto number = parse_number(field.text);
  if (!number || number->negative || number->node_id) return std::nullopt;
  return number->magnitude;
}

std::optional<bool> flag_of(const Field& field) {
  if (same_word(field.text, "true")) return true;
  if (same_word(field.text, "false")) return false;
  const auto number = number_of(field);
  if (!number || *number > 1) return std::nullopt;
  return *number == 1;
}

std::optional<ObjectCode> object_code(const Entry& entry) {
  if (entry.object_type.empty()) return ObjectCode::var;
  switch (number_of(entry.object_type).value_or(0xFF)) {
    case 0: return ObjectCode::null;
    case 2: return ObjectCode::domain;
    case 5: return ObjectCode::deftype;
    case 6: return ObjectCode::defstruct;
    case 7: return ObjectCode::var;
    case 8: return ObjectCode::array;
    case 9: return ObjectCode::record;
    default: return std::nullopt;
  }
}

std::optional<std::uint16_t> data_type(const Entry& entry) {
  const auto number = number_of(entry.data_type);
  if (!number || *number > 0xFFFF) return std::nullopt;
  return static_cast<std::uint16_t>(*number);
}

std::optional<Access> access(const Entry& entry) {
  struct Row {
    std::string_view word;
    Access access;
  };
  static constexpr Row rows[] = {{"ro", Access::ro},   {"wo", Access::wo},   {"rw", Access::rw},
                                 {"rwr", Access::rwr}, {"rww", Access::rww}, {"const", Access::constant}};
  const auto word = without_comment(entry.access_type.text);
  for (const auto& row : rows) {
    if (same_word(word, row.word)) return row.access;
  }
  return std::nullopt;
}

PdoMapping pdo_mapping(const Entry& entry) {
  const auto& text = entry.pdo_mapping.text;
  if (const auto number = number_of(entry.pdo_mapping))
    return *number != 0 ? PdoMapping::yes : PdoMapping::no;
  if (same_word(text, "optional") || same_word(text, "default")) return PdoMapping::yes;
  if (same_word(text, "TPDO")) return PdoMapping::tpdo_only;
  if (same_word(text, "RPDO")) return PdoMapping::rpdo_only;
  return PdoMapping::no;
}

bool refuses_write(const Entry& entry) { return (number_of(entry.obj_flags).value_or(0) & 1U) != 0; }
bool refuses_read(const Entry& entry) { return (number_of(entry.obj_flags).value_or(0) & 2U) != 0; }

bool is_structured(const Object& object) {
  if (!object.subs.empty() || number_of(object.compact_sub_obj).value_or(0) > 0) return true;
  const auto code = object_code(object.entry);
  return code == ObjectCode::array || code == ObjectCode::record || code == ObjectCode::defstruct;
}

bool can_be_read(Access access) { return access != Access::wo; }
bool can_be_written(Access access) { return access != Access::ro && access != Access::constant; }

}  // namespace conform::eds
