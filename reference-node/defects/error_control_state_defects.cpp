// SPDX-License-Identifier: Apache-2.0
// Defects of error control that show in a state that an error has led to, or behind a change of the NMT
// state.
#include <memory>
#include <optional>
#include <utility>

#include "defects/hooks.hpp"
#include "defects/receivers.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

/// Guard requests are not answered in Stopped that an error has led to.
void unguarded_where_an_error_stopped(Parts& parts) {
  parts.guarding.rules.is_answered_in.replace(
      [led = led_by_error(parts)](const auto& former, NmtState state) {
        return former(state) && !(*led && state == NmtState::stopped);
      });
}

/// What is lost in Stopped is not noticed, neither then nor later.
Change unnoticed_in_stopped(ErrorSource source) {
  return [source](Parts& parts) {
    parts.device.errors.raise.replace(
        [&parts, source](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
          if (cause.source != source || parts.device.state != NmtState::stopped) former(cause, detail);
        });
  };
}

/// A loss counts in the NMT state in which the last sign of life came, which `is_sign` tells.
Change unnoticed_in_another_state(ErrorSource source, bool (*is_sign)(const Parts&, const Frame&)) {
  return [source, is_sign](Parts& parts) {
    const auto begun_in = std::make_shared<NmtState>(NmtState::initialising);
    deaf_to([begun_in, is_sign](Parts& node, const Frame& frame) {
      if (is_sign(node, frame)) *begun_in = node.device.state;
      return false;
    })(parts);
    parts.device.errors.raise.replace(
        [&parts, begun_in, source](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
          if (cause.source != source || parts.device.state == *begun_in) former(cause, detail);
        });
  };
}

/// In Stopped guard requests are answered, and that is all.
void life_time_goes_on_in_stopped(Parts& parts) {
  const auto begun = std::make_shared<BusTime>();
  deaf_to([begun](Parts& node, const Frame& frame) {
    if (is_guard_request(node, frame) && node.device.state != NmtState::stopped) *begun = node.device.now;
    return false;
  })(parts);
  parts.guarding.rules.life_time.replace(
      [&parts, begun](const auto& former, std::uint64_t guard_time, std::uint64_t factor) -> Duration {
        const Duration whole = former(guard_time, factor);
        if (parts.device.state != NmtState::stopped || whole == Duration::zero()) return whole;
        return *begun + whole - parts.device.now;
      });
  parts.device.errors.clear.replace([&parts](const auto& former, const ErrorCause& cause) {
    if (cause.source != ErrorSource::guarding || parts.device.state != NmtState::stopped) former(cause);
  });
}

}  // namespace

DefectTable error_control_state_defects() {
  return {
      {"sync-produced-in-stopped-by-error",
       "In Stopped that an error has led to SYNC is produced",
       {"SYNC-PRO-06", "NMT-FSA-23"},
       works_where_led_by_error(Service::sync, NmtState::stopped)},
      {"time-produced-in-stopped-by-error",
       "In Stopped that an error has led to TIME is produced",
       {"TIME-PRO-02", "NMT-FSA-23"},
       works_where_led_by_error(Service::time, NmtState::stopped)},
      {"emcy-sent-in-stopped-by-error",
       "In Stopped that an error has led to the next error is reported",
       {"EMCY-NMT-01", "NMT-FSA-23"},
       works_where_led_by_error(Service::emergency, NmtState::stopped)},
      {"rpdo-processed-in-pre-operational-by-error",
       "In Pre-operational that an error has led to RPDOs are processed",
       {"PDO-RX-02", "NMT-FSA-21"},
       works_where_led_by_error(Service::rpdo, NmtState::pre_operational)},
      {"guard-not-answered-in-stopped-by-error",
       "In Stopped that an error has led to guard requests are not answered",
       {"NMT-SVC-04"},
       Change(unguarded_where_an_error_stopped)},
      {"life-guarding-in-stopped-unnoticed",
       "That guard requests stay away in Stopped is not noticed, nor is it afterwards",
       {"EC-NG-07"},
       unnoticed_in_stopped(ErrorSource::guarding)},
      {"life-guarding-unnoticed-behind-nmt-state",
       "That guard requests stay away is not noticed where the NMT state has changed since the last one",
       {"EC-NG-07"},
       unnoticed_in_another_state(ErrorSource::guarding, is_guard_request)},
      {"life-time-goes-on-in-stopped",
       "Guard requests in Stopped are answered and do not begin the life time anew",
       {"EC-NG-07"},
       Change(life_time_goes_on_in_stopped)},
  };
}

}  // namespace refnode
