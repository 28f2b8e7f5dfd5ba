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
  const auto memory = since_boot_up<std::map<std::uint16_t, Value>>(parts);
  ahead_of_state_change([memory](Parts&) { memory->clear(); })(parts);
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

/// Parameters that are written in the inhibit time take the alarm that would end it with them.
void dies_in_the_inhibit_time(Parts& parts) {
  struct Memory {
    std::optional<BusTime> sent;
    bool dead = false;
  };
  const auto memory = while_it_runs<Memory>(parts);
  auto& rules = parts.pdos.tpdo.rules;
  rules.carried.replace(
      [memory, &device = parts.device](const auto& former, const PdoParameters& pdo, const Bytes& due) {
        (*memory)[pdo.number()].sent = device.now;
        return former(pdo, due);
      });
  rules.takes_effect.replace([memory, &device = parts.device](const auto& former, const PdoParameters& pdo) {
    Memory& of_this = (*memory)[pdo.number()];
    if (of_this.sent && device.now < *of_this.sent + pdo.inhibit_time()) of_this.dead = true;
    return former(pdo);
  });
  const auto lives = [memory](const auto& former, const PdoParameters& pdo) {
    return !(*memory)[pdo.number()].dead && former(pdo);
  };
  rules.has_event_timer.replace(lives);
  rules.sent_with_event.replace(lives);
}

/// An event timer that is written in Operational runs whatever the type is.
void written_timer_runs(Parts& parts) {
  struct Memory {
    std::optional<Duration> time;
    bool runs = false;
  };
  const auto memory = while_it_runs<Memory>(parts);
  parts.pdos.tpdo.rules.has_event_timer.replace([memory](const auto& former, const PdoParameters& pdo) {
    Memory& of_this = (*memory)[pdo.number()];
    of_this.runs = of_this.runs || (of_this.time && *of_this.time != pdo.event_timer());
    of_this.time = pdo.event_timer();
    return of_this.runs || former(pdo);
  });
}

/// Each time that Operational is entered brings one more event timer, and none ends.
void one_timer_for_each_start(Parts& parts) {
  const auto starts = since_boot_up<int>(parts);
  ahead_of_state_change([starts](Parts& node) {
    if (node.device.state == NmtState::operational) ++*starts;
  })(parts);
  parts.pdos.tpdo.parameters.rules.event_timer.replace(
      [starts](const auto& former, const PdoParameters& pdo, std::int64_t value) {
        return former(pdo, value) / std::max(1, *starts);
      });
}

void no_timer_behind_stopped(Parts& parts) {
  const auto stopped = since_boot_up<bool>(parts);
  ahead_of_state_change([stopped](Parts& node) {
    if (node.device.state == NmtState::stopped) *stopped = true;
    if (node.device.state == NmtState::pre_operational) *stopped = false;
  })(parts);
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

/// What the mapped objects hold at the moment.
Bytes present_data(const Parts& parts, const PdoParameters& pdo) {
  Bytes data(pdo.mapped_size(), 0);
  std::size_t position = 0;  // in bits
  for (const Mapped& mapped : pdo.mapping()) {
    const Upload held =
        parts.device.dictionary.upload({conform::Index(mapped.index), conform::SubIndex(mapped.sub)});
    if (position + mapped.bits > data.size() * 8) break;
    if (held && held->size() == whole_bytes(mapped.bits)) copy_bits(*held, 0, data, position, mapped.bits);
    position += mapped.bits;
  }
  return data;
}

/// Type FCh: what was sampled answers one remote frame.
void uses_up_the_sample(Parts& parts) {
  const auto used = while_it_runs<bool>(parts);
  auto& rules = parts.pdos.tpdo.rules;
  rules.sampled.replace(
      [used](const auto& former, const PdoParameters& pdo, const Bytes& held, const Bytes& now) {
        (*used)[pdo.number()] = false;
        return former(pdo, held, now);
      });
  rules.carried.replace([&parts, used](const auto& former, const PdoParameters& pdo, const Bytes& due) {
    const bool again =
        pdo.transmission_type() == remote_synchronous_type && std::exchange((*used)[pdo.number()], true);
    return former(pdo, again ? present_data(parts, pdo) : due);
  });
}

/// Type FDh: what was there with the last SYNC is sent.
void samples_fdh(Parts& parts) {
  const auto sampled = while_it_runs<Bytes>(parts);
  auto& rules = parts.pdos.tpdo.rules;
  rules.sent_at_sync.replace(
      [&parts, sampled](const auto& former, const PdoParameters& pdo, std::uint32_t syncs, bool event) {
        if (pdo.transmission_type() == remote_event_driven_type)
          (*sampled)[pdo.number()] = present_data(parts, pdo);
        return former(pdo, syncs, event);
      });
  rules.carried.replace([sampled](const auto& former, const PdoParameters& pdo, const Bytes& due) {
    const auto old = sampled->find(pdo.number());
    const bool kept = pdo.transmission_type() == remote_event_driven_type && old != sampled->end();
    return former(pdo, kept ? old->second : due);
  });
}

/// Type FCh: a SYNC behind an answer sends once more.
void sends_behind_an_answer(Parts& parts) {
  const auto answered = while_it_runs<bool>(parts);
  auto& rules = parts.pdos.tpdo.rules;
  rules.answers_remote.replace([answered](const auto& former, const PdoParameters& pdo, bool enabled) {
    const bool answers = former(pdo, enabled);
    if (answers && pdo.transmission_type() == remote_synchronous_type) (*answered)[pdo.number()] = true;
    return answers;
  });
  rules.sent_at_sync.replace(
      [answered](const auto& former, const PdoParameters& pdo, std::uint32_t syncs, bool event) {
        return former(pdo, syncs, event) || std::exchange((*answered)[pdo.number()], false);
      });
}

/// `answers(latched, right)`: `latched` is what bit 30 has allowed when Operational was entered.
Change answers_by_the_start(bool (*answers)(bool latched, bool right)) {
  return [answers](Parts& parts) {
    const auto allowed = std::make_shared<std::set<std::uint16_t>>();
    ahead_of_state_change([allowed](Parts& node) {
      allowed->clear();
      for (std::uint16_t number = 0; number <= last_pdo; ++number) {
        const auto index = static_cast<std::uint16_t>(0x1800 + number);
        if ((node.device.dictionary.number(index, 1, 0x4000'0000U) & 0x4000'0000U) == 0)
          allowed->insert(number);
      }
    })(parts);
    parts.pdos.tpdo.rules.answers_remote.replace(
        [allowed, answers](const auto& former, const PdoParameters& pdo, bool enabled) {
          return enabled && answers(allowed->contains(pdo.number()), former(pdo, enabled));
        });
  };
}

/// The inhibit time holds back a TPDO of type 00h as well.
void inhibits_acyclic(Parts& parts) {
  const auto sent = while_it_runs<BusTime>(parts);
  parts.pdos.tpdo.rules.sent_at_sync.replace(
      [&parts, sent](const auto& former, const PdoParameters& pdo, std::uint32_t syncs, bool event) {
        const auto last = sent->find(pdo.number());
        const BusTime now = parts.device.now;
        const bool inhibited =
            pdo.transmission_type() == 0 && last != sent->end() && now < last->second + pdo.inhibit_time();
        const bool due = former(pdo, syncs, event) && !inhibited;
        if (due) sent->insert_or_assign(pdo.number(), now);
        return due;
      });
}

/// Whoever writes a communication parameter begins to count the SYNCs of all TPDOs anew.
void any_write_restarts_the_count(Parts& parts) {
  const auto counts = while_it_runs<std::uint32_t>(parts);
  for (std::uint16_t number = 0; number <= last_pdo; ++number) {
    after_writing_all(static_cast<std::uint16_t>(0x1800 + number),
                      [counts](Parts&, const std::function<void()>& former, std::uint8_t) {
                        former();
                        counts->clear();
                      })(parts);
  }
  parts.pdos.tpdo.rules.sent_at_sync.replace(
      [counts](const auto& former, const PdoParameters& pdo, std::uint32_t syncs, bool event) {
        const std::uint8_t type = pdo.transmission_type();
        if (type < 2 || !is_synchronous(type)) return former(pdo, syncs, event);
        std::uint32_t& count = (*counts)[pdo.number()];
        const bool due = ++count >= type;
        if (due) count = 0;
        return due;
      });
}

/// An answer to a remote frame leaves the event timer where it has ended.
void answer_ends_the_timer(Parts& parts) {
  struct Memory {
    bool asked = false;
    bool ended = false;
  };
  const auto memory = while_it_runs<Memory>(parts);
  auto& rules = parts.pdos.tpdo.rules;
  rules.answers_remote.replace([memory](const auto& former, const PdoParameters& pdo, bool enabled) {
    const bool answers = former(pdo, enabled);
    (*memory)[pdo.number()].asked = answers;
    return answers;
  });
  rules.carried.replace([memory](const auto& former, const PdoParameters& pdo, const Bytes& due) {
    Memory& of_this = (*memory)[pdo.number()];
    of_this.ended = std::exchange(of_this.asked, false);
    return former(pdo, due);
  });
  rules.has_event_timer.replace([memory](const auto& former, const PdoParameters& pdo) {
    return !(*memory)[pdo.number()].ended && former(pdo);
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
    const auto started = since_boot_up<bool>(parts);
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
      {"tpdo-dead-behind-a-write-in-the-inhibit-time",
       "A TPDO whose parameters are written in its inhibit time is not sent any more until the state changes",
       {"PDO-TX-09"},
       Change(dies_in_the_inhibit_time)},
      {"tpdo-event-timer-written-runs-with-any-type",
       "An event timer that is written in Operational sends a synchronous TPDO",
       {"PDO-TX-11"},
       Change(written_timer_runs)},
      {"tpdo-event-timer-for-each-start",
       "A TPDO has one more event timer each time that Operational is entered",
       {"PDO-TX-09"},
       Change(one_timer_for_each_start)},
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
      {"tpdo-type-fch-sample-used-up",
       "With type FCh a second remote frame behind a SYNC is answered with the present data",
       {"PDO-TX-20"},
       Change(uses_up_the_sample)},
      {"tpdo-type-fch-sent-behind-an-answer",
       "With type FCh the SYNC behind an answered remote frame sends the TPDO unasked",
       {"PDO-TX-20"},
       Change(sends_behind_an_answer)},
      {"tpdo-type-fdh-of-the-last-sync",
       "With type FDh a remote frame is answered with the data of the last SYNC",
       {"PDO-TX-19"},
       Change(samples_fdh)},
      {"tpdo-remote-allowed-with-the-next-start",
       "Bit 30 of the COB-ID that is cleared in Operational allows remote frames behind the next start only",
       {"OD-1800-14"},
       answers_by_the_start([](bool latched, bool right) { return latched && right; })},
      {"tpdo-remote-forbidden-with-the-next-start",
       "Bit 30 of the COB-ID that is set in Operational forbids remote frames behind the next start only",
       {"OD-1800-14"},
       answers_by_the_start([](bool latched, bool right) { return latched || right; })},
      {"tpdo-type-0-inhibited",
       "The inhibit time holds back a TPDO of type 00h",
       {"PDO-TX-07"},
       Change(inhibits_acyclic)},
      {"tpdo-type-feh-not-inhibited",
       "A TPDO of type FEh has no inhibit time",
       {"PDO-TX-12"},
       decides(tpdo_traffic, &TransmitPdoRules::held_back,
               [](const auto& former, const PdoParameters& pdo, TransmitCause cause) {
                 return pdo.transmission_type() != 0xFE && former(pdo, cause);
               })},
      {"tpdo-sync-count-restarted-by-any-write",
       "A write of a communication parameter of one TPDO begins the count of SYNCs of all TPDOs anew",
       {"PDO-TX-06"},
       Change(any_write_restarts_the_count)},
      {"tpdo-event-timer-ended-by-an-answer",
       "Behind the answer to a remote frame the event timer of a TPDO does not run any more",
       {"PDO-TX-09"},
       Change(answer_ends_the_timer)},
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
