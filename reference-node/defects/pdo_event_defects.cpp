// SPDX-License-Identifier: Apache-2.0
// Defects of TPDOs that are sent with an event, by the event timer or on remote request, and of the inhibit
// time.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>

#include "defects/pdos.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

/// A change is an event where `seen` says so, of every TPDO.
Change sees_changes(bool (*seen)(const PdoParameters&, const Bytes& sent, const Bytes& now)) {
  return decides(tpdo_traffic, &TransmitPdoRules::is_event,
                 [seen](const auto& former, const PdoParameters& pdo, const Bytes& sent, const Bytes& now) {
                   return former(pdo, sent, now) && seen(pdo, sent, now);
                 });
}

/// Whether one byte of both differs in the bits of `mask`; `first` and `end` bound the bytes looked at.
bool differ(const Bytes& one, const Bytes& other, std::uint8_t mask, std::size_t first = 0,
            std::size_t end = 8) {
  for (std::size_t i = first; i < std::min({one.size(), other.size(), end}); ++i) {
    if (((one[i] ^ other[i]) & mask) != 0) return true;
  }
  return false;
}

Change timer_of(Duration (*as)(std::int64_t value)) {
  return decides(
      tpdo_parameters, &PdoRules::event_timer,
      [as](const auto&, const PdoParameters&, std::int64_t value) -> Duration { return as(value); });
}

Change inhibit_of(Duration (*as)(std::int64_t value)) {
  return decides(
      tpdo_parameters, &PdoRules::inhibit_time,
      [as](const auto&, const PdoParameters&, std::int64_t value) -> Duration { return as(value); });
}

/// What an event timer sends does not come where a SYNC has come since the TPDO before.
void timers_restarted_by_sync(Parts& parts) {
  struct Sent {
    BusTime at{};
    conform::Bytes data;
  };
  const auto sent_by_timer = [&od = parts.device.dictionary](std::uint32_t can_id) {
    for (std::uint16_t index = 0x1800; index <= 0x1800 + last_pdo; ++index) {
      if ((od.number(index, 1) & 0x1FFF'FFFFU) == can_id)
        return is_event_driven(od.number(index, 2)) && od.number(index, 5) != 0;
    }
    return false;
  };
  const auto sync = std::make_shared<std::optional<BusTime>>();
  parts.sync.on_sync = [former = parts.sync.on_sync, sync, &parts](std::optional<std::uint8_t> counter) {
    *sync = parts.device.now;
    former(counter);
  };
  parts.device.outbox.add_filter([sync, sent_by_timer, before = std::map<std::uint32_t, Sent>{}](
                                     const FilterContext& context, std::vector<Outgoing>& frames) mutable {
    if (context.service != Service::tpdo || frames.empty()) return;
    const Frame& frame = frames.front().frame;
    if (!sent_by_timer(frame.id)) return;
    const conform::Bytes data(frame.bytes().begin(), frame.bytes().end());
    Sent& last = before[frame.id];
    const bool by_timer = data == last.data && *sync != context.now;
    if (by_timer && *sync && **sync > last.at) {
      last.at = context.now;
      return frames.clear();
    }
    last = {context.now, data};
  });
}

Change sends_with_event(std::uint8_t type) {
  return decides(tpdo_traffic, &TransmitPdoRules::sent_with_event,
                 [type](const auto& former, const PdoParameters& pdo) {
                   return pdo.transmission_type() == type || former(pdo);
                 });
}

Change sends_by_timer(std::uint8_t type) {
  return decides(tpdo_traffic, &TransmitPdoRules::has_event_timer,
                 [type](const auto& former, const PdoParameters& pdo) {
                   return pdo.transmission_type() == type || former(pdo);
                 });
}

/// The end of the inhibit time sends the TPDO again.
void end_of_inhibit_time_is_an_event(Parts& parts) {
  parts.device.outbox.add_filter([&parts](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::tpdo || frames.empty()) return;
    const Outgoing sent = frames.front();
    for (std::uint16_t index = 0x1800; index < 0x1A00; ++index) {
      const ObjectDictionary& od = parts.device.dictionary;
      const bool its = (od.number(index, 1, 0x80000000) & 0x800007FFU) == sent.frame.id;
      const microseconds inhibit(its ? static_cast<std::int64_t>(od.number(index, 3)) * 100 : 0);
      if (inhibit > microseconds::zero()) frames.push_back({sent.frame, sent.delay + inhibit});
    }
  });
}

/// What the PDO does goes on as before, though the type is another.
Change writes_type_quietly(std::uint16_t index) {
  return after_writing(index, 2, [](Parts&, const std::function<void()>&) {});
}

/// Whether a mapped object has changed is seen by what `looked_at` makes of the data.
Change sees_change_by(Bytes (*looked_at)(const Bytes&)) {
  return decides(
      tpdo_traffic, &TransmitPdoRules::is_event,
      [looked_at](const auto& former, const PdoParameters& pdo, const Bytes& sent, const Bytes& now) {
        return former(pdo, sent, now) && looked_at(sent) != looked_at(now);
      });
}

Bytes sum_of(const Bytes& data) {
  std::uint8_t sum = 0;
  for (const std::uint8_t byte : data) sum = static_cast<std::uint8_t>(sum + byte);
  return {sum};
}
Bytes first_four_of(const Bytes& data) {
  return {data.begin(), data.begin() + std::min<std::ptrdiff_t>(4, std::ssize(data))};
}

/// What a filter of TPDOs does: 18xxh:03 of the one that is sent, and the moment until which it waits.
template <typename Until>
auto holds_back(Parts& parts, Until until) {
  return [&parts, until](const FilterContext& context, std::vector<Outgoing>& frames) mutable {
    if (context.service != Service::tpdo || frames.empty()) return;
    const std::uint32_t id = frames.front().frame.id;
    for (std::uint16_t index = 0x1800; index <= 0x1800 + last_pdo; ++index) {
      if ((parts.device.dictionary.number(index, 1) & 0x7FFU) != id) continue;
      const Duration own = std::chrono::microseconds(parts.device.time_value(index, 3) * 100);
      const BusTime end = until(id, context.now, own);
      if (context.now >= end) continue;
      for (Outgoing& outgoing : frames) outgoing.delay = end - context.now;
    }
  };
}

/// TPDOs without an inhibit time wait for the end of the one that another TPDO has begun.
void shares_inhibit_time(Parts& parts) {
  parts.device.outbox.add_filter(
      holds_back(parts, [running = BusTime{}](std::uint32_t, BusTime now, Duration own) mutable {
        if (own <= Duration::zero()) return running;
        running = now + own;
        return now;
      }));
}

/// A TPDO waits until its inhibit time is over, counted from the start of Operational.
void inhibits_from_the_start(Parts& parts) {
  const auto started = std::make_shared<BusTime>();
  ahead_of_state_change([started](Parts& node) {
    if (node.device.state == NmtState::operational) *started = node.device.now;
  })(parts);
  parts.device.outbox.add_filter(
      holds_back(parts, [started](std::uint32_t, BusTime, Duration own) { return *started + own; }));
}

/// An inhibit time that is running holds the TPDO back until its end, whatever is written meanwhile.
void inhibit_time_outlives_change(Parts& parts) {
  const auto running = std::make_shared<std::map<std::uint32_t, BusTime>>();
  ahead_of_state_change([running](Parts&) { running->clear(); })(parts);
  parts.device.outbox.add_filter(holds_back(parts, [running](std::uint32_t id, BusTime now, Duration own) {
    if (own <= Duration::zero()) return (*running)[id];
    (*running)[id] = now + own;
    return now;
  }));
}

}  // namespace

DefectTable pdo_event_defects() {
  return {
      {"tpdo-type-starts-no-event-timer",
       "An event-driven type that is written in Operational does not start the event timer",
       {"PDO-TX-09"},
       together(writes_type_quietly(0x1800), writes_type_quietly(0x1801), writes_type_quietly(0x1802),
                writes_type_quietly(0x1803))},
      {"tpdo-sent-at-end-of-inhibit-time",
       "The end of the inhibit time sends a TPDO again, without an event",
       {"PDO-TX-09"},
       Change(end_of_inhibit_time_is_an_event)},
      {"tpdo-type-ffh-never-on-change",
       "A change sends no TPDO of type FFh",
       {"PDO-TX-08"},
       sees_changes([](const PdoParameters& pdo, const Bytes&, const Bytes&) {
         return pdo.transmission_type() != 0xFF;
       })},
      {"tpdo-type-feh-never-on-change",
       "A change sends no TPDO of type FEh",
       {"PDO-TX-08"},
       sees_changes([](const PdoParameters& pdo, const Bytes&, const Bytes&) {
         return pdo.transmission_type() != 0xFE;
       })},
      {"tpdo-last-never-on-change",
       "A change does not send the last TPDO",
       {"PDO-TX-08"},
       sees_changes(
           [](const PdoParameters& pdo, const Bytes&, const Bytes&) { return pdo.number() != last_pdo; })},
      {"tpdo-first-byte-watched-only",
       "A change of the first byte of a TPDO is an event only",
       {"PDO-TX-08"},
       sees_changes([](const PdoParameters&, const Bytes& sent, const Bytes& now) {
         return differ(sent, now, 0xFF, 0, 1);
       })},
      {"tpdo-first-byte-not-watched",
       "A change of the first byte of a TPDO is no event",
       {"PDO-TX-08"},
       sees_changes([](const PdoParameters&, const Bytes& sent, const Bytes& now) {
         return differ(sent, now, 0xFF, 1);
       })},
      {"tpdo-last-byte-not-watched",
       "A change of the last byte of a TPDO is no event",
       {"PDO-TX-08"},
       sees_changes([](const PdoParameters&, const Bytes& sent, const Bytes& now) {
         return differ(sent, now, 0xFF, 0, now.size() - 1);
       })},
      {"tpdo-high-bits-not-watched",
       "A change of bits 4 to 7 of a byte is no event",
       {"PDO-TX-08"},
       sees_changes([](const PdoParameters&, const Bytes& sent, const Bytes& now) {
         return differ(sent, now, 0x0F);
       })},
      {"tpdo-low-bit-not-watched",
       "A change of bit 0 of a byte is no event",
       {"PDO-TX-08"},
       sees_changes([](const PdoParameters&, const Bytes& sent, const Bytes& now) {
         return differ(sent, now, 0xFE);
       })},
      {"tpdo-change-back-not-seen",
       "A change to a smaller value is no event",
       {"PDO-TX-08"},
       sees_changes([](const PdoParameters&, const Bytes& sent, const Bytes& now) { return now > sent; })},
      {"tpdo-one-for-a-change",
       "Of two TPDOs with the object that has changed the first one is sent only",
       {"PDO-TX-08"},
       Change([](Parts& parts) {
         parts.pdos.tpdo.rules.is_event.replace(
             [&parts, last = std::make_shared<std::optional<BusTime>>()](
                 const auto& former, const PdoParameters& pdo, const Bytes& sent, const Bytes& now) {
               if (!former(pdo, sent, now) || *last == parts.device.now) return false;
               *last = parts.device.now;
               return true;
             });
       })},
      {"tpdo-change-within-inhibit-time-lost",
       "A change within the inhibit time is not sent after it",
       {"PDO-TX-12", "PDO-TX-08"},
       decides(tpdo_traffic, &TransmitPdoRules::made_up_for,
               [](const auto&, const PdoParameters&) { return false; })},
      {"tpdo-inhibit-ignored-for-changes",
       "The inhibit time holds back the event timer only",
       {"PDO-TX-12"},
       decides(tpdo_traffic, &TransmitPdoRules::held_back,
               [](const auto&, const PdoParameters&, TransmitCause cause) {
                 return cause == TransmitCause::timer;
               })},
      {"tpdo-inhibit-ignored-for-timer",
       "The inhibit time holds back changes only",
       {"PDO-TX-12"},
       decides(tpdo_traffic, &TransmitPdoRules::held_back,
               [](const auto&, const PdoParameters&, TransmitCause cause) {
                 return cause == TransmitCause::change;
               })},
      {"tpdo-inhibit-unit-1ms",
       "The inhibit time counts in milliseconds",
       {"PDO-TX-12"},
       inhibit_of([](std::int64_t value) -> Duration { return milliseconds(value); })},
      {"tpdo-inhibit-8-bits",
       "The inhibit time has eight bits",
       {"PDO-TX-12"},
       inhibit_of([](std::int64_t value) -> Duration { return microseconds((value & 0xFF) * 100); })},
      {"tpdo-inhibit-15-bits",
       "The inhibit time has fifteen bits",
       {"PDO-TX-12"},
       inhibit_of([](std::int64_t value) -> Duration { return microseconds((value & 0x7FFF) * 100); })},
      {"tpdo-last-inhibit-ignored",
       "The last TPDO has no inhibit time",
       {"PDO-TX-12"},
       decides_for(
           last_pdo, tpdo_parameters, &PdoRules::inhibit_time,
           [](const auto&, const PdoParameters&, std::int64_t) -> Duration { return Duration::zero(); })},
      {"tpdo-event-timer-8-bits",
       "The event timer of a TPDO has eight bits",
       {"PDO-TX-09"},
       timer_of([](std::int64_t value) -> Duration { return milliseconds(value & 0xFF); })},
      {"tpdo-event-timer-15-bits",
       "The event timer of a TPDO has fifteen bits",
       {"PDO-TX-09"},
       timer_of([](std::int64_t value) -> Duration { return milliseconds(value & 0x7FFF); })},
      {"tpdo-event-timer-100us",
       "The event timer of a TPDO counts in 100 us",
       {"PDO-TX-09"},
       timer_of([](std::int64_t value) -> Duration { return microseconds(value * 100); })},
      {"tpdo-last-event-timer-ignored",
       "The last TPDO has no event timer",
       {"PDO-TX-09"},
       decides_for(
           last_pdo, tpdo_parameters, &PdoRules::event_timer,
           [](const auto&, const PdoParameters&, std::int64_t) -> Duration { return Duration::zero(); })},
      {"tpdo-event-timer-zero-sends",
       "An event timer of 0 is one of 200 ms",
       {"PDO-TX-10"},
       timer_of([](std::int64_t value) -> Duration { return milliseconds(value == 0 ? 200 : value); })},
      {"tpdo-written-in-operational-without-effect",
       "What is written to a TPDO in Operational has no effect until the device is started again",
       {"PDO-TX-09", "OD-1800-09"},
       decides(tpdo_traffic, &TransmitPdoRules::takes_effect,
               [](const auto&, const PdoParameters&) { return false; })},
      {"tpdo-last-written-in-operational-without-effect",
       "What is written to the last TPDO in Operational has no effect until the device is started again",
       {"PDO-TX-09"},
       decides_for(last_pdo, tpdo_traffic, &TransmitPdoRules::takes_effect,
                   [](const auto&, const PdoParameters&) { return false; })},
      {"tpdo-event-timer-restarted-by-sdo",
       "Every SDO request restarts the event timers",
       {"PDO-TX-09"},
       misreads([](Parts& parts, Frame& frame) {
         if (frame.id == 0x600U + parts.device.node_id && parts.device.state == NmtState::operational)
           parts.pdos.on_boot_up();
       })},
      {"tpdo-event-timer-restarted-by-sync",
       "Every SYNC restarts the event timers",
       {"PDO-TX-09"},
       Change(timers_restarted_by_sync)},
      {"tpdo-type-0-sent-with-event",
       "A TPDO of type 00h is sent with the event, without a SYNC",
       {"PDO-TX-07"},
       sends_with_event(0)},
      {"tpdo-type-0-sent-by-timer",
       "A TPDO of type 00h is sent by the event timer, without a SYNC",
       {"PDO-TX-07"},
       sends_by_timer(0)},
      {"tpdo-type-fdh-sent-with-event",
       "A TPDO of type FDh is sent with an event, without being asked",
       {"PDO-TX-19"},
       sends_with_event(0xFD)},
      {"tpdo-type-fdh-sent-by-timer",
       "A TPDO of type FDh is sent by the event timer, without being asked",
       {"PDO-TX-19"},
       sends_by_timer(0xFD)},
      {"tpdo-type-fch-sent-with-event",
       "A TPDO of type FCh is sent with an event, without being asked",
       {"PDO-TX-20"},
       sends_with_event(0xFC)},
      {"tpdo-answers-remote-while-not-valid",
       "A TPDO that is not valid answers remote frames",
       {"OD-1800-09"},
       Change([](Parts& parts) {
         parts.pdos.tpdo.rules.answers_remote.replace(
             [&parts](const auto& former, const PdoParameters& pdo, bool enabled) {
               const bool works = parts.device.works_now(Service::tpdo) && pdo.mapped_size() > 0;
               return former(pdo, enabled || (works && !pdo.cob_id().valid()));
             });
       })},
      {"tpdo-answers-remote-before-operational",
       "TPDOs answer remote frames in Pre-operational",
       {"PDO-TX-22", "PDO-TX-02"},
       Change([](Parts& parts) {
         parts.pdos.tpdo.rules.answers_remote.replace(
             [&parts](const auto& former, const PdoParameters& pdo, bool enabled) {
               const bool early = parts.device.state == NmtState::pre_operational && pdo.cob_id().valid() &&
                                  pdo.mapped_size() > 0;
               return former(pdo, enabled || early);
             });
       })},
      {"tpdo-last-answers-remote-despite-bit-30",
       "The last TPDO answers remote frames although bit 30 forbids them",
       {"OD-1800-14"},
       decides_for(last_pdo, tpdo_traffic, &TransmitPdoRules::answers_remote,
                   [](const auto&, const PdoParameters&, bool enabled) { return enabled; })},
      {"tpdo-second-answers-no-remote",
       "The second TPDO answers no remote frame",
       {"OD-1800-14", "PDO-TX-19"},
       decides_for(second_pdo, tpdo_traffic, &TransmitPdoRules::answers_remote,
                   [](const auto&, const PdoParameters&, bool) { return false; })},
      {"tpdo-sent-when-stopped",
       "TPDOs are sent in Stopped",
       {"PDO-TX-02"},
       works_also(Service::tpdo, NmtState::stopped)},
      {"tpdo-second-never-sent",
       "The second TPDO is never sent",
       {"PDO-TX-09", "PDO-TX-08", "PDO-TX-05"},
       decides_for(second_pdo, tpdo_traffic, &TransmitPdoRules::valid,
                   [](const auto&, const PdoParameters&) { return false; })},
      {"tpdo-change-seen-by-sum",
       "A change is seen by the sum of all bytes of a TPDO",
       {"PDO-TX-08"},
       sees_change_by(sum_of)},
      {"tpdo-change-behind-4-bytes-not-seen",
       "A change behind the first four bytes of a TPDO is no event",
       {"PDO-TX-08"},
       sees_change_by(first_four_of)},
      {"tpdo-inhibit-time-from-the-start",
       "The inhibit time of a TPDO runs from the start of Operational, whether it was sent or not",
       {"PDO-TX-08"},
       Change(inhibits_from_the_start)},
      {"tpdo-inhibit-time-outlives-change",
       "The inhibit time that runs goes on where the TPDO was switched off and on with another one",
       {"PDO-TX-08"},
       Change(inhibit_time_outlives_change)},
      {"tpdo-inhibit-time-shared",
       "The inhibit time of one TPDO holds back the others as well",
       {"PDO-TX-08"},
       Change(shares_inhibit_time)},
      {"tpdo-last-valid-bit-ignored",
       "The last TPDO is sent although it is not valid",
       {"OD-1800-09"},
       decides_for(last_pdo, tpdo_traffic, &TransmitPdoRules::valid,
                   [](const auto&, const PdoParameters&) { return true; })},
  };
}

}  // namespace refnode
