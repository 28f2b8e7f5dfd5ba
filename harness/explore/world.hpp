// SPDX-License-Identifier: Apache-2.0
// A device alone with a tester on a simulated bus: actions in, answers and everything else it says out. Two
// worlds given the same actions are how a device is held against its model.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "can/capture.hpp"
#include "can/participant.hpp"
#include "can/simulated_bus.hpp"
#include "canopen/sdo_client.hpp"
#include "explore/action.hpp"
#include "monitor/watch.hpp"

namespace conform::explore {

/// Makes the device anew, as it comes out of its box: nothing stored, power off.
using MakeDevice = std::function<Result<std::unique_ptr<can::Participant>>()>;

/// What came of one action.
struct Answer {
  enum class Kind : std::uint8_t {
    none,       ///< nothing was asked
    confirmed,  ///< the transfer is complete
    aborted,    ///< by the device
    violation,  ///< the device broke the protocol of the transfer
    silence,
    replied,  ///< to a single request: the first frame
  };
  Kind kind = Kind::none;
  AbortCode code{};
  Bytes data{};          ///< of an upload; of a single request the eight bytes of the reply
  std::string detail{};  ///< of a violation
  Duration taken{};      ///< from the action's begin to its end

  /// "confirmed, 91 01", "abort 0602 0000h (object does not exist)", "no answer"
  [[nodiscard]] std::string text() const;
  /// Whether a reader would call both the same; how long they took does not count.
  [[nodiscard]] bool same_as(const Answer& other) const;
};

/// A frame of the device that answers no transfer: boot-up, heartbeat, EMCY, PDO, SYNC, ...
struct Unasked {
  can::Frame frame;
  BusTime time;
};

class World {
 public:
  /// `chosen`: the monitors that watch, none for a model. Switches the power on and lets the device boot.
  World(std::unique_ptr<can::Participant> device, const monitor::Facts& facts, std::uint64_t seed,
        std::span<const monitor::Rule* const> chosen);

  /// Does it and waits for the answer, for at most `patience` of each frame.
  Answer perform(const Action& action, Duration patience);
  /// Lets time pass; at once when that is over already.
  void run_until(BusTime time);
  /// The frames that came unasked since the last call.
  [[nodiscard]] std::vector<Unasked>& unasked() { return unasked_; }
  [[nodiscard]] BusTime now() const { return bus_.now(); }
  [[nodiscard]] const std::vector<can::CapturedFrame>& trace() const { return trace_; }
  [[nodiscard]] const monitor::Watch& watch() const { return watch_; }
  /// The last NMT command was to stop: nothing but NMT and error control is served.
  [[nodiscard]] bool stopped() const { return last_command_ == 2; }
  /// What the simulation gave up on: a device that never rests. Empty: all is well.
  [[nodiscard]] const std::string& broken() const { return broken_; }

 private:
  void boot();
  Answer transfer(const Action& action, Duration patience);
  Answer ask(const Action& action, Duration patience);
  void send(const can::Frame& frame);
  [[nodiscard]] std::optional<can::BusEvent> next(BusTime deadline);
  void keep(const can::BusEvent& event);
  [[nodiscard]] bool is_reply(const can::BusEvent& event) const {
    return event.direction == can::Direction::received && event.frame.is_data(response_);
  }

  std::unique_ptr<can::Participant> device_;
  can::SimulatedBus bus_;
  NodeId node_;
  CanId request_, response_;
  monitor::Watch watch_;
  bool watched_;
  std::vector<can::CapturedFrame> trace_;
  std::vector<Unasked> unasked_;
  std::uint8_t last_command_ = 0x80;
  std::string broken_;
};

/// Of a transfer, as the client is asked for it. Nullptr where the transfer has no place for its fault.
[[nodiscard]] std::unique_ptr<canopen::SdoClient> client_of(const Action& action);

}  // namespace conform::explore
