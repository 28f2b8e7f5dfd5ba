// SPDX-License-Identifier: Apache-2.0
// A device on an interface as the subject of exploration: reset before each conversation, looked at before
// anything is written, and left as it was found.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/bytes.hpp"
#include "can/transport.hpp"
#include "cli/proof/explored.hpp"
#include "device/dictionary.hpp"
#include "device/profile.hpp"
#include "engine/observer.hpp"
#include "engine/run_session.hpp"
#include "engine/scan.hpp"
#include "engine/tier_guard.hpp"
#include "explore/action.hpp"
#include "explore/place.hpp"
#include "steps/tier.hpp"

namespace conform::cli {

class LiveDevice {
 public:
  /// `observer` is told of each entry before it is changed, and when it holds its value again. `stop` becomes
  /// non-zero when the user wants an end. All of them outlive this.
  LiveDevice(can::Transport& transport, const device::Profile& profile, steps::Tier allowed,
             engine::Observer& observer, const std::atomic<int>& stop);
  LiveDevice(const LiveDevice&) = delete;
  LiveDevice& operator=(const LiveDevice&) = delete;
  ~LiveDevice();

  /// Resets the device and reads what it holds. Error: nobody answers, or others are on the bus.
  [[nodiscard]] Result<void> look();
  /// What look() has read, as a scan shows it.
  [[nodiscard]] const std::vector<engine::ScannedObject>& seen() const { return seen_; }
  [[nodiscard]] const device::Dictionary& dictionary() const { return dictionary_; }
  /// nullptr: it could not be read.
  [[nodiscard]] const Bytes* value_of(Multiplexer object) const;

  /// Whether the tier covers the action, and what it changes can be put back. Nothing is ever stored.
  [[nodiscard]] bool may(const explore::Action& action) const;
  /// For the next conversation; what the one before changed is put back first. Error: the user stops, or the
  /// device is gone.
  [[nodiscard]] Result<std::unique_ptr<explore::Place>> enter();
  /// At the end, also behind an error: resets the device, puts back what a reset did not, and says what is
  /// left. Error: the device is gone.
  [[nodiscard]] Result<std::vector<std::string>> leave();

 private:
  class Watched;
  class Here;
  struct Talk;

  /// False: no boot-up message came.
  [[nodiscard]] Result<bool> reset(engine::RunSession& session) const;
  [[nodiscard]] Error did_not_start() const;
  [[nodiscard]] Duration longest_boot() const;
  /// Resets the device. False: it does not start any more.
  [[nodiscard]] Result<bool> settle(bool at_end);
  /// By its power, where that can be switched.
  [[nodiscard]] Result<void> revive();
  [[nodiscard]] Result<void> is_alone(engine::RunSession& session) const;
  [[nodiscard]] bool may_write(Multiplexer object) const;
  [[nodiscard]] bool is_open(Multiplexer object) const;
  [[nodiscard]] bool is_as_told(const explore::Action& action) const;
  [[nodiscard]] static bool may_ask_lss(const can::Frame& frame);
  void changing(Multiplexer object);

  device::Profile profile_;
  device::Dictionary dictionary_;
  engine::TierGuard guard_;
  steps::Tier allowed_;
  engine::Observer& observer_;
  const std::atomic<int>& stop_;
  std::unique_ptr<Watched> bus_;
  std::vector<engine::ScannedObject> seen_;
  std::map<Multiplexer, Bytes> values_;
  std::set<Multiplexer> changed_;  ///< since the last reset that was looked after
  std::vector<std::string> left_;
  bool gone_ = false;  ///< it did not start when it was reset last
};

/// Makes the device that which the search meets, instead of a simulated one: what could not be read is not
/// talked about, and process data are its own affair. Both outlive the search.
void meet(Explorable& explorable, LiveDevice& device);

}  // namespace conform::cli
