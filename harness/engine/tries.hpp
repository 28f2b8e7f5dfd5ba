// SPDX-License-Identifier: Apache-2.0
// A case that says nothing about the device, because the host was late, is tried again.
#pragma once

#include <optional>
#include <set>
#include <string>

#include "engine/trust.hpp"
#include "result/run_result.hpp"

namespace conform::engine {

/// The tries of one case, and what they are worth together. A failure that the machine may have caused and
/// that does not come again stays inconclusive: it is never turned into a pass. One that comes in every try
/// is a failure.
class Tries {
 public:
  /// A machine that keeps one answer of a hundred waiting spoils four tries in a row once in a hundred
  /// million.
  static constexpr int most = 4;

  /// What one try gave, as the bus showed it, and what befell the host meanwhile. True: the case is to be
  /// tried again.
  [[nodiscard]] bool again(const result::CaseResult& seen, const std::optional<HostTrouble>& trouble);
  /// The result of the case, when no further try is needed.
  [[nodiscard]] result::CaseResult outcome();

 private:
  /// Rules that did not pass in a try and are in doubt.
  using Doubted = std::set<std::string>;
  [[nodiscard]] result::CaseResult with_failures_of_all() const;

  int count_ = 0;
  std::string why_;                    ///< the first doubt
  bool in_doubt_ = false;              ///< the latest try
  result::CaseResult seen_, trusted_;  ///< the latest try, without and with what its doubt takes away
  int of_machine_ = 0;                 ///< tries in doubt in which the host did nothing wrong
  Doubted always_;                     ///< what is doubted in all of these
  std::set<std::string> met_;          ///< rules that passed in a try in doubt
  std::optional<result::CaseResult> failed_once_;  ///< one of these with a failure
};

}  // namespace conform::engine
