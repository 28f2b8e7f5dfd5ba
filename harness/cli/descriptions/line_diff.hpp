// SPDX-License-Identifier: Apache-2.0
// What changed between two texts, as people know it from patches.
#pragma once

#include <string>
#include <string_view>

namespace conform::cli {

/// Unified, with three lines of context; empty when nothing changed. Bytes that are not printable are
/// escaped, ends of lines left out: it is made to be read. Where much changed it may be longer than need be.
[[nodiscard]] std::string line_diff(std::string_view before, std::string_view after, std::string_view name,
                                    bool colour);

}  // namespace conform::cli
