// SPDX-License-Identifier: Apache-2.0
// A minimal right description of a device that does not exist yet.
#pragma once

#include <cstdint>
#include <string>

#include "eds/eds.hpp"

namespace conform::cli {

struct NewDescription {
  unsigned profile = 301;  ///< 301, 401, 402
  std::string file_name;
  std::string vendor_name, product_name;  ///< empty: a placeholder
  std::uint32_t vendor = 0, product = 0, revision = 0;
  unsigned rpdos = 0, tpdos = 0;
  std::string date;  ///< mm-dd-yyyy
};

/// In the words of CiA 306. The objects that CiA 301 (and CiA 401 or 402) want, the heartbeat producer, and
/// as many PDOs as asked for, with a mapping that cannot be changed. What only the vendor knows is a
/// placeholder and named in [Comments].
[[nodiscard]] eds::EdsFile new_description(const NewDescription& wanted);

}  // namespace conform::cli
