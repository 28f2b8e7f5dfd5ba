// SPDX-License-Identifier: Apache-2.0
// What changed between two descriptions, for example of two firmware versions.
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

/// Compares what the files say about the device: information, dummies, commissioning, and the dictionary in
/// full with what is implied. 0x7 and 7 are the same, so are an empty and a missing entry; [FileInfo],
/// comments, names of modules and the order of sections do not count. Fails as expand() does.
[[nodiscard]] Result<std::vector<Difference>> compare(const EdsFile& before, const EdsFile& after);

}  // namespace conform::eds
