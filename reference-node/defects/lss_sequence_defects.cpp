// SPDX-License-Identifier: Apache-2.0
// Defects of the LSS slave (CiA 305) in what several frames make up: what one address leaves behind for the
// next.
#include <utility>

#include "defects/hooks.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr std::uint32_t request_id = 0x7E5;
constexpr std::uint8_t switch_state_global = 0x04;
constexpr std::uint8_t selective_vendor = 0x40;
constexpr std::uint8_t identify_vendor = 0x46;
constexpr std::uint8_t identify_serial_high = 0x4B;
constexpr std::uint8_t fastscan = 0x51;
constexpr std::uint8_t begin_of_scan = 0x80;

bool is_request(const Frame& frame) {
  return frame.id == request_id && !frame.extended && !frame.remote && frame.size() == 8;
}

void identify(Parts& parts) {
  parts.device.send(Service::lss,
                    conform::can::data_frame(conform::CanId(0x7E4), {0x4F, 0, 0, 0, 0, 0, 0, 0}));
}

/// Behind `first` another frame of this kind is not taken before `last`.
Change begins_once(std::uint8_t first, std::uint8_t last) {
  return deaf_to([first, last, begun = false](Parts&, const Frame& frame) mutable {
    if (!is_request(frame)) return false;
    if (frame.data[0] == last) begun = false;
    if (frame.data[0] != first) return false;
    return std::exchange(begun, true);
  });
}

/// The last frame of ranges that were the slave's is answered once more.
Change answers_the_last_frame_again() {
  return misreads([last = std::uint8_t{0}](Parts& parts, Frame& frame) mutable {
    if (!is_request(frame)) return;
    const std::uint8_t before = std::exchange(last, frame.data[0]);
    if (before == identify_serial_high && last == identify_serial_high) identify(parts);
  });
}

/// A scan that begins behind one that was given up waits for the part that was due there.
Change goes_on_with_a_scan() {
  return deaf_to([parts_found = 0](Parts& parts, const Frame& frame) mutable {
    if (!is_request(frame) || frame.data[0] != fastscan || parts.device.node_id <= 127) return false;
    if (frame.data[5] != begin_of_scan) {
      parts_found = frame.data[7];
      return false;
    }
    if (parts_found != 0) identify(parts);
    return parts_found != 0;
  });
}

/// A slave without node-ID takes unknown commands for those of a scan.
void takes_unknown_for_scan(Parts& parts, Frame& frame) {
  if (is_request(frame) && frame.data[0] >= 0x60 && parts.device.node_id > 127) frame.data[0] = fastscan;
}

}  // namespace

DefectTable lss_sequence_defects() {
  return {
      {"lss-second-address-not-taken",
       "Behind a vendor-ID no other LSS address is taken before the next switch state global",
       {"LSS-SS-01"},
       begins_once(selective_vendor, switch_state_global)},
      {"lss-second-ranges-not-taken",
       "Ranges that were not ended are not followed by others",
       {"LSS-ID-02"},
       begins_once(identify_vendor, identify_serial_high)},
      {"lss-last-range-alone-answered",
       "The last frame of identify remote slave is answered once more when it comes alone",
       {"LSS-GEN-08"},
       answers_the_last_frame_again()},
      {"lss-fastscan-goes-on",
       "A fastscan that begins behind one that was given up goes on with that",
       {"LSS-FS-03"},
       goes_on_with_a_scan()},
      {"lss-does-not-boot-with-new-node-id",
       "A slave without node-ID that is given one goes on waiting, until power is switched",
       {"LSS-CN-06"},
       Change([](Parts& parts) { parts.lss.on_node_id = {}; })},
      {"lss-deaf-without-node-id",
       "A slave without node-ID does not listen, until power is switched",
       {"LSS-SS-01"},
       deaf_to([](Parts& parts, const Frame& frame) {
         return frame.id == request_id && parts.device.node_id > 127;
       })},
      {"lss-unknown-command-taken-for-fastscan",
       "A slave without node-ID takes unknown commands for fastscan",
       {"LSS-GEN-02"},
       misreads(takes_unknown_for_scan)},
  };
}

}  // namespace refnode
