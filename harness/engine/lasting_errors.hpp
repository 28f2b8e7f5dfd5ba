// SPDX-License-Identifier: Apache-2.0
// Errors of the device that outlive the case that raised them.
#pragma once

#include <cstddef>

#include "base/time.hpp"
#include "engine/run_context.hpp"

namespace conform::engine {

class LastingErrors {
 public:
  explicit LastingErrors(RunContext& run) : run_(run) {}

  /// Before the first case: whether the device tells of errors (1001h), by EMCY too (1014h), and its inhibit
  /// time (1015h), which the session keeps in mind.
  [[nodiscard]] Result<void> look();
  /// Behind a case: what the inhibit time still holds back would be taken for an EMCY of the next one, and an
  /// error that stays would make the next trigger silent.
  [[nodiscard]] Result<void> end_those_of(const result::CaseResult& result);
  /// Behind a reset that brings an EMCY: what the inhibit time holds back, and the end of the error.
  [[nodiscard]] Result<void> let_end(std::size_t from);

 private:
  [[nodiscard]] Result<bool> has_errors();
  [[nodiscard]] bool has_raised_errors(std::size_t from) const;
  [[nodiscard]] Result<void> await_late_ones(std::size_t from);
  [[nodiscard]] Result<void> let_emcy_end(std::size_t from);
  [[nodiscard]] Result<void> clear_what_stays(const result::CaseResult& result);
  [[nodiscard]] Result<void> await_error_reset(std::size_t from);

  RunContext& run_;
  bool none_at_first_ = false;  ///< 1001h was 0 before the first case, and a reset makes it 0 again
  bool has_messages_ = true;    ///< EMCY is there and valid (1014h)
  int late_in_vain_ = 0;        ///< waits for EMCYs that triggers of the case were to bring
  int in_vain_ = 0;             ///< waits for an EMCY 0000h that did not come: the device sends none
};

}  // namespace conform::engine
