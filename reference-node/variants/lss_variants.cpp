// SPDX-License-Identifier: Apache-2.0
// LSS: slaves without it, without some of its services, and those of older versions of CiA 305.
#include <chrono>

#include "variants/tools.hpp"

namespace refnode {

using namespace variant;
using namespace std::chrono_literals;

namespace {

How choose(void (*how)(LssChoices&)) {
  return [how](Parts& parts) { how(parts.lss.choices); };
}

How answers_after(Duration delay) {
  return [delay](Parts& parts) {
    parts.device.outbox.add_filter([delay](const FilterContext& context, std::vector<Outgoing>& frames) {
      if (context.service != Service::lss) return;
      for (Outgoing& each : frames) each.delay += delay;
    });
  };
}

void works_only_in_stopped(Parts& parts) {
  parts.device.works.replace([](const auto& former, Service service, NmtState state) {
    return former(service, state) && (service != Service::lss || state == NmtState::stopped);
  });
}

}  // namespace

VariantTable lss_variants() {
  return {
      {.id = "lss-absent",
       .summary = "has no layer setting services",
       .legal = "CiA 305 is optional; CiA 306: LSS_Supported=0",
       .how = choose([](LssChoices& lss) { lss.supported = false; }),
       .group = "lss",
       .lacks = {"lss", "lss identify remote slave", "lss identify non-configured", "lss fastscan"}},
      {.id = "lss-without-store",
       .summary = "cannot store what LSS configures",
       .legal = "CiA 305, store configuration: error code 1",
       .how = choose([](LssChoices& lss) { lss.store = false; })},
      {.id = "lss-without-bit-timing",
       .summary = "does not answer the services of bit timing",
       .legal = "LSS-BT-02: no reply",
       .how = choose([](LssChoices& lss) { lss.bit_timing = false; }),
       .group = "lss-bit-timing",
       .warns = {"LSS-BT-01", "LSS-BT-02"}},
      {.id = "lss-bit-rate-fixed",
       .summary = "has a bit rate that switches give",
       .legal = "LSS-BT-01: error code FFh",
       .how = choose([](LssChoices& lss) { lss.bit_rate_fixed = true; }),
       .group = "lss-bit-timing",
       .warns = {"LSS-BT-01"}},
      {.id = "lss-few-bit-rates",
       .summary = "125 kbit/s to 1 Mbit/s only, others are refused with an error code of its own",
       .legal = "CiA 305, configure bit timing: error code FFh",
       .how = choose([](LssChoices& lss) { lss.few_bit_rates = true; }),
       .group = "lss-bit-timing",
       .warns = {"LSS-BT-01"}},
      {.id = "lss-node-id-fixed",
       .summary = "has a node-ID that switches give",
       .legal = "LSS-CN-01: error code FFh",
       .how = choose([](LssChoices& lss) { lss.node_id_fixed = true; }),
       .group = "lss-node-id",
       .warns = {"LSS-CN-01", "LSS-CN-02", "LSS-CN-03"}},
      {.id = "lss-always-configured",
       .summary = "has always a node-ID: FFh is refused",
       .legal = "LSS-CN-03: older versions of CiA 305",
       .how = choose([](LssChoices& lss) { lss.can_be_unconfigured = false; }),
       .group = "lss-node-id",
       .warns = {"LSS-CN-03"}},
      {.id = "lss-node-id-at-once",
       .summary = "works with another node-ID as soon as it leaves the configuration state",
       .legal = "LSS-CN-04: older versions of CiA 305",
       .how = choose([](LssChoices& lss) { lss.node_id_at_once = true; }),
       .warns = {"LSS-CN-04"}},
      {.id = "lss-without-identify",
       .summary = "cannot be found by ranges of its identity",
       .legal = "LSS-ID-01: no reply",
       .how = choose([](LssChoices& lss) { lss.identify_remote_slave = false; }),
       .lacks = {"lss identify remote slave"},
       .warns = {"LSS-ID-01"}},
      {.id = "lss-without-identify-non-configured",
       .summary = "does not tell that it has no node-ID",
       .legal = "LSS-ID-04: no reply",
       .how = choose([](LssChoices& lss) { lss.identify_non_configured = false; }),
       .lacks = {"lss identify non-configured"},
       .warns = {"LSS-ID-04"}},
      {.id = "lss-without-fastscan",
       .summary = "takes no part in fastscan",
       .legal = "LSS-FS-02: no reply",
       .how = choose([](LssChoices& lss) { lss.fastscan = false; }),
       .lacks = {"lss fastscan"},
       .warns = {"LSS-FS-02"}},
      {.id = "lss-only-in-stopped",
       .summary = "listens to LSS in Stopped only",
       .legal = "LSS-GEN-04: older versions of CiA 305",
       .how = works_only_in_stopped,
       .warns = {"LSS-GEN-04"}},
      {.id = "lss-state-survives-reset",
       .summary = "stays in the LSS configuration state over a reset",
       .legal = "LSS-GEN-05: the LSS state machine knows nothing of NMT",
       .how = choose([](LssChoices& lss) { lss.state_survives_reset = true; }),
       .warns = {"LSS-GEN-05"}},
      {.id = "lss-address-in-any-order",
       .summary = "collects the parts of a switch state selective",
       .legal = "LSS-SS-04: some stacks do",
       .how = choose([](LssChoices& lss) { lss.address_in_any_order = true; }),
       .warns = {"LSS-SS-04"}},
      {.id = "lss-slow",
       .summary = "answers LSS requests after 90 ms",
       .legal = "LSS-GEN-07: 100 ms",
       .how = answers_after(90ms)},
  };
}

}  // namespace refnode
