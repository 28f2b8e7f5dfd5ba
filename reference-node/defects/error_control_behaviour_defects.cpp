// SPDX-License-Identifier: Apache-2.0
// Defects of the error behaviour (1029h).
#include <algorithm>
#include <memory>

#include "defects/heartbeats.hpp"
#include "defects/hooks.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

void reads_the_behaviour_with_the_state(Parts& parts) {
  const auto held = std::make_shared<std::uint64_t>(parts.device.dictionary.number(0x1029, 1));
  const auto read = [held](Parts& node) { *held = node.device.dictionary.number(0x1029, 1); };
  ahead_of_state_change(read)(parts);
  with_boot_up(read)(parts);
  parts.error_behaviour.rules.next_state.replace(
      [held](const auto& former, std::uint64_t, NmtState present) { return former(*held, present); });
}

/// Every value of the type is taken.
DictionaryEdit without_limits(std::uint16_t index, std::uint8_t sub) {
  return [index, sub](ObjectDictionary& od, std::uint8_t) {
    if (Entry* entry = od.entry(index, sub)) {
      entry->low.reset();
      entry->high.reset();
    }
  };
}

/// After a communication error the node is in `wrong` where 1029h:01 is `class_value` and it was in
/// `present`.
Change reacts(std::uint64_t class_value, NmtState present, NmtState wrong) {
  return [=](Parts& parts) {
    parts.error_behaviour.rules.next_state.replace(
        [=](const auto& former, std::uint64_t value, NmtState state) {
          return value == class_value && state == present ? wrong : former(value, state);
        });
  };
}

/// TPDOs go on where a lost heartbeat has ended Operational, until the next NMT command.
void tpdos_outlive_operational(Parts& parts) {
  const auto left = std::make_shared<bool>(false);
  parts.consumer.on_loss = [&parts, left, former = parts.consumer.on_loss] {
    const bool operational = parts.device.state == NmtState::operational;
    *left = *left || operational;
    if (former) former();
    if (parts.device.state == NmtState::operational) *left = false;
  };
  deaf_to([left](Parts&, const Frame& frame) {
    if (frame.id == 0x000 && !frame.extended && !frame.remote) *left = false;
    return false;
  })(parts);
  parts.device.works.replace([left](const auto& former, Service service, NmtState state) {
    return (service == Service::tpdo && *left) || former(service, state);
  });
}

/// What is lost beside a node that is lost already changes nothing.
void behaves_with_first_loss_only(Parts& parts) {
  parts.consumer.on_loss = [&parts, former = parts.consumer.on_loss] {
    const auto lost =
        std::ranges::count(parts.emergency.active(), ErrorSource::heartbeat, &ErrorCause::source);
    if (lost <= 1 && former) former();
  };
}

/// Behind a loss every entry waits for a heartbeat again.
void loss_ends_monitoring(Parts& parts) {
  parts.consumer.on_loss = [&parts, former = parts.consumer.on_loss] {
    for (std::uint8_t sub = 1; sub <= consumer_entries(parts); ++sub) {
      if (parts.consumer.due(sub)) parts.consumer.on_written(sub);
    }
    if (former) former();
  };
}

}  // namespace

DefectTable error_control_behaviour_defects() {
  return {
      {"1029-sub0-out-of-range", "1029h:00 is 00h", {"OD-1029-01", "OD-GEN-11"}, preset(0x1029, 0, 0)},
      {"1029-sub0-is-u32",
       "1029h:00 has four bytes",
       {"OD-1029-01", "OD-GEN-10", "OD-GEN-17"},
       type(0x1029, 0, DataType::unsigned32)},
      {"1029-sub0-writable",
       "1029h:00 can be written",
       {"OD-1029-02", "OD-ACC-02", "SDO-DNL-09"},
       access(0x1029, 0, Access::rw)},
      {"1029-sub1-missing",
       "1029h:01 does not exist",
       {"OD-1029-03", "OD-CAT-02", "OD-GEN-17"},
       absent_sub(0x1029, 1)},
      {"1029-entry-is-u32",
       "1029h:01 has four bytes",
       {"OD-1029-03", "OD-GEN-19", "OD-LEN-04", "OD-GEN-17"},
       type(0x1029, 1, DataType::unsigned32)},
      {"1029-default-nonzero",
       "The default of 1029h:01 is 01h",
       {"OD-1029-04", "OD-DSC-03"},
       preset(0x1029, 1, 1)},
      {"1029-not-writable",
       "1029h:01 is read-only",
       {"OD-1029-05", "SDO-DNL-21"},
       access(0x1029, 1, Access::ro)},
      {"1029-not-stored",
       "Writing 1029h:01 is confirmed and forgotten",
       {"OD-1029-05"},
       not_stored(0x1029, 1)},
      {"1029-reserved-value-accepted",
       "1029h:01 takes reserved values",
       {"OD-1029-06", "EC-EB-04"},
       without_limits(0x1029, 1)},
      {"1029-const-writable",
       "1029h:02 can be written although it is constant",
       {"OD-1029-12", "OD-ACC-02"},
       access(0x1029, 2, Access::rw)},
      {"1029-0-goes-to-stopped",
       "With 1029h:01 = 00h a communication error stops the node",
       {"EC-EB-01", "OD-1029-07", "EC-HBC-08", "OD-1029-10"},
       reacts(0, NmtState::operational, NmtState::stopped)},
      {"1029-0-acts-in-stopped",
       "With 1029h:01 = 00h a communication error takes the node from Stopped to Pre-operational",
       {"EC-EB-05", "OD-1029-11"},
       reacts(0, NmtState::stopped, NmtState::pre_operational)},
      {"1029-1-changes-state",
       "With 1029h:01 = 01h a communication error ends Operational",
       {"EC-EB-02", "OD-1029-08"},
       reacts(1, NmtState::operational, NmtState::pre_operational)},
      {"1029-2-not-stopped",
       "With 1029h:01 = 02h a communication error changes nothing",
       {"EC-EB-03", "OD-1029-09"},
       Change([](Parts& parts) {
         parts.error_behaviour.rules.next_state.replace(
             [](const auto& former, std::uint64_t value, NmtState present) {
               return value == 2 ? present : former(value, present);
             });
       })},
      {"1029-tpdos-go-on-behind-operational",
       "TPDOs go on when a lost heartbeat has ended Operational",
       {"PDO-TX-02"},
       Change(tpdos_outlive_operational)},
      {"1029-second-loss-changes-nothing",
       "A node that is lost while another one is lost already does not end Operational",
       {"EC-EB-01"},
       Change(behaves_with_first_loss_only)},
      {"1016-loss-ends-monitoring-of-others",
       "When a node is lost the others are not monitored until their next heartbeat",
       {"EC-EB-01", "EC-HBC-13"},
       Change(loss_ends_monitoring)},
      {"1029-read-with-the-state",
       "1029h:01 counts as it was when the NMT state was entered",
       {"EC-EB-02"},
       Change(reads_the_behaviour_with_the_state)},
  };
}

}  // namespace refnode
