// SPDX-License-Identifier: Apache-2.0
// Defects of what a node has no business to send: frames of services that it does not have, or that are
// switched off, and frames that were left in from the days of development.
#include <initializer_list>

#include "defects/hooks.hpp"
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
  };
}

}  // namespace refnode
