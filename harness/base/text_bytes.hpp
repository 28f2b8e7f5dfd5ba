// SPDX-License-Identifier: Apache-2.0
// A text as the bytes that it is, where a file, a digest or a reader takes bytes.
#pragma once

#include <cstdint>
#include <string_view>

#include "base/bytes.hpp"

namespace conform {

/// They are those of `text`, which must outlive them.
[[nodiscard]] inline ByteView bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace conform
