// SPDX-License-Identifier: Apache-2.0
// Defects of the device as a whole on its bus: under load, while an SDO transfer is open, with any node-ID,
// with frames of others on its own CAN-IDs, and with 29-bit identifiers.
#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "defects/cob_ids.hpp"
#include "defects/hooks.hpp"
#include "defects/receivers.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

using namespace std::chrono_literals;

/// Whether more than `many` frames have come within `time`.
class Load {
 public:
  Load(std::size_t many, Duration time) : many_(many), time_(time) {}
  bool takes(BusTime now) {
    came_.push_back(now);
    while (came_.front() + time_ < now) came_.pop_front();
    return came_.size() > many_;
  }
  void forget() { came_.clear(); }

 private:
  std::size_t many_;
  Duration time_;
  std::deque<BusTime> came_;
};

/// A buffer of so many frames, which is worked off by and by, runs over: the watchdog resets the node.
Change restarts_when_flooded() {
  return [load = Load(40, 20ms)](Parts& parts, std::vector<Frame>&) mutable {
    if (!load.takes(parts.device.now)) return;
    load.forget();
    parts.nmt.start_reset(Reset::node);
  };
}

/// Each frame on the bus, whoever it is for, holds up the heartbeat.
Change heartbeat_waits_for_a_quiet_bus() {
  return [](Parts& parts) {
    const auto busy_until = std::make_shared<BusTime>();
    parts.device.inbox.add_filter([&parts, busy_until, load = Load(60, 20ms)](std::vector<Frame>&) mutable {
      if (load.takes(parts.device.now)) *busy_until = parts.device.now + 500ms;
    });
    parts.device.outbox.add_filter(
        [&parts, busy_until](const FilterContext& context, std::vector<Outgoing>& frames) {
          if (context.service == Service::heartbeat && parts.device.now < *busy_until) frames.clear();
        });
  };
}

/// The CAN-IDs of what the node sends are made with six bits of the node-ID.
Change node_id_of_six_bits() {
  return Filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
    for (Outgoing& each : frames) {
      const bool of_node =
          context.node_id >= 64 && !each.frame.extended && (each.frame.id & 0x7FU) == context.node_id;
      if (of_node) each.frame.id &= ~0x40U;
    }
  });
}

/// The highest node-ID is taken for none.
Change deaf_with_the_highest_node_id() {
  return deaf_to([](Parts& parts, const Frame& frame) {
    return parts.device.node_id == 127 && frame.id >= 0x580 && frame.id <= 0x67F;
  });
}

bool has_own_id(const Parts& parts, const Frame& frame, std::uint32_t base) {
  return !frame.extended && !frame.remote && frame.id == base + parts.device.node_id;
}

Change stops_when_its_heartbeat_is_heard() {
  return misreads([](Parts& parts, Frame& frame) {
    if (has_own_id(parts, frame, 0x700) && parts.device.state != NmtState::initialising)
      parts.nmt.enter(NmtState::stopped);
  });
}

Change server_hangs_on_its_own_response() {
  return [](Parts& parts) {
    deaf_to([hangs = false](Parts& whole, const Frame& frame) mutable {
      if (has_own_id(whole, frame, 0x580)) hangs = true;
      if (frame.id == 0x000) hangs = false;
      return hangs && has_own_id(whole, frame, 0x600);
    })(parts);
  };
}

/// The list of the nodes that 1016h names bites its tail when an entry gets another one once more.
void server_hangs_on_renamed_nodes(Parts& parts) {
  const auto renamed = since_boot_up<std::map<std::uint8_t, std::pair<std::uint64_t, int>>>(parts);
  after_writing_all(0x1016, [renamed](Parts& node, const std::function<void()>& former, std::uint8_t sub) {
    const std::uint64_t named = node.device.dictionary.number(0x1016, sub) >> 16U & 0x7FU;
    auto& [last, times] = (*renamed)[sub];
    if (last != 0 && named != 0 && named != last) ++times;
    if (named != 0) last = named;
    former();
  })(parts);
  deaf_to([renamed](Parts& whole, const Frame& frame) {
    int times = 0;
    for (const auto& [sub, each] : *renamed) times += each.second;
    return times > 2 && has_own_id(whole, frame, 0x600);
  })(parts);
}

constexpr std::uint32_t frame_bit = 0x2000'0000;

Change takes_frame_bit_of_tpdos() { return decided(of_tpdo, &CobIdRules::frame_bit_allowed, true); }

/// TPDOs whose COB-ID has bit 29 are sent with 29 bits, of which the upper ones are 0.
Change cuts_extended_ids() {
  return [](Parts& parts) {
    parts.device.outbox.add_filter([&parts](const FilterContext& context, std::vector<Outgoing>& frames) {
      if (context.service != Service::tpdo) return;
      for (Outgoing& each : frames) {
        for (std::uint16_t index = 0x1800; index < 0x1804; ++index) {
          const auto value = parts.device.dictionary.number(index, 1);
          if ((value & frame_bit) != 0 && (value & 0x7FFU) == each.frame.id) each.frame.extended = true;
        }
      }
    });
  };
}

/// While an SDO transfer is open, frames for which `when` holds are not looked at.
Change waits_for_sdo(bool (*when)(const Parts&, const Frame&)) {
  return deaf_to([when](Parts& parts, const Frame& frame) {
    return !frame.extended && has_open_transfer(parts) && when(parts, frame);
  });
}

bool is_change_of_state(const Parts&, const Frame& frame) {
  return !frame.remote && frame.id == 0x000 && frame.data[0] <= 0x80;
}
void takes_no_rpdo_beside_sdo(Parts& parts) {
  parts.pdos.rpdo.rules.valid.replace([&parts](const auto& former, const PdoParameters& pdo) {
    return !has_open_transfer(parts) && former(pdo);
  });
}

void sees_no_change_beside_sdo(Parts& parts) {
  parts.pdos.tpdo.rules.is_event.replace(
      [&parts](const auto& former, const PdoParameters& pdo, const Bytes& sent, const Bytes& now) {
        return !has_open_transfer(parts) && former(pdo, sent, now);
      });
}

void tells_no_error_beside_sdo(Parts& parts) {
  parts.device.outbox.add_filter([&parts](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service == Service::emergency && has_open_transfer(parts)) frames.clear();
  });
}

}  // namespace

DefectTable device_load_defects() {
  return {
      {"restarts-when-flooded",
       "More than 40 frames within 20 ms, whoever they are for, make the device restart",
       {"CAN-LOAD-02", "CAN-LOAD-01"},
       restarts_when_flooded()},
      {"heartbeat-waits-for-a-quiet-bus",
       "While the bus is busy the device sends no heartbeat",
       {"CAN-LOAD-01"},
       heartbeat_waits_for_a_quiet_bus()},
      {"node-id-of-six-bits",
       "With a node-ID from 64 on the device sends with the CAN-IDs of a lower one",
       {"CAN-ID-01", "LSS-CN-04"},
       node_id_of_six_bits()},
      {"node-id-127-without-sdo",
       "With node-ID 127 the SDO server is deaf",
       {"CAN-ID-01"},
       deaf_with_the_highest_node_id()},
      {"own-heartbeat-heard-stops",
       "A frame with the CAN-ID of its own heartbeat stops the device",
       {"CAN-ID-02"},
       stops_when_its_heartbeat_is_heard()},
      {"1016-renamed-nodes-hang-sdo",
       "Entries of 1016h that have named another node three times hang the SDO server",
       {"OD-1016-05"},
       Change(server_hangs_on_renamed_nodes)},
      {"own-response-heard-hangs-sdo",
       "A frame with the CAN-ID of its own SDO response makes the SDO server hang until the next NMT command",
       {"CAN-ID-02"},
       server_hangs_on_its_own_response()},
      {.id = "tpdo-29-bit-sent-with-11",
       .summary = "A TPDO whose COB-ID took bit 29 is sent in frames with 11 bits",
       .violates = {"CAN-EXT-01", "OD-1800-13"},
       .how = takes_frame_bit_of_tpdos(),
       .lacks = {"base frames only"}},
      {.id = "tpdo-29-bit-id-cut",
       .summary = "A TPDO whose COB-ID took bit 29 is sent with the lower 11 bits of its CAN-ID",
       .violates = {"CAN-EXT-01"},
       .how = together(takes_frame_bit_of_tpdos(), cuts_extended_ids()),
       .lacks = {"base frames only"}},
      {.id = "rpdo-29-bit-received-with-11",
       .summary = "An RPDO whose COB-ID took bit 29 is received in frames with 11 bits",
       .violates = {"CAN-EXT-01", "OD-1400-13"},
       .how = decided(of_rpdo, &CobIdRules::frame_bit_allowed, true),
       .lacks = {"base frames only"}},
      {"sync-lost-beside-sdo-transfer",
       "While an SDO transfer is open a SYNC has no effect",
       {"PDO-RX-03"},
       waits_for_sdo(is_sync)},
      {"rpdo-lost-beside-sdo-transfer",
       "While an SDO transfer is open RPDOs are not received",
       {"PDO-RX-01", "PDO-TX-08"},
       Change(takes_no_rpdo_beside_sdo)},
      {"tpdo-change-lost-beside-sdo-transfer",
       "While an SDO transfer is open a change sends no TPDO",
       {"PDO-TX-08"},
       Change(sees_no_change_beside_sdo)},
      {"emcy-lost-beside-sdo-transfer",
       "While an SDO transfer is open no error is reported",
       {"EC-HBC-03"},
       Change(tells_no_error_beside_sdo)},
      {"guarding-silent-beside-sdo-transfer",
       "While an SDO transfer is open guard requests are not answered",
       {"EC-NG-02"},
       waits_for_sdo(is_guard_request)},
      {"nmt-lost-beside-sdo-transfer",
       "While an SDO transfer is open NMT start, stop and enter pre-operational are ignored",
       {"NMT-FSA-03", "NMT-FSA-01", "NMT-FSA-02"},
       waits_for_sdo(is_change_of_state)},
  };
}

}  // namespace refnode
