// SPDX-License-Identifier: Apache-2.0
// A case that is run several times, to find what happens now and then.
#pragma once

#include <cstddef>
#include <map>
#include <optional>

#include "result/run_result.hpp"

namespace conform::engine {

struct Repeat {
  std::size_t times = 1;    ///< each case, at least 1
  bool until_fail = false;  ///< a case that has failed is not repeated any more
};

/// The repetitions of one case, and what they are worth together: the worst of them, which also tells how
/// many ended alike.
class Repeats {
 public:
  explicit Repeats(Repeat wanted) : wanted_(wanted) {}

  /// True: the case is to be run once more.
  [[nodiscard]] bool again(result::CaseResult seen);
  /// When no further one is needed; at least one was seen.
  [[nodiscard]] result::CaseResult outcome();

 private:
  Repeat wanted_;
  std::size_t count_ = 0;
  std::map<result::Verdict, std::size_t> verdicts_;
  std::optional<result::CaseResult> worst_;
};

}  // namespace conform::engine
