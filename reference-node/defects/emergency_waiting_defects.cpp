// SPDX-License-Identifier: Apache-2.0
// Defects of EMCY and of what belongs to it when something else happens beside the error: what waits for the
// inhibit time is dropped or outlives a reset, and the end of an error is told in another way than its
// beginning.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "defects/cob_ids.hpp"
#include "defects/emergencies.hpp"
#include "defects/hooks.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

/// What waits is dropped on one occasion, or kept.
Change on(WhileWaiting occasion, bool kept) {
  return decides(of_emergency_rules, &EmergencyRules::kept_waiting,
                 [=](const auto& former, WhileWaiting now) { return now == occasion ? kept : former(now); });
}

/// EMCY 0000h of one source has the error register of the message before.
Change ends_with_former_register(ErrorSource source) {
  return [source](Parts& parts) {
    const auto before = std::make_shared<std::uint8_t>(0);
    parts.device.outbox.add_filter(
        [before, source](const FilterContext& context, std::vector<Outgoing>& frames) {
          if (context.service != Service::emergency) return;
          for (Outgoing& each : frames) {
            auto& data = each.frame.data;
            if (is_error_reset(each) && data[4] == static_cast<std::uint8_t>(source))
              data[2] = *before;
            else
              *before = data[2];
          }
        });
  };
}

/// The bits of 1001h go all together, with the last of the errors.
void keeps_bits_to_the_end(Parts& parts) {
  const auto kept = std::make_shared<std::uint8_t>(0);
  const auto shown = [&parts, kept](std::uint8_t bits) {
    *kept = parts.emergency.active().empty() ? std::uint8_t{0} : static_cast<std::uint8_t>(*kept | bits);
    return *kept;
  };
  parts.device.errors.raise.replace(
      [&parts, shown](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
        former(cause, detail);
        shown(parts.emergency.error_register());
      });
  reading(0x1001, 0, [shown](Parts&, const Read& former) {
    Upload bits = former();
    if (bits) bits->front() = shown(bits->front());
    return bits;
  })(parts);
  parts.device.outbox.add_filter([shown](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::emergency) return;
    for (Outgoing& each : frames) each.frame.data[2] = shown(each.frame.data[2]);
  });
}

/// The errors of RPDOs are forgotten when Operational ends.
void forgets_errors_of_rpdos(Parts& parts) {
  const auto present = std::make_shared<std::vector<ErrorCause>>();
  const auto quiet = std::make_shared<bool>(false);
  parts.device.errors.raise.replace(
      [present](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
        if (cause.source == ErrorSource::rpdo) present->push_back(cause);
        former(cause, detail);
      });
  parts.device.outbox.add_filter([quiet](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service == Service::emergency && *quiet) frames.clear();
  });
  ahead_of_state_change([present, quiet](Parts& node) {
    if (node.device.state != NmtState::pre_operational) return;
    *quiet = true;
    for (const ErrorCause& cause : std::exchange(*present, {})) node.device.errors.clear(cause);
    *quiet = false;
  })(parts);
}

/// One state empties the history.
Change empties_history_in(NmtState state) {
  return ahead_of_state_change([state](Parts& parts) {
    if (parts.device.state == state) parts.emergency.history.clear();
  });
}

void begins_history_anew_behind_stopped(Parts& parts) {
  const auto stopped = std::make_shared<bool>(false);
  ahead_of_state_change([stopped](Parts& node) {
    if (node.device.state == NmtState::stopped) *stopped = true;
  })(parts);
  parts.device.errors.raise.replace(
      [&parts, stopped](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
        if (std::exchange(*stopped, false)) parts.emergency.history.clear();
        former(cause, detail);
      });
}

void counts_errors_in_8_bits(Parts& parts) {
  const auto count = std::make_shared<std::uint8_t>(std::uint8_t{0});
  parts.device.errors.raise.replace(
      [count](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
        ++*count;
        former(cause, detail);
      });
  reading(0x1003, 0, [count](Parts&, const Read& former) {
    Upload shown = former();
    if (shown && !shown->empty()) shown->front() = std::min(shown->front(), *count);
    return shown;
  })(parts);
}

/// What has been raised is over when the next error comes behind what `begin` tells of, and nobody is told.
struct Forgetting {
  std::vector<ErrorCause> present;
  bool due = false;
  bool silent = false;
};

Change forgets_errors(std::function<void(Parts&, std::shared_ptr<Forgetting>)> begin) {
  return [begin = std::move(begin)](Parts& parts) {
    const auto memory = std::make_shared<Forgetting>();
    begin(parts, memory);
    Errors& errors = parts.device.errors;
    errors.clear.replace([memory](const auto& former, const ErrorCause& cause) {
      std::erase(memory->present, cause);
      former(cause);
    });
    errors.raise.replace([&errors, memory](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
      if (std::exchange(memory->due, false)) {
        memory->silent = true;
        for (const ErrorCause& gone : std::exchange(memory->present, {})) errors.clear(gone);
        memory->silent = false;
      }
      memory->present.push_back(cause);
      former(cause, detail);
    });
    parts.device.outbox.add_filter([memory](const FilterContext& context, std::vector<Outgoing>& frames) {
      if (memory->silent && context.service == Service::emergency) frames.clear();
    });
  };
}

/// Behind a TPDO an EMCY waits for the inhibit time of 1015h.
void waits_behind_tpdos(Parts& parts) {
  const auto last = std::make_shared<std::optional<BusTime>>();
  parts.device.outbox.add_filter([&parts, last](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service == Service::boot_up) last->reset();
    if (context.service == Service::tpdo && !frames.empty()) *last = context.now;
    if (context.service != Service::emergency || !*last) return;
    const Duration inhibit = parts.emergency.rules.inhibit_time(parts.device.time_value(0x1015, 0));
    for (Outgoing& each : frames) each.delay = std::max(each.delay, Duration(**last + inhibit - context.now));
  });
}

/// Where more than one error was there the end of the last one is not told.
void tells_no_end_of_several(Parts& parts) {
  struct Memory {
    bool several = false, quiet = false;
  };
  const auto memory = since_boot_up<Memory>(parts);
  parts.device.errors.clear.replace([&parts, memory](const auto& former, const ErrorCause& cause) {
    const std::size_t present = parts.emergency.active().size();
    memory->several = memory->several || present > 1;
    memory->quiet = memory->several && present == 1;
    former(cause);
    memory->quiet = false;
    if (parts.emergency.active().empty()) memory->several = false;
  });
  parts.device.outbox.add_filter([memory](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service == Service::emergency && memory->quiet) frames.clear();
  });
}

/// One entry takes whatever is written, without a look at what is there.
Change takes_any(std::uint8_t producer) {
  return checking(0x1028, producer, [](Parts&, const Check&, ByteView) -> Accepted { return {}; });
}

}  // namespace

DefectTable emergency_waiting_defects() {
  return {
      {"emcy-end-on-default-can-id",
       "EMCY 0000h is sent on 80h + node-ID, whatever 1014h says",
       {"OD-1014-07"},
       reshape(Service::emergency,
               [](const FilterContext& context, Frame& frame) {
                 if (is_error_reset({frame, {}})) frame.id = 0x80U + context.node_id;
               })},
      {"emcy-newest-first-behind-inhibit-time",
       "Of the messages that wait for the inhibit time the newest is sent first",
       {"EMCY-SEQ-02"},
       decides(of_emergency_rules, &EmergencyRules::oldest_first, [](const auto&) { return false; })},
      {"emcy-end-of-several-missing",
       "Where two errors were there at a time no EMCY 0000h tells that both are gone",
       {"EMCY-SEQ-02"},
       Change(tells_no_end_of_several)},
      {"emcy-inhibited-by-tpdo",
       "The inhibit time of 1015h begins with TPDOs as well",
       {"EMCY-INH-01"},
       Change(waits_behind_tpdos)},
      {"emcy-dropped-by-nmt-state",
       "What waits for the inhibit time of EMCY is dropped by a change of the NMT state",
       {"EMCY-INH-01"},
       on(WhileWaiting::state_change, false)},
      {"emcy-dropped-by-1015",
       "What waits for the inhibit time of EMCY is dropped by a write of 1015h",
       {"EMCY-INH-01"},
       on(WhileWaiting::inhibit_time_written, false)},
      {"emcy-waiting-survives-reset-communication",
       "What waits for the inhibit time of EMCY is sent behind the reset of the communication",
       {"EMCY-SEQ-03"},
       on(WhileWaiting::reset_communication, true)},
      {"emcy-waiting-survives-reset-node",
       "What waits for the inhibit time of EMCY is sent behind the reset of the node",
       {"EMCY-SEQ-03"},
       on(WhileWaiting::reset_node, true)},
      {"1001-bits-go-with-the-last-error",
       "The bits of 1001h stay until the last error has gone",
       {"OD-1001-06"},
       keeps_bits_to_the_end},
      {"emcy-errors-of-rpdos-forgotten-in-pre-operational",
       "Entering Pre-operational ends the errors of RPDOs, and no EMCY tells so",
       {"EMCY-SEQ-02"},
       forgets_errors_of_rpdos},
      {"emcy-end-of-heartbeat-loss-with-register-before",
       "EMCY 0000h of a heartbeat that has come back has the error register of before",
       {"EMCY-FMT-03"},
       ends_with_former_register(ErrorSource::heartbeat)},
      {"emcy-end-of-sync-length-with-register-before",
       "EMCY 0000h behind a SYNC of the wrong length has the error register of before",
       {"EMCY-FMT-03"},
       ends_with_former_register(ErrorSource::sync)},
      {"1003-emptied-by-pre-operational",
       "Entering Pre-operational empties the history of errors",
       {"OD-1003-10"},
       empties_history_in(NmtState::pre_operational)},
      {"1003-emptied-by-stopped",
       "Entering Stopped empties the history of errors",
       {"OD-1003-10"},
       empties_history_in(NmtState::stopped)},
      {"1003-begun-anew-behind-stopped",
       "The first error behind Stopped takes the place of all that the history holds",
       {"OD-1003-10"},
       begins_history_anew_behind_stopped},
      {"errors-of-before-stopped-forgotten",
       "The first error behind Stopped takes the place of those that are there still",
       {"OD-1001-05"},
       forgets_errors([](Parts& parts, const std::shared_ptr<Forgetting>& memory) {
         ahead_of_state_change([memory](Parts& node) {
           if (node.device.state == NmtState::stopped) memory->due = true;
         })(parts);
       })},
      {"errors-forgotten-with-cleared-history",
       "The first error behind a cleared history takes the place of those that are there still",
       {"OD-1001-05"},
       forgets_errors([](Parts& parts, const std::shared_ptr<Forgetting>& memory) {
         after_writing(0x1003, 0, [memory](Parts&, const std::function<void()>& former) {
           former();
           memory->due = true;
         })(parts);
       })},
      {"1003-count-of-256-errors",
       "1003h:00 counts errors in eight bits: behind 256 of them the history looks empty",
       {"OD-1003-10"},
       counts_errors_in_8_bits},
      {"1028-lock-missing-in-one-entry",
       "The CAN-ID of 1028h:03 can be changed while it is valid",
       {"OD-1028-06"},
       takes_any(3)},
  };
}

}  // namespace refnode
