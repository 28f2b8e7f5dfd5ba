// SPDX-License-Identifier: Apache-2.0
#include "explore/explorer.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <utility>

#include "base/random.hpp"
#include "base/text.hpp"
#include "explore/adapt.hpp"
#include "explore/coverage.hpp"
#include "explore/guide.hpp"
#include "explore/shrink.hpp"

namespace conform::explore {
namespace {

/// Actions that have led to what is known are left out of later conversations, but for one in so many
/// episodes: there may be more behind it.
constexpr std::uint64_t all_the_same = 8;

/// A device that has made more choices than these is too far from the model to be blamed by it; the monitors
/// still do.
constexpr std::size_t most_trusted = 8;

/// What nearly every device answers alike: a model that does not any more is not the right one, whatever else
/// it explains.
std::vector<Conversation> introductions(NodeId node) {
  using namespace std::chrono_literals;
  const auto alive = upload({Index(0x1000), SubIndex(0)});
  const auto to = [node](std::uint8_t command) { return nmt(node, command); };
  return {{alive},
          {to(1), wait(200ms), alive, to(0x80), wait(200ms), alive},
          {to(0x82), wait(300ms), alive, to(0x81), wait(300ms), alive, to(2), wait(200ms), to(1), alive}};
}

/// What the communication entries hold from power-on, some at a time: no choice that changes one of those
/// values is the device's.
std::vector<Conversation> inventory(const Vocabulary& words) {
  constexpr std::size_t at_a_time = 24;
  std::vector<Conversation> out;
  for (const auto& entry : words.entries) {
    const auto index = entry.mux.index.value();
    if (index < 0x1000 || index > 0x1FFF || !entry.readable()) continue;
    if (out.empty() || out.back().size() >= at_a_time) out.emplace_back();
    out.back().push_back(upload(entry.mux));
  }
  return out;
}

/// With time behind each NMT command for the device to obey it, and before the action at which the difference
/// shows, for whatever it does by itself.
Conversation with_pauses(const Conversation& conversation, NodeId node) {
  using namespace std::chrono_literals;
  Conversation out;
  for (const auto& each : conversation) {
    const bool is_last = &each == &conversation.back();
    if (is_last && conversation.size() > 1) out.push_back(wait(200ms));
    out.push_back(each);
    const auto command = each.nmt_command(node);
    if (!is_last && (command == 1 || command == 2 || command == 0x80)) out.push_back(wait(200ms));
  }
  return out;
}

/// The same with a little more time between any two actions.
Conversation with_time_between(const Conversation& conversation, Duration more) {
  Conversation out;
  for (const auto& each : conversation) {
    if (!out.empty()) out.push_back(wait(more));
    out.push_back(each);
  }
  return out;
}

class Search {
 public:
  Search(const Bench& bench, const Vocabulary& words, const SearchOptions& options)
      : bench_(bench),
        adapter_(bench_, options.offer),
        words_(words),
        options_(options),
        seeds_(options.seed),
        chances_(options.seed) {}

  Result<SearchResult> run() {
    if (auto done = introduce(); !done) return ended_by(done.error());
    while (out_.actions < options_.most_actions && out_.findings.size() < options_.most_findings) {
      if (options_.is_over && options_.is_over()) break;
      const auto conversation = next_conversation();
      // A device on an interface is asked as seldom as can be.
      auto played = play(bench_, conversation, is_real());
      if (!played) return ended_by(played.error());
      out_.actions += std::max<std::size_t>(1, played->actions);  // also an empty one uses the budget up
      ++out_.episodes;
      if (played->distrusted) {
        ++out_.distrusted;
        continue;
      }
      if (!played->difference) {
        adapter_.agreed(conversation, *played);
        guide_.note(conversation, states_of(conversation, played->answers, words_.node));
        if (out_.episodes <= options_.corpus.size()) of_corpus_ = guide_.kept().size();
        continue;
      }
      auto ends = look_at(conversation, *played);
      if (!ends) return ended_by(ends.error());
      if (*ends) break;
    }
    return taken();
  }

 private:
  /// What nearly every device answers alike, and how long its answers take.
  Result<void> introduce() {
    for (const auto& each : introductions(words_.node)) {
      if (!may(each)) continue;
      auto played = play(bench_, each, true);
      if (!played) return std::unexpected(played.error());
      for (const auto& answer : played->answers) {
        if (answer.kind == Answer::Kind::confirmed)
          bench_.answer_time = std::max(bench_.answer_time, 2 * answer.taken);
      }
      if (!played->difference && !played->distrusted) adapter_.agrees_always(each, *played);
    }
    return take_inventory();
  }

  Result<void> take_inventory() {
    auto left = inventory(words_);
    while (!left.empty()) {
      const auto each = std::move(left.back());
      left.pop_back();
      if (!may(each) || (is_real() && options_.is_over && options_.is_over())) continue;
      auto played = play(bench_, each, true);
      if (!played) return std::unexpected(played.error());
      if (played->distrusted) continue;
      if (!played->difference) {
        adapter_.agrees_always(each, *played);
        continue;
      }
      // What the model holds otherwise is left out, and the search will meet it.
      const auto agreed = static_cast<std::ptrdiff_t>(played->difference->action);
      if (agreed > 0) left.emplace_back(each.begin(), each.begin() + agreed);
      if (each.begin() + agreed + 1 < each.end()) left.emplace_back(each.begin() + agreed + 1, each.end());
    }
    return {};
  }

  SearchResult taken() {
    for (const auto choice : adapter_.chosen()) out_.chosen.push_back(options_.offer.choices[choice].name);
    out_.kept.assign(guide_.kept().begin() + static_cast<std::ptrdiff_t>(of_corpus_), guide_.kept().end());
    out_.states = guide_.states();
    return std::move(out_);
  }

  /// What was found on a real device is not lost with it.
  Result<SearchResult> ended_by(const Error& error) {
    if (!is_real()) return std::unexpected(error);
    out_.ended_by = error;
    return taken();
  }

  Conversation next_conversation() {
    auto out = thought_of();
    if (!avoided_.empty() && out_.episodes % all_the_same != 0) {
      std::erase_if(out, [&](const Action& action) { return avoided_.contains(key_of(action)); });
    }
    std::erase_if(out, [&](const Action& action) { return options_.may && !options_.may(action); });
    return out;
  }

  /// One of an earlier search, one that is like those which came somewhere, or one that is drawn.
  Conversation thought_of() {
    if (from_corpus_ < options_.corpus.size()) return options_.corpus[from_corpus_++];
    auto drawn = draw(words_, next_random(seeds_), options_.episode_length);
    if (is_real() || guide_.empty() || !chances_.chance(options_.guided)) return drawn;
    return guide_.like_kept(chances_, std::move(drawn), 2 * options_.episode_length);
  }

  [[nodiscard]] static bool blames(const Finding& finding) {
    return finding.assigned && finding.assigned->grade == Grade::violated;
  }
  [[nodiscard]] bool is_real() const { return static_cast<bool>(bench_.place); }
  [[nodiscard]] bool may(const Conversation& conversation) const {
    return !options_.may || std::ranges::all_of(conversation, options_.may);
  }

  /// What an action is, without its values.
  [[nodiscard]] std::string key_of(const Action& action) const {
    if (!action.is_transfer()) return describe(action, words_.node);
    return std::to_string(static_cast<int>(action.kind)) + to_string(action.object) +
           std::to_string(static_cast<int>(action.transfer)) + action.fault;
  }

  /// True: the search is to end.
  Result<bool> look_at(const Conversation& conversation, const Played& played) {
    const auto signature = played.difference->signature(conversation);
    if (!known_.insert(signature).second) {
      ++out_.known;
      return false;
    }
    const auto shows = [&](const Conversation& candidate) {
      // A try of a real device takes seconds: when the time is over, what is as short as it is stays so.
      if (is_real() && options_.is_over && options_.is_over()) return false;
      const auto again = play(bench_, candidate);
      return again && again->difference && again->difference->signature(candidate) == signature;
    };
    Conversation head(conversation.begin(),
                      conversation.begin() + static_cast<std::ptrdiff_t>(played.difference->action + 1));
    // A device that is gone cannot be asked again, unless somebody switches its power.
    const bool is_gone = played.difference->what == Difference::What::gone;
    if (!is_gone && !shows(head)) {
      // To make short what shows now and then only takes long where each try does.
      if (is_real() && !shows(head)) {
        ++out_.passed_by;
        known_.erase(signature);
        return false;
      }
      if (!is_real()) head = conversation;
    }
    auto shrunk = shrink(head, shows, options_.most_tries);
    out_.shrinking += shrunk.tries;
    // A device may take a while to obey: what shows all the same behind a pause is no matter of time.
    bool in_good_time = true;
    if (auto patient = with_pauses(shrunk.conversation, words_.node); patient != shrunk.conversation) {
      in_good_time = shows(patient);
      if (in_good_time) shrunk.conversation = std::move(patient);
    }
    // On a real bus nobody knows to some milliseconds when anything happened: what does not show a little
    // later, either, is too near to the edge of some time to blame a device for it.
    if (is_real() && !is_gone && !in_good_time) {
      using namespace std::chrono_literals;
      in_good_time = shows(with_time_between(shrunk.conversation, 20ms + bench_.jitter));
    }
    auto kept = play(bench_, shrunk.conversation, true);
    if (!kept && is_real()) {
      // The device is gone, and perhaps by this: it is told as it was found.
      Finding finding;
      finding.conversation = head;
      finding.played = played;
      finding.episode = out_.episodes;
      finding.actions_until = out_.actions;
      finding.drawn = conversation.size();
      finding.assigned = assign({words_, finding.conversation, finding.played});
      out_.findings.push_back(std::move(finding));
      if (options_.on_finding) (void)options_.on_finding(out_.findings.back());
    }
    if (!kept) return std::unexpected(kept.error());
    if (!kept->difference) return false;
    Finding finding;
    finding.conversation = std::move(shrunk.conversation);
    finding.played = std::move(*kept);
    finding.episode = out_.episodes;
    finding.actions_until = out_.actions;
    finding.drawn = head.size();
    repeat(finding, signature);
    // Another model does not change what a monitor has seen.
    const auto what = finding.played.difference->what;
    const bool may_be_chosen = what != Difference::What::rule && what != Difference::What::gone;
    const auto learnt = may_be_chosen ? adapter_.learn(finding.conversation, finding.played) : std::nullopt;
    if (learnt) {
      known_.erase(signature);
      const auto warns = std::ranges::find_if(
          *learnt, [&](auto choice) { return !options_.offer.choices[choice].warns.empty(); });
      if (warns == learnt->end()) return false;
      finding.assigned = strains(options_.offer.choices[*warns].warns);
    } else {
      finding.assigned = assign({words_, finding.conversation, finding.played});
      // Choices of which none explains the next difference may have been the wrong ones.
      const bool doubtful =
          adapter_.chosen().size() > most_trusted || (is_real() && !in_good_time) ||
          (blames(finding) && adapter_.explains_without(finding.conversation, finding.played));
      if (may_be_chosen && blames(finding) && doubtful) finding.assigned->grade = Grade::tolerated;
    }
    step_round(finding);
    const bool is_allowed = finding.assigned && finding.assigned->grade == Grade::allowed;
    if (is_allowed || (finding.assigned && is_known(*finding.assigned))) {
      ++out_.known;
      return false;
    }
    out_.findings.push_back(std::move(finding));
    return options_.on_finding && options_.on_finding(out_.findings.back());
  }

  /// The same rule is broken once more; that it is violated is new where it was only strained until now.
  bool is_known(const Assigned& assigned) {
    const auto [known, is_new] = rules_.emplace(assigned.requirement, assigned.grade);
    if (is_new) return false;
    if (known->second == Grade::violated || assigned.grade == Grade::tolerated) return true;
    known->second = Grade::violated;
    return false;
  }

  /// On buses whose turnarounds are drawn by other seeds: a race shows as what it is.
  void repeat(Finding& finding, const std::string& signature) const {
    auto bench = bench_;
    for (finding.repeats = 0; finding.repeats < options_.repeats; ++finding.repeats) {
      bench.bus_seed = bench_.bus_seed + finding.repeats;
      const auto again = play(bench, finding.conversation);
      finding.repeated +=
          again && again->difference && again->difference->signature(finding.conversation) == signature;
    }
  }

  /// The action at which it showed; where that only let time pass, the one before.
  void step_round(const Finding& finding) {
    for (auto i = std::min(finding.played.difference->action + 1, finding.conversation.size()); i-- > 0;) {
      const auto& action = finding.conversation[i];
      if (action.kind == Action::Kind::wait) continue;
      avoided_.insert(key_of(action));
      return;
    }
  }

  Bench bench_;
  Adapter adapter_;
  const Vocabulary& words_;
  const SearchOptions& options_;
  std::uint64_t seeds_;
  Random chances_;  ///< of the guidance: beside the seeds, so that what is drawn is the same without it
  Guide guide_;
  std::size_t from_corpus_ = 0;  ///< conversations played
  std::size_t of_corpus_ = 0;    ///< ... and kept by the guide: they are no new ones
  SearchResult out_;
  std::set<std::string> known_;         ///< signatures
  std::map<std::string, Grade> rules_;  ///< requirements that findings have named
  std::set<std::string, std::less<>> avoided_;
};

}  // namespace

Result<SearchResult> search(const Bench& bench, const Vocabulary& words, const SearchOptions& options) {
  return Search(bench, words, options).run();
}

}  // namespace conform::explore
