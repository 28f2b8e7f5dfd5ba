// SPDX-License-Identifier: Apache-2.0
// Defects of TPDOs that show only in some mapping, or only in a configuration that nobody tests on purpose.
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
        parts.device.outbox.add_filter([&parts](const FilterContext& context, std::vector<Outgoing>& frames) {
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
       {"NMT-SVC-05", "OD-1800-09"},
       event_timer_sends_on_000h()},
      {"1800-synchronous-tpdo-too-long",
       "TPDOs of synchronous transmission types have a byte more than is mapped",
       {"PDO-TX-01"},
       Change([](Parts& parts) {
         parts.device.outbox.add_filter(
             [&parts](const FilterContext& context, std::vector<Outgoing>& frames) {
               const bool synchronous = parts.device.dictionary.number(0x1800, 2) <= 240;
               if (context.service != Service::tpdo || !synchronous) return;
               for (Outgoing& outgoing : frames) {
                 if (outgoing.frame.dlc < 8) ++outgoing.frame.dlc;
               }
             });
       })},
  };
}

}  // namespace refnode
