// SPDX-License-Identifier: Apache-2.0
// NMT, error control, EMCY and SYNC where the standard leaves the when and the whether to the device.
#include "variants/tools.hpp"

namespace refnode {

using namespace variant;
using namespace std::chrono_literals;

namespace {

/// After boot-up, one EMCY 0000h.
void announce_no_error(Parts& parts) {
  parts.device.outbox.add_filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::boot_up || frames.empty()) return;
    frames.push_back({conform::can::data_frame(conform::CanId(0x80U + context.node_id),
                                               {0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00}),
                      std::chrono::milliseconds(2)});
  });
}

/// Bytes 3 to 7 are the manufacturer's.
void fill_manufacturer_bytes(Parts& parts) {
  parts.device.outbox.add_filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::emergency) return;
    for (Outgoing& outgoing : frames) {
      for (std::size_t i = 3; i < 8; ++i) outgoing.frame.data[i] = static_cast<std::uint8_t>(0xA0U + i);
    }
  });
}

/// 1F80h, NMT start-up: bit 2 is 0, so the device starts without an NMT master.
void start_by_itself(Parts& parts) {
  parts.device.dictionary.add_variable(0x1F80,
                                       integer_entry("NMT start-up", DataType::unsigned32, Access::ro, 0));
  parts.nmt.choices.self_starting = true;
}

How boots_in(Duration after_reset_node, Duration after_reset_communication) {
  return [=](Parts& node) {
    node.nmt.choices.node_start_up = after_reset_node;
    node.nmt.choices.communication_start_up = after_reset_communication;
  };
}

How follows_after(Duration latency) {
  return [=](Parts& node) { node.nmt.choices.latency = latency; };
}

/// Storing and restoring take their time.
How slow_storage(std::chrono::milliseconds delay) {
  return [delay](Parts& parts) {
    parts.device.outbox.add_filter([delay](const FilterContext& context, std::vector<Outgoing>& frames) {
      if (context.sdo == nullptr || context.sdo->step != SdoStep::download_initiate || context.sdo->aborted)
        return;
      if (context.sdo->index() != 0x1010 && context.sdo->index() != 0x1011) return;
      for (Outgoing& outgoing : frames) outgoing.delay += delay;
    });
  };
}

}  // namespace

VariantTable service_variants() {
  return {
      {"boot-up-at-once", "boots in no time", "7.3.2.2.1: no time is given", boots_in(0ms, 0ms), "boot"},
      {"boot-up-200ms", "boots in 200 ms", "7.3.2.2.1: no time is given", boots_in(200ms, 200ms), "boot"},
      {"boot-up-2s", "boots in 2 s, after reset communication in 0.7 s", "7.3.2.2.1: no time is given",
       boots_in(2s, 700ms), "boot"},
      {"boot-up-4900ms", "boots in 4.9 s", "7.3.2.2.1: no time is given, NMT-BOOT-08: T_BOOT",
       boots_in(4900ms, 4900ms), "boot"},
      {"nmt-10ms", "follows start, stop and enter pre-operational after 10 ms",
       "7.3.2.2: no time is given, NMT-FSA-20: T_NMT", follows_after(10ms), "nmt-latency"},
      {"nmt-90ms", "follows start, stop and enter pre-operational after 90 ms",
       "7.3.2.2: no time is given, NMT-FSA-20: T_NMT", follows_after(90ms), "nmt-latency"},
      {"self-starting", "goes on into Operational after boot-up, as its 1F80h says",
       "CiA 302-2, 1F80h bit 2 = 0; NMT-BOOT-07 does not apply", start_by_itself},
      {"heartbeat-at-state-change", "one more heartbeat when the state changes", "EC-HBP-06",
       [](Parts& node) { node.producer.choices.at_state_change = true; }},
      {"heartbeat-at-once", "the first heartbeat right after 1017h was written, and after boot-up",
       "EC-HBP-02, EC-HBP-05", [](Parts& node) { node.producer.choices.at_once = true; }},
      // What a busy bus adds must stay inside the tolerance of 10 %.
      {"heartbeat-jitter", "heartbeats are 8 % late and early by turns",
       "EC-HBP-01: tolerance of single intervals",
       [](Parts& node) { node.producer.choices.jitter_percent = 8; }},
      {"consumer-boot-up-new-start", "a boot-up message ends the monitoring until the next heartbeat",
       "EC-HBC-12", [](Parts& node) { node.consumer.choices.boot_up = BootUpOfProducer::new_start; },
       "boot-up-of-producer"},
      {"consumer-boot-up-loss", "a boot-up message of a monitored node is an event", "EC-HBC-12",
       [](Parts& node) { node.consumer.choices.boot_up = BootUpOfProducer::loss; }, "boot-up-of-producer"},
      {.id = "register-generic-only",
       .summary = "the error register has bit 0 only",
       .legal = "7.5.2.2: all others are optional; EMCY-FMT-05 is a recommendation",
       .how = [](Parts& node) { node.emergency.choices.register_generic_only = true; },
       .warns = {"EMCY-FMT-05"}},
      {"error-reset-for-each", "EMCY 0000h for each error that goes, with what is left", "EMCY-SEQ-05",
       [](Parts& node) { node.emergency.choices.error_reset_for_each = true; }},
      {"emcy-dropped-in-stopped", "EMCYs of Stopped are not made up for", "EMCY-NMT-01",
       [](Parts& node) { node.emergency.choices.dropped_in_stopped = true; }},
      {"emcy-manufacturer-bytes", "bytes 3 to 7 of an EMCY are in use", "EMCY-FMT-01",
       fill_manufacturer_bytes},
      {.id = "emcy-no-error-at-boot-up",
       .summary = "EMCY 0000h after boot-up",
       .legal = "EMCY-SEQ-03, tolerated",
       .how = announce_no_error,
       .excludes = {"emcy", "1014-not-valid"},
       .warns = {"EMCY-SEQ-03"}},
      {.id = "sync-length-not-reported",
       .summary = "a SYNC with data causes no EMCY",
       .legal = "SYNC-CON-07; NMT-SVC-02 tolerates it",
       .how = [](Parts& node) { node.sync.choices.wrong_length_reported = false; },
       .warns = {"NMT-SVC-02", "SYNC-CON-05"}},
      {"sync-with-data-ignored", "a SYNC with data is not used", "SYNC-CON-07",
       [](Parts& node) { node.sync.choices.wrong_length_used = false; }},
      {"storing-takes-400ms", "storing takes 400 ms", "OD-1010-07: no limit is set",
       slow_storage(std::chrono::milliseconds(400)), "storing"},
      {"storing-takes-9s", "storing takes 9 s", "OD-1010-07: T_NVM", slow_storage(std::chrono::seconds(9)),
       "storing"},
  };
}

}  // namespace refnode
