// SPDX-License-Identifier: Apache-2.0
// The monitors over one trace, and their cases in the result.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "can/capture.hpp"
#include "monitor/follower.hpp"
#include "monitor/monitor.hpp"
#include "result/run_result.hpp"

namespace conform::monitor {

/// The first part of every monitor's case id, and its suite.
inline constexpr std::string_view suite_name = "monitor";

/// Frames [begin, end) of the trace among which the host lost some, at a place nobody knows.
struct Loss {
  std::size_t begin = 0, end = 0;
};

/// The worst verdict the level of a requirement allows; nullopt: the requirement is not in the catalogue.
using Cap = std::function<std::optional<result::Verdict>(std::string_view requirement)>;

class Watch {
 public:
  Watch(const Facts& facts, std::span<const Rule* const> chosen);

  void on_frame(const can::CapturedFrame& captured, std::size_t index) {
    (void)look_at(captured, index);
    settle();
  }
  /// The same in two steps, for who wants to see the frame as the monitors do: in the state before it.
  const Observation& look_at(const can::CapturedFrame& captured, std::size_t index);
  void settle() { follower_.settle(); }
  [[nodiscard]] const Follower& follower() const { return follower_; }
  void on_loss();
  /// No frame follows.
  void end();
  [[nodiscard]] const std::vector<std::unique_ptr<Monitor>>& monitors() const { return monitors_; }
  /// How many violations all of them have counted so far.
  [[nodiscard]] std::size_t counted() const { return counted_; }

 private:
  Follower follower_;
  std::vector<std::unique_ptr<Monitor>> monitors_;
  bool waiting_ = false;  ///< some silence waits for a sign of life
  std::size_t counted_ = 0;
  std::array<std::vector<Monitor*>, Observation::subjects> concerned_;  ///< by the subject of a frame
};

/// "monitor/sdo-toggle"
[[nodiscard]] std::string case_id(const Rule& rule);

/// The case before the trace is there. Requirements that `cap` does not know are left out.
[[nodiscard]] result::CaseResult planned_case(const Rule& rule, const Cap& cap);

/// The judgement of a watch that has seen all of `frames`, which ends with it. `cases` are the planned ones
/// of `chosen`, rules that it watched, in the same order; `others` are the scenarios that ran meanwhile, so
/// that findings can name them. `late`: frames among which a machine that the device shares was late.
void conclude(Watch& watch, std::span<const can::CapturedFrame> frames, NodeId node,
              std::span<const Rule* const> chosen, const Cap& cap, std::span<const Loss> losses,
              std::span<const result::CaseResult> others, std::span<result::CaseResult> cases,
              std::span<const Loss> late = {});

/// Both in one: of a trace that is there already.
void judge(std::span<const can::CapturedFrame> frames, const Facts& facts,
           std::span<const Rule* const> chosen, const Cap& cap, std::span<const Loss> losses,
           std::span<const result::CaseResult> others, std::span<result::CaseResult> cases,
           std::span<const Loss> late = {});

}  // namespace conform::monitor
