// SPDX-License-Identifier: Apache-2.0
// Defects of the NMT slave, of boot-up and of what a reset does.
#include "defects/hooks.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

PowerOnRules& of_power_on(Parts& parts) { return parts.store.rules; }

/// Of which groups a reset loads the power-on values; `right` is what the standard says.
Change reset_loads(bool (*loads)(bool right, Group group, bool whole_node)) {
  return decides(of_power_on, &PowerOnRules::reset_loads,
                 [loads](const auto& former, Group group, bool whole_node) {
                   return loads(former(group, whole_node), group, whole_node);
                 });
}

BehaviourSwitch restarts_on(std::function<bool(const Frame&, std::uint8_t node_id)> frame) {
  return [frame = std::move(frame)](Behaviour& behaviour) { behaviour.restarts_on = frame; };
}

}  // namespace

DefectTable nmt_defects() {
  using B = Behaviour;
  return {
      {"no-bootup",
       "There is no boot-up message",
       {"NMT-BOOT-02", "NMT-BOOT-03", "OD-RST-07", "NMT-BOOT-01"},
       Filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
         if (context.service == Service::boot_up) frames.clear();
       })},
      {"bootup-sent-twice",
       "The boot-up message is sent twice",
       {"NMT-BOOT-02", "NMT-BOOT-03", "OD-RST-07", "NMT-BOOT-01"},
       repeat(Service::boot_up)},
      {"bootup-dlc-wrong",
       "The boot-up message has two bytes",
       {"NMT-BOOT-04"},
       reshape(Service::boot_up, [](const FilterContext&, Frame& frame) { frame.dlc = 2; })},
      {"bootup-data-wrong",
       "The boot-up message carries 7Fh",
       {"NMT-BOOT-04", "NMT-BOOT-02", "NMT-BOOT-03"},
       reshape(Service::boot_up, [](const FilterContext&, Frame& frame) { frame.data[0] = 0x7F; })},
      {"bootup-on-preop-transition",
       "Entering Pre-operational sends a boot-up message",
       {"NMT-BOOT-06", "NMT-FSA-03", "NMT-FSA-06"},
       behave(&B::boot_up_on_pre_operational)},
      {"starts-in-operational",
       "The node enters Operational by itself after boot-up",
       {"NMT-BOOT-07"},
       behave(&B::starts_in_operational)},
      {"reset-during-init-hangs",
       "A reset command during start-up ends the start-up for good",
       {"NMT-BOOT-09"},
       behave(&B::reset_during_start_up_hangs)},
      {"restarts-by-itself",
       "The node restarts every 20 s",
       {"NMT-BOOT-10"},
       behave(&B::restarts_after_ms, 20'000)},
      {"restarts-on-short-request",
       "An SDO request of five bytes makes the node restart",
       {"NMT-BOOT-10", "SDO-ERR-06"},
       restarts_on([](const Frame& frame, std::uint8_t node_id) {
         return frame.id == 0x600U + node_id && !frame.extended && !frame.remote && frame.dlc == 5;
       })},
      {"restarts-on-remote-request",
       "A remote frame on the CAN-ID of SDO requests makes the node restart",
       {"NMT-BOOT-10", "SDO-GEN-10"},
       restarts_on([](const Frame& frame, std::uint8_t node_id) {
         return frame.id == 0x600U + node_id && !frame.extended && frame.remote;
       })},
      {"restarts-on-read",
       "Reading 1009h makes the node restart",
       {"NMT-BOOT-10"},
       restarts_on([](const Frame& frame, std::uint8_t node_id) {
         return frame.id == 0x600U + node_id && frame.size() == 8 && frame.data[0] == 0x40 &&
                frame.data[1] == 0x09 && frame.data[2] == 0x10;
       })},
      {"nmt-start-ignored",
       "Start remote node has no effect",
       {"NMT-FSA-01", "NMT-FSA-05"},
       behave(&B::nmt_start_ignored)},
      {"nmt-start-ignored-in-stopped",
       "Start remote node has no effect in Stopped",
       {"NMT-FSA-05"},
       behave(&B::nmt_start_ignored_in_stopped)},
      {"nmt-stop-ignored-in-preop",
       "Stop remote node has no effect in Pre-operational",
       {"NMT-FSA-02"},
       behave(&B::nmt_stop_ignored_in_pre_operational)},
      {"nmt-stop-ignored-in-operational",
       "Stop remote node has no effect in Operational",
       {"NMT-FSA-04"},
       behave(&B::nmt_stop_ignored_in_operational)},
      {"nmt-preop-ignored-in-operational",
       "Enter pre-operational has no effect in Operational",
       {"NMT-FSA-03"},
       behave(&B::nmt_pre_operational_ignored)},
      {"nmt-reset-ignored-in-stopped",
       "Reset commands have no effect in Stopped",
       {"NMT-FSA-11", "NMT-FSA-12"},
       behave(&B::nmt_reset_ignored_in_stopped)},
      {"nmt-reset-ignored-in-preop",
       "Reset commands have no effect in Pre-operational",
       {"NMT-FSA-07", "NMT-FSA-08", "NMT-BOOT-02", "NMT-BOOT-03", "OD-RST-07"},
       behave(&B::nmt_reset_ignored_in_pre_operational)},
      {"nmt-reset-ignored-in-operational",
       "Reset commands have no effect in Operational",
       {"NMT-FSA-09", "NMT-FSA-10"},
       behave(&B::nmt_reset_ignored_in_operational)},
      {"slave-sends-nmt",
       "The node starts node 127 after its boot-up message",
       {"NMT-SVC-05"},
       Filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
         if (context.service == Service::boot_up)
           frames.push_back({conform::can::data_frame(conform::CanId(0x000), {0x01, 0x7F}), {}});
       })},
      {"nmt-self-transition-resets",
       "Enter pre-operational resets a node that is there already",
       {"NMT-FSA-13"},
       behave(&B::nmt_pre_operational_resets)},
      {"nmt-broadcast-ignored",
       "Commands to node-ID 0 are ignored",
       {"NMT-FSA-14"},
       behave(&B::nmt_broadcast_ignored)},
      {"nmt-node-id-not-checked",
       "Commands to any node are obeyed",
       {"NMT-FSA-15"},
       behave(&B::nmt_node_id_unchecked)},
      {"nmt-node-id-bit7-masked",
       "Bit 7 of the node-ID of a command is not looked at",
       {"NMT-FSA-15"},
       behave(&B::nmt_node_id_masked)},
      {"nmt-unknown-command-acts",
       "Unknown commands stop the node",
       {"NMT-FSA-16"},
       behave(&B::nmt_unknown_command_stops)},
      {"nmt-short-frame-accepted",
       "Commands without node-ID are obeyed",
       {"NMT-FSA-17"},
       behave(&B::nmt_short_frame_accepted)},
      {"nmt-long-frame-accepted",
       "Commands of more than two bytes are obeyed, whatever the node-ID",
       {"NMT-FSA-18"},
       behave(&B::nmt_long_frame_accepted)},
      {"reset-communication-keeps-values",
       "Reset communication keeps the communication parameters",
       {"OD-RST-01", "NMT-FSA-24", "EC-HBP-13", "OD-1014-10", "PDO-MAP-21", "NMT-FSA-29"},
       reset_loads([](bool right, Group, bool whole_node) { return right && whole_node; })},
      {"reset-communication-resets-application",
       "Reset communication resets application parameters, too",
       {"OD-RST-02", "NMT-FSA-26"},
       reset_loads([](bool, Group, bool) { return true; })},
      {"reset-node-keeps-communication",
       "Reset node keeps the communication parameters",
       {"OD-RST-03", "OD-1010-18", "STO-1010-10"},
       reset_loads([](bool right, Group group, bool whole_node) {
         return right && !(whole_node && group == Group::communication);
       })},
      {"reset-node-keeps-application",
       "Reset node keeps the application parameters",
       {"OD-RST-03", "NMT-FSA-25"},
       reset_loads([](bool right, Group group, bool whole_node) {
         return right && !(whole_node && group != Group::communication);
       })},
  };
}

}  // namespace refnode
