// SPDX-License-Identifier: Apache-2.0
// What a device does otherwise than the model may be its right. Before a difference counts, the model is made
// such a device: where legal choices explain the conversation, and all that was played before, the device has
// chosen so.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "explore/duel.hpp"

namespace conform::explore {

class Adapter {
 public:
  /// `bench` is the search's own; learn() gives it another model.
  explicit Adapter(Bench& bench) : bench_(bench) {}

  /// The choice, or the two of them, that explain the difference of this conversation, which the model has
  /// from now on; nullopt: none do. A conversation that was explained once is played with every later model:
  /// what agrees with it by chance is found out.
  [[nodiscard]] std::optional<Choices> learn(const Conversation& conversation, const Difference& difference);

  /// In this conversation the device agreed with its model. It must do so with every later model, too: a
  /// wrong choice explains one conversation by chance, but not all.
  void agreed(const Conversation& conversation);
  /// The same, and it is never forgotten for later ones.
  void agrees_always(Conversation conversation) { explained_.push_back(std::move(conversation)); }

  [[nodiscard]] const Choices& chosen() const { return chosen_; }

 private:
  [[nodiscard]] Choices with(const Choices& chosen, std::size_t choice) const;
  [[nodiscard]] Bench bench_with(const Choices& chosen) const;
  [[nodiscard]] bool holds_for_all(const Bench& bench) const;
  bool take(const Choices& candidate, const Conversation& conversation);

  Bench& bench_;
  Choices chosen_;
  std::vector<Conversation> explained_;  ///< and those that agree always
  std::vector<Conversation> agreed_;     ///< the latest ones
  std::size_t seen_ = 0;                 ///< of those that agreed
};

}  // namespace conform::explore
