// SPDX-License-Identifier: Apache-2.0
// The device and its model in lockstep: the same actions at the same times of their own buses, and the first
// thing in which they differ, or in which the device breaks a rule that a monitor knows.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "explore/action.hpp"
#include "explore/place.hpp"
#include "explore/recording.hpp"
#include "explore/side.hpp"
#include "monitor/monitor.hpp"

namespace conform::explore {

/// The first thing that is not as it is with the model.
struct Difference {
  enum class What : std::uint8_t {
    answer,      ///< another outcome of a transfer or request
    late,        ///< the same one, much later
    missing,     ///< a frame that the model sent
    surplus,     ///< a frame that the model did not send
    other_data,  ///< the same frame with other content
    rule,        ///< a monitor found a rule broken, whatever the model does
    broken,      ///< the device never rests: the simulation gave up
    gone,        ///< behind the conversation it does not start any more, whatever it is told
  };
  What what = What::answer;
  std::size_t action = 0;  ///< number of the action at which it showed
  Answer device{}, model{};
  can::Frame came{}, due{};     ///< missing: due; surplus: came; other_data: both
  BusTime time{};               ///< of the frame
  std::size_t trace_index = 0;  ///< rule: of the frame in the trace of the device
  std::string requirement{};    ///< rule
  std::string text{};           ///< rule, broken: what was seen and what was expected

  [[nodiscard]] bool is_about_a_frame() const {
    return what == What::missing || what == What::surplus || what == What::other_data;
  }
  [[nodiscard]] bool is_about_an_answer() const { return what == What::answer || what == What::late; }
  /// Equal for what is taken for the same fault while a conversation is made shorter.
  [[nodiscard]] std::string signature(std::span<const Action> conversation) const;
};

/// What two worlds are made of.
struct Bench {
  MakeDevice device, model;
  FindPlace place{};  ///< of a device on an interface, instead of `device`
  monitor::Facts facts{};
  std::vector<const monitor::Rule*> monitors{};
  std::uint64_t bus_seed = 1;
  /// How long an answer may be on its way. Where the model says nothing, the device is waited for so long:
  /// what comes later would be taken for the answer to the next request.
  Duration answer_time = std::chrono::milliseconds(20);
  /// A model that answers later than the device is as good as any. Not one that is to explain what another
  /// cannot: all that a device does too early would be late answers of it.
  bool model_may_be_slower = true;
  /// How much later or earlier than on a simulated bus anything may be seen.
  Duration jitter{};
  /// Entries whose value is the device's own affair: process data, counters. Empty: none. Where there are
  /// some, nobody knows either what its PDOs hold, when an event sends one, or what time it has.
  std::function<bool(Multiplexer)> is_own_affair{};
  std::vector<std::uint32_t> own_cob_ids{};  ///< of these PDOs and of TIME, beside the pre-defined ones
};

struct Played {
  std::optional<Difference> difference;
  std::size_t actions = 0;                ///< that were performed
  std::vector<can::CapturedFrame> trace;  ///< of the device
  std::vector<BusTime> begins;            ///< of each action, on the bus of the device
  std::vector<Answer> answers;            ///< of the device to each action
  std::vector<Answer> due;                ///< of the model
  /// What the device did, to be held against other models; nullptr without `keep`.
  std::shared_ptr<const Recording> recording;
  bool distrusted = false;  ///< the host lost frames or was late: there is no difference to be told
  /// What the device holds where it confirmed a download that the model refused.
  std::optional<Answer> holds;
};

/// Plays a conversation from power-on until something differs. `keep`: with trace, times, what the model
/// answered, and a recording.
/// Error: the device or its model cannot be made, or the bus failed.
[[nodiscard]] Result<Played> play(const Bench& bench, std::span<const Action> conversation,
                                  bool keep = false);
/// The same with a device that was recorded in this conversation: only the model is made.
[[nodiscard]] Result<Played> play(const Bench& bench, std::span<const Action> conversation,
                                  const Recording& recording);

}  // namespace conform::explore
