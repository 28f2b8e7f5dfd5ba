// SPDX-License-Identifier: Apache-2.0
// What a device does when somebody whom it monitors is lost: it goes where 1029h says, and serves from then
// on what that state has. Whatever that state lacks is no matter of the service that is missed.
#include <chrono>

#include "canopen/cob_id.hpp"
#include "explore/assign.hpp"

namespace conform::explore {
namespace {

using What = Difference::What;
using Kind = Answer::Kind;

/// A heartbeat of another node while some are monitored, or a guard request while that is.
bool begins_to_monitor(const Evidence& evidence, const Action& action) {
  if (action.kind != Action::Kind::frame || action.frame.extended) return false;
  if (guards(action, evidence))
    return evidence.wrote(0x100C, 0).value_or(0) != 0 && evidence.wrote(0x100D, 0).value_or(0) != 0;
  const auto& frame = action.frame;
  const bool beats = !frame.remote && frame.id > 0x700 && frame.id < 0x780;
  return beats && evidence.some([](const Action& each) {
    return each.kind == Action::Kind::download && each.object.index == Index(0x1016) &&
           load_le(each.data) != 0;
  });
}

/// Time went by since somebody was heard for the last time, and nobody gave a command.
bool somebody_is_lost(const Evidence& evidence) {
  using namespace std::chrono_literals;
  bool heard = false;
  Duration since{};
  for (const auto& each : evidence.conversation) {
    if (begins_to_monitor(evidence, each) && !(heard && since >= 10ms)) {
      heard = true;
      since = {};
    }
    if (each.kind == Action::Kind::power || each.nmt_command(evidence.words.node) != 0) heard = false;
    if (each.kind == Action::Kind::wait) since += each.time;
  }
  return heard && since >= 10ms;
}

std::string rule_of_behaviour(const Evidence& evidence) {
  const auto behaviour = evidence.wrote(0x1029, 1).value_or(0);
  return behaviour == 1 ? "EC-EB-02" : behaviour == 2 ? "EC-EB-03" : "EC-EB-01";
}

}  // namespace

std::optional<Assigned> assign_behind_a_loss(const Evidence& evidence) {
  if (!evidence.operational() || !somebody_is_lost(evidence)) return std::nullopt;
  const auto& difference = evidence.difference();
  if (difference.what == What::answer) {
    const bool one_is_silent =
        (difference.device.kind == Kind::silence) != (difference.model.kind == Kind::silence);
    return one_is_silent ? strains(rule_of_behaviour(evidence)) : std::nullopt;
  }
  if (!difference.is_about_a_frame()) return std::nullopt;
  const auto set = canopen::connection_set(evidence.words.node);
  const auto& frame = frame_of(evidence);
  if (frame.is_data(set.error_control) && difference.what == What::other_data) {
    const auto state = [](const can::Frame& each) { return each.data[0] & 0x7FU; };
    const bool other_state = difference.came.dlc == 1 && state(difference.came) != 0 &&
                             state(difference.due) != 0 && state(difference.came) != state(difference.due);
    return other_state ? violates(rule_of_behaviour(evidence)) : std::nullopt;
  }
  // SYNC, TIME and PDOs come in some states only; that the loss is told by an EMCY is another rule.
  const bool of_a_state = frame.is_data(canopen::sync_can_id) || frame.is_data(canopen::time_can_id) ||
                          (!frame.extended && frame.id > 0x180 && frame.id < 0x580);
  return of_a_state && difference.what != What::other_data ? strains(rule_of_behaviour(evidence))
                                                           : std::nullopt;
}

}  // namespace conform::explore
