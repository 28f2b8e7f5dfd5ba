// SPDX-License-Identifier: Apache-2.0
// The words a run is judged with.
#pragma once

#include <cstdint>
#include <string_view>

namespace conform::result {

/// Ordered from best to worst, so that the worst of several is the greatest.
enum class Verdict : std::uint8_t {
  not_applicable,  ///< the rule does not concern this device (the reason is given)
  pass,            ///< as the standard names it
  waived,          ///< the device violates the requirement, and somebody answers for it
  warn,            ///< tolerated, or a recommendation not followed
  inconclusive,    ///< a precondition was not reached, the host was late, frames were lost
  error,           ///< the environment failed, or the case was not run to its end
  fail,            ///< the device violates the requirement
};

/// The spelling used in reports and on the command line.
[[nodiscard]] std::string_view to_string(Verdict verdict);
/// The greater of the two in the order above; a failure outranks everything.
[[nodiscard]] constexpr Verdict worst(Verdict a, Verdict b) { return a < b ? b : a; }

}  // namespace conform::result
