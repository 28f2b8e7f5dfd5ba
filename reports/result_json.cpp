// SPDX-License-Identifier: Apache-2.0
#include "reports/result_json.hpp"

#include <algorithm>
#include <exception>
#include <map>
#include <vector>

#include "reports/cause_lines.hpp"
#include "reports/tally.hpp"
#include "result/causes.hpp"
#include "result/entries.hpp"
#include "result/run_json.hpp"

namespace conform::reports {
namespace {

using result::CaseResult;
using result::Json;
using result::RunResult;
using result::text_json;
using result::Verdict;

constexpr std::string_view opening = "{\n\"canopen_conform_result\":";

Json counts_json(const result::Counts& counts) {
  return {{"pass", counts.pass},
          {"waived", counts.waived},
          {"warn", counts.warn},
          {"fail", counts.fail},
          {"inconclusive", counts.inconclusive},
          {"not_applicable", counts.not_applicable},
          {"error", counts.error}};
}

Json texts_json(const std::vector<std::string>& texts) {
  Json out = Json::array();
  for (const auto& text : texts) out.push_back(text_json(text));
  return out;
}

Json names_of(const std::vector<const CaseResult*>& cases) {
  Json out = Json::array();
  for (const auto* one : cases) out.push_back(text_json(one->name()));
  return out;
}

Json summary_of(const RunResult& run) {
  const AreaTally total = sum(tally_by_area(run));
  auto rules = counts_json(total.counts);
  rules["not judged"] = total.not_judged;
  return {{"exit_code", result::exit_code(run)},
          {"cases", counts_json(run.counts())},
          {"requirements", std::move(rules)},
          {"waived", texts_json(run.waived())}};
}

std::vector<Json> cause_rows(const RunResult& run) {
  std::vector<Json> out;
  for (const auto& cause : result::causes_of(run)) {
    const auto& primary = *cause.primary.finding;
    Json one{{"requirement", text_json(primary.requirement)},
             {"verdict", std::string(to_string(cause.verdict))},
             {"about", text_json(cause.about)},
             {"case", text_json(cause.primary.owner->name())},
             {"step", text_json(primary.step)},
             {"came", text_json(primary.actual)},
             {"why", text_json(primary.reason)},
             {"cases", names_of(cause.cases)},
             {"requirements", texts_json(cause.requirements)}};
    for (const auto* each : likenesses(run, cause)) {
      one["looks_like"].push_back({{"defect", text_json(each->name)},
                                   {"summary", text_json(each->summary)},
                                   {"percent", each->percent}});
    }
    if (!cause.resting.empty()) one["resting"] = names_of(cause.resting);
    out.push_back(std::move(one));
  }
  return out;
}

std::vector<Json> requirement_rows(const RunResult& run) {
  std::map<std::string, Json> cases;
  for (const auto& one : run.cases) {
    for (const auto& judgement : one.judgements)
      cases[judgement.requirement].push_back(text_json(one.name()));
  }
  std::vector<Json> out;
  for (const auto& one : requirement_verdicts(run)) {
    Json row{{"id", text_json(one.id)}};
    if (const auto* info = run.requirement(one.id)) {
      row["clause"] = text_json(info->clause);
      row["level"] = text_json(info->level);
      row["area"] = text_json(info->area);
      row["statement"] = text_json(info->statement);
    }
    row["verdict"] = one.verdict ? Json(std::string(to_string(*one.verdict))) : Json();
    if (const auto found = cases.find(one.id); found != cases.end()) row["cases"] = found->second;
    out.push_back(std::move(row));
  }
  return out;
}

/// Each entry of the dictionary with what differs, and what differs about others.
std::vector<Json> entry_rows(const RunResult& run) {
  const auto judged = result::judged_entries(run);
  std::vector<Json> out;
  for (const auto& entry : run.dictionary) {
    auto row = result::to_json(entry);
    if (const auto found = judged.find(entry.object); found != judged.end()) {
      for (const auto& each : found->second.differing) {
        Json one{{"aspect", each.aspect}, {"verdict", std::string(to_string(each.verdict))}};
        if (!each.requirement.empty()) one["requirement"] = text_json(each.requirement);
        if (each.where != nullptr) one["case"] = text_json(each.where->name());
        if (!each.came.empty()) one["came"] = text_json(each.came);
        row["differs"].push_back(std::move(one));
      }
      if (!found->second.cases.empty()) row["cases"] = names_of(found->second.cases);
    }
    out.push_back(std::move(row));
  }
  return out;
}

/// A list with one element per line.
std::string lines_of(const std::vector<Json>& list) {
  if (list.empty()) return "[]";
  std::string out = "[";
  for (const auto& each : list) out += (out.size() == 1 ? "\n" : ",\n") + each.dump();
  return out + "\n]";
}

}  // namespace

std::string result_json(const RunResult& run) {
  std::string out(opening);
  out += std::to_string(result_version);
  const auto add = [&out](std::string_view name, const std::string& json) {
    out += ",\n\"";
    out += name;
    out += "\":" + json;
  };
  add("summary", summary_of(run).dump());
  add("causes", lines_of(cause_rows(run)));
  add("requirements", lines_of(requirement_rows(run)));
  auto rest = result::without_cases(run);
  rest.erase("requirements");  // said above, with their verdicts
  std::vector<Json> measurements;
  if (const auto found = rest.find("measurements"); found != rest.end()) {
    measurements.assign(found->begin(), found->end());
    rest.erase(found);
  }
  rest.erase("dictionary");  // said below, with what differs
  add("run", rest.dump());
  add("measurements", lines_of(measurements));
  add("dictionary", lines_of(entry_rows(run)));
  std::vector<Json> cases;
  cases.reserve(run.cases.size());
  for (const auto& one : run.cases) {
    auto json = result::to_json(one);
    json["name"] = text_json(one.name());
    cases.push_back(std::move(json));
  }
  add("cases", lines_of(cases));
  return out + "\n}\n";
}

bool is_result_json(std::string_view text) {
  // However another program may have spaced it.
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || text[first] != '{') return false;
  const auto key = text.find_first_not_of(" \t\r\n", first + 1);
  return key != std::string_view::npos && text.substr(key).starts_with("\"canopen_conform_result\"");
}

Result<RunResult> read_result_json(std::string_view text, const std::string& where) {
  if (!is_result_json(text))
    return fail("is not a result: it does not begin with canopen_conform_result", where);
  // The one place where exceptions of the JSON library, and of run_json.cpp, end.
  try {
    auto document = Json::parse(text);
    if (document.at("canopen_conform_result").get<int>() > result_version)
      return fail("is a result that this version cannot read", where, "made by a newer canopen-conform?");
    auto whole = std::move(document.at("run"));
    for (const auto* part : {"requirements", "measurements", "cases"})
      whole[part] = std::move(document.at(part));
    if (document.contains("dictionary")) whole["dictionary"] = std::move(document.at("dictionary"));
    RunResult run;
    result::from_json(whole, run);
    return run;
  } catch (const std::exception& error) {
    return fail(std::string("is not a result: ") + error.what(), where);
  }
}

}  // namespace conform::reports
