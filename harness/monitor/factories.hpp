// SPDX-License-Identifier: Apache-2.0
// The monitors by name, for the table in rules.cpp. The requirements of a monitor are known to it by their
// position.
#pragma once

#include <memory>

#include "monitor/monitor.hpp"

namespace conform::monitor {

/// SDO-GEN-04, SDO-ERR-03, SDO-ERR-10
[[nodiscard]] std::unique_ptr<Monitor> make_sdo_responses(const Rule& rule);
/// SDO-GEN-08, SDO-GEN-09, SDO-GEN-11, SDO-GEN-12
[[nodiscard]] std::unique_ptr<Monitor> make_sdo_foreign_requests(const Rule& rule);
/// SDO-GEN-03, SDO-ERR-04
[[nodiscard]] std::unique_ptr<Monitor> make_sdo_multiplexer(const Rule& rule);
/// SDO-GEN-02
[[nodiscard]] std::unique_ptr<Monitor> make_sdo_frame_form(const Rule& rule);
/// SDO-GEN-06, SDO-GEN-07
[[nodiscard]] std::unique_ptr<Monitor> make_sdo_command_byte(const Rule& rule);
/// SDO-GEN-05
[[nodiscard]] std::unique_ptr<Monitor> make_sdo_reserved_bytes(const Rule& rule);
/// SDO-ERR-05
[[nodiscard]] std::unique_ptr<Monitor> make_sdo_abort_codes(const Rule& rule);
/// SDO-SUP-03, SDO-SDN-03
[[nodiscard]] std::unique_ptr<Monitor> make_sdo_toggle(const Rule& rule);
/// SDO-SUP-02, SDO-BUP-04
[[nodiscard]] std::unique_ptr<Monitor> make_sdo_size(const Rule& rule);
/// SDO-BUP-05, SDO-BUP-26, SDO-BUP-02, SDO-BUP-03, SDO-BUP-22
[[nodiscard]] std::unique_ptr<Monitor> make_sdo_block_upload(const Rule& rule);
/// SDO-BDN-05
[[nodiscard]] std::unique_ptr<Monitor> make_sdo_block_download(const Rule& rule);
/// SDO-GEN-15, SDO-GEN-16
[[nodiscard]] std::unique_ptr<Monitor> make_sdo_states(const Rule& rule);
/// NMT-BOOT-01 to -06
[[nodiscard]] std::unique_ptr<Monitor> make_nmt_boot_up(const Rule& rule);
/// NMT-BOOT-10
[[nodiscard]] std::unique_ptr<Monitor> make_restarts(const Rule& rule);
/// EC-HBP-06, EC-HBP-07, EC-HBP-08
[[nodiscard]] std::unique_ptr<Monitor> make_heartbeat(const Rule& rule);
/// PDO-TX-02, OD-1800-09, PDO-TX-01
[[nodiscard]] std::unique_ptr<Monitor> make_tpdos(const Rule& rule);
/// PDO-TX-05, PDO-TX-06, PDO-TX-07, PDO-TX-19, PDO-TX-20, PDO-TX-12
[[nodiscard]] std::unique_ptr<Monitor> make_tpdo_triggers(const Rule& rule);
/// EMCY-NMT-01, OD-1014-08, EMCY-FMT-01, EMCY-FMT-02, EMCY-FMT-04, EMCY-INH-01
[[nodiscard]] std::unique_ptr<Monitor> make_emergencies(const Rule& rule);
/// EMCY-FMT-03, OD-1003-11
[[nodiscard]] std::unique_ptr<Monitor> make_error_objects(const Rule& rule);
/// SYNC-PRO-03, SYNC-PRO-06, SYNC-PRO-01, SYNC-PRO-04
[[nodiscard]] std::unique_ptr<Monitor> make_sync_producer(const Rule& rule);
/// TIME-PRO-03, TIME-PRO-02, TIME-PRO-01
[[nodiscard]] std::unique_ptr<Monitor> make_time_producer(const Rule& rule);
/// EC-NG-16, EC-HBP-04, EC-NG-01, EC-NG-02, EC-NG-05, EC-NG-04, EC-HBP-12
[[nodiscard]] std::unique_ptr<Monitor> make_guarding(const Rule& rule);
/// LSS-GEN-08, LSS-GEN-01
[[nodiscard]] std::unique_ptr<Monitor> make_lss_answers(const Rule& rule);
/// CAN-TRF-02, NMT-SVC-05, CAN-TRF-03, CAN-TRF-04
[[nodiscard]] std::unique_ptr<Monitor> make_can_ids(const Rule& rule);

}  // namespace conform::monitor
