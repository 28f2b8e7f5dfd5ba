// SPDX-License-Identifier: Apache-2.0
// Storing and restoring: groups, storing by itself, signatures, and the time that it takes.
#include <chrono>

#include "variants/tools.hpp"

namespace refnode {

using namespace variant;

namespace {

/// 1010h, bit 1 of every sub-index.
How stores_by_itself(Duration rest) {
  return [rest](Parts& parts) {
    const auto object = parts.device.dictionary.objects().find(0x1010);
    if (object == parts.device.dictionary.objects().end()) return;
    for (auto& [sub, entry] : object->second.entries) {
      if (sub == 0 || sub == 0xFF) continue;
      entry.default_value[0] |= 2U;
      entry.value = entry.default_value;
    }
    parts.store.choices.rest_before_storing = rest;
  };
}

/// 1010h, bit 1 of one sub-index only.
How stores_by_itself_as_said_in(std::uint8_t sub) {
  return [sub](Parts& parts) {
    Entry* entry = parts.device.dictionary.entry(0x1010, sub);
    if (entry == nullptr) return;
    entry->default_value[0] |= 2U;
    entry->value = entry->default_value;
  };
}

/// 1010h:03 and 1011h:03 are missing, and nothing above 1FFFh is stored with "all parameters" either.
void store_communication_only(Parts& parts) {
  absent_from(0x1010, 3)(parts);
  absent_from(0x1011, 3)(parts);
  for (auto& [index, object] : parts.device.dictionary.objects()) {
    if (index < 0x2000) continue;
    for (auto& [sub, entry] : object.entries) entry.storable = false;
  }
}

How wrong_signature(AbortCode code) {
  return [code](Parts& node) { node.store.choices.wrong_signature = code; };
}

/// What was written is there, and is stored before the answer.
bool ends_download(const SdoExchange& sdo) {
  constexpr unsigned expedited = 2;
  constexpr unsigned last_segment = 1;
  switch (sdo.step) {
    case SdoStep::download_initiate: return (sdo.request[0] & expedited) != 0;
    case SdoStep::download_segment: return (sdo.request[0] & last_segment) != 0;
    case SdoStep::block_download_end: return true;
    default: return false;
  }
}

/// Storing and restoring take their time.
How slow_storage(std::chrono::milliseconds delay) {
  return [delay](Parts& parts) {
    parts.device.outbox.add_filter([delay](const FilterContext& context, std::vector<Outgoing>& frames) {
      if (context.sdo == nullptr || !ends_download(*context.sdo) || context.sdo->aborted) return;
      if (context.sdo->index() != 0x1010 && context.sdo->index() != 0x1011) return;
      for (Outgoing& outgoing : frames) outgoing.delay += delay;
    });
  };
}

}  // namespace

VariantTable storage_variants() {
  return {
      {.id = "storage-absent",
       .summary = "neither stores nor restores",
       .legal = "7.5.2.13, 7.5.2.14: optional",
       .how = absent({0x1010, 0x1011, 0x2F20}),
       .group = "storage",
       .lacks = {"store", "restore"}},
      {.id = "1010-only",
       .summary = "stores, but does not restore",
       .legal = "7.5.2.14: 1011h is optional",
       .how = absent({0x1011}),
       .group = "storage",
       .lacks = {"restore"}},
      {"1010-sub-1-only", "stores and restores everything at once only", "OD-1010-05, OD-1011-05",
       both(absent_from(0x1010, 2), absent_from(0x1011, 2)), "storage"},
      {"1010-sub-2-absent", "stores and restores all, or the application parameters", "OD-1010-05: a gap",
       both(gap(0x1010, 2), gap(0x1011, 2)), "storage"},
      {"1010-communication-only", "stores no application parameter", "OD-1010-10: what the device can store",
       store_communication_only, "storage"},
      {"1010-autonomous", "stores by itself what was written, after 4 s of rest",
       "OD-1010-04, OD-1010-17: bit 1", stores_by_itself(std::chrono::seconds(4)), "storage"},
      {"1010-autonomous-at-once", "stores by itself with each write", "OD-1010-04, OD-1010-17: bit 1",
       stores_by_itself(Duration::zero()), "storage"},
      {"1010-autonomous-01-only",
       "bit 1 of 1010h:01, not of :02 and :03: what belongs to neither is stored by itself",
       "7.5.2.13: a group's own sub-index says more of it", stores_by_itself_as_said_in(1), "storage"},
      {"1010-autonomous-02-only", "communication parameters alone are stored by themselves",
       "7.5.2.13: bit 1 of 1010h:02", stores_by_itself_as_said_in(2), "storage"},
      {"1010-autonomous-03-only", "application parameters alone are stored by themselves",
       "7.5.2.13: bit 1 of 1010h:03", stores_by_itself_as_said_in(3), "storage"},
      {"abort-signature-0800-0021", "a wrong signature: local control", "OD-1010-08, OD-1011-08",
       wrong_signature(conform::AbortCode(0x08000021)), "signature"},
      {"abort-signature-0800-0022", "a wrong signature: device state", "OD-1010-08, OD-1011-08",
       wrong_signature(abort_code::device_state), "signature"},
      {"abort-signature-0800-0024", "a wrong signature: no data", "OD-1010-08, OD-1011-08",
       wrong_signature(abort_code::no_data), "signature"},
      {"storing-in-pre-operational-only", "storing is refused in Operational", "STO-1010-12",
       [](Parts& node) { node.store.choices.storing_needs_pre_operational = true; }},
      {"storing-takes-400ms", "storing takes 400 ms", "OD-1010-07: no limit is set",
       slow_storage(std::chrono::milliseconds(400)), "storing"},
      {"storing-takes-9s", "storing takes 9 s", "OD-1010-07: T_NVM", slow_storage(std::chrono::seconds(9)),
       "storing"},
      {"1020-absent", "no configuration date", "7.5.2.23: optional", absent({0x1020})},
  };
}

}  // namespace refnode
