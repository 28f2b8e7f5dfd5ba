// SPDX-License-Identifier: Apache-2.0
#include "reports/tally.hpp"

#include <algorithm>
#include <functional>
#include <map>

namespace conform::reports {

using result::CaseResult;
using result::Counts;
using result::RunResult;
using result::Verdict;

std::vector<AreaTally> tally_by_area(const RunResult& run) {
  std::vector<AreaTally> rows;
  for (const RequirementVerdict& one : requirement_verdicts(run)) {
    const result::RequirementInfo* info = run.requirement(one.id);
    const std::string area = info == nullptr      ? "(not in the catalogue)"
                             : info->area.empty() ? "(no area)"
                                                  : info->area;
    auto row = std::ranges::find(rows, area, &AreaTally::area);
    if (row == rows.end()) row = rows.insert(rows.end(), {area, {}, 0});
    if (one.verdict) {
      row->counts.add(*one.verdict);
    } else {
      ++row->not_judged;
    }
  }
  return rows;
}

AreaTally sum(const std::vector<AreaTally>& rows) {
  AreaTally total{"total", {}, 0};
  for (const AreaTally& row : rows) {
    total.counts += row.counts;
    total.not_judged += row.not_judged;
  }
  return total;
}

namespace {

/// A reason without its numbers, objects and values.
std::string shape_of(std::string_view reason) {
  std::string out;
  for (std::size_t i = 0; i < reason.size();) {
    std::size_t end = i;
    const auto is_word = [](char c) {
      return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == ':';
    };
    while (end < reason.size() && is_word(reason[end])) ++end;
    if (end == i) {
      out += reason[i++];
      continue;
    }
    const auto word = reason.substr(i, end - i);
    // "1401h:00", "0602", "17", "C000": a digit first, or nothing but hex digits in capitals.
    const bool number = std::ranges::all_of(word, [](char c) {
      return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'F') || c == 'h' || c == ':';
    });
    out += number && word != "h" ? std::string_view("#") : word;
    i = end;
  }
  return out;
}

}  // namespace

std::vector<WantTally> tally_wants(const RunResult& run) {
  std::vector<WantTally> all;
  for (const CaseResult& one : run.cases) {
    if (one.verdict != Verdict::not_applicable) continue;
    for (const result::Want& want : one.wants) {
      auto known = std::ranges::find(all, want, &WantTally::want);
      if (known == all.end()) known = all.insert(all.end(), {want, 0});
      ++known->cases;
    }
  }
  std::ranges::stable_sort(all, std::greater{}, &WantTally::cases);
  return all;
}

std::vector<ReasonGroup> group_by_reason(const RunResult& run, Verdict verdict) {
  std::vector<ReasonGroup> groups;
  std::map<std::string, std::size_t> by_shape;
  for (const CaseResult& one : run.cases) {
    if (one.verdict != verdict) continue;
    auto shape = verdict == Verdict::not_applicable ? shape_of(one.reason) : one.reason;
    const auto [place, fresh] = by_shape.emplace(std::move(shape), groups.size());
    if (fresh) groups.push_back({one.reason, false, {}});
    auto& group = groups[place->second];
    group.varies = group.varies || group.reason != one.reason;
    group.cases.push_back(&one);
  }
  return groups;
}

}  // namespace conform::reports
