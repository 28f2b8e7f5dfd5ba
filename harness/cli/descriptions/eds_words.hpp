// SPDX-License-Identifier: Apache-2.0
// What an entry says, in the words of the field.
#pragma once

#include <string>
#include <string_view>

#include "eds/eds.hpp"

namespace conform::cli {

/// "UNSIGNED32", "type 0040h", or what the file says in its place; raw bytes.
[[nodiscard]] std::string type_words(const eds::Entry& entry);
/// "ARRAY", "RECORD", "DEFSTRUCT"
[[nodiscard]] std::string_view structure_words(const eds::Object& object);
/// "yes", "RPDO", "TPDO", or nothing
[[nodiscard]] std::string_view mapping_words(const eds::Entry& entry);

}  // namespace conform::cli
