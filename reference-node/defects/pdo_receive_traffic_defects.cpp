// SPDX-License-Identifier: Apache-2.0
// Defects of received PDOs: which are taken, when, how much of them, and their deadline; also those that only
// one of several PDOs has.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "defects/pdos.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

/// An RPDO is not processed where `ignored` holds.
Change ignores(std::uint16_t number, bool (*ignored)(std::size_t received, std::size_t mapped)) {
  return decides_for(
      number, rpdo_traffic, &ReceivePdoRules::processed,
      [ignored](const auto& former, const PdoParameters& pdo, std::size_t received, std::size_t mapped) {
        return !ignored(received, mapped) && former(pdo, received, mapped);
      });
}

Change processes(std::uint16_t number, bool (*processed)(std::size_t received, std::size_t mapped)) {
  return decides_for(number, rpdo_traffic, &ReceivePdoRules::processed,
                     [processed](const auto&, const PdoParameters&, std::size_t received,
                                 std::size_t mapped) { return processed(received, mapped); });
}

/// Types for which `for_sync` holds wait, the others take effect at once.
Change waits(bool (*for_sync)(std::uint8_t type)) {
  return decides(
      rpdo_traffic, &ReceivePdoRules::waits_for_sync,
      [for_sync](const auto&, const PdoParameters& pdo) { return for_sync(pdo.transmission_type()); });
}

/// An error that RPDOs find does not come through where `lost` says so.
Change loses_errors(bool (*lost)(std::set<std::uint16_t>& before, const ErrorCause& cause)) {
  return decides_by<std::set<std::uint16_t>>(
      +[](Parts& parts) -> Errors& { return parts.device.errors; }, &Errors::raise,
      [lost](std::set<std::uint16_t>& before, const auto& former, const ErrorCause& cause,
             std::uint8_t detail) {
        if (cause.source != ErrorSource::rpdo || !lost(before, cause)) former(cause, detail);
      });
}

Change deadline_of(Duration (*as)(std::int64_t value)) {
  return decides(
      rpdo_parameters, &PdoRules::event_timer,
      [as](const auto&, const PdoParameters&, std::int64_t value) -> Duration { return as(value); });
}

constexpr std::uint16_t too_short = 0x8210;
constexpr std::uint16_t too_late = 0x8250;

/// The length is noted whatever the state is, and looked at in Operational.
void reports_what_came_before(Parts& parts) {
  const auto noted = std::make_shared<bool>(false);
  parts.device.inbox.add_filter([&parts, noted](std::vector<Frame>& frames) {
    if (parts.device.state != NmtState::pre_operational) return;
    for (const Frame& frame : frames) {
      for (std::uint16_t number = 0; number < 4; ++number) {
        const auto& od = parts.device.dictionary;
        const std::uint64_t cob_id = od.number(static_cast<std::uint16_t>(0x1400 + number), 1);
        const auto mapping = static_cast<std::uint16_t>(0x1600 + number);
        const std::size_t bits = bits_held(od, mapping, od.number(mapping, 0));
        if ((cob_id & 0x8000'07FFU) == frame.id && !frame.remote && frame.size() * 8 < bits) *noted = true;
      }
    }
  });
  parts.nmt.on_change = [&parts, noted, former = parts.nmt.on_change](NmtState from) {
    former(from);
    if (parts.device.state == NmtState::operational && std::exchange(*noted, false))
      parts.device.errors.raise({too_short, ErrorSource::rpdo, 1}, 0);
  };
}

}  // namespace

DefectTable pdo_receive_traffic_defects() {
  return {
      {"rpdo-deaf-with-bit-30",
       "An RPDO whose COB-ID has bit 30 set is not received",
       {"PDO-RX-01", "OD-1400-14"},
       decides(rpdo_traffic, &ReceivePdoRules::valid,
               [](const auto& former, const PdoParameters& pdo) {
                 return former(pdo) && pdo.cob_id().remote_allowed();
               })},
      {"rpdo-second-not-processed",
       "The second RPDO is never processed",
       {"PDO-RX-01"},
       ignores(second_pdo, [](std::size_t, std::size_t) { return true; })},
      {"rpdo-last-not-processed",
       "The last RPDO is never processed",
       {"PDO-RX-01"},
       ignores(last_pdo, [](std::size_t, std::size_t) { return true; })},
      {"rpdo-last-short-processed",
       "The last RPDO is processed when it is too short",
       {"PDO-RX-06"},
       processes(last_pdo, [](std::size_t, std::size_t) { return true; })},
      {"rpdo-one-byte-short-processed",
       "The third RPDO is processed when one byte is missing",
       {"PDO-RX-06"},
       processes(third_pdo, [](std::size_t received, std::size_t mapped) { return received + 1 >= mapped; })},
      {"rpdo-second-long-dropped",
       "The second RPDO is dropped when it is too long",
       {"PDO-RX-07"},
       processes(second_pdo, [](std::size_t received, std::size_t mapped) { return received == mapped; })},
      {"rpdo-eight-bytes-dropped",
       "An RPDO of eight bytes is dropped when fewer are mapped",
       {"PDO-RX-07"},
       decides(rpdo_traffic, &ReceivePdoRules::processed,
               [](const auto& former, const PdoParameters& pdo, std::size_t received, std::size_t mapped) {
                 return (received < 8 || mapped == 8) && former(pdo, received, mapped);
               })},
      {"rpdo-last-short-unnoticed",
       "The last RPDO that is too short causes no EMCY",
       {"PDO-RX-06"},
       loses_errors([](std::set<std::uint16_t>&, const ErrorCause& cause) {
         return cause.code == too_short && cause.instance == last_pdo + 1;
       })},
      {"rpdo-short-reported-as-too-long",
       "An RPDO that is too short is reported with EMCY 8220h",
       {"PDO-RX-06"},
       Change([](Parts& parts) {
         parts.device.errors.raise.replace([](const auto& former, ErrorCause cause, std::uint8_t detail) {
           if (cause.source == ErrorSource::rpdo && cause.code == too_short) cause.code = 0x8220;
           former(cause, detail);
         });
       })},
      {"rpdo-processed-when-stopped",
       "RPDOs are processed in Stopped",
       {"PDO-RX-02"},
       together(works_also(Service::rpdo, NmtState::stopped), misreads([](Parts& parts, Frame& frame) {
                  if (parts.device.state == NmtState::stopped) parts.pdos.on_frame(frame);
                }))},
      {"rpdo-dead-after-stop",
       "Once the device was stopped RPDOs are not processed any more",
       {"PDO-RX-02", "PDO-RX-01"},
       Change([](Parts& parts) {
         parts.device.works.replace(
             [stopped = std::make_shared<bool>(false)](const auto& former, Service which, NmtState present) {
               *stopped = *stopped || present == NmtState::stopped;
               return former(which, present) && !(which == Service::rpdo && *stopped);
             });
       })},
      {"rpdo-last-ignores-valid-bit",
       "The last RPDO is received although it is not valid",
       {"OD-1400-09"},
       decides_for(last_pdo, rpdo_traffic, &ReceivePdoRules::valid,
                   [](const auto&, const PdoParameters&) { return true; })},
      {"rpdo-last-stays-on-its-can-id",
       "The last RPDO is received on its default CAN-ID, wherever it was moved",
       {"OD-1400-11"},
       misreads([](Parts& parts, Frame& frame) {
         if (frame.id == 0x500U + parts.device.node_id)
           frame.id = static_cast<std::uint32_t>(parts.device.dictionary.number(0x1403, 1) & 0x7FFU);
       })},
      {"rpdo-back-to-back-lost",
       "Of two RPDOs in frames without a pause the second one is lost",
       {"PDO-RX-16", "PDO-RX-01"},
       Change([](Parts& parts) {
         parts.pdos.rpdo.rules.processed.replace(
             [&parts, last = std::make_shared<std::optional<BusTime>>()](
                 const auto& former, const PdoParameters& pdo, std::size_t received, std::size_t mapped) {
               const BusTime now = parts.device.now;
               const bool busy = *last && now - **last < std::chrono::microseconds(400);
               *last = now;
               return !busy && former(pdo, received, mapped);
             });
       })},
      {"rpdo-one-at-a-time",
       "Of several RPDOs of one millisecond the first one is processed only",
       {"PDO-RX-16"},
       Change([](Parts& parts) {
         using Last = std::pair<BusTime, std::uint16_t>;
         parts.pdos.rpdo.rules.processed.replace(
             [&parts, last = std::make_shared<std::optional<Last>>()](
                 const auto& former, const PdoParameters& pdo, std::size_t received, std::size_t mapped) {
               const BusTime now = parts.device.now;
               if (*last && now - (*last)->first < std::chrono::milliseconds(1) &&
                   (*last)->second != pdo.number())
                 return false;
               *last = Last{now, pdo.number()};
               return former(pdo, received, mapped);
             });
       })},
      {"rpdo-sync-data-mixed",
       "Of two synchronous RPDOs before one SYNC the bits of both are taken",
       {"PDO-RX-04"},
       decides(
           rpdo_traffic, &ReceivePdoRules::kept_for_sync,
           [](const auto&, const PdoParameters&, const std::optional<Bytes>& waiting, const Bytes& received) {
             Bytes both = received;
             for (std::size_t i = 0; waiting && i < std::min(both.size(), waiting->size()); ++i)
               both[i] |= (*waiting)[i];
             return both;
           })},
      {"rpdo-sync-buffer-shared",
       "All synchronous RPDOs share one buffer",
       {"PDO-RX-03"},
       Change([](Parts& parts) {
         const auto buffer = std::make_shared<Bytes>();
         parts.pdos.rpdo.rules.kept_for_sync.replace([buffer](const auto& former, const PdoParameters& pdo,
                                                              const std::optional<Bytes>& waiting,
                                                              const Bytes& received) {
           *buffer = received;
           return former(pdo, waiting, received);
         });
         parts.pdos.rpdo.rules.taken_at_sync.replace(
             [buffer](const auto&, const PdoParameters&, const Bytes& waiting) {
               Bytes taken = *buffer;
               taken.resize(waiting.size());
               return taken;
             });
       })},
      {"rpdo-sync-only-first",
       "With a SYNC only the RPDO of the lowest number takes effect",
       {"PDO-RX-03"},
       Change([](Parts& parts) {
         parts.pdos.rpdo.rules.due_at_sync.replace(
             [&parts, last = std::make_shared<std::optional<BusTime>>()](
                 const auto& former, const PdoParameters& pdo, std::uint32_t syncs) {
               if (*last == parts.device.now) return false;
               *last = parts.device.now;
               return former(pdo, syncs);
             });
       })},
      {"rpdo-type-0-at-once",
       "An RPDO of type 00h takes effect before the SYNC",
       {"PDO-RX-05"},
       waits([](std::uint8_t type) { return type >= 1 && is_synchronous(type); })},
      {"rpdo-types-from-80h-at-once",
       "RPDOs of the types 80h to F0h take effect before the SYNC",
       {"PDO-RX-05"},
       waits([](std::uint8_t type) { return type < 0x80; })},
      {"rpdo-type-f0h-at-once",
       "An RPDO of type F0h takes effect before the SYNC",
       {"PDO-RX-05"},
       waits([](std::uint8_t type) { return type < 0xF0; })},
      {"rpdo-type-feh-waits-for-sync",
       "An RPDO of type FEh waits for the SYNC",
       {"PDO-RX-01"},
       waits([](std::uint8_t type) { return type != 0xFF; })},
      {"rpdo-type-counts-syncs",
       "An RPDO of type n takes effect with the n-th SYNC",
       {"PDO-RX-05"},
       decides(rpdo_traffic, &ReceivePdoRules::due_at_sync,
               [](const auto&, const PdoParameters& pdo, std::uint32_t syncs) {
                 return syncs >= pdo.transmission_type();
               })},
      {"rpdo-last-at-once",
       "The last RPDO takes effect before the SYNC, of whatever type it is",
       {"PDO-RX-03"},
       decides_for(last_pdo, rpdo_traffic, &ReceivePdoRules::waits_for_sync,
                   [](const auto&, const PdoParameters&) { return false; })},
      {"rpdo-deadline-works-once",
       "A deadline that has elapsed is reported the first time only",
       {"PDO-RX-14"},
       loses_errors([](std::set<std::uint16_t>& before, const ErrorCause& cause) {
         return cause.code == too_late && !before.insert(cause.instance).second;
       })},
      {"rpdo-deadline-of-one-only",
       "Of several RPDOs only the first one that is late is reported, until the device is switched off",
       {"PDO-RX-14"},
       loses_errors([](std::set<std::uint16_t>& before, const ErrorCause& cause) {
         if (cause.code != too_late) return false;
         before.insert(cause.instance);
         return before.size() > 1 && *before.begin() != cause.instance;
       })},
      {"rpdo-deadline-stays-late",
       "An RPDO that comes again does not end the error of its deadline",
       {"PDO-RX-14"},
       Change([](Parts& parts) {
         parts.device.errors.clear.replace([](const auto& former, const ErrorCause& cause) {
           if (cause.source != ErrorSource::rpdo || cause.code != too_late) former(cause);
         });
       })},
      {"rpdo-deadline-from-start",
       "The deadline of an RPDO is watched from the start of Operational on",
       {"PDO-RX-14"},
       decides(rpdo_traffic, &ReceivePdoRules::watched_from_start,
               [](const auto&, const PdoParameters&) { return true; })},
      {"rpdo-deadline-8-bits",
       "The deadline of an RPDO has eight bits",
       {"PDO-RX-14"},
       deadline_of([](std::int64_t value) -> Duration { return std::chrono::milliseconds(value & 0xFF); })},
      {"rpdo-deadline-15-bits",
       "The deadline of an RPDO has fifteen bits",
       {"PDO-RX-14"},
       deadline_of([](std::int64_t value) -> Duration { return std::chrono::milliseconds(value & 0x7FFF); })},
      {"rpdo-deadline-unit-wrong",
       "The deadline of an RPDO counts in 100 us",
       {"PDO-RX-14"},
       deadline_of([](std::int64_t value) -> Duration { return std::chrono::microseconds(value * 100); })},
      {"rpdo-deadline-zero-watches",
       "A deadline of 0 is one of 100 ms",
       {"PDO-RX-15"},
       deadline_of([](std::int64_t value) -> Duration {
         return std::chrono::milliseconds(value == 0 ? 100 : value);
       })},
      {"rpdo-last-deadline-ignored",
       "The last RPDO has no deadline",
       {"PDO-RX-14"},
       decides_for(
           last_pdo, rpdo_parameters, &PdoRules::event_timer,
           [](const auto&, const PdoParameters&, std::int64_t) -> Duration { return Duration::zero(); })},
      {"rpdo-high-byte-lost",
       "Of values of two bytes RPDOs bring the lower one only",
       {"PDO-RX-01"},
       receives_values([](const Entry&, Bytes& value) {
         if (value.size() == 2) value[1] = 0;
       })},
      {"rpdo-high-nibble-lost",
       "Of values of one byte RPDOs bring the lower four bits only",
       {"PDO-RX-01"},
       receives_values([](const Entry&, Bytes& value) {
         if (value.size() == 1) value[0] &= 0x0F;
       })},
      {"rpdo-bit-7-lost",
       "Of values of one byte RPDOs bring the lower seven bits only",
       {"PDO-RX-01"},
       receives_values([](const Entry&, Bytes& value) {
         if (value.size() == 1) value[0] &= 0x7F;
       })},
      {"rpdo-short-told-once",
       "Of an RPDO that becomes too short again the first time is reported only",
       {"PDO-RX-06"},
       loses_errors([](std::set<std::uint16_t>& before, const ErrorCause& cause) {
         return cause.code == too_short && !before.insert(cause.instance).second;
       })},
      {"rpdo-length-of-pre-operational-reported",
       "An RPDO that came too short in Pre-operational is reported when Operational is entered",
       {"PDO-RX-02"},
       Change(reports_what_came_before)},
      {"rpdo-event-driven-late-discarded",
       "An event-driven RPDO that comes behind the window of 1007h is discarded",
       {"PDO-RX-01"},
       Change([](Parts& parts) {
         parts.pdos.rpdo.rules.processed.replace([&parts](const auto& former, const PdoParameters& pdo,
                                                          std::size_t received, std::size_t mapped) {
           const bool late = is_event_driven(pdo.transmission_type()) && !parts.pdos.rpdo.in_window();
           return !late && former(pdo, received, mapped);
         });
       })},
      {"rpdo-synchronous-too-long-discarded",
       "A synchronous RPDO that is too long is discarded",
       {"PDO-RX-07"},
       decides(rpdo_traffic, &ReceivePdoRules::processed,
               [](const auto& former, const PdoParameters& pdo, std::size_t received, std::size_t mapped) {
                 const bool discarded = is_synchronous(pdo.transmission_type()) && received > mapped;
                 return !discarded && former(pdo, received, mapped);
               })},
      {"rpdo-deaf-on-can-ids-of-emcy",
       "CAN-IDs from 081h to 0FFh are confirmed for an RPDO, which is not received with them",
       {"OD-1400-11"},
       deaf_to([](Parts&, const Frame& frame) {
         return frame.id > 0x80 && frame.id < 0x100 && !frame.extended && !frame.remote;
       })},
      {"rpdo-without-data-unnoticed",
       "An RPDO without data is taken for no RPDO",
       {"PDO-RX-06"},
       deaf_to([](Parts&, const Frame& frame) {
         return frame.size() == 0 && !frame.remote && frame.id > 0x180 && frame.id < 0x580;
       })},
  };
}

}  // namespace refnode
