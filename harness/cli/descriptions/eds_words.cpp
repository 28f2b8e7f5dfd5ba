// SPDX-License-Identifier: Apache-2.0
#include "cli/descriptions/eds_words.hpp"

#include <fmt/format.h>

#include "eds/type_table.hpp"

namespace conform::cli {

std::string type_words(const eds::Entry& entry) {
  const auto type = eds::data_type(entry);
  if (!type) return entry.data_type.text;
  const auto* info = eds::find_type(*type);
  return info != nullptr ? std::string(info->name) : fmt::format("type {:04X}h", *type);
}

std::string_view structure_words(const eds::Object& object) {
  const auto code = eds::object_code(object.entry);
  return code == eds::ObjectCode::array       ? "ARRAY"
         : code == eds::ObjectCode::defstruct ? "DEFSTRUCT"
                                              : "RECORD";
}

std::string_view mapping_words(const eds::Entry& entry) {
  switch (eds::pdo_mapping(entry)) {
    case eds::PdoMapping::no: return "";
    case eds::PdoMapping::yes: return "yes";
    case eds::PdoMapping::rpdo_only: return "RPDO";
    case eds::PdoMapping::tpdo_only: return "TPDO";
  }
  return "";
}

}  // namespace conform::cli
