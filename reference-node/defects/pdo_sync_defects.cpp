// SPDX-License-Identifier: Apache-2.0
// Defects of synchronous TPDOs: which SYNC sends them, and the SYNC start value; and of what TPDOs carry.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "defects/pdos.hpp"
#include "defects/receivers.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

using Counter = std::optional<std::uint8_t>;

Change at_sync(bool (*sent)(const PdoParameters& pdo, std::uint32_t syncs, bool event, bool right)) {
  return decides(tpdo_traffic, &TransmitPdoRules::sent_at_sync,
                 [sent](const auto& former, const PdoParameters& pdo, std::uint32_t syncs, bool event) {
                   return sent(pdo, syncs, event, former(pdo, syncs, event));
                 });
}

Change begins(bool (*at)(const PdoParameters& pdo, Counter counter, bool right)) {
  return decides(tpdo_traffic, &TransmitPdoRules::counting_begins,
                 [at](const auto& former, const PdoParameters& pdo, Counter counter) {
                   return at(pdo, counter, former(pdo, counter));
                 });
}

/// The TPDO carries something else than what is due.
Change carries(Bytes (*what)(const PdoParameters& pdo, Bytes due)) {
  return decides(tpdo_traffic, &TransmitPdoRules::carried,
                 [what](const auto& former, const PdoParameters& pdo, const Bytes& due) {
                   return what(pdo, former(pdo, due));
                 });
}

/// A TPDO carries what it should have carried the time before; `when` tells which.
Change carries_the_former(bool (*when)(const PdoParameters& pdo)) {
  using Former = std::map<std::uint16_t, Bytes>;
  return decides_by<Former>(
      tpdo_traffic, &TransmitPdoRules::carried,
      [when](Former& before, const auto& former, const PdoParameters& pdo, const Bytes& due) {
        Bytes sent = former(pdo, due);
        const Bytes fresh = sent;
        const auto old = before.find(pdo.number());
        if (old != before.end() && old->second.size() == sent.size() && when(pdo)) sent = old->second;
        before[pdo.number()] = fresh;
        return sent;
      });
}

/// Within the inhibit time a SYNC sends nothing.
void inhibits_synchronous(Parts& parts) {
  const auto sent = std::make_shared<std::map<std::uint16_t, BusTime>>();
  parts.pdos.tpdo.rules.sent_at_sync.replace(
      [&parts, sent](const auto& former, const PdoParameters& pdo, std::uint32_t syncs, bool event) {
        const auto last = sent->find(pdo.number());
        const BusTime now = parts.device.now;
        const bool inhibited = last != sent->end() && now < last->second + pdo.inhibit_time();
        const bool due = former(pdo, syncs, event) && !inhibited;
        if (due) sent->insert_or_assign(pdo.number(), now);
        return due;
      });
  ahead_of_state_change([sent](Parts&) { sent->clear(); })(parts);
}

/// SYNCs that wait for Operational: with its start they send each TPDO whose type has had enough of them.
struct Waiting {
  std::uint32_t syncs = 0;
  BusTime last{};  ///< the last one in Operational
  bool makes_up = false;
};

/// `takes` sees each SYNC, `leaves` the end of Operational.
Change sends_with_the_start(void (*takes)(Waiting& waiting, NmtState state, BusTime now),
                            void (*leaves)(Waiting& waiting, BusTime now)) {
  return [takes, leaves](Parts& parts) {
    const auto waiting = since_boot_up<Waiting>(parts);
    deaf_to([waiting, takes](Parts& node, const Frame& frame) {
      if (is_sync(node, frame)) takes(*waiting, node.device.state, node.device.now);
      return false;
    })(parts);
    ahead_of_state_change([waiting, leaves](Parts& node) {
      if (node.device.state != NmtState::operational) return leaves(*waiting, node.device.now);
      waiting->makes_up = true;
      node.pdos.on_sync(std::nullopt);
      *waiting = {};
    })(parts);
    parts.pdos.tpdo.rules.sent_at_sync.replace(
        [waiting](const auto& former, const PdoParameters& pdo, std::uint32_t syncs, bool event) {
          if (!waiting->makes_up) return former(pdo, syncs, event);
          const std::uint8_t type = pdo.transmission_type();
          return type > 0 && is_synchronous(type) && waiting->syncs >= type;
        });
  };
}

Change sends_for_earlier_syncs() {
  return sends_with_the_start(
      [](Waiting& waiting, NmtState state, BusTime) {
        if (state == NmtState::pre_operational) ++waiting.syncs;
      },
      [](Waiting&, BusTime) {});
}

/// The mark that a SYNC sets is taken back a moment after its TPDO was sent, and not outside Operational.
Change sends_for_the_last_sync() {
  return sends_with_the_start(
      [](Waiting& waiting, NmtState state, BusTime now) {
        if (state == NmtState::operational) waiting.last = now;
      },
      [](Waiting& waiting, BusTime now) {
        constexpr Duration until_looked_at = std::chrono::milliseconds(5);
        if (now - std::exchange(waiting.last, BusTime{}) < until_looked_at) waiting.syncs = 1;
      });
}

/// Who is sent with SYNC is settled when Operational is entered.
void subscribes_with_the_start(Parts& parts) {
  const auto subscribed = std::make_shared<std::set<std::uint16_t>>();
  ahead_of_state_change([subscribed](Parts& node) {
    if (node.device.state != NmtState::operational) return;
    subscribed->clear();
    for (std::uint16_t number = 0; number <= last_pdo; ++number) {
      const auto index = static_cast<std::uint16_t>(0x1800 + number);
      if (!is_event_driven(node.device.dictionary.number(index, 2))) subscribed->insert(number);
    }
  })(parts);
  parts.pdos.tpdo.rules.sent_at_sync.replace(
      [subscribed](const auto& former, const PdoParameters& pdo, std::uint32_t syncs, bool event) {
        return subscribed->contains(pdo.number()) && former(pdo, syncs, event);
      });
}

}  // namespace

DefectTable pdo_sync_defects() {
  return {
      {"tpdo-type-0-never-sent",
       "A TPDO of type 00h is never sent",
       {"PDO-TX-07"},
       at_sync([](const PdoParameters& pdo, std::uint32_t, bool, bool right) {
         return right && pdo.transmission_type() != 0;
       })},
      {"tpdo-type-0-with-event-timer-at-every-sync",
       "A TPDO of type 00h that has an event timer is sent with every SYNC",
       {"PDO-TX-07"},
       at_sync([](const PdoParameters& pdo, std::uint32_t, bool, bool right) {
         const bool timed = pdo.transmission_type() == 0 && pdo.event_timer() > Duration::zero();
         return right || timed;
       })},
      {"tpdo-types-from-80h-never-sent",
       "A TPDO of the types 80h to F0h is not sent with SYNC",
       {"PDO-TX-06"},
       at_sync([](const PdoParameters& pdo, std::uint32_t, bool, bool right) {
         return right && pdo.transmission_type() < 0x80;
       })},
      {"tpdo-type-has-7-bits",
       "Of the transmission type of a TPDO the lower seven bits count",
       {"PDO-TX-06"},
       at_sync([](const PdoParameters& pdo, std::uint32_t syncs, bool, bool right) {
         const std::uint8_t type = pdo.transmission_type();
         return is_synchronous(type) && type >= 0x80 ? syncs >= (type & 0x7FU) : right;
       })},
      {"tpdo-type-f0h-one-late",
       "A TPDO of type F0h is sent with every 241st SYNC",
       {"PDO-TX-06"},
       at_sync([](const PdoParameters& pdo, std::uint32_t syncs, bool, bool right) {
         return pdo.transmission_type() == 0xF0 ? syncs > 0xF0 : right;
       })},
      {"tpdo-last-never-with-sync",
       "The last TPDO is never sent with SYNC",
       {"PDO-TX-05"},
       at_sync([](const PdoParameters& pdo, std::uint32_t, bool, bool right) {
         return right && pdo.number() != last_pdo;
       })},
      {"tpdo-second-cyclic-ratio-wrong",
       "The second TPDO is sent one SYNC too late",
       {"PDO-TX-05", "PDO-TX-06"},
       at_sync([](const PdoParameters& pdo, std::uint32_t syncs, bool, bool right) {
         const std::uint8_t type = pdo.transmission_type();
         return pdo.number() == second_pdo && is_synchronous(type) && type > 0 ? syncs > type : right;
       })},
      {"tpdo-type-fdh-sent-with-sync",
       "A TPDO of type FDh is sent with SYNC, without being asked",
       {"PDO-TX-19"},
       at_sync([](const PdoParameters& pdo, std::uint32_t, bool, bool right) {
         return right || pdo.transmission_type() == 0xFD;
       })},
      {"tpdo-type-ffh-sent-with-sync-as-well",
       "A TPDO of type FFh is sent with every SYNC, beside its events",
       {"PDO-TX-08"},
       at_sync([](const PdoParameters& pdo, std::uint32_t, bool, bool right) {
         return right || pdo.transmission_type() == 0xFF;
       })},
      {"tpdo-of-a-sync-before-the-start",
       "SYNCs in Pre-operational count, and send a synchronous TPDO with NMT start",
       {"PDO-TX-05", "PDO-TX-06"},
       sends_for_earlier_syncs()},
      {"tpdo-of-the-last-sync-sent-with-the-start",
       "A SYNC right before Operational is left sends its TPDO once more with NMT start",
       {"PDO-TX-26"},
       sends_for_the_last_sync()},
      {"tpdo-synchronous-from-the-next-start",
       "A TPDO that becomes a synchronous one in Operational is not sent with SYNC until it is entered again",
       {"PDO-TX-05"},
       Change(subscribes_with_the_start)},
      {"tpdo-event-driven-sent-with-sync-only",
       "A TPDO of type FFh waits with its change for the SYNC",
       {"PDO-TX-08"},
       Change([](Parts& parts) {
         parts.pdos.tpdo.rules.sent_with_event.replace(
             [](const auto&, const PdoParameters&) { return false; });
         parts.pdos.tpdo.rules.sent_at_sync.replace(
             [](const auto& former, const PdoParameters& pdo, std::uint32_t syncs, bool event) {
               return former(pdo, syncs, event) || (event && is_event_driven(pdo.transmission_type()));
             });
       })},
      {"tpdo-one-for-a-sync",
       "With a SYNC the TPDO of the lowest number is sent only",
       {"PDO-TX-27"},
       Change([](Parts& parts) {
         parts.pdos.tpdo.rules.sent_at_sync.replace(
             [&parts, last = std::make_shared<std::optional<BusTime>>()](
                 const auto& former, const PdoParameters& pdo, std::uint32_t syncs, bool event) {
               if (!former(pdo, syncs, event) || *last == parts.device.now) return false;
               *last = parts.device.now;
               return true;
             });
       })},
      {"tpdo-three-for-a-sync",
       "With a SYNC three TPDOs are sent at most",
       {"PDO-TX-27"},
       Change([](Parts& parts) {
         struct Sent {
           BusTime time{};
           unsigned count = 0;
         };
         parts.pdos.tpdo.rules.sent_at_sync.replace(
             [&parts, sent = std::make_shared<Sent>()](const auto& former, const PdoParameters& pdo,
                                                       std::uint32_t syncs, bool event) {
               if (!former(pdo, syncs, event)) return false;
               if (sent->time != parts.device.now) *sent = {parts.device.now, 0};
               return ++sent->count <= 3;
             });
       })},
      {"tpdo-burst-after-pause",
       "After a pause of SYNC a TPDO of type n is sent with each of the first two",
       {"PDO-TX-26", "PDO-TX-06"},
       Change([](Parts& parts) {
         struct Burst {
           BusTime last{};
           unsigned left = 0;
         };
         using All = std::map<std::uint16_t, Burst>;
         parts.pdos.tpdo.rules.sent_at_sync.replace(
             [&parts, all = std::make_shared<All>()](const auto& former, const PdoParameters& pdo,
                                                     std::uint32_t syncs, bool event) {
               Burst& burst = (*all)[pdo.number()];
               if (parts.device.now - burst.last > std::chrono::milliseconds(250)) burst.left = 2;
               burst.last = parts.device.now;
               const std::uint8_t type = pdo.transmission_type();
               if (burst.left > 0 && type > 1 && is_synchronous(type)) {
                 --burst.left;
                 return true;
               }
               return former(pdo, syncs, event);
             });
       })},
      {"tpdo-sync-start-ignored",
       "The SYNC start value has no effect",
       {"PDO-TX-14"},
       begins([](const PdoParameters&, Counter, bool) { return true; })},
      {"tpdo-sync-start-two-late",
       "A TPDO begins to count two SYNCs after its start value",
       {"PDO-TX-14"},
       begins([](const PdoParameters& pdo, Counter counter, bool right) {
         return counter ? *counter == pdo.sync_start() + 2 : right;
       })},
      {"tpdo-sync-start-from-value-on",
       "A TPDO begins to count with a counter of its start value or above",
       {"PDO-TX-14"},
       begins([](const PdoParameters& pdo, Counter counter, bool right) {
         return counter ? *counter >= pdo.sync_start() : right;
       })},
      {"tpdo-sync-start-7-bits",
       "The SYNC start value has seven bits",
       {"PDO-TX-14"},
       begins([](const PdoParameters& pdo, Counter counter, bool right) {
         return counter ? *counter == (pdo.sync_start() & 0x7F) : right;
       })},
      {"tpdo-sync-start-blocks-without-counter",
       "A TPDO with a SYNC start value is not sent while SYNCs have no counter",
       {"PDO-TX-15"},
       begins([](const PdoParameters&, Counter counter, bool right) { return right && counter; })},
      {"tpdo-carries-former-data-with-sync",
       "A synchronous TPDO carries the data of the SYNC before",
       {"PDO-TX-01", "PDO-TX-05"},
       carries_the_former([](const PdoParameters& pdo) { return is_synchronous(pdo.transmission_type()); })},
      {"tpdo-carries-former-data-with-event",
       "An event-driven TPDO carries the data of the event before",
       {"PDO-TX-01"},
       carries_the_former([](const PdoParameters& pdo) { return is_event_driven(pdo.transmission_type()); })},
      {"tpdo-carries-former-data-on-request",
       "A TPDO of type FDh carries the data of the remote frame before",
       {"PDO-TX-19"},
       carries_the_former([](const PdoParameters& pdo) { return pdo.transmission_type() == 0xFD; })},
      {"tpdo-last-carries-zeros",
       "The last TPDO carries zeros",
       {"PDO-TX-01"},
       carries([](const PdoParameters& pdo, Bytes due) {
         return pdo.number() == last_pdo ? Bytes(due.size(), 0) : due;
       })},
      {"tpdo-fifth-byte-on-lost",
       "From the fifth byte on TPDOs carry zeros",
       {"PDO-TX-01"},
       carries([](const PdoParameters&, Bytes due) {
         for (std::size_t i = 4; i < due.size(); ++i) due[i] = 0;
         return due;
       })},
      {"tpdo-bit-7-lost",
       "Of every byte TPDOs carry the lower seven bits only",
       {"PDO-TX-01"},
       carries([](const PdoParameters&, Bytes due) {
         for (std::uint8_t& byte : due) byte &= 0x7F;
         return due;
       })},
      {"tpdo-second-eight-bytes-long",
       "The second TPDO always has eight bytes",
       {"PDO-TX-01"},
       carries([](const PdoParameters& pdo, Bytes due) {
         if (pdo.number() == second_pdo) due.resize(8);
         return due;
       })},
      {"tpdo-last-one-byte-short",
       "The last TPDO lacks its last byte",
       {"PDO-TX-01"},
       carries([](const PdoParameters& pdo, Bytes due) {
         if (pdo.number() == last_pdo && !due.empty()) due.pop_back();
         return due;
       })},
      {"tpdo-third-sent-with-can-id-of-first",
       "The third TPDO is sent with the CAN-ID of the first one",
       {"PDO-TX-09", "PDO-TX-05"},
       Change([](Parts& parts) {
         parts.device.outbox.add_filter(
             [&parts](const FilterContext& context, std::vector<Outgoing>& frames) {
               if (context.service != Service::tpdo) return;
               const auto can_id = [&](std::uint16_t index) {
                 return static_cast<std::uint32_t>(parts.device.dictionary.number(index, 1) & 0x7FFU);
               };
               for (Outgoing& outgoing : frames) {
                 if (outgoing.frame.id == can_id(0x1802)) outgoing.frame.id = can_id(0x1800);
               }
             });
       })},
      {"tpdo-synchronous-inhibited",
       "The inhibit time holds back synchronous TPDOs as well",
       {"PDO-TX-05"},
       Change(inhibits_synchronous)},
      {"tpdo-sync-start-value-once",
       "A TPDO waits for its SYNC start value once; behind another start it counts from the first SYNC on",
       {"PDO-TX-14"},
       decides_by<std::set<std::uint16_t>>(
           tpdo_traffic, &TransmitPdoRules::counting_begins,
           [](std::set<std::uint16_t>& begun, const auto& former, const PdoParameters& pdo, Counter counter) {
             const bool begins = former(pdo, counter) || begun.contains(pdo.number());
             if (begins) begun.insert(pdo.number());
             return begins;
           })},
  };
}

}  // namespace refnode
