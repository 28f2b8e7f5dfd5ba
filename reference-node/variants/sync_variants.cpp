// SPDX-License-Identifier: Apache-2.0
// SYNC, its counter and its window.
#include "variants/tools.hpp"

namespace refnode {

using namespace variant;

namespace {

void consumes_only(Parts& parts) { parts.sync.cob_id_rules.choices.produced = false; }

/// A producer with another choice.
How producer(void (*choose)(SyncProducerChoices&)) {
  return [choose](Parts& parts) { choose(parts.sync_producer.choices); };
}

}  // namespace

VariantTable sync_variants() {
  return {
      {.id = "sync-absent",
       .summary = "no SYNC: 1005h to 1007h and 1019h absent, no synchronous PDO",
       .legal = "7.5.2.5: 1005h is for devices that support SYNC",
       .how = both(absent({0x1005, 0x1006, 0x1007, 0x1019}),
                   choose_of_pdos([](PdoChoices& c) { c.synchronous_types = c.remote_types = false; })),
       .group = "sync",
       .lacks = {"sync consumer", "sync counter", "sync producer"}},
      {.id = "1006-1007-absent",
       .summary = "neither cycle period nor window length, and no SYNC is produced",
       .legal = "7.5.2.6, 7.5.2.7: for SYNC producers; optional",
       .how = both(absent({0x1006, 0x1007}), consumes_only),
       .group = "sync-producer",
       .lacks = {"sync producer"}},
      {.id = "sync-not-produced",
       .summary = "SYNC is consumed only",
       .legal = "OD-1005-03: bit 30 of 1005h is refused",
       .how = consumes_only,
       .group = "sync-producer",
       .lacks = {"sync producer"}},
      {.id = "sync-not-produced-0800-0000",
       .summary = "SYNC is consumed only; bit 30: general error",
       .legal = "OD-1005-03",
       .how = both(consumes_only,
                   [](Parts& node) { node.sync.cob_id_rules.choices.fixed_bit = abort_code::general_error; }),
       .group = "sync-producer",
       .lacks = {"sync producer"}},
      {.id = "sync-not-produced-no-counter",
       .summary = "SYNC is consumed only, without period, window and counter",
       .legal = "7.5.2.6, 7.5.2.7, 7.5.2.22: optional",
       .how = both(absent({0x1006, 0x1007, 0x1019}), consumes_only),
       .group = "sync-producer",
       .excludes = {"1019"},
       .lacks = {"sync producer", "sync counter"}},
      {"sync-producer-unnamed",
       "SYNC can be produced, and the profile does not say so",
       "7.5.2.5: bit 30 of 1005h shows it",
       [](Parts&) {},
       "sync-producer",
       {},
       {"sync producer"}},
      {"sync-first-at-once", "the first SYNC when production begins", "OD-1005-09: within one period",
       producer([](SyncProducerChoices& c) { c.first_at_once = true; })},
      {"sync-due-one-stays", "a new period counts from the next SYNC on", "OD-1006-05: within one new cycle",
       producer([](SyncProducerChoices& c) { c.due_sync_stays = true; })},
      {"sync-jitters", "SYNC comes late and early by turns", "SYNC-PRO-01: the mean counts",
       producer([](SyncProducerChoices& c) { c.jitter_percent = 10; })},
      {"1006-in-whole-ms", "1006h takes whole milliseconds", "OD-1006-03: 0609 0030h",
       producer([](SyncProducerChoices& c) { c.resolution = 1000; }), "1006"},
      {"1006-in-10-ms", "1006h takes multiples of 10 ms, others cannot be produced", "OD-1006-03: 0604 0047h",
       producer([](SyncProducerChoices& c) {
         c.resolution = 10000;
         c.not_a_multiple = AbortCode{0x06040047};
       }),
       "1006"},
      {"1006-50-ms-to-1-s", "1006h takes 50 ms to 1 s", "OD-1006-03: 0609 0031h, 0609 0032h",
       producer([](SyncProducerChoices& c) {
         c.shortest = 50000;
         c.longest = 1000000;
       }),
       "1006"},
      {"1006-16-bits", "1006h takes up to 65 ms", "OD-1006-03: 0609 0031h",
       producer([](SyncProducerChoices& c) { c.longest = 0xFFFF; }), "1006"},
      {"1006-from-1-s", "1006h takes 1 s and more", "OD-1006-03: 0609 0030h",
       producer([](SyncProducerChoices& c) {
         c.shortest = 1000000;
         c.too_short = abort_code::invalid_value;
       }),
       "1006"},
      {.id = "1005-producing-without-period",
       .summary = "SYNC would be produced if 1006h were not 0",
       .legal = "OD-1005-02 warns",
       .how = preset(0x1005, 0, 0x40000080),
       .excludes = {"sync-producer", "1005-bit-31"},
       .warns = {"OD-1005-02"}},
      {.id = "1005-producing-at-power-on",
       .summary = "SYNC every 100 ms from power-on",
       .legal = "OD-1005-02 and OD-1006-02 warn",
       .how = both(preset(0x1005, 0, 0x40000080), preset(0x1006, 0, 100'000)),
       .excludes = {"sync-producer", "1005-bit-31", "1005-producing-without-period", "1006", "sync", "1019"},
       .warns = {"OD-1005-02", "OD-1006-02"}},
      {"sync-loss-reported", "a SYNC that stays away is reported", "SYNC-CON-10: one EMCY",
       [](Parts& node) { node.sync_supervision.choices.loss_reported = true; }},
      {.id = "1007-5-ms",
       .summary = "a synchronous window of 5 ms by default",
       .legal = "OD-1007-01 warns; 7.5.2.7: later RPDOs are discarded",
       .how = preset(0x1007, 0, 5000),
       .warns = {"OD-1007-01"}},
      {"1007-late-rpdo-kept", "a synchronous RPDO behind the window is taken over", "OD-1007-03",
       [](Parts& node) { node.sync_window.choices.late_discarded = false; }},
      {"1007-16-bits", "a synchronous window of more than 65 535 us is refused: 0609 0031h",
       "OD-1007-01: what the device can measure",
       also_checked(0x1007, 0,
                    [](const Parts&, ByteView bytes) -> Accepted {
                      if (conform::load_le(bytes) > 0xFFFF) return refuse(abort_code::value_too_high);
                      return {};
                    })},
      {"1007-within-1006",
       "a synchronous window beyond the cycle is refused: 0604 0043h",
       "OD-1007-01: 7.5.2.7, a part of the cycle",
       also_checked(0x1007, 0,
                    [](const Parts& parts, ByteView bytes) -> Accepted {
                      if (conform::load_le(bytes) > parts.device.dictionary.number(0x1006, 0))
                        return refuse(abort_code::parameter_incompatible);
                      return {};
                    }),
       {},
       {"1007-5-ms"}},
      {"1007-absent", "no synchronous window", "7.5.2.7: optional", absent({0x1007})},
      {"1005-bit-31", "default 8000 0080h", "OD-1005-02: bit 31 is not looked at",
       preset(0x1005, 0, 0x80000080)},
      {.id = "1005-const",
       .summary = "the COB-ID of SYNC cannot be changed",
       .legal = "OD-1005-06: 0601 0002h from a const entry",
       .how = access(0x1005, 0, Access::constant),
       .excludes = {"1005-producing-without-period"},
       .lacks = {"sync producer"}},
      {.id = "sync-length-not-reported",
       .summary = "a SYNC with data causes no EMCY",
       .legal = "SYNC-CON-07; NMT-SVC-02 tolerates it",
       .how = [](Parts& node) { node.sync.choices.wrong_length_reported = false; },
       .warns = {"NMT-SVC-02", "SYNC-CON-05"}},
      {"sync-with-data-ignored", "a SYNC with data is not used", "SYNC-CON-07",
       [](Parts& node) { node.sync.choices.wrong_length_used = false; }},
      {.id = "1019-absent",
       .summary = "no SYNC counter",
       .legal = "7.5.2.22: optional",
       .how = absent({0x1019}),
       .group = "1019",
       .lacks = {"sync counter"}},
      {"1019-const", "SYNC never has a counter", "OD-1019-08: const", access(0x1019, 0, Access::constant),
       "1019"},
      {"1019-10",
       "SYNCs are counted to 10 by default",
       "7.5.2.22: the default is the device's",
       preset(0x1019, 0, 10),
       "1019",
       // Scenarios that count SYNCs do not ask yet where a TPDO begins to count.
       {"tpdos-start-at-sync-3", "tpdos-start-at-sync-2-const"}},
      {"abort-1019-reserved-0800-0000", "a reserved counter overflow: general error", "OD-1019-04",
       [](Parts& node) { node.sync.choices.counter_reserved = abort_code::general_error; }},
      {"abort-1019-locked-0800-0000", "a counter overflow in use: general error", "OD-1019-05",
       [](Parts& node) { node.sync.choices.counter_locked = abort_code::general_error; }},
  };
}

}  // namespace refnode
