// SPDX-License-Identifier: Apache-2.0
// How requirements hang together: which one cannot be seen to be kept where another one is broken. What
// findings are grouped by (explanations.hpp); it decides no verdict.
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace conform::result {

/// "SDO-SUP-05 SDO-SUP-06" cannot be seen where "SDO-SUP-01" is broken. Lists of ids with a space between; an
/// id that ends in * stands for all that begin so.
struct Ground {
  std::string_view rules;
  std::string_view grounds;  ///< the one that explains most first
};
[[nodiscard]] std::span<const Ground> grounds();

/// Rules that say the same of different services, the one that says it in general first: two of them broken
/// are one fault, and the first one tells it.
[[nodiscard]] std::span<const std::string_view> kin();

/// What everything rests on that is seen through the answer of the SDO server.
[[nodiscard]] std::string_view grounds_of_any_answer();
/// And where there was none.
[[nodiscard]] std::string_view grounds_of_any_silence();
/// And where another value came back than was written.
[[nodiscard]] std::string_view grounds_of_what_is_stored();
/// And where it was an abort.
[[nodiscard]] std::string_view grounds_of_any_abort();

/// About the form of a single frame. A monitor sees it in every frame; where none does, a scenario that found
/// it broken has met something else in place of the frame.
[[nodiscard]] bool is_about_form(std::string_view requirement);

[[nodiscard]] std::vector<std::string_view> words(std::string_view list);
/// Whether `requirement` is `pattern`, or begins as it does before its *.
[[nodiscard]] bool fits(std::string_view pattern, std::string_view requirement);
/// Whether `requirement` is in a list of patterns.
[[nodiscard]] bool is_in(std::string_view list, std::string_view requirement);

}  // namespace conform::result
