// SPDX-License-Identifier: Apache-2.0
#include "result/entries.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>

#include "base/text.hpp"
#include "result/relations.hpp"

namespace conform::result {
namespace {

struct Aspect {
  std::string_view requirements, name;
};
/// What rules about entries are about; the first that fits.
constexpr std::array aspects{
    Aspect{"OD-GEN-04 OD-GEN-05 OD-GEN-06 OD-GEN-07 OD-GEN-08 OD-GEN-11 OD-GEN-14 OD-GEN-15 OD-GEN-17 "
           "OD-GEN-18 OD-CAT-*",
           "presence"},
    Aspect{"OD-ACC-* EDS-VSD-04", "access"},
    Aspect{"OD-LEN-* OD-GEN-10 SDO-UPL-01 SDO-UPL-02 SDO-UPL-03 SDO-UPL-04 SDO-UPL-05", "length"},
    Aspect{"OD-OBJ-* OD-GEN-19 OD-TYP-*", "type"},
    Aspect{"OD-RNG-* OD-DSC-04", "limits"},
    Aspect{"OD-DSC-03 EDS-VSD-06", "default"},
    Aspect{"OD-DSC-05 OD-DSC-06 OD-DSC-07 OD-MAP-* EDS-VSD-12", "PDO mapping"},
    Aspect{"OD-*", "rule"},
};

/// None: a rule about services, which its entry only lent itself to.
std::optional<std::string_view> aspect_of(std::string_view requirement) {
  const auto* found = std::ranges::find_if(
      aspects, [&](const Aspect& each) { return is_in(each.requirements, requirement); });
  return found == aspects.end() ? std::nullopt : std::optional(found->name);
}

/// The first entry that the words name with its sub-index: "upload 1018h:01".
std::optional<Multiplexer> entry_in(std::string_view words) {
  constexpr std::size_t digits = 4, size = 8;  // "1018h:01"
  for (auto at = words.find("h:"); at != std::string_view::npos; at = words.find("h:", at + 1)) {
    if (at < digits || at - digits + size > words.size()) continue;
    if (const auto object = parse_multiplexer(words.substr(at - digits, size))) return object;
  }
  return std::nullopt;
}

/// The entry that a case was played for.
std::optional<Multiplexer> entry_of(const CaseResult& one) {
  return one.instance.find(':') == std::string::npos ? std::nullopt : parse_multiplexer(one.instance);
}

void add(JudgedEntry& to, EntryDifference difference) {
  const auto known = std::ranges::find(to.differing, difference.requirement, &EntryDifference::requirement);
  if (known == to.differing.end()) {
    to.differing.push_back(std::move(difference));
  } else if (difference.verdict > known->verdict) {
    *known = std::move(difference);
  }
}

void add_findings(const CaseResult& one, std::map<Multiplexer, JudgedEntry>& out) {
  const auto own = entry_of(one);
  for (const auto& judgement : one.judgements) {
    const auto aspect = aspect_of(judgement.requirement);
    if (!aspect) continue;
    for (const auto& finding : judgement.findings) {
      const auto verdict = std::min(finding.verdict, judgement.verdict);
      if (verdict != Verdict::fail && verdict != Verdict::warn && verdict != Verdict::waived) continue;
      auto object = entry_in(finding.step);
      // A step about another entry, in a case about this one, still tells of this one.
      if (own && (!object || object->index != own->index)) object = own;
      if (object) add(out[*object], {*aspect, judgement.requirement, &one, verdict, finding.actual});
    }
  }
}

/// What the survey saw by itself. That a value is another one than the default is no difference: the device
/// may have been configured.
std::optional<EntryDifference> difference_of(const EntryFacts& entry) {
  if (entry.presence == absent && entry.claimed)
    return EntryDifference{"presence", {}, nullptr, Verdict::fail, entry.refusal};
  if (entry.length && entry.size && *entry.length != *entry.size) {
    return EntryDifference{"length",
                           {},
                           nullptr,
                           Verdict::fail,
                           fmt::format("{} bytes instead of {}", *entry.size, *entry.length)};
  }
  return std::nullopt;
}

}  // namespace

std::map<Multiplexer, JudgedEntry> judged_entries(const RunResult& run) {
  std::map<Multiplexer, JudgedEntry> out;
  for (const auto& one : run.cases) {
    if (one.judgements.empty()) continue;
    if (const auto own = entry_of(one); own && one.verdict != Verdict::not_applicable)
      out[*own].cases.push_back(&one);
    add_findings(one, out);
  }
  for (const auto& entry : run.dictionary) {
    const auto seen = difference_of(entry);
    if (!seen) continue;
    auto& judged = out[entry.object];
    // What a requirement says of it tells more.
    if (std::ranges::find(judged.differing, seen->aspect, &EntryDifference::aspect) == judged.differing.end())
      add(judged, *seen);
  }
  return out;
}

}  // namespace conform::result
