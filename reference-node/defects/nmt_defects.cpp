// SPDX-License-Identifier: Apache-2.0
// Defects of the NMT slave, of boot-up and of what a reset does.
#include <algorithm>
#include <chrono>
#include <deque>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include "defects/hooks.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

using namespace nmt_command;

Frame command_to(const Parts& parts, std::uint8_t command) {
  return conform::can::data_frame(conform::CanId(0x000), {command, parts.device.node_id});
}

bool is_command(const Frame& frame) { return frame.id == 0x000 && !frame.extended && !frame.remote; }
bool is_command(const Frame& frame, std::uint8_t command) {
  return is_command(frame) && frame.size() != 0 && frame.data[0] == command;
}

/// The command has no effect.
Change ignores(std::uint8_t command) {
  return deaf_to([command](Parts&, const Frame& frame) { return is_command(frame, command); });
}
/// The command has no effect in this state.
Change ignores(std::uint8_t command, NmtState state) {
  return deaf_to([=](Parts& parts, const Frame& frame) {
    return parts.device.state == state && is_command(frame, command);
  });
}

/// What comes on CAN-ID 000h is taken for something else.
Change misreads_commands(std::function<void(Parts&, Frame&)> change) {
  return misreads([change = std::move(change)](Parts& parts, Frame& frame) {
    if (is_command(frame)) change(parts, frame);
  });
}

/// What the heartbeat shows in place of the state; nullopt: the state.
using Shown = std::optional<std::uint8_t>;
/// `next(command, shown)` tells what it is behind a command to this node.
Change shows_in_heartbeat(std::function<Shown(std::uint8_t command, Shown shown)> next) {
  return [next = std::move(next)](Parts& parts) {
    const auto shown = std::make_shared<Shown>();
    misreads_commands([shown, next](Parts& node, Frame& frame) {
      if (frame.size() != 2 || (frame.data[1] != 0 && frame.data[1] != node.device.node_id)) return;
      *shown = next(frame.data[0], *shown);
    })(parts);
    parts.device.outbox.add_filter([shown](const FilterContext& context, std::vector<Outgoing>& frames) {
      if (context.service != Service::heartbeat || !*shown) return;
      for (Outgoing& each : frames) each.frame.data[0] = **shown;
    });
  };
}

/// States of CiA 301's predecessors: 50h sleep, 60h standby.
Change sleeps() {
  return shows_in_heartbeat([](std::uint8_t command, Shown shown) -> Shown {
    constexpr std::uint8_t awake[] = {start, stop, enter_pre_operational, reset_node, reset_communication};
    if (command == 0x50 || command == 0x60) return command;
    return std::ranges::find(awake, command) != std::end(awake) ? std::nullopt : shown;
  });
}

/// The server is switched on by the way into Pre-operational alone.
Change stays_off_behind_stopped() {
  return [](Parts& parts) {
    const auto off = since_boot_up<bool>(parts);
    ahead_of_state_change([off](Parts& node) {
      if (node.device.state == NmtState::stopped) *off = true;
      if (node.device.state == NmtState::pre_operational) *off = false;
    })(parts);
    deaf_to([off](Parts& node, const Frame& frame) {
      return *off && !frame.extended && node.sdo.server_of(frame) != nullptr;
    })(parts);
  };
}

Change initialises_until_commanded() {
  return shows_in_heartbeat([](std::uint8_t command, Shown) -> Shown {
    if (command == reset_node || command == reset_communication) return std::uint8_t{0};
    return std::nullopt;
  });
}

/// A frame for which `when` holds acts like reset node.
Change restarts_on(std::function<bool(const Frame&, std::uint8_t node_id)> when) {
  return misreads([when = std::move(when)](Parts& parts, Frame& frame) {
    if (when(frame, parts.device.node_id)) frame = command_to(parts, reset_node);
  });
}

/// As if somebody reset the node that long after its boot-up.
Change restarts_after(Duration running) {
  return [running](Parts& parts) {
    parts.device.outbox.add_filter([&parts, running](const FilterContext& context, std::vector<Outgoing>&) {
      if (context.service == Service::boot_up)
        parts.device.inbox.put(command_to(parts, reset_node), context.now + running);
    });
  };
}

/// The start-up that such a reset begins has no end; only another reset gets the node out of it.
void hangs_when_reset_during_start_up(Parts& parts) {
  parts.nmt.rules.start_up_time.replace([&parts](const auto& former, Reset reset) -> Duration {
    constexpr Duration without_end = std::chrono::hours(24);
    const auto due = parts.nmt.boot_up_due();
    const bool hangs = due && *due > parts.device.now + without_end / 2;
    return due && !hangs ? without_end : former(reset);
  });
}

void boots_up_on_pre_operational(Parts& parts) {
  parts.nmt.on_change = [&parts, former = parts.nmt.on_change](NmtState from) {
    if (parts.device.state == NmtState::pre_operational) {
      parts.device.send(Service::boot_up,
                        conform::can::data_frame(conform::CanId(0x700U + parts.device.node_id), {0x00}));
    }
    former(from);
  };
}

/// NMT start in Operational is taken for a change of the state.
void enters_operational_again(Parts& parts) {
  deaf_to([](Parts& node, const Frame& frame) {
    const bool again = node.device.state == NmtState::operational && is_command(frame, start);
    if (again && frame.data[1] == node.device.node_id) node.nmt.on_change(NmtState::operational);
    return false;
  })(parts);
}

PowerOnRules& of_power_on(Parts& parts) { return parts.store.rules; }

/// Of which groups a reset loads the power-on values; `right` is what the standard says.
Change reset_loads(bool (*loads)(bool right, Group group, bool whole_node)) {
  return decides(of_power_on, &PowerOnRules::reset_loads,
                 [loads](const auto& former, Group group, bool whole_node) {
                   return loads(former(group, whole_node), group, whole_node);
                 });
}

/// Commands that come right behind many other frames are lost.
Reading loses_commands_under_load() {
  return [load = std::deque<BusTime>()](Parts& parts, std::vector<Frame>& frames) mutable {
    constexpr std::size_t many = 24;
    constexpr Duration short_time = std::chrono::milliseconds(50);
    const bool full = load.size() == many && parts.device.now - load.front() < short_time;
    std::erase_if(frames, [full](const Frame& frame) { return full && is_command(frame); });
    load.push_back(parts.device.now);
    if (load.size() > many) load.pop_front();
  };
}

/// Of the resets communication since the last reset node.
void starts_up_slowly_at_the_tenth(Parts& parts) {
  const auto resets = std::make_shared<int>(0);
  parts.nmt.rules.start_up_time.replace([resets](const auto& former, Reset reset) -> Duration {
    constexpr Duration more = std::chrono::milliseconds(2000);
    *resets = reset == Reset::node ? 0 : *resets + 1;
    return *resets == 10 ? former(reset) + more : former(reset);
  });
}

/// Of commands back to back no more than two are kept.
Reading keeps_two_commands() {
  return [taken = std::deque<BusTime>()](Parts& parts, std::vector<Frame>& frames) mutable {
    constexpr Duration until_obeyed = std::chrono::milliseconds(5);
    constexpr std::size_t most = 2;
    std::erase_if(taken, [&](BusTime at) { return parts.device.now - at >= until_obeyed; });
    if (std::ranges::none_of(frames, [](const Frame& frame) { return is_command(frame); })) return;
    if (taken.size() < most) {
      taken.push_back(parts.device.now);
    } else {
      std::erase_if(frames, [](const Frame& frame) { return is_command(frame); });
    }
  };
}

/// What comes on a CAN-ID for which `when` holds is a command, too.
Change takes_for_command(bool (*when)(std::uint32_t id)) {
  return misreads([when](Parts&, Frame& frame) {
    if (!frame.extended && !frame.remote && frame.size() == 2 && when(frame.id)) frame.id = 0;
  });
}

}  // namespace

DefectTable nmt_defects() {
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
       {"NMT-BOOT-06", "NMT-FSA-03", "NMT-FSA-06", "NMT-BOOT-10"},
       Change(boots_up_on_pre_operational)},
      {"starts-in-operational",
       "The node enters Operational by itself after boot-up",
       {"NMT-BOOT-07"},
       Change([](Parts& parts) { parts.nmt.choices.self_starting = true; })},
      {"started-again-in-operational",
       "NMT start in Operational begins the event timers of TPDOs anew",
       {"PDO-TX-09"},
       Change(enters_operational_again)},
      {"reset-during-init-hangs",
       "A reset command during start-up ends the start-up for good",
       {"NMT-BOOT-09"},
       Change(hangs_when_reset_during_start_up)},
      {"tenth-start-up-slow",
       "The tenth reset communication after a reset node takes 2 s",
       {"NMT-BOOT-08"},
       Change(starts_up_slowly_at_the_tenth)},
      {"restarts-by-itself",
       "The node restarts every 20 s",
       {"NMT-BOOT-10"},
       restarts_after(std::chrono::seconds(20))},
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
      {"nmt-start-ignored", "Start remote node has no effect", {"NMT-FSA-01", "NMT-FSA-05"}, ignores(start)},
      {"nmt-start-ignored-in-stopped",
       "Start remote node has no effect in Stopped",
       {"NMT-FSA-05"},
       ignores(start, NmtState::stopped)},
      {"nmt-stop-ignored-in-preop",
       "Stop remote node has no effect in Pre-operational",
       {"NMT-FSA-02"},
       ignores(stop, NmtState::pre_operational)},
      {"nmt-stop-ignored-in-operational",
       "Stop remote node has no effect in Operational",
       {"NMT-FSA-04"},
       ignores(stop, NmtState::operational)},
      {"nmt-preop-ignored-in-operational",
       "Enter pre-operational has no effect in Operational",
       {"NMT-FSA-03"},
       ignores(enter_pre_operational, NmtState::operational)},
      {"nmt-reset-ignored-in-stopped",
       "Reset commands have no effect in Stopped",
       {"NMT-FSA-11", "NMT-FSA-12"},
       together(ignores(reset_node, NmtState::stopped), ignores(reset_communication, NmtState::stopped))},
      {"nmt-reset-ignored-in-preop",
       "Reset commands have no effect in Pre-operational",
       {"NMT-FSA-07", "NMT-FSA-08", "NMT-BOOT-02", "NMT-BOOT-03", "OD-RST-07"},
       ignores(reset_node, NmtState::pre_operational)},
      {"nmt-reset-ignored-in-operational",
       "Reset commands have no effect in Operational",
       {"NMT-FSA-09", "NMT-FSA-10"},
       ignores(reset_node, NmtState::operational)},
      {"nmt-reset-communication-ignored-in-preop",
       "Reset communication has no effect in Pre-operational, where reset node has",
       {"NMT-FSA-08"},
       ignores(reset_communication, NmtState::pre_operational)},
      {"nmt-reset-communication-ignored-in-operational",
       "Reset communication has no effect in Operational, where reset node has",
       {"NMT-FSA-10"},
       ignores(reset_communication, NmtState::operational)},
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
       misreads_commands([](Parts& parts, Frame& frame) {
         if (parts.device.state == NmtState::pre_operational && is_command(frame, enter_pre_operational))
           frame.data[0] = reset_communication;
       })},
      {"nmt-broadcast-ignored",
       "Commands to node-ID 0 are ignored",
       {"NMT-FSA-14"},
       deaf_to([](Parts&, const Frame& frame) {
         return is_command(frame) && frame.size() == 2 && frame.data[1] == 0;
       })},
      {"nmt-node-id-not-checked",
       "Commands to any node are obeyed",
       {"NMT-FSA-15"},
       misreads_commands([](Parts& parts, Frame& frame) {
         if (frame.size() == 2) frame.data[1] = parts.device.node_id;
       })},
      {"nmt-node-id-bit7-masked",
       "Bit 7 of the node-ID of a command is not looked at",
       {"NMT-FSA-15"},
       misreads_commands([](Parts& parts, Frame& frame) {
         if ((frame.data[1] & 0x7FU) == parts.device.node_id) frame.data[1] = parts.device.node_id;
       })},
      {"nmt-unknown-command-acts",
       "Unknown commands stop the node",
       {"NMT-FSA-16"},
       misreads_commands([](Parts&, Frame& frame) {
         constexpr std::uint8_t known[] = {start, stop, enter_pre_operational, reset_node,
                                           reset_communication};
         if (std::ranges::find(known, frame.data[0]) == std::end(known)) frame.data[0] = stop;
       })},
      {"nmt-sleep-and-standby-obeyed",
       "The commands 50h and 60h put the node into states of their own, which the heartbeat shows",
       {"NMT-FSA-16"},
       sleeps()},
      {"sdo-deaf-from-stopped-to-operational",
       "NMT start in Stopped leaves the SDO server off",
       {"SDO-GEN-14", "NMT-FSA-22"},
       stays_off_behind_stopped()},
      {"heartbeat-initialising-behind-a-reset",
       "Behind a reset the heartbeat shows 00h until the next NMT command",
       {"NMT-BOOT-06", "NMT-BOOT-10", "EC-HBP-06", "EC-HBP-05"},
       initialises_until_commanded()},
      {"nmt-short-frame-accepted",
       "Commands without node-ID are obeyed",
       {"NMT-FSA-17"},
       misreads_commands([](Parts& parts, Frame& frame) {
         if (frame.size() == 1) frame = command_to(parts, frame.data[0]);
       })},
      {"nmt-long-frame-accepted",
       "Commands of more than two bytes are obeyed, whatever the node-ID",
       {"NMT-FSA-18"},
       misreads_commands([](Parts& parts, Frame& frame) {
         if (frame.size() > 2) frame = command_to(parts, frame.data[0]);
       })},
      {"nmt-lost-under-load",
       "Commands that follow 24 other frames within 50 ms are lost",
       {"NMT-FSA-28"},
       loses_commands_under_load()},
      {"nmt-queue-too-short",
       "Of commands back to back only the first two are obeyed",
       {"NMT-FSA-20"},
       keeps_two_commands()},
      {"nmt-can-id-cut-to-8-bits",
       "Only the lower eight bits of the CAN-ID say whether a frame is a command",
       {"NMT-FSA-27"},
       takes_for_command([](std::uint32_t id) { return (id & 0xFFU) == 0; })},
      {"nmt-can-id-bit-0-masked",
       "Commands are taken from CAN-ID 001h as well",
       {"NMT-FSA-27"},
       takes_for_command([](std::uint32_t id) { return id == 1; })},
      {"time-consumed-in-stopped",
       "TIME is taken in Stopped",
       {"NMT-SVC-03"},
       Reading([](Parts& parts, std::vector<Frame>& frames) {
         if (parts.device.state != NmtState::stopped) return;
         for (const Frame& frame : frames) (void)parts.time.on_frame(frame);
       })},
      {"time-not-consumed-in-operational",
       "TIME is not taken in Operational",
       {"NMT-SVC-03"},
       deaf_to([](Parts& parts, const Frame& frame) {
         return parts.device.state == NmtState::operational && frame.id == 0x100;
       })},
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
      {"nmt-reset-communication-to-all-ignored-in-stopped",
       "In Stopped reset communication to all nodes is ignored",
       {"NMT-FSA-14", "NMT-BOOT-03"},
       deaf_to([](Parts& parts, const Frame& frame) {
         return parts.device.state == NmtState::stopped && is_command(frame, reset_communication) &&
                frame.data[1] == 0;
       })},
      {"nmt-reset-node-in-stopped-resets-communication",
       "In Stopped reset node resets the communication only",
       {"NMT-FSA-25"},
       misreads_commands([](Parts& parts, Frame& frame) {
         if (parts.device.state == NmtState::stopped && frame.data[0] == reset_node)
           frame.data[0] = reset_communication;
       })},
      {"nmt-stop-to-all-ignored-in-preop",
       "In Pre-operational stop to all nodes is ignored",
       {"NMT-FSA-14"},
       deaf_to([](Parts& parts, const Frame& frame) {
         return parts.device.state == NmtState::pre_operational && is_command(frame, stop) &&
                frame.data[1] == 0;
       })},
  };
}

}  // namespace refnode
