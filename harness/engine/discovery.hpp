// SPDX-License-Identifier: Apache-2.0
// What is at the other end: a look at what CiA 301 and the profile name.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/liveness.hpp"
#include "engine/run_session.hpp"
#include "engine/survey.hpp"
#include "result/run_result.hpp"

namespace conform::engine {

struct Discovery {
  std::vector<Multiplexer> silent;  ///< never answered
  std::size_t not_looked_at = 0;    ///< entries for which there was no time
};

/// Reads every entry of the session's dictionary; afterwards the dictionary holds what is present or claimed.
/// Read-only, unless the device falls silent for good and the means allow to wake it. Tells `survey` what
/// came. From `until` on no further entry is looked at: those that are claimed stay, and whoever needs one
/// looks for it then.
[[nodiscard]] Result<Discovery> discover(RunSession& session, Survey& survey, const Means& means,
                                         std::optional<BusTime> until);

/// Identity and names as read from the device, for reports: "dut.vendor_id", "dut.1008", ...
[[nodiscard]] Result<std::vector<result::Property>> device_properties(RunSession& session);

/// Values of all readable entries that may be written and do not change by themselves: compared at the end of
/// the run. Those for which there was time until `until`.
[[nodiscard]] Result<std::map<Multiplexer, Bytes>> snapshot(RunSession& session,
                                                            std::optional<BusTime> until);

/// Nothing is stored in a device that holds what its description says, in every entry that could keep
/// something else: what was read from one that does not, in words; empty: there is none. Where the
/// description is silent, 0, nothing and the value of the standard say the same.
[[nodiscard]] std::string what_is_no_default(const device::Dictionary& dictionary,
                                             const std::map<Multiplexer, Bytes>& held);

}  // namespace conform::engine
