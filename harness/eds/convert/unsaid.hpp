// SPDX-License-Identifier: Apache-2.0
// What a conversion leaves behind, or has to put in the place of something that is not there.
#pragma once

#include <string>
#include <vector>

#include "eds/eds.hpp"

namespace conform::eds {

struct Unsaid {
  std::string where;  ///< "[DeviceInfo]", "1018h:01", or a part of the source: "[Tools]"
  std::string key;    ///< of CiA 306; empty: all of it
  std::string value;  ///< raw bytes of the source, shortened; empty: none, or not to be quoted
  std::string why;    ///< half a sentence: "CiA 311 has no attribute for it"
  Position at;        ///< in the source; not known when the source says nothing
};

/// A description in the words of another format.
struct Converted {
  EdsFile file;
  std::vector<Unsaid> unsaid;
};

}  // namespace conform::eds
