// SPDX-License-Identifier: Apache-2.0
// The parts of the page that compares two runs, in their order. Each is markup for one <section>, or empty
// where there is no such difference.
#pragma once

#include <string>
#include <string_view>

#include "reports/compare.hpp"
#include "reports/html/book.hpp"
#include "result/compare.hpp"

namespace conform::reports::html {

/// Values of `data-v`: in what way a row is different.
namespace difference_kind {
inline constexpr std::string_view worse = "worse", better = "better", lost = "lost", other = "different";
}

/// What all parts of the page know.
struct Compared {
  const result::Comparison& comparison;
  const CompareOptions& options;
  Book before, after;

  /// `comparison` knows both runs.
  Compared(const result::Comparison& of, const CompareOptions& how);
};

/// Verdict, what was compared, causes as a list: the first screen.
[[nodiscard]] std::string compared_summary(const Compared& page);
[[nodiscard]] std::string new_section(const Compared& page);
[[nodiscard]] std::string gone_section(const Compared& page);
/// Requirements that turned, or are no longer judged.
[[nodiscard]] std::string turn_section(const Compared& page);
/// Steps that came out otherwise, and scenarios played for other objects.
[[nodiscard]] std::string answer_section(const Compared& page);
[[nodiscard]] std::string dictionary_section(const Compared& page);
[[nodiscard]] std::string times_section(const Compared& page);
/// What could not be compared, and why.
[[nodiscard]] std::string left_out_section(const Compared& page);

}  // namespace conform::reports::html
