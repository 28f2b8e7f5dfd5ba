// SPDX-License-Identifier: Apache-2.0
// Judges what a scenario is about to send by the table of tiers, and by what the profile says may be written.
#pragma once

#include <string_view>

#include "base/error.hpp"
#include "can/frame.hpp"
#include "device/dictionary.hpp"
#include "device/profile.hpp"
#include "steps/session.hpp"
#include "steps/tier.hpp"

namespace conform::engine {

class TierGuard {
 public:
  TierGuard(const device::Profile& profile, const device::Dictionary& dictionary)
      : profile_(profile), dictionary_(dictionary) {}

  /// What the run allows; no case is of a higher tier.
  void allow(steps::Tier tier) { run_ = tier; }
  void begin_case(steps::Tier tier) { case_ = tier; }
  [[nodiscard]] steps::Tier run() const { return run_; }

  // Errors (of the scenario) say what must not be done, and the risk that the scenario would need.
  [[nodiscard]] Result<void> needs(steps::Need need) const;
  [[nodiscard]] Result<void> judge(const can::Frame& frame) const;
  [[nodiscard]] Result<void> judge(const steps::SdoJob& job) const;
  /// A download to this entry, whatever it holds.
  [[nodiscard]] Result<void> judge_download(Multiplexer object) const;
  /// Whether the profile lets tests write the entry: below 2000h those that are not untouchable, from there
  /// on those that it names.
  [[nodiscard]] bool may_write(Multiplexer object) const;

 private:
  const device::Profile& profile_;
  const device::Dictionary& dictionary_;
  steps::Tier run_ = steps::Tier::motion;
  steps::Tier case_ = steps::Tier::read_only;
};

}  // namespace conform::engine
