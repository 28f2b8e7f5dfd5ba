// SPDX-License-Identifier: Apache-2.0
// What is at the other end: one probe whether anything is there at all, then a look at what CiA 301 and the
// profile name.
#pragma once

#include <string>
#include <vector>

#include "engine/run_session.hpp"
#include "result/run_result.hpp"

namespace conform::engine {

/// How the probe ended.
struct Liveness {
  bool alive = false;    ///< an SDO answer, a boot-up message, a heartbeat or an EMCY was seen
  bool answers = false;  ///< the default SDO server answers
  std::string heard;     ///< "SDO answer", "heartbeat: stopped", "nothing"
};

/// Whether a frame can only come from the device: SDO response, error control, EMCY where the standard puts
/// it.
[[nodiscard]] bool is_from_node(const RunSession& session, const can::CapturedFrame& captured);

/// Listens and asks (1000h:00), for three SDO time-outs at most. `may_command`: a stopped node may be told to
/// enter Pre-operational, and a silent one is reset: its boot-up message shows that it is there and only its
/// SDO server is not.
[[nodiscard]] Result<Liveness> probe(RunSession& session, bool may_command);

/// Reads every entry of the session's dictionary; afterwards the dictionary holds what is present or claimed.
/// Read-only.
[[nodiscard]] Result<void> discover(RunSession& session);

/// Identity and names as read from the device, for reports: "dut.vendor_id", "dut.1008", ...
[[nodiscard]] Result<std::vector<result::Property>> device_properties(RunSession& session);

/// Values of all readable entries that may be written and do not change by themselves: compared at the end of
/// the run.
[[nodiscard]] Result<std::map<Multiplexer, Bytes>> snapshot(RunSession& session);

}  // namespace conform::engine
