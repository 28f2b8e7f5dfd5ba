// SPDX-License-Identifier: Apache-2.0
// What the other tool can say of a case, and the shape that each of it is shown with.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace conform::reports::html {

/// In the order in which one reads them: what failed first.
[[nodiscard]] std::span<const std::string_view> outcomes_of_the_other_tool();
[[nodiscard]] std::string outcome_badge(std::string_view outcome);

}  // namespace conform::reports::html
