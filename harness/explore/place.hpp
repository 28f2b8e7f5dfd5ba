// SPDX-License-Identifier: Apache-2.0
// Where a device is met: the bus it is on, and how it is brought to its beginning. In simulation a device is
// new each time and its power is switched; on an interface it is reset.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "base/error.hpp"
#include "base/time.hpp"
#include "can/participant.hpp"
#include "can/simulated_bus.hpp"
#include "can/transport.hpp"

namespace conform::explore {

class Place {
 public:
  Place() = default;
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;
  virtual ~Place() = default;

  [[nodiscard]] virtual can::Transport& bus() = 0;
  /// The device starts: its boot-up message is still to come. Error: it cannot be told to.
  [[nodiscard]] virtual Result<void> start() = 0;
  /// Its power goes off and on.
  [[nodiscard]] virtual Result<void> switch_power() = 0;
  /// It is up by then, or counts as one that does not start.
  [[nodiscard]] virtual Duration longest_boot() const = 0;
  /// What it is when no boot-up message comes by then; nullopt: a device like any other.
  [[nodiscard]] virtual std::optional<Error> without_boot_up() const { return std::nullopt; }
  /// Behind a conversation: whether the device starts again when it is told to. In simulation it is made
  /// anew.
  [[nodiscard]] virtual Result<bool> comes_back() { return true; }
  /// A real one may not come back, and its host may lose frames or be late: then nothing is concluded.
  [[nodiscard]] virtual bool is_real() const = 0;
};

/// Makes the device anew, as it comes out of its box: nothing stored, power off.
using MakeDevice = std::function<Result<std::unique_ptr<can::Participant>>()>;
/// Goes where the device is, for one conversation.
using FindPlace = std::function<Result<std::unique_ptr<Place>>()>;

/// A device alone with a tester on a simulated bus. `seed` draws the reaction times.
class SimulatedPlace final : public Place {
 public:
  SimulatedPlace(std::unique_ptr<can::Participant> device, std::uint64_t seed);
  [[nodiscard]] can::Transport& bus() override { return bus_.transport(); }
  [[nodiscard]] Result<void> start() override;
  [[nodiscard]] Result<void> switch_power() override;
  [[nodiscard]] Duration longest_boot() const override;
  [[nodiscard]] bool is_real() const override { return false; }

 private:
  std::unique_ptr<can::Participant> device_;
  can::SimulatedBus bus_;
};

}  // namespace conform::explore
