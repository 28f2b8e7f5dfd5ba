// SPDX-License-Identifier: Apache-2.0
#include "explore/shrink.hpp"

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

namespace conform::explore {
namespace {

using namespace std::chrono_literals;

class Shrinker {
 public:
  Shrinker(Conversation conversation, const Shows& shows, std::size_t most_tries)
      : best_(std::move(conversation)), shows_(shows), left_(most_tries) {}

  Conversation run() {
    bool smaller = true;
    while (smaller && left_ > 0) {
      smaller = remove_actions();
      smaller = simplify_actions() || smaller;
    }
    return best_;
  }

 private:
  bool accept(Conversation candidate) {
    if (left_ == 0) return false;
    --left_;
    if (!shows_(candidate)) return false;
    best_ = std::move(candidate);
    return true;
  }

  /// Leaves out pieces, half of all at first and single actions in the end. From the end on: what comes late
  /// rarely prepares what came before.
  bool remove_actions() {
    bool removed = false;
    for (auto piece = std::max<std::size_t>(1, best_.size() / 2);; piece = piece / 2) {
      for (auto end = best_.size(); end > 0 && left_ > 0;) {
        const auto begin = end > piece ? end - piece : 0;
        Conversation candidate(best_.begin(), best_.begin() + static_cast<std::ptrdiff_t>(begin));
        candidate.insert(candidate.end(), best_.begin() + static_cast<std::ptrdiff_t>(end), best_.end());
        if (!candidate.empty() && accept(std::move(candidate))) removed = true;
        end = std::min(begin, best_.size());
      }
      if (piece == 1) return removed;
    }
  }

  bool simplify_actions() {
    bool simpler = false;
    for (std::size_t i = 0; i < best_.size() && left_ > 0; ++i) {
      for (auto& plainer : plainer_than(best_[i])) {
        auto candidate = best_;
        candidate[i] = std::move(plainer);
        if (accept(std::move(candidate))) {
          simpler = true;
          break;
        }
      }
    }
    return simpler;
  }

  /// Plainer ones that come nearer and nearer to `action`; each is strictly plainer, so that this ends.
  static std::vector<Action> plainer_than(const Action& action) {
    std::vector<Action> out;
    const auto add = [&](auto change) {
      auto candidate = action;
      change(candidate);
      if (candidate != action) out.push_back(std::move(candidate));
    };
    if (action.kind == Action::Kind::wait) {
      for (const auto shorter : {Duration(1ms), action.time / 4, action.time / 2}) {
        const auto whole = std::chrono::floor<std::chrono::milliseconds>(shorter);
        if (whole > 0ms && whole < action.time) add([&](Action& it) { it.time = whole; });
      }
    }
    if (!action.is_transfer()) return out;
    if (!action.fault.empty()) add([](Action& it) { it.fault.clear(); });
    if (action.transfer != Transfer::automatic) add([](Action& it) { it.transfer = Transfer::automatic; });
    if (action.blksize != 127) add([](Action& it) { it.blksize = 127; });
    if (action.data.size() > 8) add([](Action& it) { it.data.resize(it.data.size() / 2); });
    if (std::ranges::any_of(action.data, [](auto byte) { return byte != 0; }))
      add([](Action& it) { std::ranges::fill(it.data, std::uint8_t{0}); });
    return out;
  }

  Conversation best_;
  const Shows& shows_;
  std::size_t left_;
};

}  // namespace

Shrunk shrink(Conversation conversation, const Shows& shows, std::size_t most_tries) {
  Shrunk out;
  const Shows counted = [&](const Conversation& candidate) {
    ++out.tries;
    return shows(candidate);
  };
  out.conversation = Shrinker(std::move(conversation), counted, most_tries).run();
  return out;
}

}  // namespace conform::explore
