// SPDX-License-Identifier: Apache-2.0
// Two texts that are alike: where they differ, and how that is shown.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace conform::reports::html {

/// How many bytes at the beginning and at the end of two texts are the same: whole characters, and none
/// counted twice.
struct SharedEnds {
  std::size_t begin = 0, end = 0;
};
[[nodiscard]] SharedEnds shared_ends(std::string_view one, std::string_view other);

/// Both as markup, with a mark around what differs where that is a part of it. Long ones are shown from
/// shortly before they differ, and at most `width` characters of them.
struct Difference {
  std::string before, after;
};
[[nodiscard]] Difference difference(std::string_view before, std::string_view after, std::size_t width);

}  // namespace conform::reports::html
