// SPDX-License-Identifier: Apache-2.0
#include "result/causes.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "result/explanations.hpp"
#include "result/relations.hpp"
#include "result/services.hpp"

namespace conform::result {
namespace {

constexpr std::size_t few_objects = 2;
/// Behind every rule: what was seen beside.
constexpr int beside = 10;

/// How the server bears states, resets and load: seen through transfers.
constexpr std::string_view sdo_server =
    "SDO-GEN-13 SDO-GEN-14 SDO-GEN-15 SDO-GEN-16 SDO-GEN-17 SDO-GEN-18 SDO-GEN-19 SDO-GEN-20";
constexpr int depth_of_sdo_server = 5;

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

/// The frame that decided, or else the one after which it was decided; counted from 1.
std::size_t decided_at(const Finding& finding) {
  const auto* frame = decisive_frame(finding);
  return frame == nullptr ? finding.frames_seen : frame->capture_index + 1;
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
    explanations_.emplace(places_);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const auto& place = places_[i];
      const auto& finding = *place.finding;
      const auto* service = service_of_requirement(finding.requirement);
      if (service != nullptr) own_rule_broken_.insert(std::string(service->name));
      if (is_counted(place) && explanations_->steps(i) == 0 && !is_told_by_a_service(place))
        parts_with_[finding.deviation].insert(place.part());
    }
    for (std::size_t i = 0; i < places_.size(); ++i) keys_.push_back(key_of(places_[explanations_->root(i)]));
    explain_by_lower_layers();
    join_transfers();
    join_kin();
    join_general_rules();
    join_what_never_fails_alone();
  }

  std::vector<Cause> causes() {
    std::map<std::string, std::vector<std::size_t>> members;
    for (std::size_t i = 0; i < places_.size(); ++i) members[joined_.root(keys_[i])].push_back(i);
    std::vector<Cause> out;
    for (const auto& [key, places] : members) {
      Cause cause;
      const auto primary = primary_of(key, places);
      cause.about = title_of(places_[primary]);
      put_first(primary, places, cause);
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
  /// Whether its deviation says something about a cause that several parts may share.
  static bool is_counted(const Place& place) {
    const auto& deviation = place.finding->deviation;
    // That a heartbeat, an EMCY or a PDO did not come has as many reasons as there are services.
    const bool says_little = deviation.starts_with("no ") && deviation != "no answer";
    return !place.is_monitor() && place.finding->broken_rules.empty() && !deviation.empty() && !says_little;
  }
  /// A rule about entries in general, where the case shows the same of a service as well: its entry was lent.
  [[nodiscard]] bool is_told_by_a_service(const Place& place) const {
    if (service_of_requirement(place.finding->requirement) != nullptr) return false;
    return std::ranges::any_of(places_, [&](const Place& other) {
      return other.owner == place.owner && other.finding->deviation == place.finding->deviation &&
             service_of_requirement(other.finding->requirement) != nullptr;
    });
  }
  [[nodiscard]] bool is_shared(const std::string& deviation) const {
    const auto found = parts_with_.find(deviation);
    return found != parts_with_.end() && found->second.size() >= many_parts;
  }

  [[nodiscard]] std::string key_of(const Place& place) const {
    const auto& finding = *place.finding;
    if (is_counted(place) && is_shared(finding.deviation)) return finding.deviation;
    // A rule about entries in general belongs to the part of its entry where that part breaks a rule of its
    // own.
    if (service_of_requirement(finding.requirement) == nullptr && !own_rule_broken_.contains(place.part()))
      return "rules " + family_of(finding.requirement);
    return place.part();
  }

  /// What a reader calls it: what many parts have in common, or else what the broken rule is about.
  [[nodiscard]] std::string title_of(const Place& place) const {
    const auto& finding = *place.finding;
    const auto* info = run_.requirement(finding.requirement);
    const bool is_common = is_counted(place) && is_shared(finding.deviation);
    return is_common || info == nullptr || info->area.empty() ? key_of(place) : info->area;
  }

  /// What many parts share and an SDO service shows as well is that service's.
  void explain_by_lower_layers() {
    for (const auto& [deviation, parts] : parts_with_) {
      if (parts.size() < many_parts) continue;
      for (std::size_t i = 0; i < places_.size(); ++i) {
        if (explanations_->steps(i) != 0) continue;
        const auto& place = places_[i];
        const auto* service = service_of_requirement(place.finding->requirement);
        if (service != nullptr && service->depth <= deepest_of_sdo && place.finding->deviation == deviation)
          joined_.join(std::string(service->name), deviation);
      }
    }
  }

  /// What one transfer service answers wrongly and another one answers as well: they have one server.
  void join_transfers() {
    std::map<std::string, std::size_t> first;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const auto& finding = *places_[i].finding;
      const auto* service = service_of_requirement(finding.requirement);
      const bool counts = is_counted(places_[i]) && finding.deviation != "no answer" &&
                          finding.deviation != "not what was written" &&
                          finding.deviation != "protocol violation";
      if (!counts || service == nullptr || service->depth > deepest_of_sdo || explanations_->steps(i) != 0)
        continue;
      const auto other = first.try_emplace(finding.deviation, i).first->second;
      joined_.join(keys_[i], keys_[other]);
    }
  }

  /// Rules that say the same of several services, where they are broken in the same way as far as is known.
  void join_kin() {
    for (const auto rules : kin()) {
      std::optional<std::size_t> first;
      for (std::size_t i = 0; i < places_.size(); ++i) {
        const auto& finding = *places_[i].finding;
        if (!is_in(rules, finding.requirement)) continue;
        if (first) {
          const auto& other = places_[*first].finding->deviation;
          // What something else explains is alike only where the same was seen.
          const bool explained = explanations_->steps(i) != 0 || explanations_->steps(*first) != 0;
          const bool known = !finding.deviation.empty() && !other.empty();
          if ((known || explained) && !(known && finding.deviation == other)) continue;
          joined_.join(keys_[i], keys_[*first]);
        }
        first = i;
      }
    }
  }

  /// A rule about entries in general that many parts break is one fault, whatever each of them answers.
  void join_general_rules() {
    std::map<std::string, std::vector<std::size_t>> general;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const auto& requirement = places_[i].finding->requirement;
      if (service_of_requirement(requirement) == nullptr && explanations_->steps(i) == 0)
        general[requirement].push_back(i);
    }
    for (const auto& [requirement, members] : general) {
      std::set<std::string> parts;
      for (const auto i : members) parts.insert(places_[i].part());
      if (parts.size() < many_parts) continue;
      for (const auto i : members) joined_.join(keys_[i], keys_[members.front()]);
    }
  }

  /// Where the findings of one key show.
  struct Footprint {
    /// With the frame that decided first; 0 where a monitor did: it looks at frames, not at what they were
    /// sent for.
    std::map<std::string, std::size_t> cases;
    std::set<std::uint16_t> objects;
    bool without_object = false;
    bool is_sdo = false;         ///< a rule of an SDO service is among them
    bool has_own_rules = false;  ///< one of another service
  };
  [[nodiscard]] std::map<std::string, Footprint> footprints() {
    std::map<std::string, Footprint> out;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const auto& place = places_[i];
      auto& one = out[joined_.root(keys_[i])];
      const auto at = place.is_monitor() ? 0 : decided_at(*place.finding);
      const auto& name = place.is_monitor() ? place.finding->during : place.owner->name();
      auto& first = one.cases.try_emplace(name, at).first->second;
      first = std::min(first, at);
      const auto object = place.finding->object;
      const auto* service = service_of_requirement(place.finding->requirement);
      const bool deep = service != nullptr && service->depth > deepest_of_sdo;
      if (service != nullptr) (deep ? one.has_own_rules : one.is_sdo) = true;
      // Entries of other parts lend themselves to tests of anything: they are common ground of SDO and
      // dictionary only.
      const bool lent = deep && object && service != &service_of_object(*object);
      if (object && !lent && is_seen_through_sdo(*place.finding)) {
        one.objects.insert(object->value());
      } else {
        one.without_object = true;
      }
    }
    return out;
  }

  static bool shows_first(const Footprint& other, const Footprint& one) {
    return std::ranges::all_of(one.cases, [&](const auto& each) {
      const auto found = other.cases.find(each.first);
      return found != other.cases.end() && (each.second == 0 || found->second <= each.second);
    });
  }
  /// Two services that are tried with the same objects have nothing else in common: only where another one's
  /// few objects are all that was tried is it about them.
  static bool is_about_the_objects_of(const Footprint& one, const Footprint& other) {
    if (one.without_object || !std::ranges::includes(other.objects, one.objects)) return false;
    if (!one.has_own_rules && !one.is_sdo) return true;
    return other.has_own_rules && !other.is_sdo && other.objects.size() <= few_objects;
  }

  /// A part that fails only in cases in which another has failed before, or only about objects about which
  /// another fails as well, has no cause of its own: with two faults one of them would show alone somewhere.
  void join_what_never_fails_alone() {
    const auto join_one = [this] {
      const auto all = footprints();
      for (const auto& [key, one] : all) {
        for (const auto& [other_key, other] : all) {
          if (key == other_key || !(shows_first(other, one) || is_about_the_objects_of(one, other))) continue;
          joined_.join(key, other_key);
          return true;
        }
      }
      return false;
    };
    while (join_one()) continue;
  }

  /// What explains what: a fault before what rests on it, nearer to the frame before farther, then the order
  /// of the run. Where all is about one object, its own rules come first; what many parts have in common is
  /// explained by a rule about entries in general rather than by one of each part.
  [[nodiscard]] std::size_t primary_of(const std::string& key,
                                       const std::vector<std::size_t>& members) const {
    std::set<std::uint16_t> objects;
    // A monitor sees the frames that a scenario provoked, too: it explains something only where scenarios
    // could not read a frame because of the rule that it names.
    std::set<std::string> unreadable;
    for (const auto i : members) {
      const auto& finding = *places_[i].finding;
      if (finding.object) objects.insert(finding.object->value());
      unreadable.insert(finding.broken_rules.begin(), finding.broken_rules.end());
    }
    const bool shared = is_shared(key) || std::ranges::any_of(members, [this](std::size_t i) {
                          return is_counted(places_[i]) && is_shared(places_[i].finding->deviation);
                        });
    const auto depth = [&](const Place& place) {
      const auto& finding = *place.finding;
      if (place.is_monitor() && !unreadable.contains(finding.requirement)) return beside;
      const auto* service = service_of_requirement(finding.requirement);
      constexpr int general = 2;
      if (service == nullptr && shared) return general;
      // An object of a deep service is an object among others.
      if (shared && finding.requirement.starts_with("OD-"))
        return std::max(depth_of_requirement(finding.requirement), general + 1);
      if (is_in(sdo_server, finding.requirement)) return depth_of_sdo_server;
      const bool own = objects.size() == 1 && service != nullptr && finding.object &&
                       service == &service_of_object(*finding.object);
      return own ? 1 : depth_of_requirement(finding.requirement);
    };
    const auto weight = [&](std::size_t i) {
      const auto& place = places_[i];
      const auto& finding = *place.finding;
      const auto deep = depth(place);
      return std::tuple(place.formless, explanations_->steps(i), deep == beside,
                        place.verdict != Verdict::fail, deep, decided_at(finding));
    };
    return *std::ranges::min_element(members, {}, weight);
  }

  void put_first(std::size_t primary, const std::vector<std::size_t>& members, Cause& cause) const {
    cause.findings.push_back(places_[primary]);
    for (const auto i : members) {
      if (i != primary) cause.findings.push_back(places_[i]);
    }
  }

  void complete(Cause& cause) const {
    cause.primary = cause.findings.front();
    cause.verdict = cause.primary.verdict;
    for (const auto& place : cause.findings) cause.verdict = std::max(cause.verdict, place.verdict);
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
  std::optional<Explanations> explanations_;
  std::set<std::string> own_rule_broken_;                    ///< parts of which a rule of their own is broken
  std::map<std::string, std::set<std::string>> parts_with_;  ///< by deviation
  std::vector<std::string> keys_;
  Joined joined_;
};

}  // namespace

std::vector<Cause> causes_of(const RunResult& run) { return Grouping(run).causes(); }

}  // namespace conform::result
