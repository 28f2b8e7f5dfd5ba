// SPDX-License-Identifier: Apache-2.0
// Defects of single communication objects: absent entries, other access, other length, other default.
#include <iterator>

#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr DataType u8 = DataType::unsigned8;
constexpr DataType u16 = DataType::unsigned16;
constexpr DataType u32 = DataType::unsigned32;

Bytes text(std::string_view value) { return Bytes(value.begin(), value.end()); }

DefectTable identity_rows() {
  return {
      {"1000-absent", "1000h does not exist", {"OD-1000-01", "OD-CAT-01"}, absent(0x1000)},
      {"1000-is-u16", "1000h has two bytes", {"OD-1000-01", "OD-LEN-04", "OD-CAT-01"}, type(0x1000, 0, u16)},
      {"1000-writable", "1000h can be written", {"OD-1000-02", "OD-ACC-01", "OD-ACC-08", "SDO-DNL-07", "SDO-SDN-21"}, access(0x1000, 0, Access::rw)},
      {"1000-profile-zero-with-info", "1000h has additional information without a device profile", {"OD-1000-03", "OD-1000-07"}, preset(0x1000, 0, 0x000F0000)},
      {"1000-wrong-value", "1000h names CiA 402 instead of CiA 401", {"OD-1000-07"}, preset(0x1000, 0, 0x000F0192)},
      {"1001-absent", "1001h does not exist", {"OD-1001-01", "OD-CAT-01"}, absent(0x1001)},
      {"1001-is-u32", "1001h has four bytes", {"OD-1001-01", "OD-LEN-04", "SDO-UPL-02"}, type(0x1001, 0, u32)},
      {"1001-writable", "1001h can be written", {"OD-1001-02", "OD-ACC-01"}, access(0x1001, 0, Access::rw)},
      {"1002-is-u16", "1002h has two bytes", {"OD-1002-01", "OD-LEN-04"}, type(0x1002, 0, u16)},
      {"1002-writable", "1002h can be written", {"OD-1002-02"}, access(0x1002, 0, Access::rw)},
      {"1008-non-visible-characters", "1008h contains a control character", {"OD-1008-01"}, bytes(0x1008, 0, text("canopen\x07refnode"))},
      {"1008-writable", "1008h can be written", {"OD-1008-02", "SDO-DNL-08", "OD-ACC-02"}, access(0x1008, 0, Access::rw)},
      {"1009-non-visible-characters", "1009h contains a character above 7Eh", {"OD-1009-01"}, bytes(0x1009, 0, text("M\xFChle 1"))},
      {"1009-writable", "1009h can be written", {"OD-1009-02", "SDO-DNL-08", "OD-ACC-02"}, access(0x1009, 0, Access::rw)},
      {"100a-non-visible-characters", "100Ah contains a tab", {"OD-100A-01"}, bytes(0x100A, 0, text("1.00\tbeta"))},
      {"100a-writable", "100Ah can be written", {"OD-100A-02", "SDO-DNL-08", "OD-ACC-02"}, access(0x100A, 0, Access::rw)},
      {"1018-absent", "1018h does not exist", {"OD-1018-01", "OD-CAT-01"}, absent(0x1018)},
      {"1018-vendor-absent", "1018h:01 does not exist", {"OD-1018-03", "OD-CAT-01", "OD-CAT-02"}, absent_sub(0x1018, 1)},
      {"1018-sub0-out-of-range", "1018h has a fifth entry", {"OD-1018-01"},
       both(extra(0x1018, 5, integer_entry("Fifth", u32, Access::ro, 1)), preset(0x1018, 0, 5))},
      {"1018-sub0-is-u32", "1018h:00 has four bytes", {"OD-1018-01", "OD-GEN-10", "OD-LEN-04"}, type(0x1018, 0, u32)},
      {"1018-sub0-writable", "1018h:00 can be written", {"OD-1018-02", "OD-ACC-02", "SDO-DNL-09"}, access(0x1018, 0, Access::rw)},
      {"1018-vendor-zero", "The vendor-ID is 0000 0000h", {"OD-1018-03", "OD-1018-08"}, preset(0x1018, 1, 0)},
      {"1018-vendor-is-u16", "The vendor-ID has two bytes", {"OD-1018-03", "OD-CAT-01", "OD-LEN-04"}, type(0x1018, 1, u16)},
      {"1018-vendor-writable", "The vendor-ID can be written", {"OD-1018-04"}, access(0x1018, 1, Access::rw)},
      {"1018-serial-writable", "The serial number can be written", {"OD-1018-04"}, access(0x1018, 4, Access::rw)},
      {"1018-optional-sub-wrong-size", "The revision number has two bytes", {"OD-1018-05", "OD-LEN-04"}, type(0x1018, 3, u16)},
      {"1018-product-zero", "The product code is 0000 0000h", {"OD-1018-06", "OD-1018-08"}, preset(0x1018, 2, 0)},
      {"1018-serial-zero", "The serial number is 0000 0000h", {"OD-1018-06"}, preset(0x1018, 4, 0)},
      {"1018-revision-halves-swapped", "The halves of the revision number are exchanged", {"OD-1018-07"}, preset(0x1018, 3, 0x00000001)},
      {"1018-vendor-differs", "The vendor-ID is not that of the device description", {"OD-1018-08"}, preset(0x1018, 1, 0x00005AFF)},
      {"1018-product-differs", "The product code is not that of the device description", {"OD-1018-08"}, preset(0x1018, 2, 0x00000302)},
      {"1200-sub0-wrong", "1200h:00 is 04h", {"OD-1200-01", "OD-GEN-11"}, preset(0x1200, 0, 4)},
      {"1200-rx-without-node-id", "1200h:01 lacks the node-ID", {"OD-1200-02", "SDO-GEN-21"}, preset(0x1200, 1, 0x600)},
      {"1200-rx-valid-bit-set", "1200h:01 says that the default SDO does not exist", {"OD-1200-02", "SDO-GEN-21"}, preset_with_node_id(0x1200, 1, 0x80000600)},
      {"1200-tx-without-node-id", "1200h:02 lacks the node-ID", {"OD-1200-03", "SDO-GEN-21"}, preset(0x1200, 2, 0x580)},
      {"1200-rx-tx-swapped", "The COB-IDs of 1200h are exchanged", {"OD-1200-02", "OD-1200-03", "SDO-GEN-21"},
       both(preset_with_node_id(0x1200, 1, 0x580), preset_with_node_id(0x1200, 2, 0x600))},
      {"1200-cob-id-writable", "The COB-IDs of the default SDO can be written", {"OD-1200-04"},
       both(access(0x1200, 1, Access::rw), access(0x1200, 2, Access::rw))},
      {"1200-sub0-writable", "1200h:00 can be written", {"OD-1200-04"}, access(0x1200, 0, Access::rw)},
  };
}

DefectTable communication_rows() {
  return {
      {"1005-absent", "1005h does not exist although SYNC is consumed", {"OD-1005-01", "OD-CAT-03"}, absent(0x1005)},
      {"1005-is-u16", "1005h has two bytes", {"OD-1005-01", "OD-LEN-04"}, type(0x1005, 0, u16)},
      {"1005-default-wrong", "The default of 1005h is 0000 0081h", {"OD-1005-02", "SYNC-COB-01"}, preset(0x1005, 0, 0x81)},
      {"1005-default-includes-node-id", "The default of 1005h contains the node-ID", {"OD-1005-02", "SYNC-COB-01"}, preset_with_node_id(0x1005, 0, 0x80)},
      {"1005-change-not-stored", "Another CAN-ID in 1005h is confirmed and forgotten", {"OD-1005-06"}, not_stored(0x1005, 0)},
      {"1006-is-u16", "1006h has two bytes", {"OD-1006-01", "OD-LEN-04"}, type(0x1006, 0, u16)},
      {"1006-default-nonzero", "The default of 1006h is 10 ms", {"OD-1006-02"}, preset(0x1006, 0, 10000)},
      {"1006-not-writable", "1006h is read-only", {"OD-1006-03", "SDO-DNL-21"}, access(0x1006, 0, Access::ro)},
      {"1006-not-stored", "Writing 1006h is confirmed and forgotten", {"OD-1006-03"}, not_stored(0x1006, 0)},
      {"1007-is-u16", "1007h has two bytes", {"OD-1007-01", "OD-LEN-04"}, type(0x1007, 0, u16)},
      {"1007-not-writable", "1007h is read-only", {"OD-1007-01", "SDO-DNL-21"}, access(0x1007, 0, Access::ro)},
      {"1007-default-nonzero", "The default of 1007h is 5 ms", {"OD-1007-01"}, preset(0x1007, 0, 5000)},
      {"1010-sub0-out-of-range", "1010h:00 is 00h", {"OD-1010-01", "OD-GEN-11"}, preset(0x1010, 0, 0)},
      {"1010-sub0-is-u32", "1010h:00 has four bytes", {"OD-1010-01", "OD-GEN-10"}, type(0x1010, 0, u32)},
      {"1010-sub0-writable", "1010h:00 can be written", {"OD-1010-02", "SDO-DNL-09"}, access(0x1010, 0, Access::rw)},
      {"1010-sub1-missing", "1010h:01 does not exist", {"OD-1010-03", "OD-CAT-02"}, absent_sub(0x1010, 1)},
      {"1010-sub1-is-u8", "1010h:01 has one byte", {"OD-1010-03", "OD-GEN-19"}, type(0x1010, 1, u8)},
      {"1010-reserved-bits-set", "1010h:01 has reserved bits set", {"OD-1010-04", "STO-1010-01"}, preset(0x1010, 1, 0x80000001)},
      {"1010-returns-signature", "1010h:01 reads as the signature", {"OD-1010-04", "STO-1010-01"}, preset(0x1010, 1, 0x65766173)},
      {"1010-reserved-sub-answers", "1010h:80 exists", {"OD-1010-06"}, extra(0x1010, 0x80, integer_entry("Reserved", u32, Access::rw, 1))},
      {"1010-cmd-bit-zero-but-confirms", "1010h:01 says that nothing is stored on command, yet confirms it",
       {"OD-1010-19", "STO-1010-09"}, preset(0x1010, 1, 0)},
      {"1011-sub0-out-of-range", "1011h:00 is 00h", {"OD-1011-01", "OD-GEN-11"}, preset(0x1011, 0, 0)},
      {"1011-sub0-is-u32", "1011h:00 has four bytes", {"OD-1011-01", "OD-GEN-10"}, type(0x1011, 0, u32)},
      {"1011-sub0-writable", "1011h:00 can be written", {"OD-1011-02", "SDO-DNL-09"}, access(0x1011, 0, Access::rw)},
      {"1011-sub1-missing", "1011h:01 does not exist", {"OD-1011-03", "OD-CAT-02"}, absent_sub(0x1011, 1)},
      {"1011-sub1-is-u8", "1011h:01 has one byte", {"OD-1011-03", "OD-GEN-19"}, type(0x1011, 1, u8)},
      {"1011-reserved-bits-set", "1011h:01 has reserved bits set", {"OD-1011-04", "STO-1011-01"}, preset(0x1011, 1, 0x00000003)},
      {"1011-returns-signature", "1011h:01 reads as the signature", {"OD-1011-04", "STO-1011-01"}, preset(0x1011, 1, 0x64616F6C)},
      {"1011-reserved-sub-answers", "1011h:80 exists", {"OD-1011-06"}, extra(0x1011, 0x80, integer_entry("Reserved", u32, Access::rw, 1))},
      {"1011-cmd-bit-zero-but-confirms", "1011h:01 says that nothing can be restored, yet confirms the command",
       {"OD-1011-16"}, preset(0x1011, 1, 0)},
      {"1012-is-u16", "1012h has two bytes", {"OD-1012-01", "OD-LEN-04"}, type(0x1012, 0, u16)},
      {"1012-default-wrong", "The default of 1012h is 0000 0190h", {"OD-1012-02", "TIME-COB-01"}, preset(0x1012, 0, 0x190)},
      {"1012-change-not-stored", "Another CAN-ID in 1012h is confirmed and forgotten", {"OD-1012-06"}, not_stored(0x1012, 0)},
      {"1014-absent", "1014h does not exist although EMCY is sent", {"OD-1014-01", "OD-CAT-03"}, absent(0x1014)},
      {"1014-is-u16", "1014h has two bytes", {"OD-1014-01", "OD-LEN-04"}, type(0x1014, 0, u16)},
      {"1014-default-without-node-id", "The default of 1014h lacks the node-ID", {"OD-1014-02", "EMCY-COB-01"}, preset(0x1014, 0, 0x80)},
      {"1014-default-wrong", "The default of 1014h is C0h + node-ID", {"OD-1014-02", "EMCY-COB-01"}, preset_with_node_id(0x1014, 0, 0xC0)},
      {"1014-reserved-bit30-set", "The default of 1014h has the reserved bit 30 set", {"OD-1014-03", "EMCY-COB-01"}, preset_with_node_id(0x1014, 0, 0x40000080)},
      {"cob-id-upper-bits-set", "The default of 1014h has bits above the CAN-ID set", {"OD-CID-01", "OD-1014-02", "EMCY-COB-01"}, preset_with_node_id(0x1014, 0, 0x00010080)},
      {"default-cob-id-extended", "The default of 1014h is a 29-bit identifier", {"OD-CID-02", "OD-1014-02", "EMCY-COB-01"}, preset_with_node_id(0x1014, 0, 0x20000080)},
      {"1015-is-u32", "1015h has four bytes", {"OD-1015-01", "OD-LEN-04"}, type(0x1015, 0, u32)},
      {"1015-not-writable", "1015h is read-only", {"OD-1015-01", "SDO-DNL-21"}, access(0x1015, 0, Access::ro)},
      {"1015-default-nonzero", "The default of 1015h is 10 ms", {"OD-1015-02"}, preset(0x1015, 0, 100)},
      {"1016-sub0-out-of-range", "1016h:00 is 80h", {"OD-1016-01", "OD-GEN-11"}, preset(0x1016, 0, 0x80)},
      {"1016-sub0-is-u32", "1016h:00 has four bytes", {"OD-1016-01", "OD-GEN-10"}, type(0x1016, 0, u32)},
      {"1016-sub0-writable", "1016h:00 can be written", {"OD-1016-02", "SDO-DNL-09"}, access(0x1016, 0, Access::rw)},
      {"1016-sub1-missing", "1016h:01 does not exist", {"OD-1016-03", "OD-CAT-02"}, absent_sub(0x1016, 1)},
      {"1016-entry-is-u16", "1016h:03 has two bytes", {"OD-1016-03", "OD-GEN-19", "OD-LEN-04"}, type(0x1016, 3, u16)},
      {"sub0-too-high", "1016h:00 is 05h with four entries", {"OD-GEN-11"}, preset(0x1016, 0, 5)},
      {"sub0-too-low", "1016h:00 is 03h with four entries", {"OD-GEN-11", "OD-1016-03"}, preset(0x1016, 0, 3)},
      {"1016-default-nonzero", "1016h:01 watches node 126 by default", {"OD-1016-04"}, preset(0x1016, 1, 0x007E03E8)},
      {"1016-not-writable", "1016h:01 is read-only", {"OD-1016-05", "EC-HBC-01", "SDO-DNL-21"}, access(0x1016, 1, Access::ro)},
      {"1016-entry-not-stored", "Writing 1016h:01 is confirmed and forgotten", {"OD-1016-05", "EC-HBC-01"}, not_stored(0x1016, 1)},
      {"1017-absent", "1017h does not exist, nor does node guarding", {"OD-1017-01", "OD-ERC-01", "EC-GEN-01", "OD-CAT-03"}, absent(0x1017)},
      {"1017-is-u32", "1017h has four bytes", {"OD-1017-01", "OD-LEN-04", "SDO-UPL-03"}, type(0x1017, 0, u32)},
      {"1017-default-wrong", "The default of 1017h is 500 ms instead of the declared 0", {"OD-1017-02"}, preset(0x1017, 0, 500)},
      {"1017-not-writable", "1017h is read-only", {"OD-1017-03", "OD-ACC-04", "SDO-DNL-01"}, access(0x1017, 0, Access::ro)},
      {"1017-not-stored", "Writing 1017h is confirmed and forgotten", {"OD-1017-03", "OD-ACC-04", "SDO-DNL-01"}, not_stored(0x1017, 0)},
  };
}

}  // namespace

DefectTable dictionary_defects() {
  DefectTable rows = identity_rows();
  DefectTable more = communication_rows();
  rows.insert(rows.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  return rows;
}

}  // namespace refnode
