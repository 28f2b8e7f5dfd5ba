// SPDX-License-Identifier: Apache-2.0
// The communication objects of CiA 301 v4.2 (7.5.2) as one table. The lint reads it, and
// device/standard_objects makes the dictionary of it that `run` and `scan` judge by: what they would blame a
// device for because of its file, the lint says first. The reference node has a table of its own, so that no
// mistake cancels itself out.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/strong.hpp"
#include "eds/eds.hpp"

namespace conform::eds {

/// Whether the standard asks for an entry. Conditional: with its feature, or (sub-indices) with its object.
enum class Category : std::uint8_t { mandatory, conditional, optional };

/// What a row says beyond type and access.
enum class StandardFlag : std::uint8_t {
  leaves_access = 1,  ///< the device may make it const (or ro) instead of rw
  adds_node_id = 2,   ///< the default is a constant plus the node-ID
  pdo_mappable = 4,
  may_change = 8,   ///< by itself
  is_command = 16,  ///< a write has an effect other than storing
};

/// A sub-index, or a run of alike ones, of an index or of a run of alike ones.
struct StandardRow {
  static constexpr std::int64_t none = -1;

  std::uint16_t first_index, last_index;
  std::uint8_t first_sub, last_sub;
  std::string_view name;
  std::uint16_t type;  ///< index of the data type
  Access access;       ///< the widest that the standard allows
  Category category;
  ObjectCode object;  ///< of the object that the entry belongs to
  unsigned flags = 0;
  std::int64_t default_value = none;
  std::int64_t low = none;
  std::int64_t high = none;

  [[nodiscard]] bool has(StandardFlag flag) const { return (flags & static_cast<unsigned>(flag)) != 0; }
};

/// By index; of the PDO parameters those that all have in common stand beside those of PDO 1 to 4.
[[nodiscard]] std::span<const StandardRow> standard_rows();
/// nullptr where the standard defines nothing.
[[nodiscard]] const StandardRow* find_standard_row(Multiplexer mux);
/// All rows of an object; empty when the standard does not know it.
[[nodiscard]] std::vector<const StandardRow*> rows_of(Index index);

}  // namespace conform::eds
