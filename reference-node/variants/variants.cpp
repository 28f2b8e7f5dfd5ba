// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "variants/variant.hpp"

namespace refnode {

namespace {

/// A device with the habits of one stack, all at once: what goes with one of them goes with it.
Variant like(std::string_view id, std::string_view summary, const VariantTable& all,
             const std::vector<std::string_view>& habits) {
  Variant row{.id = id,
              .summary = summary,
              .legal = "all of these at once, each for its own reason",
              .how = {},
              .group = "stack"};
  std::vector<std::function<void(Parts&)>> changes;
  const auto add = [](std::vector<std::string_view>& to, const std::vector<std::string_view>& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  for (const std::string_view habit : habits) {
    const auto found = std::ranges::find(all, habit, &Variant::id);
    if (found == all.end()) continue;
    changes.push_back(found->how);
    for (const Variant& other : all) {
      if (!compatible(*found, other)) row.excludes.push_back(other.id);
    }
    add(row.lacks, found->lacks);
    add(row.gains, found->gains);
    add(row.warns, found->warns);
  }
  row.how = [changes = std::move(changes)](Parts& parts) {
    for (const auto& change : changes) change(parts);
  };
  return row;
}

VariantTable stacks(const VariantTable& all) {
  return {
      like("like-canopennode", "habits of CANopenNode", all,
           {"heartbeat-restarts-at-state-change",
            "heartbeat-at-once",
            "emcy-once-for-a-kind",
            "emcy-manufacturer-bytes",
            "emcy-completed-when-sent",
            "emcy-overflow-told",
            "1003-records-error-resets",
            "error-reset-for-each",
            "1015-runs-from-setting",
            "error-prevents-operational",
            "consumer-boot-up-loss",
            "consumer-errors-end-together",
            "consumer-pauses-in-stopped",
            "guarding-absent",
            "1028-absent",
            "tpdo-when-set",
            "tpdo-in-the-middle",
            "tpdo-type-0-timed",
            "tpdo-without-remote-frames",
            "rpdo-length-at-sync",
            "rpdo-too-long-reported",
            "sync-loss-reported",
            "sync-with-data-ignored",
            "sdo-busy-0504-0001",
            "sdo-gap-at-once",
            "sdo-first-segment-awaited",
            "sdo-all-reserved-bits-refused",
            "sdo-former-mux-in-aborts",
            "lss-address-in-any-order",
            "lss-without-identify",
            "lss-without-identify-non-configured"}),
      like("like-gocanopen", "habits of gocanopen", all,
           {"heartbeat-restarts-at-state-change",
            "heartbeat-at-once",
            "1003-records-error-resets",
            "error-reset-for-each",
            "1015-runs-from-setting",
            "errors-of-frames-stay",
            "consumer-boot-up-loss",
            "consumer-errors-end-together",
            "guarding-absent",
            "1028-absent",
            "1029-absent",
            "tpdo-when-set",
            "tpdo-in-the-middle",
            "tpdo-type-0-timed",
            "tpdo-without-remote-frames",
            "tpdo-remote-types-absent",
            "rpdo-too-long-reported",
            "sync-loss-reported",
            "sync-with-data-ignored",
            "sdo-busy-0504-0001",
            "sdo-gap-at-once",
            "sdo-first-segment-awaited",
            "sdo-all-reserved-bits-refused",
            "sdo-former-mux-in-aborts",
            "lss-without-bit-timing",
            "lss-without-store",
            "lss-without-identify",
            "lss-without-identify-non-configured",
            "lss-without-fastscan",
            "lss-address-in-any-order"}),
      like("like-c-open", "habits of c-open", all,
           {"heartbeat-from-the-last", "tpdo-timer-from-the-last", "emcy-for-each-frame",
            "error-reset-for-each", "sdo-block-absent", "abort-lock-0800-0022", "lss-without-fastscan",
            "lss-without-identify-non-configured", "1400-bit-30", "boot-up-at-once"}),
      like("like-lely", "habits of lely-core", all,
           {"emcy-for-each-frame", "error-reset-for-each", "rpdo-too-long-reported",
            "abort-map-order-0609-0030", "sdo-busy-0800-0022", "tpdo-29-bit", "consumer-boot-up-new-start",
            "sdo-entry-looked-at-late", "sdo-toggle-errors-ignored-in-downloads", "locked-by-former-value"}),
      like("like-canfestival", "habits of CanFestival", all,
           {"emcy-once-for-a-kind", "emcy-dropped-in-stopped", "tpdo-initial", "sdo-time-out-10s",
            "sdo-block-absent", "1015-absent", "1019-absent", "1029-absent", "1028-absent", "lss-absent",
            "sdo-toggle-errors-ignored"}),
      like("like-canopen-stack", "habits of canopen-stack of Embedded Office", all,
           {"error-reset-for-each", "emcy-dropped-in-stopped", "1015-absent", "1028-absent", "1029-absent",
            "guarding-absent", "tpdo-on-write", "tpdo-without-remote-frames", "1019-absent",
            "tpdo-inhibit-in-10-ms", "sdo-time-out-10s", "boot-up-at-once"}),
      like("like-python-canopen", "habits of canopen for Python", all,
           {"heartbeat-at-once", "boot-up-at-once", "guarding-absent", "1015-absent", "1019-absent",
            "1028-absent", "1029-absent", "lss-absent", "sdo-no-time-out", "sdo-segments-checked-at-the-end",
            "sdo-servers-absent", "sdo-client-absent", "sdo-block-unknown", "tpdo-without-remote-frames",
            "abort-too-long-0607-0010", "abort-too-short-0607-0010"}),
      like("like-durand", "habits of durand", all,
           {"heartbeat-at-once", "boot-up-at-once", "guarding-absent", "1019-absent", "1028-absent",
            "1029-absent", "lss-address-in-any-order", "lss-without-store", "sdo-no-time-out",
            "sdo-gap-refused", "sdo-abort-of-its-object-only", "tpdo-initial", "tpdo-without-remote-frames",
            "abort-too-long-0607-0010", "abort-too-short-0607-0010"}),
      like("like-zencan", "habits of zencan", all,
           {"boot-up-at-once", "guarding-absent", "1019-absent", "1028-absent", "1029-absent",
            "sdo-busy-names-transfer", "sdo-time-out-25ms", "sdo-sequence-ignored",
            "sdo-segments-checked-at-the-end", "sdo-blocks-checked-at-the-end", "sdo-servers-absent",
            "sdo-client-absent", "tpdo-without-remote-frames"}),
  };
}

}  // namespace

std::span<const Variant> variants() {
  static const VariantTable all = [] {
    VariantTable joined;
    for (VariantTable table :
         {objects_variants(), dictionary_variants(), storage_variants(), sync_variants(), time_variants(),
          emergency_variants(), error_control_variants(), nmt_variants(), lss_variants(), pdo_variants(),
          sdo_variants(), cob_id_variants(), rare_variants()}) {
      for (Variant& row : table) joined.push_back(std::move(row));
    }
    for (Variant& row : stacks(joined)) joined.push_back(std::move(row));
    return joined;
  }();
  return all;
}

const Variant* find_variant(std::string_view id) {
  const auto all = variants();
  const auto found = std::ranges::find(all, id, &Variant::id);
  return found == all.end() ? nullptr : &*found;
}

bool compatible(const Variant& one, const Variant& other) {
  if (one.id == other.id) return false;
  if (!one.group.empty() && one.group == other.group) return false;
  const auto names = [](const Variant& from, const Variant& to) {
    return std::ranges::any_of(from.excludes, [&](std::string_view word) {
      return word == to.id || (!to.group.empty() && word == to.group);
    });
  };
  return !names(one, other) && !names(other, one);
}

}  // namespace refnode
