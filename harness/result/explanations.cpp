// SPDX-License-Identifier: Apache-2.0
#include "result/explanations.hpp"

#include <algorithm>
#include <array>

#include "result/relations.hpp"
#include "result/services.hpp"

namespace conform::result {
namespace {

/// Keeps nobody from reading a frame.
constexpr std::string_view reserved_bytes = "SDO-GEN-05";

bool is_sdo(std::string_view requirement) { return requirement.starts_with("SDO-"); }

/// Whether it was decided by an abort of the server, of whatever content.
bool is_abort(const Finding& finding) {
  if (finding.deviation.starts_with("abort")) return true;
  const auto* frame = decisive_frame(finding);
  return frame != nullptr && frame->frame.id > 0x580 && frame->frame.id < 0x600 && frame->frame.size() > 0 &&
         frame->frame.data[0] == 0x80;
}

bool contains(const std::vector<std::string>& list, const std::string& one) {
  return std::ranges::find(list, one) != list.end();
}

}  // namespace

const EvidenceFrame* decisive_frame(const Finding& finding) {
  const auto found = std::ranges::find_if(finding.evidence, &EvidenceFrame::decisive);
  return found == finding.evidence.end() ? nullptr : &*found;
}

bool is_seen_through_sdo(const Finding& finding) {
  // Where no answer came, the request decided.
  if (const auto* frame = decisive_frame(finding)) return frame->frame.id > 0x580 && frame->frame.id < 0x680;
  return finding.object && finding.deviation == "no answer";
}

std::string Place::part() const {
  if (const auto* service = service_of_requirement(finding->requirement)) return std::string(service->name);
  if (finding->object) return std::string(service_of_object(*finding->object).name);
  return "entries in general";
}

Explanations::Explanations(std::vector<Place>& places) : places_(places) {
  std::set<std::string> monitored;
  for (const auto& place : places) {
    if (place.is_monitor()) monitored.insert(place.finding->requirement);
    monitored.insert(place.finding->broken_rules.begin(), place.finding->broken_rules.end());
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    auto& place = places[i];
    const auto& finding = *place.finding;
    const auto& requirement = finding.requirement;
    place.formless = is_about_form(requirement) && !place.is_monitor() && !monitored.contains(requirement) &&
                     !contains(finding.broken_rules, requirement);
    broken_[requirement].push_back(i);
    if (!place.formless) parts_[requirement].insert(place.part());
    const auto object = object_of_requirement(requirement);
    if (object && !contains(own_rules_[*object], requirement)) own_rules_[*object].push_back(requirement);
  }
  note_single_objects();
  for (const auto& place : places) {
    const auto rule = explained_by(place);
    const auto found = rule ? broken_.find(*rule) : broken_.end();
    reason_.push_back(found == broken_.end() ? std::nullopt : std::optional(found->second.front()));
  }
  // Of several findings about the rule, one that is a fault itself.
  for (auto& reason : reason_) {
    if (!reason) continue;
    const auto& all = broken_[places_[*reason].finding->requirement];
    const auto fault = std::ranges::find_if(all, [this](std::size_t i) { return !reason_[i]; });
    if (fault != all.end()) reason = *fault;
  }
}

std::vector<std::size_t> Explanations::chain(std::size_t place) const {
  std::vector<std::size_t> out{place};
  while (const auto& next = reason_[out.back()]) {
    if (std::ranges::find(out, *next) != out.end()) break;
    out.push_back(*next);
  }
  return out;
}

void Explanations::note_single_objects() {
  for (const auto& [requirement, all] : broken_) {
    const auto* service = service_of_requirement(requirement);
    if (service == nullptr) continue;
    std::set<std::optional<Index>> objects;
    for (const auto i : all) {
      if (!places_[i].is_monitor()) objects.insert(places_[i].finding->object);
    }
    if (objects.size() != 1 || !*objects.begin()) continue;
    const auto object = **objects.begin();
    const auto own = own_rules_.find(object);
    if (own == own_rules_.end()) continue;
    const auto& first = *std::ranges::min_element(own->second);
    const bool of_transfers = is_sdo(requirement) && service->depth <= deepest_of_sdo;
    // Other rules are tried with an entry that every device has: they cannot be where it is not there.
    if (!of_transfers && (service == &service_of_object(object) || !first.ends_with("-01"))) continue;
    // The basic ones are tried with one object each; with an SDO server that breaks them, many objects fail.
    if (is_in(grounds_of_any_answer(), requirement) && own_rules_.size() > 2) continue;
    single_[requirement] = first;
  }
}

/// Whether it shows in answers of the same kind: one that confirms a download says nothing of uploads, and
/// one of two bytes nothing of those of three. What was read wrongly may be refused, for its length or its
/// value.
bool Explanations::shows_in_such_an_answer(std::string_view requirement, const Finding& finding) const {
  constexpr int download_confirmed = 3, upload_initiated = 2;
  constexpr auto not_for_content = std::to_array<std::string_view>(
      {"abort 0601", "abort 0602", "abort 0609 0011h", "abort 0503", "abort 0504"});
  const auto command = [](const Finding& of) -> std::optional<int> {
    const auto* frame = decisive_frame(of);
    if (frame == nullptr || frame->frame.size() == 0) return std::nullopt;
    return frame->frame.data[0];
  };
  const auto found = broken_.find(requirement);
  const auto shows_in = [&](const auto& alike) {
    return found != broken_.end() &&
           std::ranges::any_of(found->second, [&](std::size_t i) { return alike(*places_[i].finding); });
  };
  const bool refused = std::ranges::any_of(
      not_for_content, [&](std::string_view each) { return finding.deviation.starts_with(each); });
  if (refused && requirement.starts_with("SDO-UPL"))
    return shows_in([&](const Finding& other) { return other.deviation == finding.deviation; });
  const auto seen = command(finding);
  const bool read = seen && (*seen >> 5 == download_confirmed || *seen >> 5 == upload_initiated) &&
                    finding.deviation != "protocol violation";
  return !read || shows_in([&](const Finding& other) { return !command(other) || command(other) == seen; });
}

bool Explanations::explains(std::string_view ground, const Place& place) const {
  const auto& requirement = place.finding->requirement;
  const auto found = parts_.find(ground);
  if (found == parts_.end() || ground == requirement) return false;
  // One entry that breaks a rule about entries in general says nothing about another part of the device, and
  // a part of the device nothing about an entry of another one.
  const auto* from = service_of_requirement(ground);
  const auto* to = service_of_requirement(requirement);
  const auto& object = place.finding->object;
  if (from == nullptr) {
    return is_sdo(requirement) || to == nullptr || found->second.size() >= many_parts;
  }
  const bool of_entries = requirement.starts_with("OD-") || requirement.starts_with("EDS-");
  return to != nullptr || !of_entries || !object || from->depth <= deepest_of_sdo ||
         from == &service_of_object(*object);
}

std::optional<std::string> Explanations::first_that_explains(std::string_view grounds,
                                                             const Place& place) const {
  for (const auto pattern : words(grounds)) {
    for (const auto& [requirement, all] : broken_) {
      if (fits(pattern, requirement) && explains(requirement, place)) return requirement;
    }
  }
  return std::nullopt;
}

std::optional<std::string> Explanations::by_relation(const Place& place) const {
  const auto& requirement = place.finding->requirement;
  for (const auto& relation : grounds()) {
    if (!is_in(relation.rules, requirement)) continue;
    if (auto found = first_that_explains(relation.grounds, place)) return found;
  }
  for (const auto rules : kin()) {
    const auto ids = words(rules);
    const auto self = std::ranges::find(ids, std::string_view(requirement));
    if (self == ids.end()) continue;
    for (auto before = ids.begin(); before != self; ++before) {
      if (explains(*before, place)) return std::string(*before);
    }
  }
  return std::nullopt;
}

/// Whether no other rule explains that this one is broken.
bool Explanations::is_fault(std::string_view requirement) const {
  const auto found = broken_.find(requirement);
  return found != broken_.end() && !by_relation(places_[found->second.front()]);
}

/// An SDO server that answers wrongly, or not at all, keeps from seeing whatever is seen through it.
std::optional<std::string> Explanations::by_the_answer(const Place& place) const {
  const auto& finding = *place.finding;
  const auto any = grounds_of_any_answer();
  const auto silence = grounds_of_any_silence();
  const auto& requirement = finding.requirement;
  if (contains(finding.broken_rules, requirement)) return std::nullopt;
  const bool silent = finding.deviation == "no answer" || finding.deviation == "abort 0504 0000h";
  const auto aborts = is_abort(finding) ? grounds_of_any_abort() : std::string_view();
  const auto stored =
      finding.deviation == "not what was written" ? grounds_of_what_is_stored() : std::string_view();
  // A rule about the form of any answer spoils only the answers that break it.
  const bool well_formed = finding.deviation.starts_with("abort") && finding.broken_rules.empty();
  for (const auto list : {any, silent ? silence : std::string_view(), aborts, stored}) {
    for (const auto ground : words(list)) {
      if (ground == requirement) break;
      if (well_formed && is_about_form(ground) && list == any) continue;
      if (list == any && !shows_in_such_an_answer(ground, finding)) continue;
      if (!single_.contains(ground) && explains(ground, place) && is_fault(ground))
        return std::string(ground);
    }
  }
  return std::nullopt;
}

/// What goes wrong with an entry as a transfer goes wrong by its own rules, and a download that was read back
/// by a transfer that does.
std::optional<std::string> Explanations::by_the_transfer(const Place& place) const {
  constexpr std::string_view uploads =
      "SDO-UPL-01 SDO-UPL-02 SDO-UPL-03 SDO-UPL-04 SDO-UPL-05 SDO-UPL-06 SDO-SUP-01 SDO-SUP-02 SDO-SUP-04 "
      "SDO-SUP-16";
  constexpr std::string_view transfers =
      "SDO-UPL-01 SDO-UPL-02 SDO-UPL-03 SDO-UPL-04 SDO-UPL-05 SDO-UPL-06 SDO-DNL-01 SDO-DNL-02 SDO-DNL-03 "
      "SDO-DNL-04 SDO-DNL-05 SDO-DNL-06 SDO-SUP-01 SDO-SUP-02 SDO-SUP-04 SDO-SUP-16 SDO-SDN-01 SDO-SDN-03 "
      "SDO-SDN-11 SDO-BUP-01 SDO-BDN-01";
  const auto& finding = *place.finding;
  const auto* service = service_of_requirement(finding.requirement);
  const bool read_back =
      (finding.requirement.starts_with("SDO-BDN") || finding.requirement.starts_with("SDO-SDN")) &&
      finding.step.starts_with("upload");
  const bool unreadable = read_back && finding.deviation == "protocol violation";
  if (!read_back && service != nullptr && service->depth <= deepest_of_sdo) return std::nullopt;
  for (const auto& other : places_) {
    const auto& ground = *other.finding;
    if (other.is_monitor() || single_.contains(ground.requirement)) continue;
    if (!unreadable && ground.deviation != finding.deviation) continue;
    const bool same_object = ground.object && ground.object == finding.object;
    const bool is_content =
        !unreadable && (ground.deviation.empty() || ground.deviation == "not what was written" ||
                        ground.deviation == "a refused value is stored");
    if (is_content && !same_object) continue;
    if (is_in(read_back ? uploads : transfers, ground.requirement) && explains(ground.requirement, place))
      return ground.requirement;
  }
  return std::nullopt;
}

/// What a scenario has met that blames the form of a frame: the same deviation elsewhere, or else whatever is
/// wrong with the SDO server or with the object.
std::optional<std::string> Explanations::met_in_its_place(const Place& place) const {
  std::optional<std::string> alike, of_sdo, of_object;
  for (const auto& other : places_) {
    const auto& requirement = other.finding->requirement;
    if (other.formless || other.is_monitor() || requirement == place.finding->requirement) continue;
    if (other.finding->deviation == place.finding->deviation) {
      if (other.finding->object == place.finding->object) return requirement;
      if (!alike && !other.finding->deviation.empty()) alike = requirement;
    }
    if (!of_sdo && is_sdo(requirement)) of_sdo = requirement;
    if (!of_object && other.finding->object == place.finding->object) of_object = requirement;
  }
  if (alike) return alike;
  return of_sdo ? of_sdo : of_object;
}

std::optional<std::string> Explanations::explained_by(const Place& place) const {
  const auto& finding = *place.finding;
  const auto& requirement = finding.requirement;
  if (!finding.broken_rules.empty() && !contains(finding.broken_rules, requirement)) {
    for (const auto& rule : finding.broken_rules) {
      if (rule != reserved_bytes && broken_.contains(rule)) return rule;
    }
  }
  if (place.formless) return met_in_its_place(place);
  if (auto found = by_relation(place)) return found;
  if (const auto own = single_.find(requirement); own != single_.end()) return own->second;
  if (place.is_monitor()) return std::nullopt;
  const bool through_sdo = is_seen_through_sdo(finding);
  if (through_sdo) {
    if (auto found = by_the_answer(place)) return found;
  }
  // A rule about entries in general, where the object breaks one of its own; unless many do.
  const auto parts = parts_.find(requirement);
  const bool many = parts != parts_.end() && parts->second.size() >= many_parts;
  if (service_of_requirement(requirement) == nullptr && finding.object && !many) {
    const auto own = own_rules_.find(*finding.object);
    if (own != own_rules_.end()) {
      for (const auto& rule : own->second) {
        if (explains(rule, place)) return rule;
      }
    }
  }
  return through_sdo ? by_the_transfer(place) : std::nullopt;
}

}  // namespace conform::result
