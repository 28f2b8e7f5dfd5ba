// SPDX-License-Identifier: Apache-2.0
// Defects of the NMT slave and of resets that show only behind something else: another command, another
// node's command, an error, a reset before.
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "defects/hooks.hpp"
#include "defects/receivers.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

using namespace nmt_command;

bool is_reset(const Frame& frame) {
  return frame.data[0] == reset_node || frame.data[0] == reset_communication;
}

/// The command that was given last is taken for done, although an error may have changed the state since.
void drops_repeated_commands(Parts& parts) {
  const auto last = std::make_shared<std::uint8_t>(0);
  deaf_to([last](Parts& node, const Frame& frame) {
    if (!is_nmt_command(frame) || !is_for(node, frame)) return false;
    const bool same = std::exchange(*last, frame.data[0]) == frame.data[0];
    return same && !is_reset(frame);
  })(parts);
}

/// RPDOs are switched on by the way through Pre-operational alone.
void ignores_rpdos_behind_stopped(Parts& parts) {
  const auto off = since_boot_up<bool>(parts);
  ahead_of_state_change([off](Parts& node) {
    if (node.device.state != NmtState::operational) *off = node.device.state == NmtState::stopped;
  })(parts);
  deaf_to([off](Parts&, const Frame& frame) {
    return *off && !frame.remote && (frame.extended || (frame.id >= 0x180 && frame.id < 0x580));
  })(parts);
}

/// With such a command the SDO server forgets its transfer.
Change drops_transfer_with(bool (*command)(const Parts& parts, const Frame& frame)) {
  return deaf_to([command](Parts& parts, const Frame& frame) {
    if (is_nmt_command(frame) && command(parts, frame)) parts.sdo.drop();
    return false;
  });
}

/// Such services hear of a state by the task of the heartbeat, which does not run while 1017h is 0. By
/// default it does.
Change told_by_the_heartbeat_task(bool (*hears)(Service service)) {
  return [hears](Parts& parts) {
    preset(0x1017, 0, 1000)(parts.device.dictionary, parts.device.node_id);
    const auto told = std::make_shared<NmtState>(NmtState::pre_operational);
    const auto tell = [told](Parts& node) {
      if (node.device.dictionary.number(0x1017, 0) != 0) *told = node.device.state;
    };
    with_boot_up([told](Parts&) { *told = NmtState::pre_operational; })(parts);
    ahead_of_state_change(tell)(parts);
    after_writing(0x1017, 0, [tell](Parts& node, const std::function<void()>& written) {
      written();
      tell(node);
    })(parts);
    parts.device.works.replace([told, hears](const auto& former, Service service, NmtState state) {
      return former(service, hears(service) && state != NmtState::initialising ? *told : state);
    });
  };
}

bool is_pdo(Service service) { return service == Service::rpdo || service == Service::tpdo; }

/// Behind reset communication the timer is left as it is where 1017h has not changed; but the reset had
/// stopped it.
void heartbeat_waits_for_a_change(Parts& parts) {
  const auto off = std::make_shared<bool>(false);
  parts.nmt.on_reset = [&parts, off, former = parts.nmt.on_reset](Reset kind) {
    const std::uint64_t before = parts.device.dictionary.number(0x1017, 0);
    former(kind);
    *off = kind == Reset::communication && parts.device.dictionary.number(0x1017, 0) == before;
  };
  after_writing(0x1017, 0, [off](Parts&, const std::function<void()>& written) {
    *off = false;
    written();
  })(parts);
  parts.device.outbox.add_filter([off](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service == Service::heartbeat && *off) frames.clear();
  });
}

/// The timer of the heartbeat runs on while the node starts, and the state is that of the boot-up message.
void heartbeat_goes_on_in_start_up(Parts& parts) {
  parts.nmt.on_reset = [&parts, former = parts.nmt.on_reset](Reset kind) {
    const Duration period = parts.producer.rules.period(parts.device.time_value(0x1017, 0));
    former(kind);
    if (period == Duration::zero()) return;
    const Duration start_up = parts.nmt.rules.start_up_time(kind);
    const Frame frame = conform::can::data_frame(conform::CanId(0x700U + parts.device.node_id), {0x00});
    std::vector<Outgoing> frames;
    for (Duration at = period / 2; at < start_up; at += period) frames.push_back({frame, at});
    if (frames.empty()) return;
    const FilterContext context{Service::heartbeat, parts.device.node_id, parts.device.state};
    parts.device.outbox.send(context, std::move(frames), parts.device.now);
  };
}

/// While an NMT frame is looked at, of whichever node, an SDO request is lost.
void loses_requests_behind_commands(Parts& parts) {
  const auto last = std::make_shared<std::optional<BusTime>>();
  deaf_to([last](Parts& node, const Frame& frame) {
    constexpr Duration until_read = std::chrono::milliseconds(1);
    if (is_nmt_command(frame)) *last = node.device.now;
    return *last && node.device.now - **last < until_read && node.sdo.server_of(frame) != nullptr;
  })(parts);
}

}  // namespace

DefectTable nmt_course_defects() {
  return {
      {"nmt-repeated-by-remote-frame",
       "A remote frame on CAN-ID 000h is taken for the last command once more",
       {"NMT-FSA-19"},
       repeats_by_remote_frame(0x000, is_nmt_command)},
      {"nmt-repeated-command-dropped",
       "Start, stop or enter pre-operational is dropped when it was the last command, too, whatever happened since",
       {"NMT-FSA-01"},
       Change(drops_repeated_commands)},
      {"rpdo-ignored-behind-stopped",
       "In Operational that was entered from Stopped no RPDO is processed",
       {"NMT-FSA-22"},
       Change(ignores_rpdos_behind_stopped)},
      {"nmt-of-another-drops-transfer",
       "An NMT command for another node ends the SDO transfer that runs",
       {"NMT-FSA-15"},
       drops_transfer_with([](const Parts& parts, const Frame& frame) { return !is_for(parts, frame); })},
      {"nmt-start-again-drops-transfer",
       "NMT start in Operational ends the SDO transfer that runs",
       {"NMT-FSA-13"},
       drops_transfer_with([](const Parts& parts, const Frame& frame) {
         return frame.data[0] == start && is_for(parts, frame) && parts.device.state == NmtState::operational;
       })},
      {"nmt-state-followed-with-heartbeat-only",
       "The default of 1017h is a second, and while it is 0 SDO and PDO do not hear of changes of the NMT state",
       {"NMT-FSA-22", "NMT-FSA-23", "SDO-GEN-15"},
       told_by_the_heartbeat_task(
           [](Service service) { return service == Service::sdo || is_pdo(service); })},
      {"pdos-follow-the-nmt-state-with-heartbeat-only",
       "The default of 1017h is a second, and while it is 0 PDOs do not hear of changes of the NMT state",
       {"NMT-FSA-22"},
       told_by_the_heartbeat_task(is_pdo)},
      {"heartbeat-silent-behind-reset-communication",
       "Where reset communication does not change 1017h the heartbeat does not start behind it",
       {"EC-HBP-05"},
       Change(heartbeat_waits_for_a_change)},
      {"heartbeat-in-start-up",
       "The heartbeat goes on while the node starts, and shows 00h",
       {"NMT-BOOT-02", "NMT-BOOT-03"},
       Change(heartbeat_goes_on_in_start_up)},
      {"nmt-node-id-bit6-masked",
       "Bit 6 of the node-ID of a command is not looked at",
       {"NMT-FSA-15"},
       misreads([](Parts& parts, Frame& frame) {
         if (is_nmt_command(frame) && frame.data[1] == (parts.device.node_id ^ 0x40U))
           frame.data[1] = parts.device.node_id;
       })},
      {"nmt-reset-node-of-all-resets-communication",
       "Reset node for all nodes resets the communication only",
       {"NMT-FSA-25"},
       misreads([](Parts&, Frame& frame) {
         if (is_nmt_command(frame) && frame.data[0] == reset_node && frame.data[1] == 0)
           frame.data[0] = reset_communication;
       })},
      {"nmt-reset-communication-of-all-resets-node",
       "Reset communication for all nodes resets the whole node",
       {"NMT-FSA-14", "NMT-FSA-26"},
       misreads([](Parts&, Frame& frame) {
         if (is_nmt_command(frame) && frame.data[0] == reset_communication && frame.data[1] == 0)
           frame.data[0] = reset_node;
       })},
      {"sdo-served-in-stopped-by-error",
       "In Stopped that an error has led to SDO is served",
       {"NMT-FSA-23"},
       works_where_led_by_error(Service::sdo, NmtState::stopped)},
      {"nmt-taken-from-can-ids-below-080h",
       "CAN-IDs from 000h to 07Fh are taken for commands, of 11 bits or 29",
       {"NMT-FSA-27", "NMT-FSA-19"},
       misreads([](Parts&, Frame& frame) {
         if (frame.id >= 0x80 || frame.remote) return;
         frame.id = 0;
         frame.extended = false;
       })},
      {"nmt-lost-behind-another",
       "Of commands on the bus one right behind the other the first one is obeyed",
       {"NMT-FSA-20"},
       has_one_buffer_for(is_nmt_command)},
      {"sdo-request-lost-behind-nmt",
       "An SDO request right behind an NMT command of another node is lost",
       {"CAN-LOAD-02"},
       Change(loses_requests_behind_commands)},
  };
}

}  // namespace refnode
