// SPDX-License-Identifier: Apache-2.0
// A device and a tester on a bus. Two worlds given the same actions are how a device is held against its
// model.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "can/capture.hpp"
#include "canopen/sdo_client.hpp"
#include "explore/action.hpp"
#include "explore/place.hpp"
#include "explore/side.hpp"
#include "monitor/watch.hpp"

namespace conform::explore {

class World final : public Side {
 public:
  /// `chosen`: the monitors that watch, none for a model. Lets the device boot.
  World(std::unique_ptr<Place> place, const monitor::Facts& facts,
        std::span<const monitor::Rule* const> chosen);

  Answer perform(const Action& action, Duration patience) override;
  void run_until(BusTime time) override;
  [[nodiscard]] std::vector<Unasked>& unasked() override { return unasked_; }
  /// Since the place was entered.
  [[nodiscard]] BusTime now() const override { return BusTime(place_->bus().now() - zero_); }
  [[nodiscard]] const std::vector<can::CapturedFrame>& trace() const override { return trace_; }
  [[nodiscard]] const monitor::Watch* watch() const override { return watched_ ? &watch_ : nullptr; }
  /// The last NMT command was to stop: nothing but NMT and error control is served.
  [[nodiscard]] bool stopped() const { return last_command_ == 2; }
  [[nodiscard]] const std::string& broken() const override { return broken_; }
  [[nodiscard]] const std::optional<Error>& fault() const override { return fault_; }
  [[nodiscard]] Result<bool> comes_back() override { return place_->comes_back(); }
  [[nodiscard]] bool distrusted() override;

 private:
  void boot();
  Answer transfer(const Action& action, Duration patience);
  Answer ask(const Action& action, Duration patience);
  void send(const can::Frame& frame);
  void fail_by(const Error& error);
  [[nodiscard]] std::optional<can::BusEvent> next(BusTime deadline);
  void keep(const can::BusEvent& event);
  [[nodiscard]] bool is_reply(const can::BusEvent& event) const {
    return event.direction == can::Direction::received && event.frame.is_data(response_);
  }

  std::unique_ptr<Place> place_;
  BusTime zero_;
  can::BusHealth health_;  ///< when the place was entered
  NodeId node_;
  CanId request_, response_;
  monitor::Watch watch_;
  bool watched_;
  std::vector<can::CapturedFrame> trace_;
  std::vector<Unasked> unasked_;
  BusTime replied_{};  ///< when the last frame came that answers a transfer or a request
  std::uint8_t last_command_ = 0x80;
  std::string broken_;
  std::optional<Error> fault_;
};

/// Of a transfer, as the client is asked for it. Nullptr where the transfer has no place for its fault.
[[nodiscard]] std::unique_ptr<canopen::SdoClient> client_of(const Action& action);

}  // namespace conform::explore
