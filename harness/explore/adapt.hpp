// SPDX-License-Identifier: Apache-2.0
// What a device does otherwise than the model may be its right. Before a difference counts, the model is made
// such a device: where legal choices explain the conversation, and all that was played before, the device has
// chosen so.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "explore/duel.hpp"

namespace conform::explore {

/// A legal way to be another device than the model is by itself.
struct Choice {
  std::string name;
  std::string group;  ///< of all with the same one here a device has one at most; empty: beside any other
  std::string
      warns;  ///< the requirement that tolerates it with a warning; empty: nothing is to be said of it
};
/// Numbers of choices.
using Choices = std::set<std::size_t>;

/// What may explain a difference.
struct Offer {
  std::vector<Choice> choices{};
  /// The model that has chosen so; making it fails where the choices exclude each other.
  std::function<MakeDevice(const Choices&)> model_of{};
};

class Adapter {
 public:
  /// `bench` is the search's own; learn() gives it another model. Both outlive this.
  Adapter(Bench& bench, const Offer& offer) : bench_(bench), offer_(offer) {}

  /// The choice, or the two of them, that explain the difference of this conversation, which the model has
  /// from now on; nullopt: none do. A conversation that was explained once is played with every later model:
  /// what agrees with it by chance is found out.
  /// Where the conversation was kept with what the device did in it, that is held against the models; else
  /// the device plays it again.
  /// None of them: the device is as the model without a choice that it was wrongly thought to have made.
  [[nodiscard]] std::optional<Choices> learn(const Conversation& conversation, const Played& played);

  /// Whether the model would agree in this conversation if it had not made one of its choices: then the
  /// device is not blamed for what the choice asks of it. It may have chosen so in one case and not in
  /// another.
  [[nodiscard]] bool explains_without(const Conversation& conversation, const Played& played) const;

  /// In this conversation the device agreed with its model. It must do so with every later model, too: a
  /// wrong choice explains one conversation by chance, but not all.
  void agreed(const Conversation& conversation, const Played& played);
  /// The same, and it is never forgotten for later ones.
  void agrees_always(const Conversation& conversation, const Played& played) {
    explained_.push_back({conversation, played.recording, true});
  }

  [[nodiscard]] const Choices& chosen() const { return chosen_; }

 private:
  [[nodiscard]] Choices with(const Choices& chosen, std::size_t choice) const;
  [[nodiscard]] Bench bench_with(const Choices& chosen) const;
  struct Heard {
    Conversation conversation;
    std::shared_ptr<const Recording> recording;  ///< nullptr: the device is asked again
    bool always = false;                         ///< it is never given up
  };
  [[nodiscard]] static Result<Played> play_again(const Bench& bench, const Heard& heard);
  [[nodiscard]] bool holds_for_all(const Bench& bench) const;
  bool take(const Choices& candidate, const Heard& heard);
  bool refute(const Heard& heard);

  Bench& bench_;
  const Offer& offer_;
  Choices chosen_;
  Choices refuted_;               ///< they are never chosen again
  std::vector<Heard> explained_;  ///< and those that agree always
  std::vector<Heard> agreed_;     ///< the latest ones
  std::size_t seen_ = 0;          ///< of those that agreed
};

}  // namespace conform::explore
