// SPDX-License-Identifier: Apache-2.0
// What differs between two descriptions, of whatever format.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "eds/eds.hpp"

namespace conform::eds {

struct Difference {
  enum class Kind : std::uint8_t { added, removed, changed };
  Kind kind = Kind::changed;
  std::string where;   ///< "1018h:01", "1018h" or "[DeviceInfo]"
  std::string name;    ///< of the object or sub-object, or empty
  std::string key;     ///< what changed: "DefaultValue"; empty when all of it was added or removed
  std::string before;  ///< raw text; empty: the entry says nothing
  std::string after;
  Position at_before;  ///< not known when there is nothing
  Position at_after;
};

struct Comparison {
  std::vector<Difference> of_device;  ///< information, dummies, commissioning and the dictionary in full
  std::vector<Difference> of_file;    ///< [FileInfo] and [Comments]: who wrote it, when, under which name
  /// What one of the two formats has no room for, so that nothing is known of a change.
  std::vector<Difference> unsayable;
};

/// Compares what the files say, with what is implied: values by their data type (same_value.hpp), an empty
/// and a missing entry are the same, so are the words of EDS and XDD for one thing (`rwr` mapped, and `rw`
/// mapped as TPDO). The order of sections, and between two files of CiA 306 their modules, do not count.
/// Fails as expand() does.
[[nodiscard]] Result<Comparison> compare_in_full(const EdsFile& before, const EdsFile& after);

/// compare_in_full(), of the device alone.
[[nodiscard]] Result<std::vector<Difference>> compare(const EdsFile& before, const EdsFile& after);

}  // namespace conform::eds
