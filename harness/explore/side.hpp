// SPDX-License-Identifier: Apache-2.0
// One side of a duel: actions in, answers and everything else that is said out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "can/capture.hpp"
#include "explore/action.hpp"
#include "monitor/watch.hpp"

namespace conform::explore {

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
  Bytes data{};           ///< of an upload; of a single request the eight bytes of the reply
  bool size_told = true;  ///< of an upload; else the last of the four bytes may be no data
  std::string detail{};   ///< of a violation
  Duration taken{};       ///< from the action's begin to its end
  /// From the begin to the last frame that the device answered with: what is waited for in vain behind that
  /// is not its time.
  Duration answered{};

  /// "confirmed, 91 01", "abort 0602 0000h (object does not exist)", "no answer"
  [[nodiscard]] std::string text() const;
  /// Whether a reader would call both the same; how long they took does not count.
  [[nodiscard]] bool same_as(const Answer& other) const;
};

/// A frame of the device that answers no transfer: boot-up, heartbeat, EMCY, PDO, SYNC, ...
struct Unasked {
  can::Frame frame;
  BusTime time;  ///< since the place was entered
};

class Side {
 public:
  Side() = default;
  Side(const Side&) = delete;
  Side& operator=(const Side&) = delete;
  virtual ~Side() = default;

  /// Does it and waits for the answer, for at most `patience` of each frame.
  virtual Answer perform(const Action& action, Duration patience) = 0;
  /// How long the next action is known to be answered by nothing; zero where nobody knows.
  [[nodiscard]] virtual Duration will_be_silent() const { return {}; }
  /// Lets time pass; at once when that is over already.
  virtual void run_until(BusTime time) = 0;
  [[nodiscard]] virtual BusTime now() const = 0;
  /// The frames that came unasked since they were taken.
  [[nodiscard]] virtual std::vector<Unasked>& unasked() = 0;
  /// Nullptr: nobody watches.
  [[nodiscard]] virtual const monitor::Watch* watch() const { return nullptr; }
  /// All frames, where somebody watches.
  [[nodiscard]] virtual const std::vector<can::CapturedFrame>& trace() const = 0;
  /// What the simulation gave up on: a device that never rests. Empty: all is well.
  [[nodiscard]] virtual const std::string& broken() const = 0;
  /// The bus or the host failed: nobody is to be blamed.
  [[nodiscard]] virtual const std::optional<Error>& fault() const = 0;
  /// Behind a conversation: whether the device starts again. False: it is gone. Error: nobody can say.
  [[nodiscard]] virtual Result<bool> comes_back() { return true; }
  /// Whether the host lost frames or was late, so that nothing may be concluded.
  [[nodiscard]] virtual bool distrusted() { return false; }
};

}  // namespace conform::explore
