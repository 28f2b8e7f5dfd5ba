// SPDX-License-Identifier: Apache-2.0
// What a step may touch: the device through SDO and NMT, the bus, the recorded trace, and the scenario's
// names. The engine implements it; verbs see nothing else of the run.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/time.hpp"
#include "can/capture.hpp"
#include "can/frame.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/nmt.hpp"
#include "canopen/sdo_request.hpp"
#include "device/dictionary.hpp"
#include "device/profile.hpp"
#include "steps/condition.hpp"

namespace conform::steps {

/// How an SDO transfer ended, seen from the bus.
struct SdoAnswer {
  enum class Kind : std::uint8_t { confirmed, aborted, silence, violation, gave_up };
  Kind kind = Kind::silence;  ///< gave_up: the client aborted on purpose
  Bytes data;                 ///< uploads: what was delivered
  /// false: an expedited upload with s = 0; `data` is then as long as the entry's type, where that is known.
  bool size_indicated = false;
  AbortCode code{};
  std::string detail;                        ///< violation: what was wrong, in one sentence
  std::vector<std::string> remarks;          ///< reserved bits or bytes that were not zero
  std::size_t decisive = 0;                  ///< capture index of the frame that ended it
  std::optional<std::uint32_t> announced{};  ///< uploads: size that the server told
  canopen::TransferCounts counts{};

  /// A long value of which only the beginning was read: `data`, of `announced` bytes.
  [[nodiscard]] bool glanced_at() const { return kind == Kind::gave_up && announced && !data.empty(); }
  /// Why it was not confirmed: "abort 0601 0002h (write of a read-only object)", "no answer within 1 s".
  [[nodiscard]] std::string refusal() const {
    return kind == Kind::aborted ? "abort " + canopen::describe(code) : detail;
  }
};

/// CAN-IDs of an SDO channel, as the client uses them.
struct SdoChannelIds {
  CanId request, response;
  friend constexpr auto operator<=>(const SdoChannelIds&, const SdoChannelIds&) = default;
};

/// An SDO transfer as a step asks for it.
struct SdoJob {
  canopen::SdoRequest request;
  std::optional<SdoChannelIds> channel{};  ///< absent: the default channel
  std::optional<Duration> timeout{};       ///< absent: the profile's
  std::optional<Duration> wait{};          ///< after a fault; absent: the profile's quiet time
};

/// Where a waiting step begins to look, and from when its window counts. Frames that came while the previous
/// step was still waiting for its own answer are found as well: nothing falls between two steps.
struct Window {
  std::size_t first = 0;  ///< capture index
  BusTime anchor;  ///< stamp of the last frame we sent in the previous acting step, or of a labelled frame
};

/// A frame that is sent again and again beside the steps that follow.
struct Production {
  std::string label;
  can::Frame frame;
  Duration every{};
  std::optional<std::uint64_t> count;  ///< absent: until stopped or the scenario ends
  /// The first data byte counts from 1 to this, and again; absent: every frame is the same.
  std::optional<std::uint8_t> counts_to{};
  bool keeps_time = true;  ///< no: how many frames there are counts, and not when each is sent
  /// A device may watch for it: behind the scenario it goes on until the device's values are back.
  bool life_sign = false;
};

class Session : public Facts {
 public:
  using Match = std::function<bool(const can::CapturedFrame&)>;

  [[nodiscard]] virtual const device::Profile& profile() const = 0;
  [[nodiscard]] virtual const device::Dictionary& dictionary() const = 0;
  [[nodiscard]] virtual const can::Capture& capture() const = 0;
  [[nodiscard]] virtual BusTime now() const = 0;

  // Errors below are faults of the environment (interface gone, frames lost): they end the case, they judge
  // nothing.
  [[nodiscard]] virtual Result<SdoAnswer> upload(Multiplexer object, std::optional<Duration> timeout) = 0;
  /// Notes the old value first, so that the engine can put it back.
  [[nodiscard]] virtual Result<SdoAnswer> download(Multiplexer object, Bytes data,
                                                   canopen::SdoDownload::Mode mode,
                                                   std::optional<Duration> timeout) = 0;
  /// The same with everything that a transfer can have, several at once when each has a channel of its own.
  /// Error of the scenario: a fault has no place in its transfer.
  [[nodiscard]] virtual Result<std::vector<SdoAnswer>> transfer(const std::vector<SdoJob>& jobs) = 0;
  /// What the entry held just before the last download to it in this scenario; nullopt if none, or not
  /// readable.
  [[nodiscard]] virtual std::optional<Bytes> before_last_write(Multiplexer object) const = 0;
  [[nodiscard]] virtual Result<void> nmt(canopen::NmtCommand command) = 0;
  /// A heartbeat of a node that is played because an error trigger of the device needs it. Which trigger that
  /// is, the profile says and not the scenario, so it is the run that must allow it and not the scenario's
  /// risk.
  [[nodiscard]] virtual Result<void> play_heartbeat(NodeId node, canopen::NmtState state) = 0;
  /// Any frame. A download hidden in it must have been announced with will_change() before.
  [[nodiscard]] virtual Result<void> send(const can::Frame& frame) = 0;
  [[nodiscard]] virtual Result<void> will_change(Multiplexer object) = 0;
  /// The SDO channel was left in an unknown state (a conversation, a time-out): make it idle before the next
  /// use.
  virtual void sdo_channel_dirty() = 0;
  /// An answer that was due did not come: it may come yet, and must not be taken for the answer to the next
  /// request.
  virtual void sdo_answer_may_be_late() = 0;

  /// Index of the first captured frame at or after `from` that matches and is stamped not after `deadline`.
  /// Looks at what is recorded, then receives. nullopt: the deadline passed on the bus.
  [[nodiscard]] virtual Result<std::optional<std::size_t>> find_frame(std::size_t from, const Match& match,
                                                                      BusTime deadline) = 0;
  /// What is sent next is a new request: nothing that was on the bus before it is its answer.
  virtual void next_request() = 0;
  /// The next frame of the SDO server's channel that matches and may answer what was sent since the last
  /// next_request(). `within` counts from the last frame sent; absent: T_SDO. nullopt: none came.
  [[nodiscard]] virtual Result<std::optional<std::size_t>> find_answer(const Match& match,
                                                                       std::optional<Duration> within) = 0;
  /// Receives until `until` without looking for anything.
  [[nodiscard]] virtual Result<void> wait_until(BusTime until) = 0;

  /// Window of the step that runs, or counted from a labelled frame.
  [[nodiscard]] virtual Window window() const = 0;
  /// The device has T_NMT to follow a start, stop or enter pre-operational. Waits until that time is over or
  /// the device shows the new state; a window that began before then begins there. Nothing to do without such
  /// a command, and for steps that say `at_once`.
  [[nodiscard]] virtual Result<void> await_state() = 0;
  /// How much longer than usual may be waited for what the device sends in the state that was commanded last.
  [[nodiscard]] virtual Duration time_to_follow() const = 0;
  /// An EMCY that is due may come so late, as the inhibit time (1015h) runs behind the last one of this case.
  [[nodiscard]] virtual BusTime emcy_held_until() const = 0;
  /// The error of a trigger was raised or cleared: an EMCY is due.
  virtual void error_changed(std::uint16_t code, bool raised) = 0;
  [[nodiscard]] virtual Result<Window> window_after(std::string_view label) const = 0;
  /// The step has used the trace up to and including `index`: later steps look behind it. An index behind the
  /// last frame means all that was recorded; windows then count from now.
  virtual void consume(std::size_t index) = 0;
  /// Where EMCY frames of the device are expected now (1014h as last read or written; 80h + node-ID
  /// otherwise).
  [[nodiscard]] virtual CanId emcy_can_id() const = 0;
  virtual void label(std::string_view name, std::size_t capture_index) = 0;

  virtual void set(std::string name, Value value) = 0;
  /// Names that end with the step (the placeholders of a conversation) go through the scope as well.
  [[nodiscard]] virtual Result<void> produce(Production production) = 0;
  virtual void stop_producing(std::string_view label) = 0;

  /// Takes the power of the device away and gives it back, as the user has said how. The device may have
  /// started before this returns; a window of the running step begins before it. Error of the environment:
  /// the power could not be switched.
  [[nodiscard]] virtual Result<void> power_cycle() {
    return fail_scenario("no way to switch the power of the device is known");
  }
};

}  // namespace conform::steps
