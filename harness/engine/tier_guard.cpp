// SPDX-License-Identifier: Apache-2.0
#include "engine/tier_guard.hpp"

#include <algorithm>
#include <string>

#include "base/text.hpp"

namespace conform::engine {
namespace {

/// Writes that the profile asks for to raise an error or to make storing fail.
bool is_trigger(const device::Profile& profile, Multiplexer object) {
  const auto writes = [object](const auto& write) { return write && write->object == object; };
  const auto& fault = profile.store_fault;
  return std::ranges::any_of(profile.errors,
                             [&](const auto& error) { return writes(error.raise) || writes(error.clear); }) ||
         (fault && (fault->arm.object == object || fault->disarm.object == object));
}

bool shortens(const canopen::SdoFault& fault) { return fault.kind == canopen::SdoFault::Kind::shorten; }

}  // namespace

Result<void> TierGuard::needs(steps::Need need) const {
  if (need.covered_by(case_)) return {};
  return fail_scenario(
      "a scenario of risk '" + std::string(steps::word_of(case_)) + "' must not " + std::string(need.what),
      "give the scenario 'risk: " + std::string(steps::word_of(need.tier)) + "'");
}

bool TierGuard::may_write(Multiplexer object) const {
  if (profile_.is_untouchable(object)) return false;
  if (!steps::is_of_application(object.index)) return true;
  const auto* entry = dictionary_.find(object);
  return profile_.is_safe(object) || (entry != nullptr && entry->open_to_writes) ||
         is_trigger(profile_, object);
}

Result<void> TierGuard::judge_download(Multiplexer object) const {
  if (auto allowed = needs(steps::need_of_download(object)); !allowed) return allowed;
  if (may_write(object)) return {};
  if (profile_.is_untouchable(object))
    return fail_scenario(to_string(object) + " must not be written: untouchable in the device profile");
  return fail_scenario(
      to_string(object) + " must not be written: from 2000h on only what the profile calls safe",
      "name it under safe_objects in the device profile");
}

Result<void> TierGuard::judge(const can::Frame& frame) const {
  if (const auto object = steps::download_begun(frame, profile_.node)) {
    if (auto allowed = judge_download(*object); !allowed) return allowed;
  }
  return needs(steps::need_of(frame, profile_.node));
}

Result<void> TierGuard::judge(const steps::SdoJob& job) const {
  // Which node listens there is not known.
  if (job.channel) {
    if (auto allowed = needs({steps::Tier::motion, "use other SDO channels than the default one"}); !allowed)
      return allowed;
  }
  if (!job.request.upload) return judge_download(job.request.object);
  if (std::ranges::any_of(job.request.faults, shortens))
    return needs({steps::Tier::config, "send broken SDO requests"});
  return {};
}

}  // namespace conform::engine
