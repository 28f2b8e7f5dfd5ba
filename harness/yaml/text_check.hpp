// SPDX-License-Identifier: Apache-2.0
// What is refused before the parser sees a byte: it would replace, garble or hide it.
#pragma once

#include "yaml/diagnostic.hpp"

namespace conform::yaml {

/// Size, encoding and characters; false when the text must not reach the parser.
[[nodiscard]] bool check_text(const Source& source, Diagnostics& diagnostics);

}  // namespace conform::yaml
