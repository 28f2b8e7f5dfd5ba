// SPDX-License-Identifier: Apache-2.0
// What verbs about frames have in common: whose frames, and the time in which they are looked for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "steps/step.hpp"

namespace conform::steps {

/// "12.5 ms" behind the beginning of the window.
[[nodiscard]] std::string relative(BusTime time, const Window& window);

/// "CAN-ID 281h"; of a name that has no value yet, the name.
[[nodiscard]] std::string can_id_words(const Expression& id, Session& session);

/// The entry that these words name, for what a verb concerns; none where they name none.
[[nodiscard]] std::vector<ObjectReference> entry_named(std::string_view text);

/// Names that `ready_error_control` sets: the time from one error control message to the next (ns), how many
/// times as long as asked for that is, and the bits of a message that show the state.
inline constexpr std::string_view error_control_period = "error_control_period";
inline constexpr std::string_view error_control_stretch = "error_control_stretch";
inline constexpr std::string_view error_control_mask = "error_control_mask";

/// The frames a verb is about: a CAN-ID, or a service of the device under test.
struct Source {
  Expression id;
  std::string service;

  static std::optional<Source> parse(const yaml::Field& field, const NameCheck& names);
  [[nodiscard]] bool is_emcy() const { return service.starts_with("emcy"); }
  /// Messages on 700h + node-ID that show the NMT state: heartbeats alone, or whatever the device has.
  [[nodiscard]] bool shows_state() const { return service == "heartbeat" || is_error_control(); }
  [[nodiscard]] bool is_error_control() const { return service == "error control"; }

  /// Channels that a frame of the source comes through; that none comes is no ground for anything.
  [[nodiscard]] Channels rests_on() const;
  [[nodiscard]] std::string words(Session& session) const {
    return service.empty() ? can_id_words(id, session) : service;
  }
  /// The entry that configures the service.
  [[nodiscard]] std::vector<ObjectReference> concerns() const;
  [[nodiscard]] Result<Session::Match> match(Session& session) const;
  /// `time` for a device that shows its state as often as a scenario wants it; as much longer for one that
  /// cannot.
  [[nodiscard]] Duration stretched(Duration time, const Session& session) const;
  /// The time from one frame to the next that was made sure of; none: it is not known.
  [[nodiscard]] std::optional<Duration> nominal_period(const Session& session) const;
  /// The bits of a frame of one byte that say the state.
  [[nodiscard]] std::uint8_t state_bits(const Session& session) const;
};

/// From the label on, or, where there is none, from the step before on.
[[nodiscard]] Result<Window> window_of(Session& session, const std::string& after);
/// For steps that count frames or insist on none: what the device sends before it has followed an NMT command
/// is of the old state.
[[nodiscard]] Result<Window> settled_window_of(Session& session, const std::string& after);

/// `for: 1 s`, or `until:` with a label that was reached, or `now`: the step itself.
struct WindowEnd {
  TimeReference time;
  std::string until;  ///< empty: `time` counts

  static std::optional<WindowEnd> parse(yaml::Fields& fields, const ParseContext& context);
  [[nodiscard]] std::string words() const { return until.empty() ? "for " + time.text() : "until " + until; }
  [[nodiscard]] Result<BusTime> after(BusTime anchor, const Session& session) const;
  /// The same for frames of `source`, which may need longer.
  [[nodiscard]] Result<BusTime> after(BusTime anchor, const Session& session, const Source& source) const;
};

/// `after:` with a label of the scenario.
void parse_after(yaml::Fields& fields, const ParseContext& context, std::string& after);

}  // namespace conform::steps
