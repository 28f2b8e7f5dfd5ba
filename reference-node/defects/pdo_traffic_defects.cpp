// SPDX-License-Identifier: Apache-2.0
// Defects of TPDOs that show only in some mapping, or only in a configuration that nobody tests on purpose.
#include <chrono>

#include "defects/hooks.hpp"
#include "defects/pdos.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

TransmitPdoRules& traffic(Parts& parts) { return parts.pdos.tpdo.rules; }

/// The event timer of a TPDO that is not valid sends on, with the CAN-ID that is left of its COB-ID.
Change event_timer_sends_on_000h() {
  return together(
      decides(traffic, &TransmitPdoRules::valid,
              [](const auto& former, const PdoParameters& pdo) {
                const bool timed =
                    is_event_driven(pdo.transmission_type()) && pdo.event_timer() > Duration::zero();
                return timed || former(pdo);
              }),
      [](Parts& parts) {
        parts.device.outbox.add_filter(
            [&parts](const FilterContext& context, std::vector<Outgoing>& frames) {
              if (context.service != Service::tpdo) return;
              const auto cob_id = parts.device.dictionary.number(0x1800, 1);
              if ((cob_id & 0x8000'0000U) == 0) return;
              for (Outgoing& outgoing : frames) outgoing.frame.id = 0;
            });
      });
}

}  // namespace

DefectTable pdo_traffic_defects() {
  return {
      {"1800-invalid-tpdo-on-can-id-0",
       "The event timer of a TPDO that is not valid sends it with CAN-ID 000h, where it is an NMT command",
       {"NMT-SVC-05"},
       event_timer_sends_on_000h()},
      {"1a00-odd-length-padded",
       "TPDOs have an even number of bytes, whatever is mapped",
       {"PDO-TX-01"},
       reshape(Service::tpdo,
               [](const FilterContext&, Frame& frame) {
                 if (frame.dlc % 2 == 1) ++frame.dlc;
               })},
      {"1800-last-tpdo-after-operational",
       "A TPDO that is due within 200 ms after Operational has been left is still sent",
       {"PDO-TX-02"},
       Filter([left = BusTime{}](const FilterContext& context, std::vector<Outgoing>& frames) mutable {
         // As if it had been put into the queue for the next cycle of the application.
         if (context.service != Service::tpdo || context.now < left) return;
         left = context.now + std::chrono::seconds(2);
         frames.back().delay = std::chrono::milliseconds(200);
       })},
      {"1800-rtr-only-has-event-timer",
       "The event timer also sends TPDOs of transmission type FDh",
       {"PDO-TX-19"},
       decides(traffic, &TransmitPdoRules::has_event_timer,
               [](const auto& former, std::uint8_t type) { return type == 0xFD || former(type); })},
  };
}

}  // namespace refnode
