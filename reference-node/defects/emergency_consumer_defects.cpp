// SPDX-License-Identifier: Apache-2.0
// Defects of the EMCY consumer (1028h).
#include <vector>

#include "defects/cob_ids.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr DataType u16 = DataType::unsigned16;
constexpr DataType u32 = DataType::unsigned32;

bool is_emergency_of_another(const Parts& parts, const Frame& frame) {
  return frame.id > 0x80 && frame.id <= 0xFF && frame.id != 0x80U + parts.device.node_id && !frame.extended &&
         !frame.remote;
}

/// Every EMCY that comes is sent again as one of this node.
void passes_on(Parts& parts, std::vector<Frame>& frames) {
  for (Frame frame : frames) {
    if (!is_emergency_of_another(parts, frame)) continue;
    frame.id = 0x80U + parts.device.node_id;
    frame.dlc = 8;
    parts.device.send(Service::emergency, frame);
  }
}

}  // namespace

DefectTable emergency_consumer_defects() {
  return {
      {"1028-sub0-out-of-range", "1028h:00 is 00h", {"OD-1028-01", "OD-GEN-11"}, preset(0x1028, 0, 0)},
      {"1028-sub0-is-u32",
       "1028h:00 has four bytes",
       {"OD-1028-01", "OD-GEN-10", "OD-GEN-17"},
       type(0x1028, 0, u32)},
      {"1028-sub0-writable",
       "1028h:00 can be written",
       {"OD-1028-02", "OD-ACC-02", "SDO-DNL-09"},
       access(0x1028, 0, Access::rw)},
      {"1028-sub1-missing",
       "1028h:01 does not exist",
       {"OD-1028-03", "OD-CAT-02", "OD-GEN-17"},
       absent_sub(0x1028, 1)},
      {"1028-entry-is-u16",
       "1028h:02 has two bytes",
       {"OD-1028-03", "OD-GEN-19", "OD-LEN-04", "OD-GEN-17"},
       type(0x1028, 2, u16)},
      {"1028-reserved-bit30-set",
       "Bit 30 of 1028h:01 is set by default",
       {"OD-1028-04"},
       preset(0x1028, 1, 0xC0000000)},
      {"1028-reserved-bit30-writable",
       "Bit 30 of 1028h can be set",
       {"OD-1028-04"},
       decided(of_emergencies, &CobIdRules::bit30_allowed, true)},
      {"1028-upper-bits-set",
       "1028h:01 has bits above the CAN-ID set by default",
       {"OD-1028-04"},
       preset(0x1028, 1, 0x80010081)},
      {"1028-frame-bit-accepted",
       "1028h accepts bit 29 although the node knows base frames only",
       {"OD-1028-05"},
       decided(of_emergencies, &CobIdRules::frame_bit_allowed, true)},
      {"1028-frame-bit-wrong-abort",
       "1028h refuses with 0601 0000h instead of 0609 0030h",
       {"OD-1028-05", "OD-1028-06"},
       wrong_abort(abort_code::invalid_value, abort_code::unsupported_access, {0x1028, 0x1028})},
      {"1028-lock-missing",
       "The CAN-ID of a valid entry of 1028h can be changed",
       {"OD-1028-06", "EMCY-CON-01"},
       decided(of_emergencies, &CobIdRules::locked, false)},
      {"1028-change-refused",
       "1028h refuses another CAN-ID even while the entry is not valid",
       {"OD-1028-07"},
       keeps_can_ids(0x1028)},
      {"1028-change-not-stored",
       "Writing 1028h:01 and 1028h:02 is confirmed and forgotten",
       {"OD-1028-07"},
       both(not_stored(0x1028, 1), not_stored(0x1028, 2))},
      {"emcy-of-others-passed-on",
       "An EMCY of another node is sent again as one of this node",
       {"EMCY-CON-02"},
       Reading(passes_on)},
      {"1028-const-writable",
       "1028h:04 can be written although it is constant",
       {"OD-1028-08", "OD-ACC-02"},
       access(0x1028, 4, Access::rw)},
  };
}

}  // namespace refnode
