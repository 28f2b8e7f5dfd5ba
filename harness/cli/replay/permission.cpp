// SPDX-License-Identifier: Apache-2.0
#include "cli/replay/permission.hpp"

#include <cstdint>
#include <string>

#include "base/text.hpp"
#include "engine/tier_guard.hpp"

namespace conform::cli {

Result<void> may_replay(const Side& then, const device::Profile& profile, steps::Tier allowed) {
  const auto dictionary = device::dictionary_of(profile);
  const engine::TierGuard guard(profile, dictionary);
  const auto number = [](std::size_t index) { return "frame " + std::to_string(index + 1); };
  const auto refuse = [&](std::size_t index, const steps::Need& need) -> std::unexpected<Error> {
    return fail("the replay would " + std::string(need.what), number(index),
                "--allow " + std::string(steps::word_of(need.tier)) + " lets it; nothing was sent");
  };
  for (const auto& sent : then.dialogue.sent) {
    const auto& frame = then.at(sent.index).frame;
    constexpr std::uint32_t longest_base_id = 0x7FF;
    if (!frame.extended && frame.id > longest_base_id)
      return fail("is no frame that can be sent: a CAN-ID of 11 bits that has more", number(sent.index),
                  "nothing was sent");
    // Each frame for itself, whatever the capture says that it was: a segment of a block download looks like
    // any other request to a server that has left the transfer, and this one may leave it where that one did
    // not.
    const auto object = steps::download_begun(frame, profile.node);
    const auto need = object ? steps::need_of_download(*object) : steps::need_of(frame, profile.node);
    if (!need.covered_by(allowed)) return refuse(sent.index, need);
    if (!object || guard.may_write(*object)) continue;
    if (profile.is_untouchable(*object)) {
      return fail(
          "the replay would write to " + to_string(*object) + ", which is untouchable in the device profile",
          number(sent.index), "nothing was sent");
    }
    return fail(
        "the replay would write to " + to_string(*object) + ", which the device profile does not call safe",
        number(sent.index), "--device FILE with the profile of the run that was recorded; nothing was sent");
  }
  const steps::Need power{steps::Tier::config, "switch the power of the device"};
  const auto& switches = then.dialogue.power;
  if (!switches.empty() && !power.covered_by(allowed)) return refuse(switches.front(), power);
  return {};
}

}  // namespace conform::cli
