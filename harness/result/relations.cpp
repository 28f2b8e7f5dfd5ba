// SPDX-License-Identifier: Apache-2.0
#include "result/relations.hpp"

#include <algorithm>
#include <array>

namespace conform::result {
namespace {

constexpr auto ground_table = std::to_array<Ground>({
    // SDO frames and server.
    {"SDO-UPL-01 SDO-UPL-02 SDO-UPL-03 SDO-UPL-04 SDO-UPL-06 SDO-UPL-12 SDO-UPL-13 SDO-SUP-16 "
     "SDO-MUL-01 SDO-MUL-04",
     "SDO-GEN-01 SDO-GEN-02 SDO-GEN-03 SDO-GEN-06 SDO-GEN-07"},
    {"SDO-BUP-05 SDO-BUP-26 SDO-MUL-01 SDO-MUL-04 SDO-GEN-03 SDO-GEN-12 SDO-GEN-20 SDO-BDN-01 "
     "SDO-BUP-15",
     "SDO-GEN-04"},
    {"SDO-ERR-05", "SDO-SUP-02 SDO-BUP-04"},
    {"SDO-BDN-03 SDO-BDN-10", "SDO-ERR-04 SDO-ERR-05"},
    {"SDO-ERR-03 SDO-BDN-21", "SDO-SUP-11 SDO-SDN-17 SDO-BUP-29"},
    {"SDO-SUP-20 SDO-BUP-21 SDO-BDN-22", "SDO-GEN-17"},
    {"SDO-GEN-04 SDO-ERR-03 SDO-ERR-04", "SDO-ERR-10"},
    {"SDO-ERR-04 SDO-ERR-05", "SDO-BUP-05"},
    {"SDO-GEN-13 SDO-GEN-14 SDO-GEN-17 SDO-GEN-18 SDO-GEN-19 SDO-GEN-20",
     "SDO-GEN-01 SDO-BUP-01 SDO-BUP-22 SDO-BUP-24 SDO-BDN-01 SDO-BDN-02 SDO-BDN-17 SDO-BDN-04 "
     "SDO-SUP-01 SDO-SDN-01 SDO-UPL-01 SDO-UPL-06 SDO-DNL-01 OD-GEN-04 OD-GEN-07 OD-1000-01"},
    {"SDO-GEN-20", "OD-1018-03 SDO-GEN-19"},
    {"SDO-MUL-01 SDO-MUL-04 SDO-MUL-05 OD-1201-04 OD-1201-05",
     "SDO-GEN-01 SDO-UPL-01 SDO-UPL-06 OD-1000-01 OD-1018-03"},
    {"SDO-MUL-04", "SDO-SUP-01 SDO-SUP-02 SDO-SUP-04 SDO-SUP-16 SDO-SDN-01 SDO-SDN-03 SDO-SDN-13 SDO-BUP-01 "
                   "SDO-BUP-05 SDO-BUP-06 SDO-BUP-08 SDO-BUP-13 SDO-BUP-24 SDO-BUP-26 SDO-BUP-29 SDO-BDN-01 "
                   "SDO-BDN-05 SDO-BDN-06 SDO-BDN-18 SDO-GEN-20"},
    {"SDO-MUL-04 SDO-MUL-05 OD-1201-05", "SDO-MUL-01"},
    // Uploads.
    {"SDO-SUP-03 SDO-SUP-05 SDO-SUP-06 SDO-SUP-07 SDO-SUP-10 SDO-SUP-16 SDO-SUP-21 SDO-SUP-22 "
     "SDO-SUP-17",
     "SDO-SUP-01"},
    {"SDO-SUP-03", "SDO-SUP-08"},
    {"SDO-SUP-01 SDO-SUP-04 SDO-UPL-05", "SDO-SUP-02"},
    {"SDO-UPL-05 SDO-SUP-01", "SDO-SUP-04"},
    {"SDO-UPL-12 SDO-UPL-13 SDO-BUP-15 SDO-BUP-16 SDO-DNL-*", "SDO-UPL-01 SDO-UPL-02 SDO-UPL-03 SDO-UPL-04"},
    {"SDO-SDN-11 SDO-BDN-17 SDO-DNL-21", "SDO-UPL-05"},
    {"SDO-SUP-23", "SDO-SUP-01 SDO-SUP-04 SDO-SUP-16 SDO-BUP-01 SDO-UPL-01 SDO-UPL-02 SDO-UPL-03 SDO-UPL-04 "
                   "SDO-UPL-05 SDO-GEN-06 SDO-GEN-07"},
    {"SDO-SUP-21 SDO-SUP-22", "SDO-SDN-01 SDO-SDN-03 SDO-SUP-01 SDO-GEN-14 SDO-GEN-08"},
    {"SDO-SUP-21 SDO-MUL-04 SDO-ERR-08 SDO-SUP-10 SDO-SDN-19 OD-1021-01 OD-GEN-12", "SDO-SUP-17"},
    {"SDO-SUP-18 SDO-SDN-25 SDO-BUP-25 SDO-BDN-25", "SDO-ERR-04 SDO-ERR-05 SDO-ERR-10"},
    {"SDO-SUP-10 SDO-SUP-07 SDO-SUP-20 SDO-SDN-19 SDO-SDN-20 SDO-BUP-20 SDO-BDN-21 SDO-SUP-19", "SDO-SUP-08"},
    {"SDO-SDN-19 SDO-SUP-13 SDO-SUP-20 SDO-SDN-03", "SDO-SDN-16"},
    {"SDO-SUP-13 SDO-SUP-20", "SDO-SDN-24"},
    {"SDO-SUP-19", "SDO-SUP-11 SDO-GEN-15"},
    {"SDO-BUP-15", "SDO-UPL-12 SDO-UPL-13 SDO-SUP-14"},
    {"SDO-UPL-14", "SDO-SUP-10 SDO-ERR-04 SDO-ERR-05"},
    // Block upload.
    {"SDO-BUP-02 SDO-BUP-03 SDO-BUP-04 SDO-BUP-06 SDO-BUP-08 SDO-BUP-09 SDO-BUP-11 SDO-BUP-12 "
     "SDO-BUP-13 SDO-BUP-14 SDO-BUP-17 SDO-BUP-18 SDO-BUP-20 SDO-BUP-22 SDO-BUP-24 SDO-BUP-26 "
     "SDO-BUP-27 SDO-BUP-28 SDO-BUP-29 SDO-SUP-11",
     "SDO-BUP-01"},
    {"SDO-BUP-01 SDO-BUP-05", "OD-1000-01"},
    {"SDO-BUP-01 SDO-BUP-07", "SDO-GEN-04"},
    {"SDO-BUP-02", "SDO-BUP-26"},
    {"SDO-BUP-01 SDO-BUP-05 SDO-BUP-06 SDO-BUP-07 SDO-BUP-08 SDO-BUP-13 SDO-BUP-14 SDO-BUP-26 "
     "SDO-BUP-16",
     "SDO-SUP-01"},
    {"SDO-BUP-16 SDO-BUP-21", "SDO-BUP-24 SDO-BUP-01"},
    {"SDO-BUP-22", "SDO-BUP-04"},
    {"SDO-BUP-26 SDO-BUP-02", "SDO-BUP-05"},
    {"SDO-BUP-12 SDO-BUP-06 SDO-BUP-08", "SDO-BUP-13"},
    {"SDO-BUP-17 SDO-BUP-18", "SDO-BUP-21"},
    // Downloads.
    {"SDO-SDN-02 SDO-SDN-03 SDO-SDN-04 SDO-SDN-05 SDO-SDN-11 SDO-SDN-12 SDO-SDN-13 SDO-SDN-15 "
     "SDO-SDN-17 SDO-SDN-08 SDO-SDN-09 SDO-SDN-14 SDO-SDN-18 SDO-SDN-19 SDO-SDN-23",
     "SDO-SDN-01"},
    {"SDO-SDN-02 SDO-SDN-05 SDO-SDN-11 SDO-SDN-13 SDO-SDN-17", "SDO-SDN-03"},
    {"SDO-SDN-11", "SDO-SDN-08 SDO-SDN-09 SDO-SDN-10"},
    {"SDO-SDN-04 SDO-SDN-05 SDO-SDN-08 SDO-SDN-09 SDO-SDN-10 SDO-SDN-14 SDO-SDN-16 SDO-SDN-19 "
     "SDO-SDN-23 SDO-SDN-26 SDO-SDN-27",
     "SDO-SDN-24 SDO-GEN-04"},
    {"SDO-SDN-23 OD-ACC-05 SDO-SDN-08 SDO-SDN-09 SDO-SDN-10", "SDO-SDN-18"},
    {"SDO-SDN-15 SDO-BDN-17 SDO-BDN-26", "SDO-SDN-11 SDO-SUP-16"},
    {"SDO-DNL-21", "SDO-DNL-01 SDO-DNL-02 SDO-DNL-03 SDO-DNL-04 SDO-DNL-05 SDO-SDN-01 SDO-SDN-03 SDO-SDN-11 "
                   "SDO-SUP-01 SDO-UPL-01 SDO-UPL-03"},
    {"SDO-BDN-02 SDO-BDN-03 SDO-BDN-04 SDO-BDN-06 SDO-BDN-07 SDO-BDN-08 SDO-BDN-09 SDO-BDN-10 "
     "SDO-BDN-14 SDO-BDN-15 SDO-BDN-16 SDO-BDN-19 SDO-BDN-20 SDO-BDN-21 SDO-BDN-26 SDO-BDN-27",
     "SDO-BDN-01"},
    {"SDO-BDN-01", "SDO-BDN-05 SDO-BDN-17"},
    {"SDO-BDN-05 SDO-BDN-06 SDO-BDN-07 SDO-BDN-08 SDO-BDN-09 SDO-BDN-16 SDO-BDN-17 SDO-BDN-03", "SDO-BDN-18"},
    {"SDO-BDN-05 SDO-BDN-06 SDO-BDN-10 SDO-BDN-16 SDO-BDN-17 SDO-BDN-03 SDO-BDN-27", "SDO-BDN-19"},
    {"SDO-BDN-20", "SDO-BDN-22"},
    // Entries in general.
    {"OD-TYP-*", "OD-GEN-04 OD-GEN-07"},
    {"OD-TYP-13", "OD-TYP-12 OD-TYP-17"},
    {"OD-OBJ-07", "OD-OBJ-06"},
    {"OD-GEN-10", "OD-LEN-04"},
    {"OD-GEN-01 OD-GEN-02 OD-GEN-06 OD-GEN-12 OD-GEN-16 OD-GEN-18", "OD-GEN-04"},
    {"OD-TYP-10 OD-TYP-22 OD-TYP-23", "OD-GEN-05"},
    {"OD-1008-02 OD-1009-02 OD-100A-02", "OD-ACC-08 OD-ACC-01"},
    {"OD-1003-14 OD-100D-03 SDO-SDN-09 SDO-BDN-15 SDO-SDN-27 SDO-SDN-10 OD-1011-17 OD-1010-20", "OD-LEN-02"},
    {"OD-LEN-01 OD-LEN-02 SDO-DNL-12 OD-1017-09", "SDO-DNL-01 SDO-DNL-03"},
    {"SDO-SDN-08 SDO-BDN-14 SDO-SDN-14 SDO-DNL-19 OD-1011-17 OD-1010-20", "OD-LEN-01"},
    {"OD-1400-01 EDS-VSD-06 OD-DSC-03", "OD-1400-15 OD-1400-20 OD-1400-21"},
    {"OD-1800-01", "OD-1800-15 OD-1800-20"},
    {"OD-1400-16", "OD-1400-15"},
    {"OD-1400-03 OD-1800-03", "SDO-GEN-01 SDO-GEN-03 SDO-GEN-04 SDO-ERR-04"},
    {"OD-1800-16", "OD-1800-15"},
    {"OD-1014-07", "OD-1014-02"},
    {"OD-1003-13", "OD-1003-15"},
    // NMT, boot-up, error control.
    {"NMT-BOOT-02 NMT-BOOT-03", "NMT-BOOT-04"},
    {"NMT-BOOT-02", "NMT-FSA-07 NMT-FSA-08 NMT-FSA-09 NMT-FSA-10 NMT-FSA-11 NMT-FSA-12"},
    {"NMT-BOOT-09", "SDO-GEN-01 OD-1000-01"},
    {"NMT-FSA-03 NMT-FSA-06", "NMT-BOOT-06"},
    {"OD-1003-04", "NMT-BOOT-02"},
    {"EC-EB-* OD-1800-11 OD-1800-09 OD-1400-11 PDO-* SYNC-CON-*", "NMT-BOOT-10"},
    {"EC-HBP-*", "OD-1017-03"},
    {"EC-HBP-03 EC-HBP-05 EC-HBP-07 EC-HBP-08 EC-HBP-09 EC-HBP-10", "EC-HBP-02"},
    {"NMT-FSA-*", "EC-HBP-02 EC-HBP-08 NMT-SVC-04"},
    {"NMT-FSA-21", "OD-1017-03"},
    {"EC-HBP-06 NMT-BOOT-02 NMT-BOOT-03", "NMT-FSA-14"},
    {"EC-HBP-10 NMT-FSA-18 STO-1010-13 NMT-BOOT-06 NMT-BOOT-10 PDO-RX-05", "NMT-FSA-13"},
    {"NMT-FSA-14 NMT-FSA-27 NMT-FSA-21 NMT-FSA-28 NMT-FSA-20 NMT-FSA-13 EC-HBP-06 PDO-TX-02 PDO-RX-02 "
     "PDO-TX-22 SDO-GEN-15",
     "NMT-FSA-03 NMT-FSA-04 NMT-FSA-02 NMT-FSA-01"},
    {"NMT-FSA-21", "PDO-TX-02 PDO-RX-02"},
    {"NMT-FSA-26", "SDO-DNL-01"},
    {"NMT-SVC-02", "SYNC-CON-05"},
    {"EC-EB-03", "NMT-FSA-02"},
    {"OD-ERC-01 OD-100C-01 OD-100D-01 OD-CAT-03", "OD-1017-01"},
    {"OD-1029-10 EC-NG-*", "OD-100C-02 OD-100D-02"},
    {"OD-ERC-01", "OD-100C-01 OD-100D-01"},
    {"EC-NG-*", "SDO-GEN-10 OD-1017-01 OD-1017-03 NMT-FSA-01 NMT-FSA-02 NMT-FSA-03 NMT-FSA-04 NMT-FSA-13"},
    {"EC-NG-02 EC-NG-03 EC-NG-04 EC-NG-05 EC-NG-06 EC-NG-07 EC-NG-08 EC-NG-09 EC-NG-10 EC-NG-12 EC-NG-13 EC-NG-14 "
     "EC-NG-15 OD-1029-10",
     "EC-NG-01"},
    {"EC-NG-03 EC-NG-10 EC-NG-12 EC-NG-14", "EC-NG-02"},
    {"EC-NG-08", "EC-NG-04"},
    {"EC-HBP-12", "EC-NG-11"},
    {"OD-1029-10", "EC-NG-07 EC-NG-10 EC-NG-12"},
    {"EC-NG-07 EC-NG-08 EC-NG-09 EC-NG-10", "EMCY-FMT-01 EMCY-NMT-02 OD-1014-08 EMCY-SEQ-* OD-1001-06"},
    {"LSS-CN-04", "OD-1200-02 NMT-FSA-24 OD-1011-10"},
    {"LSS-*", "NMT-BOOT-02"},
    {"OD-100C-02", "OD-100C-01"},
    {"OD-100D-02", "OD-100D-01"},
    {"OD-1014-10 EC-HBP-13 PDO-MAP-21 SDO-MUL-05 OD-1201-08 NMT-FSA-29", "NMT-FSA-24 OD-1010-18"},
    // LSS: what is asked of a slave needs the way into the configuration state.
    {"LSS-SS-* LSS-SG-03 LSS-INQ-* LSS-CN-* LSS-BT-* LSS-ST-* LSS-ID-* LSS-FS-* LSS-GEN-*",
     "LSS-SG-01 LSS-SG-02"},
    {"LSS-INQ-* LSS-CN-* LSS-BT-* LSS-ST-* LSS-ID-* LSS-FS-* LSS-GEN-*", "LSS-SS-01"},
    {"LSS-SS-04 LSS-SS-02", "LSS-SS-03"},
    // EMCY and errors.
    {"EC-HBC-07 EC-HBC-08 EC-HBC-09 EC-HBC-10 EC-HBC-12 EC-HBC-13 EC-EB-* EMCY-FMT-05", "EC-HBC-03"},
    {"EMCY-INH-* EMCY-SEQ-* EMCY-FMT-* OD-1003-10 OD-1003-11 NMT-SVC-02", "EMCY-FMT-01"},
    {"EMCY-INH-* NMT-FSA-29 EMCY-FMT-05 EMCY-SEQ-* EC-HBC-* SYNC-CON-05 PDO-RX-06 PDO-RX-14 "
     "NMT-SVC-02",
     "OD-1014-08 EMCY-NMT-02"},
    {"EMCY-INH-* EMCY-NMT-01 EC-HBC-07 EC-HBC-10 EC-HBC-12", "EMCY-SEQ-*"},
    {"EMCY-NMT-01 EC-HBP-06", "EC-EB-05"},
    // Storage.
    {"OD-1010-11 OD-1010-12 OD-1010-13 OD-1010-14 OD-1010-15 OD-1010-18 STO-1010-* OD-RST-04 "
     "OD-1020-04 OD-1020-05 SDO-MUL-07 EC-HBP-05 OD-1011-* STO-1011-* SYNC-PRO-07",
     "OD-1010-10"},
    {"OD-1011-11 OD-1011-12 OD-1011-13 OD-1011-15 OD-RST-05 STO-1020-04 STO-1011-*", "OD-1011-10"},
    {"OD-1010-11 OD-1011-13", "NMT-FSA-25"},
    {"NMT-FSA-25 NMT-FSA-24", "OD-1010-10 OD-1011-10"},
    {"OD-1010-1* OD-1010-2* OD-1011-08 OD-1011-09 OD-1011-1* OD-RST-04 OD-1020-05 STO-*", "OD-1017-03"},
    // PDO and SYNC.
    {"OD-1600-05 OD-1600-11 OD-1600-12 OD-1400-18 OD-1400-10 OD-1400-11", "OD-1400-09"},
    {"OD-1400-09 OD-1400-11 PDO-MAP-15", "PDO-RX-01"},
    {"OD-1A00-05 OD-1A00-11 OD-1A00-12 OD-1800-18 OD-1800-10 OD-1800-11 OD-1800-21", "OD-1800-09"},
    {"OD-1800-09 OD-1800-11 OD-1800-14 PDO-TX-12 PDO-TX-19 PDO-TX-20", "PDO-TX-09"},
    {"SYNC-CON-01 SYNC-CON-03 SYNC-CON-04 SYNC-CON-09 PDO-TX-26 PDO-TX-27 PDO-TX-06", "PDO-TX-05"},
    {"PDO-TX-20 PDO-TX-22", "PDO-TX-01 PDO-TX-02 PDO-TX-19"},
    {"OD-1800-09 OD-1800-11 PDO-TX-05 SYNC-CON-*", "OD-1005-01"},
    {"OD-1800-14 PDO-TX-19 PDO-TX-20 OD-1029-10", "SDO-GEN-10"},
    {"TIME-CON-01 TIME-CON-02 TIME-CON-03", "SDO-SUP-01 SDO-UPL-05 SDO-SUP-02"},
    {"EC-EB-* OD-1029-10", "EC-HBC-08"},
    {"OD-1201-04", "SDO-GEN-04"},
});

// One rule that CiA 301 gives for each kind of transfer, or for each service, and that one piece of firmware
// usually serves.
constexpr auto kin_table = std::to_array<std::string_view>({
    "SDO-SUP-10 SDO-SDN-19 SDO-BUP-17 SDO-BUP-18 SDO-BDN-19 SDO-BDN-20",
    "SDO-SUP-08 SDO-SUP-09 SDO-SDN-16 SDO-SDN-26",
    "SDO-SUP-20 SDO-BUP-21 SDO-BDN-22",
    "SDO-SUP-11 SDO-SUP-12 SDO-SDN-17 SDO-BUP-29",
    "SDO-SUP-13 SDO-SDN-20 SDO-BUP-20 SDO-BDN-21",
    "SDO-SUP-18 SDO-SDN-25 SDO-BUP-25 SDO-BDN-25",
    "SDO-GEN-15 NMT-FSA-23 SDO-SUP-19 SDO-BUP-27",
    "OD-LEN-01 SDO-DNL-12 SDO-SDN-07 SDO-BDN-13 OD-1017-09",
    "OD-LEN-02 SDO-DNL-12 SDO-SDN-06 SDO-BDN-12 OD-1017-09",
    "SDO-SDN-08 SDO-BDN-14",
    "SDO-SDN-09 SDO-SDN-27 SDO-BDN-15",
    "OD-RNG-01 OD-RNG-02 OD-1029-06 SDO-SDN-23 SDO-BDN-24 OD-1201-07 OD-1280-06",
    "SDO-UPL-12 SDO-UPL-13 SDO-DNL-18 SDO-SUP-14 SDO-BUP-28",
    "SDO-GEN-04 SDO-ERR-10 SDO-SDN-24",
    "SDO-GEN-08 SDO-SUP-22",
    "SDO-GEN-16 NMT-BOOT-05",
    "OD-GEN-04 OD-GEN-03 OD-GEN-05 OD-GEN-07 OD-GEN-08 OD-ACC-01 OD-ACC-03 SDO-UPL-14 SDO-BUP-23 "
    "SDO-BDN-23 SDO-SDN-22",
    "SDO-BUP-12 SDO-BDN-10",
    "SDO-GEN-10 SYNC-CON-02 PDO-RX-13 TIME-CON-03 EC-HBC-11 NMT-FSA-19 SDO-GEN-11 EC-NG-15 LSS-GEN-03",
});

constexpr std::string_view any_answer =
    "SDO-GEN-01 SDO-GEN-07 SDO-UPL-01 SDO-UPL-02 SDO-UPL-03 SDO-UPL-04 SDO-UPL-06";
constexpr std::string_view any_silence =
    "SDO-GEN-13 SDO-GEN-14 SDO-GEN-17 SDO-GEN-19 SDO-SUP-17 SDO-SUP-01 SDO-UPL-05 SDO-SUP-16 "
    "SDO-SUP-11 SDO-SUP-10";
constexpr std::string_view any_abort = "SDO-ERR-04 SDO-ERR-05 SDO-ERR-10";
constexpr std::string_view stored = "SDO-DNL-01 SDO-DNL-02 SDO-DNL-03";

// What the monitors see in the frame as such.
constexpr std::string_view form =
    "SDO-GEN-02 SDO-GEN-03 SDO-GEN-04 SDO-GEN-05 SDO-GEN-06 SDO-GEN-07 SDO-ERR-03 SDO-ERR-04 SDO-ERR-05 "
    "SDO-ERR-10";

}  // namespace

std::span<const Ground> grounds() { return ground_table; }
std::span<const std::string_view> kin() { return kin_table; }
std::string_view grounds_of_any_answer() { return any_answer; }
std::string_view grounds_of_any_silence() { return any_silence; }
std::string_view grounds_of_what_is_stored() { return stored; }
std::string_view grounds_of_any_abort() { return any_abort; }

bool is_about_form(std::string_view requirement) { return is_in(form, requirement); }

std::vector<std::string_view> words(std::string_view list) {
  std::vector<std::string_view> out;
  while (!list.empty()) {
    const auto end = std::min(list.find(' '), list.size());
    if (end != 0) out.push_back(list.substr(0, end));
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return out;
}

bool fits(std::string_view pattern, std::string_view requirement) {
  if (pattern.ends_with('*')) return requirement.starts_with(pattern.substr(0, pattern.size() - 1));
  return pattern == requirement;
}

bool is_in(std::string_view list, std::string_view requirement) {
  return std::ranges::any_of(words(list), [&](std::string_view each) { return fits(each, requirement); });
}

}  // namespace conform::result
