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
/// EC-HBP-08, EC-HBP-07, EC-HBP-06
[[nodiscard]] std::unique_ptr<Monitor> make_heartbeat(const Rule& rule);

}  // namespace conform::monitor
