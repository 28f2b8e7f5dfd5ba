// SPDX-License-Identifier: Apache-2.0
#include "result/compare.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <set>

#include "result/compare_steps.hpp"
#include "result/requirement_verdicts.hpp"

namespace conform::result {
namespace {

bool is_decided(std::optional<Verdict> verdict) { return verdict && is_decided(*verdict); }
/// Files that the user gives about the device: another one makes no other device.
bool is_of_the_user(std::string_view property) {
  return property.starts_with("input.") || property.starts_with("dut.description");
}

bool is_undecided(std::optional<Verdict> verdict) {
  return verdict == Verdict::inconclusive || verdict == Verdict::error;
}

/// The verdicts of a run by requirement and case, the unit of judgement.
class Ledger {
 public:
  explicit Ledger(const RunResult& run) {
    for (const auto& one : run.cases) {
      ids_.insert(one.id);
      names_.insert(one.name());
      auto rules = std::set<std::string>(one.requirements.begin(), one.requirements.end());
      for (const auto& judgement : one.judgements) rules.insert(judgement.requirement);
      for (const auto& rule : rules) {
        if (const auto verdict = verdict_in(one, rule))
          units_[rule].emplace(one.name(), Unit{*verdict, &one});
      }
    }
    for (auto& each : requirement_verdicts(run)) whole_.emplace(std::move(each.id), each.verdict);
  }

  struct Unit {
    Verdict verdict;
    const CaseResult* owner;
  };
  using Units = std::map<std::string, Unit>;

  [[nodiscard]] const Units& units(const std::string& rule) const {
    static const Units none;
    const auto found = units_.find(rule);
    return found == units_.end() ? none : found->second;
  }
  [[nodiscard]] std::optional<Verdict> unit(const std::string& rule, const std::string& name) const {
    const auto found = units(rule).find(name);
    return found == units(rule).end() ? std::nullopt : std::optional(found->second.verdict);
  }
  /// The worst that was decided of the rule, whatever else was not.
  [[nodiscard]] std::optional<Verdict> decided(const std::string& rule) const {
    std::optional<Verdict> out;
    for (const auto& [name, unit] : units(rule)) {
      if (is_decided(unit.verdict)) out = out ? worst(*out, unit.verdict) : unit.verdict;
    }
    return out;
  }
  /// By requirement; none: no branch that was taken judges it.
  [[nodiscard]] const std::map<std::string, std::optional<Verdict>>& whole() const { return whole_; }
  [[nodiscard]] const std::set<std::string>& ids() const { return ids_; }
  [[nodiscard]] bool has_case(const std::string& name) const { return names_.contains(name); }

 private:
  std::map<std::string, Units> units_;
  std::map<std::string, std::optional<Verdict>> whole_;
  std::set<std::string> ids_, names_;
};

class Comparing {
 public:
  Comparing(const RunResult& before, const RunResult& after)
      : before_(before), after_(after), old_(before), new_(after), old_causes_(causes_of(before)) {
    for (const auto& cause : old_causes_) {
      for (const auto& place : cause.findings) {
        auto& found = found_[{place.finding->requirement, place.owner->name()}];
        found = worst(found, place.verdict);
      }
    }
  }

  Comparison all() {
    out_.before = &before_;
    out_.after = &after_;
    compare_causes();
    compare_requirements();
    out_.observed = observed_changes(before_, after_);
    out_.identity = property_changes(before_, after_, {"dut."});
    std::erase_if(out_.identity, [](const auto& each) { return is_of_the_user(each.name); });
    out_.entries = entry_changes(before_, after_);
    out_.instances = instance_changes(before_, after_);
    // Where scenarios were left out, so were single instances.
    if (!std::ranges::includes(new_.ids(), old_.ids()))
      std::erase_if(out_.instances, [](const auto& each) { return each.added.empty(); });
    out_.times = times_changes(before_, after_);
    add_circumstances();
    return std::move(out_);
  }

 private:
  /// Whether the old run had found it as well.
  [[nodiscard]] bool is_known(const Place& place) const {
    const auto& rule = place.finding->requirement;
    // Also where the case was not decided afterwards.
    const auto found = found_.find({rule, place.owner->name()});
    if (found != found_.end() && found->second >= place.verdict) return true;
    const auto same = old_.unit(rule, place.owner->name());
    // A case that was not there, or got nowhere, says nothing: a sample draws other objects, and a fault that
    // shows with another one is no new fault.
    const auto was = is_decided(same) ? same : old_.decided(rule);
    return was && *was >= place.verdict;
  }

  void compare_causes() {
    for (auto& cause : causes_of(after_)) {
      NewCause one;
      for (const auto& place : cause.findings) {
        if (!is_known(place)) one.fresh.push_back(place);
      }
      const bool has_known_failure = std::ranges::any_of(cause.findings, [this](const Place& place) {
        return place.verdict == Verdict::fail && is_known(place);
      });
      if (has_known_failure) ++out_.known_failures;
      if (one.fresh.empty()) continue;
      // The primary one first, but a failure before any warning.
      std::ranges::stable_sort(one.fresh, std::greater{}, &Place::verdict);
      one.verdict = one.fresh.front().verdict;
      one.cause = std::move(cause);
      out_.new_causes.push_back(std::move(one));
    }
    std::ranges::stable_sort(out_.new_causes, [](const NewCause& one, const NewCause& other) {
      if (one.verdict != other.verdict) return one.verdict > other.verdict;
      return !one.has_spread() && other.has_spread();
    });
    for (const auto& cause : old_causes_) {
      GoneCause one;
      for (const auto& place : cause.findings) {
        const auto now = new_.unit(place.finding->requirement, place.owner->name());
        if (is_decided(now)) {
          // What somebody answers for is there still.
          ++(*now < place.verdict && now != Verdict::waived ? one.mended : one.left);
        } else if (is_undecided(now)) {
          ++one.left;
        } else if (!place.is_monitor() && new_.has_case(place.owner->name())) {
          ++one.mended;  // the device has no such thing any more, or shows it in no way that was taken
        }  // what was not tried again is neither
      }
      if (one.mended == 0) continue;
      one.cause = cause;
      out_.gone_causes.push_back(std::move(one));
    }
    std::ranges::stable_sort(out_.gone_causes, {}, [](const GoneCause& one) { return one.left != 0; });
  }

  /// A case that both runs have and that shows the turn; monitors judge what happens to come by.
  [[nodiscard]] const CaseResult* evidence(const std::string& rule, bool was_decided, bool is_decided_now,
                                           bool of_monitors) const {
    for (const auto& [name, unit] : new_.units(rule)) {
      const auto was = old_.unit(rule, name);
      if (was && is_decided(was) == was_decided && is_decided(unit.verdict) == is_decided_now &&
          (of_monitors || unit.owner->suite != "monitor") && *was != unit.verdict)
        return unit.owner;
    }
    return nullptr;
  }
  [[nodiscard]] const CaseResult* worst_case(const std::string& rule) const {
    const auto& units = new_.units(rule);
    const auto found =
        std::ranges::max_element(units, {}, [](const auto& each) { return each.second.verdict; });
    return found == units.end() ? nullptr : found->second.owner;
  }

  void compare_requirements() {
    for (const auto& [rule, now] : new_.whole()) {
      const auto found = old_.whole().find(rule);
      if (found == old_.whole().end()) {
        out_.only_in_new.push_back(rule);
      } else {
        compare_requirement(rule, found->second, now);
      }
    }
    for (const auto& [rule, was] : old_.whole()) {
      if (!new_.whole().contains(rule)) out_.only_in_old.push_back(rule);
    }
  }

  void compare_requirement(const std::string& rule, std::optional<Verdict> was, std::optional<Verdict> now) {
    // Of a rule that was not decided everywhere, nothing may be decided any more.
    if (is_undecided(was) && is_undecided(now) && !new_.decided(rule)) was = old_.decided(rule);
    if (was == now) return;
    Turn turn{rule, was, now, worst_case(rule)};
    if (is_decided(was) && is_decided(now)) {
      if (*now > *was) {
        // Failures that are known by other cases do not count as turned; a waived one is no cause.
        if (now == Verdict::waived || is_fresh(rule)) out_.worse.push_back(turn);
      } else {
        turn.where = evidence(rule, true, true, true);
        if (turn.where != nullptr) out_.better.push_back(turn);
      }
    } else if (is_decided(was)) {
      if (!is_undecided(now)) turn.where = evidence(rule, true, false, false);
      if (turn.where != nullptr) out_.lost.push_back(turn);
    } else if (is_decided(now)) {
      if (!is_undecided(was)) turn.where = evidence(rule, false, true, false);
      if (turn.where != nullptr) out_.gained.push_back(turn);
    }
  }
  [[nodiscard]] bool is_fresh(const std::string& rule) const {
    return std::ranges::any_of(out_.new_causes, [&](const NewCause& each) {
      return std::ranges::any_of(each.fresh,
                                 [&](const Place& place) { return place.finding->requirement == rule; });
    });
  }

  void add_circumstances() {
    if (before_.tool != after_.tool) out_.circumstances.push_back({"tool", before_.tool, after_.tool});
    if (before_.host != after_.host) out_.circumstances.push_back({"host", before_.host, after_.host});
    auto rest = property_changes(
        before_, after_, {"suite.", "run.", "can.", "simulation.", "capture.", "input.", "dut.description"});
    // It names the reports as well; what of it matters stands in the other properties.
    std::erase_if(rest, [](const auto& each) { return each.name == "run.command"; });
    std::ranges::move(rest, std::back_inserter(out_.circumstances));
    for (const auto& [run, which] : {std::pair(&before_, "old"), std::pair(&after_, "new")}) {
      if (run->aborted)
        out_.remarks.push_back(std::string("the ") + which + " run stopped early: " + *run->aborted);
    }
    const auto seeds = std::ranges::find(out_.circumstances, "run.seed", &ValueChange::name);
    if (seeds != out_.circumstances.end())
      out_.remarks.emplace_back("the seeds differ: cases that were drawn for other objects are not compared");
  }

  const RunResult& before_;
  const RunResult& after_;
  Ledger old_, new_;
  std::vector<Cause> old_causes_;
  std::map<std::pair<std::string, std::string>, Verdict> found_;  ///< the worst finding of rule and case
  Comparison out_;
};

}  // namespace

std::size_t Comparison::undecided() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(lost, [](const Turn& turn) { return is_undecided(turn.after); }));
}

bool Comparison::is_same() const {
  return new_causes.empty() && gone_causes.empty() && worse.empty() && better.empty() && lost.empty() &&
         gained.empty() && observed.empty() && identity.empty() && instances.empty() && times.empty() &&
         std::ranges::all_of(entries, &EntryChange::is_process);
}

Comparison compare(const RunResult& before, const RunResult& after) { return Comparing(before, after).all(); }

int exit_code(const Comparison& comparison, bool strict) {
  const auto is_red = [strict](const NewCause& each) { return strict || each.verdict == Verdict::fail; };
  if (std::ranges::any_of(comparison.new_causes, is_red)) return 1;
  return comparison.undecided() != 0 ? 3 : 0;
}

}  // namespace conform::result
