// SPDX-License-Identifier: Apache-2.0
#include "result/causes.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "result/services.hpp"

namespace conform::result {
namespace {

/// A deviation that shows in this many parts of a device at once is a fault of its own, and not one of each
/// part.
constexpr std::size_t many_parts = 3;
/// What a device does with SDO frames; whatever else is seen, is seen through them.
constexpr int deepest_of_sdo = 3;
/// Behind every rule: what was seen beside.
constexpr int beside = 10;

bool is_monitor(const CaseResult& one) { return one.suite == "monitor"; }

/// Keys that mean the same cause, joined.
class Joined {
 public:
  void join(const std::string& one, const std::string& other) {
    const auto to = root(other);
    parent_[root(one)] = to;
  }
  std::string root(const std::string& key) {
    auto at = parent_.try_emplace(key, key).first;
    while (at->second != at->first) at = parent_.find(at->second);
    return at->first;
  }

 private:
  std::map<std::string, std::string> parent_;
};

/// "OD-OBJ" of "OD-OBJ-07".
std::string family_of(const std::string& requirement) {
  return requirement.substr(0, requirement.rfind('-'));
}

class Grouping {
 public:
  explicit Grouping(const RunResult& run) : run_(run) {
    for (const auto& one : run.cases) {
      for (const auto& judgement : one.judgements) {
        for (const auto& finding : judgement.findings) {
          const auto verdict = std::min(finding.verdict, judgement.verdict);
          if (verdict == Verdict::fail || verdict == Verdict::warn)
            places_.push_back({&one, &finding, verdict});
        }
      }
    }
    for (const auto& place : places_) {
      const auto& finding = *place.finding;
      const auto* service = service_of_requirement(finding.requirement);
      if (service != nullptr) own_rule_broken_.insert(std::string(service->name));
      if (is_counted(place)) parts_with_[finding.deviation].insert(part_of(finding));
    }
    for (const auto& place : places_) keys_.push_back(key_of(place));
    explain_by_lower_layers();
    join_what_never_fails_alone();
  }

  std::vector<Cause> causes() {
    std::map<std::string, Cause> by_key;
    for (std::size_t i = 0; i < places_.size(); ++i)
      by_key[joined_.root(keys_[i])].findings.push_back(places_[i]);
    std::vector<Cause> out;
    for (auto& [key, cause] : by_key) {
      cause.about = key;
      complete(cause);
      out.push_back(std::move(cause));
    }
    std::ranges::stable_sort(out, [](const Cause& one, const Cause& other) {
      const auto weight = [](const Cause& cause) { return cause.cases.size() + cause.resting.size(); };
      if (one.verdict != other.verdict) return one.verdict > other.verdict;
      return weight(one) > weight(other);
    });
    return out;
  }

 private:
  /// The part of the device that a finding is about.
  static std::string part_of(const Finding& finding) {
    if (const auto* service = service_of_requirement(finding.requirement)) return std::string(service->name);
    if (finding.object) return std::string(service_of_object(*finding.object).name);
    return "entries in general";
  }
  /// Whether its deviation says something about a cause that several parts may share.
  static bool is_counted(const Place& place) {
    return !is_monitor(*place.owner) && place.finding->broken_rules.empty() &&
           !place.finding->deviation.empty();
  }
  [[nodiscard]] bool is_shared(const std::string& deviation) const {
    const auto found = parts_with_.find(deviation);
    return found != parts_with_.end() && found->second.size() >= many_parts;
  }

  std::string key_of(const Place& place) {
    const auto& finding = *place.finding;
    // What the deciding frame breaks by itself comes before what a scenario wanted of it.
    if (!is_monitor(*place.owner) && !finding.broken_rules.empty()) {
      const auto name = [](const std::string& rule) {
        const auto* service = service_of_requirement(rule);
        return service != nullptr ? std::string(service->name) : std::string("entries in general");
      };
      const auto key = name(finding.broken_rules.front());
      for (const auto& rule : finding.broken_rules) joined_.join(name(rule), key);
      return key;
    }
    if (is_counted(place) && is_shared(finding.deviation)) return finding.deviation;
    // A rule about entries in general belongs to the part of its entry where that part breaks a rule of its
    // own.
    if (service_of_requirement(finding.requirement) == nullptr &&
        !own_rule_broken_.contains(part_of(finding)))
      return "rules " + family_of(finding.requirement);
    return part_of(finding);
  }

  /// What many parts share and an SDO service shows as well is that service's.
  void explain_by_lower_layers() {
    for (const auto& [deviation, parts] : parts_with_) {
      if (parts.size() < many_parts) continue;
      for (const auto& place : places_) {
        const auto* service = service_of_requirement(place.finding->requirement);
        if (service != nullptr && service->depth <= deepest_of_sdo && place.finding->deviation == deviation)
          joined_.join(std::string(service->name), deviation);
      }
    }
  }

  /// A part that fails only in cases in which another fails as well, or only about objects about which
  /// another fails as well, has no cause of its own: with two faults one of them would show alone somewhere.
  void join_what_never_fails_alone() {
    for (bool changed = true; changed;) {
      changed = false;
      std::map<std::string, std::set<std::string>> cases;
      std::map<std::string, std::set<std::uint16_t>> objects;
      std::set<std::string> without_object;
      for (std::size_t i = 0; i < places_.size(); ++i) {
        const auto key = joined_.root(keys_[i]);
        const auto& place = places_[i];
        cases[key].insert(is_monitor(*place.owner) ? place.finding->during : place.owner->name());
        if (place.finding->object) {
          objects[key].insert(place.finding->object->value());
        } else {
          without_object.insert(key);
        }
      }
      for (const auto& [one, in] : cases) {
        for (const auto& [other, where] : cases) {
          if (one == other) continue;
          const bool same_cases = std::ranges::includes(where, in);
          const bool same_objects =
              !without_object.contains(one) && std::ranges::includes(objects[other], objects[one]);
          if (!same_cases && !same_objects) continue;
          joined_.join(one, other);
          changed = true;
          break;
        }
        if (changed) break;
      }
    }
  }

  /// What explains what: a failure before a warning, nearer to the frame before farther, then the order of
  /// the run. Where all is about one object, its own rules come first; what many parts have in common is
  /// explained by a rule about entries in general rather than by one of each part.
  void complete(Cause& cause) const {
    std::set<std::uint16_t> objects;
    for (const auto& place : cause.findings) {
      if (place.finding->object) objects.insert(place.finding->object->value());
    }
    const bool shared = is_shared(cause.about);
    // A monitor sees the frames that a scenario provoked, too: it explains something only where scenarios
    // could not read a frame because of the rule that it names.
    std::set<std::string> unreadable;
    for (const auto& place : cause.findings)
      unreadable.insert(place.finding->broken_rules.begin(), place.finding->broken_rules.end());
    const auto depth = [&](const Place& place) {
      const auto& finding = *place.finding;
      if (is_monitor(*place.owner) && !unreadable.contains(finding.requirement)) return beside;
      const auto* service = service_of_requirement(finding.requirement);
      if (service == nullptr && shared) return 2;
      const bool own = objects.size() == 1 && service != nullptr && finding.object &&
                       service == &service_of_object(*finding.object);
      return own ? 1 : depth_of_requirement(finding.requirement);
    };
    const auto weight = [&](const Place& place) {
      const auto& finding = *place.finding;
      const auto frame = std::ranges::find_if(finding.evidence, &EvidenceFrame::decisive);
      return std::tuple(place.verdict != Verdict::fail, depth(place),
                        frame == finding.evidence.end() ? finding.frames_seen : frame->capture_index + 1);
    };
    const auto primary = std::ranges::min_element(cause.findings, {}, weight);
    std::rotate(cause.findings.begin(), primary, primary + 1);
    cause.primary = cause.findings.front();
    cause.verdict = cause.primary.verdict;
    std::set<const CaseResult*> owners;
    for (const auto& place : cause.findings) {
      owners.insert(place.owner);
      const auto& requirement = place.finding->requirement;
      if (std::ranges::find(cause.requirements, requirement) == cause.requirements.end())
        cause.requirements.push_back(requirement);
    }
    for (const auto& one : run_.cases) {
      if (owners.contains(&one)) {
        cause.cases.push_back(&one);
      } else if (!one.rests_on.empty() &&
                 std::ranges::find(cause.requirements, one.rests_on) != cause.requirements.end()) {
        cause.resting.push_back(&one);
      }
    }
  }

  const RunResult& run_;
  std::vector<Place> places_;
  std::set<std::string> own_rule_broken_;                    ///< parts of which a rule of their own is broken
  std::map<std::string, std::set<std::string>> parts_with_;  ///< by deviation
  std::vector<std::string> keys_;
  Joined joined_;
};

}  // namespace

std::vector<Cause> causes_of(const RunResult& run) { return Grouping(run).causes(); }

}  // namespace conform::result
