// SPDX-License-Identifier: Apache-2.0
// What is at the other end: a look at what CiA 301 and the profile name.
#pragma once

#include <string>
#include <vector>

#include "engine/liveness.hpp"
#include "engine/run_session.hpp"
#include "engine/survey.hpp"
#include "result/run_result.hpp"

namespace conform::engine {

/// Reads every entry of the session's dictionary; afterwards the dictionary holds what is present or claimed.
/// Read-only, unless the device falls silent for good and the means allow to wake it. Gives the entries that
/// are never answered, and tells `survey` what came.
[[nodiscard]] Result<std::vector<Multiplexer>> discover(RunSession& session, Survey& survey,
                                                        const Means& means = {});

/// Identity and names as read from the device, for reports: "dut.vendor_id", "dut.1008", ...
[[nodiscard]] Result<std::vector<result::Property>> device_properties(RunSession& session);

/// Values of all readable entries that may be written and do not change by themselves: compared at the end of
/// the run.
[[nodiscard]] Result<std::map<Multiplexer, Bytes>> snapshot(RunSession& session);

}  // namespace conform::engine
