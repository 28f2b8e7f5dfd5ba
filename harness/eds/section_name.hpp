// SPDX-License-Identifier: Apache-2.0
// What the name of a section says: [1018sub1], [1A00Value], [M2FixedObjects]...
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "base/strong.hpp"

namespace conform::eds {

enum class SectionKind : std::uint8_t {
  unknown,
  file_info,
  device_info,
  dummy_usage,
  commissioning,
  mandatory_objects,
  optional_objects,
  manufacturer_objects,
  comments,
  tools,
  dynamic_channels,
  object,       ///< [1018]
  sub_object,   ///< [1018sub1]
  names,        ///< [1A00Name]
  values,       ///< [1A00Value]
  denotations,  ///< [1A00Denotation]
  links,        ///< [1A00ObjectLinks]
  supported_modules,
  connected_modules,
  module_info,
  module_comments,
  fixed_list,
  fixed_object,
  fixed_sub_object,
  extension_list,
  extension,
};

struct SectionName {
  SectionKind kind = SectionKind::unknown;
  Index index;
  SubIndex sub;
  std::uint64_t module = 0;
  bool odd_form = false;  ///< leading zeros, 0x, or another number of digits than the standard writes
};

/// Case-insensitive, as everything in CiA 306. What is written with 0x or leading zeros is understood, too.
[[nodiscard]] SectionName parse_section_name(std::string_view name);

}  // namespace conform::eds
