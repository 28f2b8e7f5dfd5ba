// SPDX-License-Identifier: Apache-2.0
// Life and death of the device during a run: whether it is alone, whether it restarts although nobody told it
// to, and how far the trace can be trusted.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "can/transport.hpp"
#include "engine/case_runner.hpp"
#include "engine/liveness.hpp"
#include "engine/run_context.hpp"
#include "monitor/restarts.hpp"

namespace conform::engine {

class Life {
 public:
  explicit Life(RunContext& run) : run_(run) {}

  /// What may be done to a device that does not answer.
  [[nodiscard]] Means means();
  /// Switches the power of the device off and on; the start that follows is nobody's fault. Empty where only
  /// a hand can do it.
  [[nodiscard]] std::function<Result<void>()> power_switch();
  /// Two devices with one node-ID would be blamed for each other. `listen`: for a second answer.
  [[nodiscard]] Result<void> make_sure_it_is_alone(Duration listen);
  /// A start that nobody asked for leaves the device in its power-on state; or a second device has joined.
  [[nodiscard]] Result<void> note_restarts();
  /// Where the host lost frames, or its clock was set, nobody must draw conclusions from the trace.
  void note_losses();

  /// The machine was late, which the device shares: capture indices from `first` to now.
  void note_late(std::size_t first) { late_.push_back({first, run_.recorder.capture().size()}); }

  /// A start that nobody asked for, while the case ran: what was judged afterwards was judged of another
  /// device.
  [[nodiscard]] Result<void> judge_restarts(result::CaseResult& result, CaseRunner& runner);
  /// In the summary, with the cases they fell into.
  void tell_restarts();
  /// A case needed more than one try.
  void tried_again(const result::CaseResult& result) { tried_again_.push_back(result.name()); }
  /// In the summary, with the cases.
  void tell_tries();
  /// How many frames are missing in the capture.
  void tell_losses();

  [[nodiscard]] const std::vector<monitor::Loss>& losses() const { return losses_; }
  [[nodiscard]] const std::vector<monitor::Loss>& late() const { return late_; }
  /// Index behind the last frame of the device, 0 when none came.
  [[nodiscard]] std::size_t last_heard() const;

 private:
  [[nodiscard]] bool concerns_restart(const result::CaseResult& result, std::size_t since) const;
  [[nodiscard]] Result<bool> restarts_upon(const monitor::Stimulus& stimulus, std::size_t restart);
  [[nodiscard]] std::optional<monitor::Stimulus> stimulus_of(std::size_t restart) const;
  [[nodiscard]] const result::CaseResult* case_of(std::size_t restart) const;

  /// Starts that nobody asked for, up to now: capture indices of the boot-up messages.
  [[nodiscard]] const std::vector<std::size_t>& restarts();

  RunContext& run_;
  std::size_t known_restarts_ = 0;
  std::size_t unexplained_ = 0;  ///< restarts without a known cause
  bool says_all_twice_ = false;  ///< one device, and the scenarios judge it
  std::vector<monitor::Loss> losses_, late_;
  std::vector<std::string> tried_again_;
  can::BusHealth health_;           ///< at the last look
  std::size_t trusted_frames_ = 0;  ///< capture's length at that time
};

}  // namespace conform::engine
