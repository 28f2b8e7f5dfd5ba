// SPDX-License-Identifier: Apache-2.0
// Defects of the COB-ID parameters 1005h, 1012h, 1014h, 1400h:01 and 1800h:01.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "defects/cob_ids.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

bool is_the_same(std::uint64_t present, std::uint64_t wanted) { return wanted == present; }
bool sets_bit31(std::uint64_t present, std::uint64_t wanted) {
  return wanted != present && (wanted & 0x80000000U) != 0;
}

/// Bits 31-28 of the milliseconds of a TIME message show in 2F10h.
Change keeps_reserved_bits_of_time() {
  return [](Parts& parts) {
    const auto reserved = std::make_shared<std::uint8_t>();
    Change(Reading([reserved](Parts&, std::vector<Frame>& frames) {
      for (const Frame& frame : frames) {
        if (frame.size() == 6) *reserved = frame.data[3] & 0xF0U;
      }
    }))(parts);
    reading(0x2F10, 0, [reserved](Parts&, const Read& former) {
      Upload time = former();
      if (time) (*time)[3] |= *reserved;
      return time;
    })(parts);
  };
}

/// A restricted CAN-ID is taken with bit 31, which has no meaning in 1005h.
Accepted takes_restricted_with_bit31(Parts&, const Check& former, ByteView bytes) {
  const auto wanted = static_cast<std::uint32_t>(conform::load_le(bytes));
  const bool taken = (wanted & 0xFFFFF800U) == 0x80000000U && restricted_can_id(wanted & 0x7FFU);
  return taken ? Accepted{} : former(bytes);
}

/// TIME is taken on the CAN-ID that differs in the lowest bit as well.
void compares_ten_bits_of_time(Parts& parts, Frame& frame) {
  const std::uint64_t cob_id = parts.device.dictionary.number(0x1012, 0);
  if (!frame.remote && !frame.extended && ((frame.id ^ cob_id) & 0x7FFU) == 1) frame.id ^= 1U;
}

/// What comes on the CAN-ID that the entry named before is taken, too.
Change hears_former_can_id(std::uint16_t index, std::uint8_t sub) {
  struct Known {
    std::uint32_t now = 0;
    std::uint32_t former = 0;
  };
  return Reading([index, sub, known = std::make_shared<Known>()](Parts& parts, std::vector<Frame>& frames) {
    const auto named = static_cast<std::uint32_t>(parts.device.dictionary.number(index, sub)) & 0x7FFU;
    if (named != known->now) *known = {.now = named, .former = known->now};
    std::vector<Frame> again;
    for (const Frame& frame : frames) {
      const bool other = frame.extended || frame.remote || known->former == 0;
      if (other || frame.id != known->former) continue;
      again.push_back(frame);
      again.back().id = named;
    }
    frames.insert(frames.end(), again.begin(), again.end());
  });
}

/// A CAN-ID that lacks the node-ID to be the default one is read with it.
Change reads_with_node_id(std::uint16_t index, std::uint32_t base) {
  return reading(index, 1, [base](Parts& parts, const Read& former) {
    Upload value = former();
    if (!value || value->size() != 4) return value;
    const std::uint64_t number = conform::load_le(*value);
    if ((number & 0x7FFU) == base) conform::store_le(std::span(*value), number + parts.device.node_id);
    return value;
  });
}

/// The lowest bit of a CAN-ID may be changed at any time.
Change unlocks_lowest_bit(std::uint16_t index, std::uint8_t sub) {
  return checking(index, sub, [index, sub](Parts& parts, const Check& former, ByteView bytes) {
    const bool lowest = (parts.device.dictionary.number(index, sub) ^ conform::load_le(bytes)) == 1;
    return lowest ? Accepted{} : former(bytes);
  });
}

/// This bit of a CAN-ID may be changed at any time, where no restricted CAN-ID comes of it.
Change unlocks_bit(std::uint16_t index, std::uint8_t sub, std::uint32_t bit) {
  return checking(index, sub, [index, sub, bit](Parts& parts, const Check& former, ByteView bytes) {
    const auto wanted = static_cast<std::uint32_t>(conform::load_le(bytes));
    const bool alone = (parts.device.dictionary.number(index, sub) ^ wanted) == bit;
    return alone && !restricted_can_id(wanted & 0x7FFU) ? Accepted{} : former(bytes);
  });
}

/// The restricted ranges above those of the PDOs are taken to begin and to end one CAN-ID further out.
Change restricts_neighbours(CobIdPart part) {
  return decides(part, &CobIdRules::restricted, [](const auto& former, std::uint32_t id) {
    constexpr std::uint32_t behind_pdos = 0x580;
    return former(id) || (id >= behind_pdos && (former(id - 1) || former(id + 1)));
  });
}

}  // namespace

DefectTable cob_id_defects() {
  constexpr AbortCode right = abort_code::invalid_value;
  constexpr AbortCode wrong = abort_code::unsupported_access;
  return {
      {"1005-gen-bit-accepted",
       "1005h accepts bit 30 although the node generates no SYNC",
       {"OD-1005-03", "SYNC-COB-03", "OD-CID-05"},
       decided(of_sync, &CobIdRules::produced, false),
       {"sync producer"}},
      {"1005-comes-with-000h",
       "1005h comes with 000h, the CAN-ID of NMT",
       {"OD-CID-03", "OD-1005-02"},
       preset(0x1005, 0, 0)},
      {"1005-frame-bit-accepted",
       "1005h accepts bit 29 although the node knows base frames only",
       {"OD-1005-04", "SYNC-COB-04", "OD-CID-05"},
       decided(of_sync, &CobIdRules::frame_bit_allowed, true)},
      {"1005-wrong-abort",
       "1005h refuses with 0601 0000h instead of 0609 0030h",
       {"OD-1005-03", "OD-1005-04", "SYNC-COB-03", "SYNC-COB-04", "OD-CID-05", "OD-1005-12"},
       wrong_abort_at(mux(0x1005, 0), right, wrong)},
      {"1005-restricted-accepted-with-bit31",
       "1005h accepts restricted CAN-IDs together with bit 31",
       {"CAN-RID-01", "OD-CID-03"},
       checking(0x1005, 0, takes_restricted_with_bit31)},
      {"1012-lowest-bit-not-compared",
       "TIME is taken on a CAN-ID that differs in the lowest bit from that of 1012h",
       {"TIME-CON-01"},
       misreads(compares_ten_bits_of_time)},
      {"1005-change-refused",
       "1005h refuses another CAN-ID",
       {"OD-1005-06"},
       refuses(0x1005, 0, abort_code::invalid_value, is_moved)},
      {"1005-new-id-not-used",
       "The node goes on listening on 080h after 1005h was changed",
       {"OD-1005-07", "SYNC-COB-02", "OD-1005-09"},
       stays_on_default(of_sync)},
      {"1005-former-id-used-too",
       "A SYNC on the CAN-ID that 1005h named before is used, too",
       {"OD-1005-07", "SYNC-COB-02"},
       hears_former_can_id(0x1005, 0)},
      {"1012-former-id-used-too",
       "A TIME on the CAN-ID that 1012h named before is used, too",
       {"TIME-CON-01"},
       hears_former_can_id(0x1012, 0)},
      {"1400-former-id-used-too",
       "An RPDO that was moved is received on its former CAN-ID, too",
       {"OD-1400-11"},
       hears_former_can_id(0x1400, 1)},
      {"1403-former-id-used-too",
       "RPDO 4, when it was moved, is received on its former CAN-ID, too",
       {"OD-1400-11"},
       hears_former_can_id(0x1403, 1)},
      {"1401-base-id-reads-with-node-id",
       "The CAN-ID 300h of RPDO 2 is read back with the node-ID",
       {"OD-1400-11"},
       reads_with_node_id(0x1401, 0x300)},
      {"1801-base-id-reads-with-node-id",
       "The CAN-ID 280h of TPDO 2 is read back with the node-ID",
       {"OD-1800-11"},
       reads_with_node_id(0x1801, 0x280)},
      {"1005-bit31-treated-as-valid",
       "1005h refuses bit 31",
       {"OD-1005-11"},
       refuses(0x1005, 0, abort_code::invalid_value, sets_bit31)},
      {"1005-upper-id-bits-accepted",
       "1005h accepts bits 28-11 with an 11-bit identifier",
       {"OD-1005-12"},
       decided(of_sync, &CobIdRules::upper_bits_allowed, true)},
      {"1005-restricted-id-accepted",
       "1005h accepts restricted CAN-IDs",
       {"CAN-RID-01", "OD-CID-03"},
       decided(of_sync, &CobIdRules::restricted, false)},
      {"1005-id-of-sdo-taken",
       "1005h accepts restricted CAN-IDs, and with that of its SDO requests the SDO server is dead",
       {"CAN-RID-01", "OD-CID-03"},
       together(decided(of_sync, &CobIdRules::restricted, false),
                deaf_to([](Parts& parts, const Frame& frame) {
                  return !frame.extended && !frame.remote && parts.sync.on_frame(frame);
                }))},
      {"1012-produce-bit-accepted",
       "1012h accepts bit 30 although the node produces no TIME",
       {"OD-1012-03", "TIME-COB-02", "OD-CID-05"},
       decided(of_time, &CobIdRules::produced, false),
       {"time producer"}},
      {"1012-frame-bit-accepted",
       "1012h accepts bit 29 although the node knows base frames only",
       {"OD-1012-04", "TIME-COB-03", "OD-CID-05"},
       decided(of_time, &CobIdRules::frame_bit_allowed, true)},
      {"1012-wrong-abort",
       "1012h refuses with 0601 0000h instead of 0609 0030h",
       {"OD-1012-03", "OD-1012-04", "OD-1012-05", "TIME-COB-02", "TIME-COB-03"},
       wrong_abort_at(mux(0x1012, 0), right, wrong)},
      {"1012-lock-missing",
       "The CAN-ID of 1012h can be changed while TIME is consumed",
       {"OD-1012-05", "TIME-COB-04"},
       decided(of_time, &CobIdRules::locked, false)},
      {"1012-change-refused",
       "1012h refuses another CAN-ID",
       {"OD-1012-06"},
       refuses(0x1012, 0, abort_code::invalid_value, is_moved)},
      {"1012-consumes-when-disabled",
       "TIME is consumed whatever bit 31 of 1012h says",
       {"OD-1012-07", "TIME-CON-04"},
       decided(of_time, &CobIdRules::valid, true)},
      {"1012-consume-bit-inverted",
       "Bit 31 of 1012h = 0 consumes TIME",
       {"OD-1012-07", "TIME-CON-01", "TIME-CON-04"},
       inverted(of_time, &CobIdRules::valid)},
      {"1012-restricted-id-accepted",
       "1012h accepts restricted CAN-IDs",
       {"CAN-RID-02", "OD-CID-03"},
       decided(of_time, &CobIdRules::restricted, false)},
      {"time-short-taken",
       "A TIME message of five bytes is taken over",
       {"TIME-CON-03"},
       misreads([](Parts&, Frame& frame) {
         if (!frame.extended && !frame.remote && frame.id == 0x100 && frame.dlc == 5) frame.dlc = 6;
       })},
      {"time-of-eight-bytes-taken-wrongly",
       "Of a TIME message of eight bytes the last six are taken over",
       {"TIME-CON-03"},
       misreads([](Parts&, Frame& frame) {
         if (frame.extended || frame.remote || frame.id != 0x100 || frame.dlc != 8) return;
         std::copy(frame.data.begin() + 2, frame.data.begin() + 8, frame.data.begin());
         frame.dlc = 6;
       })},
      {"time-reserved-bits-not-masked",
       "The reserved bits of a TIME message are taken for milliseconds",
       {"TIME-CON-02"},
       keeps_reserved_bits_of_time()},
      {"1014-lock-missing",
       "The CAN-ID of 1014h can be changed while EMCY is valid",
       {"OD-1014-06", "EMCY-COB-04"},
       decided(of_emergency, &CobIdRules::locked, false)},
      {"1014-frame-bit-accepted",
       "1014h accepts bit 29 although the node knows base frames only",
       {"OD-1014-05", "EMCY-COB-05"},
       decided(of_emergency, &CobIdRules::frame_bit_allowed, true)},
      {"1014-frame-bit-wrong-abort",
       "1014h refuses with 0601 0000h instead of 0609 0030h",
       {"OD-1014-05", "OD-1014-06", "OD-1014-04", "EMCY-COB-05"},
       wrong_abort_at(mux(0x1014, 0), right, wrong)},
      {"1014-reserved-bit30-writable",
       "Bit 30 of 1014h can be set",
       {"OD-1014-04", "OD-1014-03"},
       decided(of_emergency, &CobIdRules::bit30_allowed, true)},
      {"1014-lowest-bit-not-locked",
       "The lowest bit of the CAN-ID of EMCY can be changed while EMCY is valid",
       {"OD-1014-06"},
       unlocks_lowest_bit(0x1014, 0)},
      {"1014-bit-7-not-locked",
       "Bit 7 of the CAN-ID of EMCY can be changed while EMCY is valid",
       {"OD-1014-06"},
       unlocks_bit(0x1014, 0, 0x80)},
      {"1400-highest-bit-not-locked",
       "Bit 10 of the CAN-ID of a valid RPDO can be changed",
       {"OD-1400-10"},
       unlocks_bit(0x1400, 1, 0x400)},
      {"1800-highest-bit-not-locked",
       "Bit 10 of the CAN-ID of a valid TPDO can be changed",
       {"OD-1800-10"},
       unlocks_bit(0x1800, 1, 0x400)},
      {"1201-request-highest-bit-not-locked",
       "Bit 10 of the CAN-ID of the requests to a valid SDO server can be changed",
       {"OD-1201-05"},
       unlocks_bit(0x1201, 1, 0x400)},
      {"1201-response-bit-9-not-locked",
       "Bit 9 of the CAN-ID of the responses of a valid SDO server can be changed",
       {"OD-1201-05"},
       unlocks_bit(0x1201, 2, 0x200)},
      {"1014-valid-bit-polarity-inverted",
       "EMCY is sent with bit 31 of 1014h set and not without",
       {"OD-1014-08", "EMCY-COB-03", "EMCY-FMT-01", "OD-1014-07"},
       inverted(of_emergency, &CobIdRules::valid)},
      {"1014-change-refused",
       "1014h refuses another CAN-ID even while EMCY is not valid",
       {"OD-1014-07", "EMCY-COB-02"},
       refuses(0x1014, 0, abort_code::invalid_value, is_moved)},
      {"1014-new-id-not-used",
       "EMCY stays on 80h + node-ID after 1014h was changed",
       {"OD-1014-07", "EMCY-COB-02", "NMT-FSA-29"},
       stays_on_default(of_emergency)},
      {"1014-restricted-id-accepted",
       "1014h accepts restricted CAN-IDs",
       {"CAN-RID-03", "OD-CID-03"},
       decided(of_emergency, &CobIdRules::restricted, false)},
      {"1014-upper-id-bits-accepted",
       "1014h accepts bits 28-11 with an 11-bit identifier",
       {"OD-CID-01", "CAN-RID-08"},
       decided(of_emergency, &CobIdRules::upper_bits_allowed, true)},
      {"1014-rewrite-refused",
       "1014h refuses the value it holds",
       {"OD-CID-04", "SDO-DNL-21"},
       refuses(0x1014, 0, abort_code::invalid_value, is_the_same)},
      {"1400-lock-missing",
       "The CAN-ID of a valid RPDO can be changed",
       {"OD-1400-10", "PDO-RX-10"},
       decided(of_rpdo, &CobIdRules::locked, false)},
      {"1400-frame-bit-accepted",
       "1400h:01 accepts bit 29 although the node knows base frames only",
       {"OD-1400-13", "PDO-RX-11"},
       decided(of_rpdo, &CobIdRules::frame_bit_allowed, true)},
      {"1400-frame-bit-wrong-abort",
       "1400h:01 refuses with 0601 0000h instead of 0609 0030h",
       {"OD-1400-13", "OD-1400-10", "PDO-RX-11"},
       wrong_abort_at(mux(0x1400, 1), right, wrong)},
      {"1400-valid-bit-polarity-inverted",
       "The RPDO is received with bit 31 set and not without",
       {"OD-1400-09", "PDO-RX-08", "PDO-RX-01"},
       inverted(of_rpdo, &CobIdRules::valid)},
      {"1400-disable-ignored",
       "The RPDO is received whatever bit 31 says",
       {"OD-1400-09", "PDO-RX-08"},
       decided(of_rpdo, &CobIdRules::valid, true)},
      {"1400-change-refused",
       "1400h:01 refuses another CAN-ID even while the RPDO is not valid",
       {"OD-1400-11", "PDO-RX-09"},
       refuses(0x1400, 1, abort_code::invalid_value, is_moved)},
      {"1400-new-id-not-used",
       "The RPDO stays on its default CAN-ID",
       {"OD-1400-11", "PDO-RX-09"},
       stays_on_default(of_rpdo)},
      {"1400-restricted-id-accepted",
       "1400h:01 accepts restricted CAN-IDs",
       {"CAN-RID-04", "OD-CID-03"},
       decided(of_rpdo, &CobIdRules::restricted, false)},
      {"1400-neighbours-of-restricted-ids-refused",
       "1400h:01 refuses the CAN-IDs next to restricted ones",
       {"CAN-RID-07"},
       restricts_neighbours(of_rpdo)},
      {"1400-bit30-refused",
       "1400h:01 refuses a change of bit 30 with 0601 0000h",
       {"OD-1400-14"},
       refuses(0x1400, 1, wrong,
               [](std::uint64_t present, std::uint64_t wanted) {
                 return ((present ^ wanted) & 0x40000000U) != 0;
               })},
      {"rpdo1-default-without-node-id",
       "The default of 1400h:01 lacks the node-ID",
       {"OD-1400-04", "PDO-DEF-01"},
       preset(0x1400, 1, 0x200)},
      {"rpdo1-default-cob-id-wrong",
       "The default of 1400h:01 is 300h + node-ID",
       {"OD-1400-04", "PDO-DEF-01"},
       preset_with_node_id(0x1400, 1, 0x300)},
      {"1800-lock-missing",
       "The CAN-ID of a valid TPDO can be changed",
       {"OD-1800-10", "PDO-TX-23"},
       decided(of_tpdo, &CobIdRules::locked, false)},
      {"1800-frame-bit-accepted",
       "1800h:01 accepts bit 29 although the node knows base frames only",
       {"OD-1800-13", "PDO-TX-24"},
       decided(of_tpdo, &CobIdRules::frame_bit_allowed, true)},
      {"1800-frame-bit-wrong-abort",
       "1800h:01 refuses with 0601 0000h instead of 0609 0030h",
       {"OD-1800-13", "OD-1800-10", "PDO-TX-24"},
       wrong_abort_at(mux(0x1800, 1), right, wrong)},
      {"1800-valid-bit-polarity-inverted",
       "The TPDO is sent with bit 31 set and not without",
       {"OD-1800-09", "PDO-TX-03", "PDO-TX-05", "PDO-TX-07"},
       inverted(of_tpdo, &CobIdRules::valid)},
      {"1800-disable-ignored",
       "The TPDO is sent whatever bit 31 says",
       {"OD-1800-09", "PDO-TX-03"},
       decided(of_tpdo, &CobIdRules::valid, true)},
      {"1800-change-refused",
       "1800h:01 refuses another CAN-ID even while the TPDO is not valid",
       {"OD-1800-11", "PDO-TX-04"},
       refuses(0x1800, 1, abort_code::invalid_value, is_moved)},
      {"1800-new-id-not-used",
       "The TPDO stays on its default CAN-ID",
       {"OD-1800-11", "PDO-TX-01", "PDO-TX-04", "NMT-FSA-29"},
       stays_on_default(of_tpdo)},
      {"1800-restricted-id-accepted",
       "1800h:01 accepts restricted CAN-IDs",
       {"CAN-RID-05", "OD-CID-03"},
       decided(of_tpdo, &CobIdRules::restricted, false)},
      {"1800-upper-id-bits-accepted",
       "1800h:01 accepts bits 28-11 with an 11-bit identifier",
       {"CAN-RID-08"},
       decided(of_tpdo, &CobIdRules::upper_bits_allowed, true)},
      {"1800-answers-rtr-when-forbidden",
       "Remote frames are answered although bit 30 forbids it",
       {"OD-1800-14", "PDO-TX-21"},
       decided(of_tpdo, &CobIdRules::remote_allowed, true)},
      {"1800-rtr-bit-polarity-inverted",
       "Remote frames are answered with bit 30 set and not without",
       {"OD-1800-14", "PDO-TX-21", "PDO-TX-19"},
       inverted(of_tpdo, &CobIdRules::remote_allowed)},
      {"1800-neighbours-of-restricted-ids-refused",
       "1800h:01 refuses the CAN-IDs next to restricted ones",
       {"CAN-RID-07"},
       restricts_neighbours(of_tpdo)},
      {"tpdo1-default-without-node-id",
       "The default of 1800h:01 lacks the node-ID",
       {"OD-1800-04", "PDO-DEF-02"},
       preset(0x1800, 1, 0x40000180)},
      {"tpdo1-default-cob-id-wrong",
       "The default of 1800h:01 is 280h + node-ID",
       {"OD-1800-04", "PDO-DEF-02"},
       preset_with_node_id(0x1800, 1, 0x40000280)},
  };
}

}  // namespace refnode
