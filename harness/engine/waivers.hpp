// SPDX-License-Identifier: Apache-2.0
// Waivers at work: which failures of a run they cover, which have expired, and which are not needed any more.
#pragma once

#include <chrono>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "device/waiver.hpp"
#include "result/run_result.hpp"
#include "scenario/catalogue.hpp"

namespace conform::engine {

/// Whether the waiver is about this judgement of `requirement` in the case, expired or not.
[[nodiscard]] bool covers(const device::Waiver& waiver, std::string_view requirement,
                          const result::CaseResult& one, const result::Judgement& judgement);

class Waivers {
 public:
  /// `waivers` and `catalogue` live longer than this.
  Waivers(std::span<const device::Waiver> waivers, const scenario::Catalogue& catalogue,
          std::chrono::sys_days today);

  /// Failures that a waiver covers become `waived`; what an expired one covers stays a failure and says so.
  void apply(result::CaseResult& one);

  /// What became of each, for the result. `names_a_case`: whether a pattern names any case that there is.
  /// With `strict` one that is not needed any more, or names what does not exist, fails the run.
  [[nodiscard]] std::vector<result::WaiverUse> uses(const result::RunResult& run,
                                                    const std::function<bool(std::string_view)>& names_a_case,
                                                    bool strict) const;

 private:
  struct Work {
    std::string requirement;           ///< by its own id; empty: there is none
    std::vector<std::string> cases{};  ///< that it covered
    bool refused = false;              ///< it would have covered something, but has expired
  };

  [[nodiscard]] bool has_expired(const device::Waiver& waiver) const {
    return waiver.expires && *waiver.expires < today_;
  }

  std::span<const device::Waiver> waivers_;
  std::vector<Work> work_;
  std::chrono::sys_days today_;
};

}  // namespace conform::engine
