// SPDX-License-Identifier: Apache-2.0
// A run from the first probe to the finished result.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <string>

#include "can/capture.hpp"
#include "can/transport.hpp"
#include "device/profile.hpp"
#include "engine/observer.hpp"
#include "engine/plan.hpp"
#include "engine/repeats.hpp"
#include "result/run_result.hpp"
#include "scenario/catalogue.hpp"
#include "scenario/loader.hpp"

namespace conform::engine {

struct RunOptions {
  PlanOptions plan;
  /// The run leaves out what would not have ended within this time from its begin, by plan.worths; nothing:
  /// all is played.
  std::optional<Duration> budget{};
  /// The bus is listened to for so long before the first request: a node that is powered with the run is only
  /// starting, and what it is asked meanwhile gets lost.
  Duration listen_first{};
  bool fail_fast = false;  ///< the first case that fails is the last one
  Repeat repeat;
  bool strict = false;            ///< recommended and optional rules fail as well
  std::chrono::sys_days today{};  ///< by which waivers expire; 1970: none does
  bool measure = false;        ///< the result tells times and the load of the bus, for reports that show them
  bool comment_parts = false;  ///< frames of the capture tell the case and the step they belong to
  /// Takes the power of the device away and gives it back, where a scenario wants it, and when the device
  /// does not come back by a reset. Empty: by hand only. Its error is none of the device.
  std::function<Result<void>()> power_cycle;
  /// How long the power stays away after `power_cycle` has returned; the device's boot_time begins behind it.
  Duration power_away{};
  /// false: only where a scenario wants it. A simulated device that is dead is to be seen so.
  bool power_revives = true;
  /// How long a run waits for a bus that went away in the middle of it: link down, adapter unplugged,
  /// bus-off.
  Duration bus_patience = std::chrono::seconds(10);
  const std::atomic<int>* stop = nullptr;  ///< a signal number ends the run in good order
  Observer* observer = nullptr;            ///< who is told what happens; lives longer than the run
};

/// Runs the plan on an open transport. Never throws a verdict away: whatever happens, the result says what
/// was judged.
[[nodiscard]] result::RunResult run(can::Transport& transport, const device::Profile& profile,
                                    const scenario::Suite& suite, const scenario::Catalogue& catalogue,
                                    const RunOptions& options, can::Capture& capture);

}  // namespace conform::engine
