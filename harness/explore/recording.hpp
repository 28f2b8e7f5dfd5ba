// SPDX-License-Identifier: Apache-2.0
// What a device did in a conversation, to be held against other models than the one it was played with: the
// device itself is not asked again.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "explore/side.hpp"

namespace conform::explore {

struct Recording {
  std::vector<Answer> answers;   ///< of each action that was performed
  std::vector<BusTime> ends;     ///< of each
  std::vector<Unasked> unasked;  ///< in their order, those of the boot included
  BusTime booted{}, end{};
};

/// The side of a recorded device: whatever is asked of it, it does what it did.
class Recorded final : public Side {
 public:
  explicit Recorded(const Recording& recording);
  Answer perform(const Action& action, Duration patience) override;
  [[nodiscard]] Duration will_be_silent() const override;
  void run_until(BusTime time) override;
  [[nodiscard]] BusTime now() const override { return now_; }
  [[nodiscard]] std::vector<Unasked>& unasked() override { return came_; }
  [[nodiscard]] const std::vector<can::CapturedFrame>& trace() const override { return trace_; }
  [[nodiscard]] const std::string& broken() const override { return broken_; }
  [[nodiscard]] const std::optional<Error>& fault() const override { return fault_; }

 private:
  void hear(BusTime until);

  const Recording& recording_;
  std::size_t next_answer_ = 0, next_frame_ = 0;
  BusTime now_{};
  std::vector<Unasked> came_;
  std::vector<can::CapturedFrame> trace_;
  std::string broken_;
  std::optional<Error> fault_;
};

/// Takes down what the side does that it stands before.
class Recorder final : public Side {
 public:
  explicit Recorder(std::unique_ptr<Side> inner);
  Answer perform(const Action& action, Duration patience) override;
  void run_until(BusTime time) override;
  [[nodiscard]] BusTime now() const override { return inner_->now(); }
  [[nodiscard]] std::vector<Unasked>& unasked() override { return came_; }
  [[nodiscard]] const monitor::Watch* watch() const override { return inner_->watch(); }
  [[nodiscard]] const std::vector<can::CapturedFrame>& trace() const override { return inner_->trace(); }
  [[nodiscard]] const std::string& broken() const override { return inner_->broken(); }
  [[nodiscard]] const std::optional<Error>& fault() const override { return inner_->fault(); }
  [[nodiscard]] Result<bool> comes_back() override { return inner_->comes_back(); }
  [[nodiscard]] bool distrusted() override { return inner_->distrusted(); }
  [[nodiscard]] const Recording& recording() const { return recording_; }

 private:
  void take_down();

  std::unique_ptr<Side> inner_;
  Recording recording_;
  std::vector<Unasked> came_;
};

}  // namespace conform::explore
