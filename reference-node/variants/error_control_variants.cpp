// SPDX-License-Identifier: Apache-2.0
// Heartbeat, its consumer, guarding and the error behaviour.
#include "variants/tools.hpp"

namespace refnode {

using namespace variant;

VariantTable error_control_variants() {
  return {
      {.id = "1016-absent",
       .summary = "no heartbeat consumer",
       .legal = "7.5.2.19: optional",
       .how = absent({0x1016}),
       .group = "1016",
       .lacks = {"heartbeat consumer"}},
      {"1016-one", "monitors one node", "7.5.2.19: 1 to 127", absent_from(0x1016, 2), "1016"},
      {"1016-two", "monitors two nodes", "7.5.2.19: 1 to 127", absent_from(0x1016, 3), "1016"},
      {"1017-10ms", "a heartbeat every 10 ms by default", "OD-1017-02: declared default",
       preset(0x1017, 0, 10), "1017"},
      {"1017-50ms", "a heartbeat every 50 ms by default", "OD-1017-02: declared default",
       preset(0x1017, 0, 50), "1017"},
      {"1017-1s", "a heartbeat every second by default", "OD-1017-02: declared default",
       preset(0x1017, 0, 1000), "1017"},
      {"1017-const", "the heartbeat time is fixed to 100 ms", "7.5.2.20: rw or const",
       both(preset(0x1017, 0, 100), access(0x1017, 0, Access::constant)), "1017"},
      {"1017-const-350ms", "the heartbeat time is fixed to 350 ms", "7.5.2.20: rw or const",
       both(preset(0x1017, 0, 350), access(0x1017, 0, Access::constant)), "1017"},
      {"1017-in-pre-operational-only",
       "the heartbeat time cannot be changed in Operational: 0800 0022h",
       "7.2.4.3.17: 0800 0022h, the present device state",
       also_checked(0x1017, 0,
                    [](const Parts& parts, ByteView) -> Accepted {
                      if (parts.device.state == NmtState::operational)
                        return refuse(abort_code::device_state);
                      return {};
                    }),
       {},
       {"self-starting"}},
      {"abort-1016-reserved-0609-0031", "reserved bits of 1016h are a value too high", "OD-1016-12",
       [](Parts& node) { node.consumer.choices.reserved_bits = abort_code::value_too_high; },
       "1016-reserved"},
      {"abort-1016-reserved-0604-0043", "reserved bits of 1016h are incompatible", "OD-1016-12",
       [](Parts& node) { node.consumer.choices.reserved_bits = abort_code::parameter_incompatible; },
       "1016-reserved"},
      {"1016-reserved-cleared", "reserved bits of 1016h are taken and read back as 0", "OD-1016-12",
       [](Parts& node) { node.consumer.choices.reserved_bits_cleared = true; }, "1016-reserved"},
      {.id = "abort-1016-no-node-0604-0043",
       .summary = "a node-ID that does not exist is incompatible in 1016h",
       .legal = "OD-1016-09, tolerated",
       .how = [](Parts& node) { node.consumer.choices.no_node = abort_code::parameter_incompatible; },
       .warns = {"OD-1016-09"}},
      {.id = "abort-1016-duplicate-0800-0000",
       .summary = "a second entry for one node is a general error",
       .legal = "OD-1016-06, tolerated",
       .how = [](Parts& node) { node.consumer.choices.duplicate = abort_code::general_error; },
       .warns = {"OD-1016-06"}},
      {"heartbeat-at-state-change", "one more heartbeat when the state changes", "EC-HBP-06",
       [](Parts& node) { node.producer.choices.at_state_change = true; }},
      {"heartbeat-restarts-at-state-change",
       "a heartbeat when the state changes, from which the period counts", "EC-HBP-06",
       [](Parts& node) {
         node.producer.choices.at_state_change = node.producer.choices.restarts_at_change = true;
       }},
      {"heartbeat-first-early",
       "the first heartbeat comes half a period after boot-up",
       "EC-HBP-05",
       [](Parts& node) { node.producer.choices.first_early = true; },
       {},
       {"heartbeat-at-once"}},
      {"heartbeat-from-the-last", "a new period counts from the last heartbeat", "EC-HBP-09",
       [](Parts& node) { node.producer.choices.from_last = true; }},
      {.id = "consumer-pauses-in-stopped",
       .summary = "monitoring ends in Stopped, and begins with the next heartbeat behind it",
       .legal = "EC-HBC-03, tolerated: what becomes of a watch that runs into Stopped is not said",
       .how =
           [](Parts& node) {
             node.nmt.on_change = [&node, former = node.nmt.on_change](NmtState from) {
               former(from);
               if (node.device.state == NmtState::stopped || from == NmtState::stopped)
                 node.consumer.on_reset();
             };
           },
       .warns = {"EC-HBC-03"}},
      {"heartbeat-at-once", "the first heartbeat right after 1017h was written, and after boot-up",
       "EC-HBP-02, EC-HBP-05", [](Parts& node) { node.producer.choices.at_once = true; }},
      // What a busy bus adds must stay inside the tolerance of 10 %.
      {"heartbeat-jitter", "heartbeats are 8 % late and early by turns",
       "EC-HBP-01: tolerance of single intervals",
       [](Parts& node) { node.producer.choices.jitter_percent = 8; }},
      {"heartbeat-crosses-reset", "a heartbeat that waits to be sent is sent behind the command of a reset",
       "7.2.8.3.2.2: nobody says what becomes of a frame in the transmit buffer",
       [](Parts& node) { node.producer.choices.crosses_reset = true; }},
      {"consumer-boot-up-new-start", "a boot-up message ends the monitoring until the next heartbeat",
       "EC-HBC-12", [](Parts& node) { node.consumer.choices.boot_up = BootUpOfProducer::new_start; },
       "boot-up-of-producer"},
      {"consumer-boot-up-loss", "a boot-up message of a monitored node is an event", "EC-HBC-12",
       [](Parts& node) { node.consumer.choices.boot_up = BootUpOfProducer::loss; }, "boot-up-of-producer"},
      {"consumer-errors-end-together",
       "the error of a lost node ends when the nodes of all entries of 1016h have been heard",
       "7.2.8.3.2.2: the application is told, no more; 7.2.7: errors of one kind may be one",
       [](Parts& node) { node.consumer.choices.errors_end_together = true; }},
      {.id = "guarding-absent",
       .summary = "neither node guarding nor life guarding",
       .legal = "7.2.8.2.2.1: heartbeat or guarding",
       .how = absent({0x100C, 0x100D}),
       .group = "guarding",
       .lacks = {"node guarding", "life guarding"}},
      {.id = "1017-absent",
       .summary = "is guarded and produces no heartbeat",
       .legal = "7.2.8.2.2.1: heartbeat or guarding",
       .how = absent({0x1017}),
       .group = "guarding",
       .excludes = {"1017"},
       .lacks = {"heartbeat producer"}},
      {.id = "life-guarding-absent",
       .summary = "is guarded and does not watch the guarding",
       .legal = "OD-100C-03: both entries read-only",
       .how = both(access(0x100C, 0, Access::ro), access(0x100D, 0, Access::ro)),
       .group = "guarding",
       .lacks = {"life guarding"}},
      {.id = "guarding-preset",
       .summary = "a life time of 20 s by default",
       .legal = "OD-100C-04, tolerated: a profile-specific default",
       .how = both(preset(0x100C, 0, 10000), preset(0x100D, 0, 2)),
       .group = "guarding",
       .warns = {"OD-100C-04"}},
      {.id = "guard-answered-as-heartbeat",
       .summary = "guard requests beside the heartbeat are answered by the state, without a toggle bit",
       .legal = "EC-HBP-12, tolerated: such a reply is a heartbeat",
       .how = [](Parts& node) { node.guarding.choices.answered_as_heartbeat = true; },
       .warns = {"EC-HBP-12", "EC-NG-11"}},
      {.id = "guarding-refused-beside-heartbeat",
       .summary = "100Ch and 100Dh cannot be written while there is a heartbeat, which is so by default",
       .legal = "7.2.8.2.2.1: one of the two services at a time",
       .how =
           [](Parts& node) {
             preset(0x1017, 0, 1000)(node);
             for (const std::uint16_t index : {std::uint16_t{0x100C}, std::uint16_t{0x100D}}) {
               also_checked(index, 0, [](const Parts& parts, ByteView) -> Accepted {
                 if (parts.device.dictionary.number(0x1017, 0) != 0) return refuse(abort_code::general_error);
                 return {};
               })(node);
             }
           },
       .group = "1017",
       .excludes = {"guarding"},
       .warns = {"SDO-DNL-21"}},
      {.id = "guarding-only-with-life-time",
       .summary = "guard requests are answered while 100Ch and 100Dh are both above 0 only",
       .legal = "EC-NG-09, tolerated: with 0 in either there is no guarding at all",
       .how =
           [](Parts& node) {
             node.guarding.rules.is_answered_with = [](Duration life_time) {
               return life_time > Duration::zero();
             };
           },
       .group = "guarding",
       .warns = {"EC-NG-09"}},
      {.id = "guard-toggle-begins-anew-with-guarding",
       .summary = "guard replies begin with toggle bit 0 when the heartbeat has been switched off",
       .legal = "EC-NG-03, tolerated: the first response after guarding becomes active (7.2.8.3.2.1)",
       .how =
           [](Parts& node) {
             Entry* entry = node.device.dictionary.entry(0x1017, 0);
             if (entry == nullptr) return;
             entry->written = [&node, former = entry->written] {
               if (former) former();
               node.guarding.begin_toggle_anew();
             };
           },
       .excludes = {"1017"},
       .warns = {"EC-NG-03"}},
      {.id = "1029-absent",
       .summary = "the error behaviour cannot be chosen",
       .legal = "7.5.2.32: optional",
       .how = absent({0x1029}),
       .group = "1029",
       .lacks = {"error behaviour"}},
      {"1029-communication-only", "an error behaviour for communication errors only",
       "7.5.2.32: 02h to FEh are optional", absent_from(0x1029, 2), "1029"},
      {"1029-const", "the error behaviour is fixed", "OD-1029-12", access(0x1029, 1, Access::constant),
       "1029"},
      {.id = "1029-stops",
       .summary = "a communication error stops the device by default",
       .legal = "OD-1029-04, tolerated: a profile-specific default",
       .how = preset(0x1029, 1, 2),
       .group = "1029",
       .warns = {"OD-1029-04"}},
  };
}

}  // namespace refnode
