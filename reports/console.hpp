// SPDX-License-Identifier: Apache-2.0
// The run as text for a terminal or a CI log: pure functions, plain ASCII of our own, colour only when asked
// for.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "result/run_result.hpp"

namespace conform::reports {

struct Style {
  bool colour = false;      ///< ANSI colours
  std::size_t width = 100;  ///< columns to wrap at, at least 60
  std::size_t cards = 0;    ///< at most so many findings of each kind in full, 0 for all
};

/// One line per case, without newline:
/// "pass     cia301/dictionary/1003-error-history/non-zero-write[02h]  OD-1003-06, OD-1003-07  12 ms".
/// What did not pass says why behind it; the line may be longer than the width, logs wrap by themselves.
[[nodiscard]] std::string case_line(const result::CaseResult& one, const Style& style);

/// The whole run: what was tested, requirements by area, whatever needs attention in full, totals and the
/// meaning of the exit code. Ends with a newline.
[[nodiscard]] std::string summary(const result::RunResult& run, const Style& style);

/// One finding in full: the rule, the graded set, what came, the frames around it, the place in the scenario.
[[nodiscard]] std::string finding_card(const result::RunResult& run, const result::CaseResult& one,
                                       const result::Finding& finding, const Style& style);

/// Minutes and seconds, of a long time also hours: "0:41", "1:02:03".
[[nodiscard]] std::string clock_words(Duration time);
/// A time that is guessed, so that it is not told more exactly than it is known: "20 s", "4 min", "2 h".
[[nodiscard]] std::string about(Duration time);

/// A line for a live terminal, never wider than the style: "[ 37/412]  0:41, 4 min left  1 fail  2 warn
/// cia301/sdo/...". `times` may be empty. Of a long name the end is shown. No newline.
[[nodiscard]] std::string progress(std::size_t number, std::size_t total, std::string_view times,
                                   std::string_view name, const result::Counts& counts, const Style& style);

}  // namespace conform::reports
