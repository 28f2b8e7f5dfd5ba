// SPDX-License-Identifier: Apache-2.0
// Defects of what a node has no business to send: frames of services that it does not have, or that are
// switched off, and frames that were left in from the days of development. And of frames that it takes for
// its own: by a part of their identifiers.
#include <cstdint>
#include <initializer_list>

#include "defects/hooks.hpp"
#include "defects/receivers.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

Frame frame_of(std::uint32_t id, std::initializer_list<std::uint8_t> data) {
  return conform::can::data_frame(conform::CanId(id), data);
}

/// Becoming Operational sends a frame that is no service of the node.
Change sends_when_operational(Service service, Frame frame) {
  return [service, frame](Parts& parts) {
    parts.nmt.on_change = [&parts, service, frame, former = parts.nmt.on_change](NmtState from) {
      former(from);
      if (parts.device.state == NmtState::operational) parts.device.send(service, frame);
    };
  };
}

/// So does every boot-up message, right behind it.
Change sends_behind_boot_up(Frame (*frame)(std::uint8_t node_id)) {
  return Filter([frame](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service == Service::boot_up) frames.push_back({frame(context.node_id), {}});
  });
}

/// ... and every SDO abort.
Change sends_behind_aborts(Frame frame) {
  return Filter([frame](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service == Service::sdo && context.sdo != nullptr && context.sdo->aborted)
      frames.push_back({frame, {}});
  });
}

Frame extended(Frame frame) {
  frame.extended = true;
  return frame;
}

/// Bit 6 of the CAN-ID of the second RPDO is not compared.
void takes_rpdo_of_another(Parts& parts, Frame& frame) {
  constexpr std::uint32_t bit = 0x40;
  const auto cob_id = parts.device.dictionary.number(0x1401, 1);
  const bool base = (cob_id & 0xA000'0000U) == 0;
  if (base && !frame.extended && !frame.remote && frame.id == ((cob_id & 0x7FFU) ^ bit)) frame.id ^= bit;
}

}  // namespace

DefectTable device_traffic_defects() {
  return {
      {"sync-sent-when-operational",
       "Becoming Operational sends a SYNC although the node is no producer",
       {"SYNC-PRO-03"},
       sends_when_operational(Service::sync, frame_of(0x080, {}))},
      {"time-sent-behind-boot-up",
       "The boot-up message is followed by a TIME message although the node is no producer",
       {"TIME-PRO-03"},
       sends_behind_boot_up([](std::uint8_t) { return frame_of(0x100, {0, 0, 0, 0, 0, 0}); })},
      {"trace-frame-on-restricted-can-id",
       "Every SDO abort is followed by a frame for developers on CAN-ID 7C0h",
       {"CAN-TRF-02"},
       sends_behind_aborts(frame_of(0x7C0, {0xAB, 0x01}))},
      {"trace-frame-on-free-can-id",
       "Every SDO abort is followed by a frame for developers on CAN-ID 6D3h",
       {"CAN-TRF-02"},
       sends_behind_aborts(frame_of(0x6D3, {0xAB, 0x01}))},
      {"trace-frame-with-29-bits",
       "The boot-up message is followed by a frame for developers with a 29-bit identifier",
       {"CAN-TRF-03"},
       sends_behind_boot_up([](std::uint8_t) { return extended(frame_of(0x18FF'0001, {0x01})); })},
      {"remote-frame-behind-boot-up",
       "The boot-up message is followed by a remote frame with CAN-ID 080h",
       {"CAN-TRF-04"},
       sends_behind_boot_up(
           [](std::uint8_t) { return conform::can::remote_frame(conform::CanId(0x080), 0); })},
      {"slave-guards-another-node",
       "The boot-up message is followed by a guard request to node 126",
       {"NMT-SVC-05"},
       sends_behind_boot_up(
           [](std::uint8_t) { return conform::can::remote_frame(conform::CanId(0x77E), 1); })},
      {"slave-sends-lss-commands",
       "Becoming Operational brings all LSS slaves into the waiting state",
       {"NMT-SVC-05"},
       sends_when_operational(Service::lss, frame_of(0x7E5, {0x04, 0x00, 0, 0, 0, 0, 0, 0}))},
      {"lss-answer-unasked",
       "The boot-up message is followed by an LSS answer that nobody asked for",
       {"LSS-GEN-08"},
       sends_behind_boot_up([](std::uint8_t) { return frame_of(0x7E4, {0x4F, 0, 0, 0, 0, 0, 0, 0}); })},
      {"nmt-known-by-lower-bits",
       "Extended frames whose lower eleven bits are 0, but not all, are NMT commands",
       {"NMT-FSA-19"},
       known_by(lower_bits, 0x000, 0x000)},
      {"sync-known-by-lower-bits",
       "Extended frames whose lower eleven bits are 080h, and others set, are SYNC",
       {"SYNC-CON-02"},
       known_by(lower_bits, 0x080, 0x080)},
      {"sync-known-by-upper-bits",
       "Extended frames whose upper eleven bits are 080h are SYNC",
       {"SYNC-CON-02"},
       known_by(upper_bits, 0x080, 0x080)},
      {"time-known-by-lower-bits",
       "Extended frames whose lower eleven bits are 100h, and others set, are TIME",
       {"TIME-CON-03"},
       known_by(lower_bits, 0x100, 0x100)},
      {"time-known-by-upper-bits",
       "Extended frames whose upper eleven bits are 100h are TIME",
       {"TIME-CON-03"},
       known_by(upper_bits, 0x100, 0x100)},
      {"rpdo-known-by-lower-bits",
       "Extended frames whose lower eleven bits are those of an RPDO, and others set, are that RPDO",
       {"PDO-RX-13"},
       known_by(lower_bits, 0x200, 0x57F)},
      {"rpdo-known-by-upper-bits",
       "Extended frames whose upper eleven bits are those of an RPDO are that RPDO",
       {"PDO-RX-13"},
       known_by(upper_bits, 0x200, 0x57F)},
      {"rpdo-2-known-without-bit-6",
       "The second RPDO is also received with bit 6 of its CAN-ID inverted, as that of another node",
       {"PDO-RX-13"},
       misreads(takes_rpdo_of_another)},
      {"sdo-known-by-lower-bits",
       "Extended frames whose lower eleven bits are those of SDO requests, and others set, are requests",
       {"SDO-GEN-11"},
       known_by(lower_bits, 0x600, 0x67F)},
      {"sdo-known-by-upper-bits",
       "Extended frames whose upper eleven bits are those of SDO requests are requests",
       {"SDO-GEN-11"},
       known_by(upper_bits, 0x600, 0x67F)},
      {"heartbeat-known-by-lower-bits",
       "Extended frames whose lower eleven bits are those of a heartbeat, and others set, are heartbeats",
       {"EC-HBC-11", "EC-HBC-03"},
       known_by(lower_bits, 0x701, 0x77F)},
      {"heartbeat-known-by-upper-bits",
       "Extended frames whose upper eleven bits are those of a heartbeat are heartbeats",
       {"EC-HBC-11", "EC-HBC-03"},
       known_by(upper_bits, 0x701, 0x77F)},
  };
}

}  // namespace refnode
