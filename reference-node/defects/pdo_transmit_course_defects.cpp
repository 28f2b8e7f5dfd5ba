// SPDX-License-Identifier: Apache-2.0
// Defects of transmitted PDOs that show in what follows only: what ends a timer that runs, the second change
// or SYNC, what was sent shortly before; and of one entry that is mapped.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "defects/pdos.hpp"
#include "pdo/bits.hpp"

namespace refnode {

using namespace defect;

namespace {

/// A memory of every TPDO that ends with the state, and when the PDO is switched off.
template <typename Value>
std::shared_ptr<std::map<std::uint16_t, Value>> while_it_runs(Parts& parts) {
  const auto memory = std::make_shared<std::map<std::uint16_t, Value>>();
  ahead_of_state_change([memory](Parts&) { memory->clear(); })(parts);
  with_boot_up([memory](Parts&) { memory->clear(); })(parts);
  parts.pdos.tpdo.rules.takes_effect.replace([memory](const auto& former, const PdoParameters& pdo) {
    if (!pdo.cob_id().valid()) memory->erase(pdo.number());
    return former(pdo);
  });
  return memory;
}

/// Event timer 0 is looked at when the TPDO is switched on only.
void zero_leaves_the_timer(Parts& parts) {
  const auto running = while_it_runs<std::int64_t>(parts);
  parts.pdos.tpdo.parameters.rules.event_timer.replace(
      [running](const auto& former, const PdoParameters& pdo, std::int64_t value) {
        std::int64_t& time = (*running)[pdo.number()];
        if (value != 0) time = value;
        return former(pdo, time);
      });
}

/// Another type leaves the event timer running.
void type_leaves_the_timer(Parts& parts) {
  const auto running = while_it_runs<bool>(parts);
  parts.pdos.tpdo.rules.has_event_timer.replace([running](const auto& former, const PdoParameters& pdo) {
    bool& runs = (*running)[pdo.number()];
    runs = runs || former(pdo);
    return runs;
  });
}

void no_timer_behind_stopped(Parts& parts) {
  const auto stopped = std::make_shared<bool>(false);
  ahead_of_state_change([stopped](Parts& node) {
    if (node.device.state == NmtState::stopped) *stopped = true;
    if (node.device.state == NmtState::pre_operational) *stopped = false;
  })(parts);
  with_boot_up([stopped](Parts&) { *stopped = false; })(parts);
  parts.pdos.tpdo.rules.has_event_timer.replace(
      [stopped](const auto& former, const PdoParameters& pdo) { return !*stopped && former(pdo); });
}

/// Type 00h: every change before the SYNC asks for a TPDO of its own.
void one_for_each_change(Parts& parts) {
  struct Memory {
    Bytes seen;
    std::uint32_t changes = 0;
  };
  const auto memory = while_it_runs<Memory>(parts);
  auto& rules = parts.pdos.tpdo.rules;
  rules.is_event.replace(
      [memory](const auto& former, const PdoParameters& pdo, const Bytes& sent, const Bytes& now) {
        const bool event = former(pdo, sent, now);
        Memory& of_this = (*memory)[pdo.number()];
        if (event && of_this.seen != now) ++of_this.changes;
        of_this.seen = now;
        return event;
      });
  rules.sent_at_sync.replace(
      [memory](const auto& former, const PdoParameters& pdo, std::uint32_t syncs, bool event) {
        if (pdo.transmission_type() != 0) return former(pdo, syncs, event);
        std::uint32_t& changes = (*memory)[pdo.number()].changes;
        const bool due = former(pdo, syncs, event) || changes > 0;
        if (changes > 0) --changes;
        return due;
      });
}

/// Type FCh: what was sampled is kept until it has been asked for.
void keeps_the_first_sample(Parts& parts) {
  const auto asked = while_it_runs<bool>(parts);
  auto& rules = parts.pdos.tpdo.rules;
  rules.sampled.replace(
      [asked](const auto& former, const PdoParameters& pdo, const Bytes& held, const Bytes& now) {
        const bool gone = std::exchange((*asked)[pdo.number()], false);
        return held.empty() || gone ? former(pdo, held, now) : held;
      });
  rules.carried.replace([asked](const auto& former, const PdoParameters& pdo, const Bytes& due) {
    (*asked)[pdo.number()] = true;
    return former(pdo, due);
  });
}

/// On request only: none within the inhibit time behind another one.
void inhibits_answers(Parts& parts) {
  const auto sent = while_it_runs<BusTime>(parts);
  auto& rules = parts.pdos.tpdo.rules;
  rules.carried.replace([&parts, sent](const auto& former, const PdoParameters& pdo, const Bytes& due) {
    (*sent)[pdo.number()] = parts.device.now;
    return former(pdo, due);
  });
  rules.answers_remote.replace([&parts, sent](const auto& former, const PdoParameters& pdo, bool enabled) {
    const auto last = sent->find(pdo.number());
    const bool inhibited = is_on_remote_request(pdo.transmission_type()) && last != sent->end() &&
                           parts.device.now - last->second < pdo.inhibit_time();
    return !inhibited && former(pdo, enabled);
  });
}

/// `change(mapped, data, position)` is done to what is sent, for every mapped object.
Change carries(void (*change)(const Mapped& mapped, Bytes& data, std::size_t position)) {
  return decides(tpdo_traffic, &TransmitPdoRules::carried,
                 [change](const auto& former, const PdoParameters& pdo, const Bytes& due) {
                   Bytes data = former(pdo, due);
                   std::size_t position = 0;  // in bits
                   for (const Mapped& mapped : pdo.mapping()) {
                     if (position + mapped.bits <= data.size() * 8) change(mapped, data, position);
                     position += mapped.bits;
                   }
                   return data;
                 });
}

/// A change of process data sends its TPDO at once, whatever the state is; or until the first NMT start only.
Change sends_changes_in_other_states(bool until_the_first_start) {
  return [until_the_first_start](Parts& parts) {
    const auto changing = std::make_shared<bool>(false);
    const auto started = std::make_shared<bool>(false);
    with_boot_up([started](Parts&) { *started = false; })(parts);
    ahead_of_state_change([started, until_the_first_start](Parts& node) {
      if (until_the_first_start && node.device.state == NmtState::operational) *started = true;
    })(parts);
    parts.device.works.replace([changing, started](const auto& former, Service service, NmtState state) {
      return (service == Service::tpdo && *changing && !*started) || former(service, state);
    });
    for (auto& [index, object] : parts.device.dictionary.objects()) {
      for (auto& [sub, entry] : object.entries) {
        if (index < 0x2000 || !entry.written) continue;
        entry.written = [changing, former = entry.written] {
          *changing = true;
          former();
          *changing = false;
        };
      }
    }
  };
}

}  // namespace

DefectTable pdo_transmit_course_defects() {
  return {
      {"tpdo-event-timer-from-8000h-never-elapses",
       "An event timer of a TPDO from 8000h on never elapses",
       {"PDO-TX-09"},
       decides(tpdo_parameters, &PdoRules::event_timer,
               [](const auto& former, const PdoParameters& pdo, std::int64_t value) {
                 return former(pdo, value < 0x8000 ? value : 0);
               })},
      {"tpdo-inhibit-time-from-8000h-never-ends",
       "An inhibit time of a TPDO from 8000h on holds back for ever",
       {"PDO-TX-12"},
       decides(tpdo_parameters, &PdoRules::inhibit_time,
               [](const auto& former, const PdoParameters& pdo, std::int64_t value) -> Duration {
                 if (value < 0x8000) return former(pdo, value);
                 return std::chrono::hours(24);
               })},
      {"tpdo-event-timer-runs-on-behind-zero",
       "Event timer 0 that is written in Operational leaves the one that is running",
       {"PDO-TX-10"},
       Change(zero_leaves_the_timer)},
      {"tpdo-event-timer-outlives-its-type",
       "A synchronous type that is written in Operational leaves the event timer running",
       {"PDO-TX-11"},
       Change(type_leaves_the_timer)},
      {"tpdo-event-timer-dead-behind-stopped",
       "When Operational is entered from Stopped the event timer of a TPDO is not started",
       {"PDO-TX-09"},
       Change(no_timer_behind_stopped)},
      {"tpdo-type-feh-without-event-timer",
       "A TPDO of type FEh has no event timer",
       {"PDO-TX-09"},
       decides(tpdo_traffic, &TransmitPdoRules::has_event_timer,
               [](const auto& former, const PdoParameters& pdo) {
                 return pdo.transmission_type() != 0xFE && former(pdo);
               })},
      {"tpdo-type-0-sent-for-each-change",
       "Two changes before a SYNC send a TPDO of type 00h with two SYNCs",
       {"PDO-TX-07"},
       Change(one_for_each_change)},
      {"tpdo-type-fch-first-sample-kept",
       "With type FCh a SYNC samples only when there is no sample that was not asked for",
       {"PDO-TX-20"},
       Change(keeps_the_first_sample)},
      {"tpdo-bit-30-ignored-on-request-only",
       "Bit 30 of the COB-ID does not forbid remote frames with types FCh and FDh",
       {"OD-1800-14"},
       decides(tpdo_traffic, &TransmitPdoRules::answers_remote,
               [](const auto& former, const PdoParameters& pdo, bool enabled) {
                 return is_on_remote_request(pdo.transmission_type()) ? enabled : former(pdo, enabled);
               })},
      {"tpdo-on-request-inhibited",
       "With types FCh and FDh a remote frame within the inhibit time is not answered",
       {"PDO-TX-19"},
       Change(inhibits_answers)},
      {"tpdo-of-a-change-in-every-state",
       "A change of process data is sent in Pre-operational, too, where nothing else sends a TPDO",
       {"PDO-TX-02"},
       sends_changes_in_other_states(false)},
      {"tpdo-of-a-change-before-the-first-start",
       "Between the boot-up and the first NMT start a change of process data is sent",
       {"PDO-TX-02"},
       sends_changes_in_other_states(true)},
      {"tpdo-error-register-always-0",
       "A TPDO that the error register is mapped to carries 00h for it, whatever errors there are",
       {"PDO-TX-01"},
       carries([](const Mapped& mapped, Bytes& data, std::size_t position) {
         constexpr std::uint8_t none[1] = {0};
         if (mapped.index == 0x1001) copy_bits(none, 0, data, position, 8);
       })},
      {"tpdo-second-long-halves-swapped",
       "A TPDO carries an object of four bytes behind four others with its halves swapped",
       {"PDO-TX-01"},
       carries([](const Mapped& mapped, Bytes& data, std::size_t position) {
         if (mapped.bits == 32 && position == 32)
           std::swap_ranges(data.begin() + 4, data.begin() + 6, data.begin() + 6);
       })},
  };
}

}  // namespace refnode
