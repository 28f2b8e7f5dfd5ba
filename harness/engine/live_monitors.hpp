// SPDX-License-Identifier: Apache-2.0
// The monitors while the run goes on: which rules a frame breaks by itself, whatever a scenario wanted of it,
// and where the device started although nobody told it to.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "can/frame.hpp"
#include "monitor/restarts.hpp"
#include "monitor/watch.hpp"
#include "steps/outcome.hpp"

namespace conform::engine {

class LiveMonitors {
 public:
  /// Watches for the sake of attribution, and with `chosen` for the cases of the monitors.
  LiveMonitors(const monitor::Facts& facts, std::span<const monitor::Rule* const> chosen);

  /// The trace so far; frames that were looked at before are not looked at again.
  void follow(std::span<const can::CapturedFrame> frames);
  /// The host lost frames before the next one, or the power was switched: the next start is nobody's fault.
  void lose_track();
  /// What it has seen of the whole trace, to be concluded from.
  [[nodiscard]] monitor::Watch& watch() { return watch_; }
  /// Starts of the device that nobody asked for, so far: capture indices of the boot-up messages.
  [[nodiscard]] const std::vector<std::size_t>& restarts() const { return restarts_; }

  /// Rules that the frame which decided `actual` breaks so that its content cannot be judged: an answer that
  /// the client could not use, an abort with a code that does not exist. What does not keep anybody from
  /// reading the frame (a reserved byte) excuses nothing. Nearest to the frame first.
  [[nodiscard]] std::vector<std::string> rules_below(const steps::Actual& actual) const;
  /// The same, and all that a frame breaks which differs from the one that a conversation says. There the
  /// bytes are the point, so it excuses nothing, but it tells whose fault it is.
  [[nodiscard]] std::vector<std::string> rules_broken(const steps::Actual& actual) const;

 private:
  monitor::Watch watch_;
  monitor::Starts starts_;
  std::vector<std::size_t> restarts_;
  std::size_t seen_ = 0;
  std::size_t counted_ = 0;  ///< violations, as last looked at
  /// Per monitor and requirement, as last looked at; empty of a monitor that attributes nothing.
  std::vector<std::vector<std::size_t>> violated_;
  std::map<std::size_t, std::vector<std::string>> broken_;  ///< by capture index
};

}  // namespace conform::engine
