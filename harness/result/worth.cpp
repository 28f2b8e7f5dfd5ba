// SPDX-License-Identifier: Apache-2.0
#include "result/worth.hpp"

#include <exception>
#include <set>

#include "result/case_name.hpp"
#include "result/run_json.hpp"

namespace conform::result {
namespace {

constexpr const char* version_key = "canopen_conform_worth";
constexpr int version = 1;

/// Whole milliseconds, so that the file changes only where a case does.
std::int64_t milliseconds(Duration time) {
  return std::chrono::round<std::chrono::milliseconds>(time).count();
}

}  // namespace

Worths::Worths(std::vector<Worth> cases) : cases_(std::move(cases)) {
  Duration sum{};
  for (std::size_t i = 0; i < cases_.size(); ++i) {
    by_name_.emplace(cases_[i].name, i);
    by_scenario_[std::string(scenario_of(cases_[i].name))].push_back(i);
    sum += cases_[i].takes;
  }
  if (!cases_.empty()) mean_ = sum / static_cast<std::int64_t>(cases_.size());
}

std::vector<std::size_t> Worths::places(std::span<const std::string> names) const {
  std::vector<std::size_t> out(names.size(), cases_.size());
  std::set<std::size_t> taken;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto known = by_name_.find(names[i]);
    if (known == by_name_.end()) continue;
    out[i] = known->second;
    taken.insert(known->second);
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (out[i] != cases_.size()) continue;
    const auto scenario = by_scenario_.find(scenario_of(names[i]));
    if (scenario == by_scenario_.end()) continue;
    for (const auto place : scenario->second) {
      if (!taken.insert(place).second) continue;
      out[i] = place;
      break;
    }
  }
  return out;
}

Duration Worths::takes(std::string_view name) const {
  if (const auto known = by_name_.find(name); known != by_name_.end()) return cases_[known->second].takes;
  const auto scenario = by_scenario_.find(scenario_of(name));
  if (scenario == by_scenario_.end()) return mean_;
  Duration sum{};
  for (const auto place : scenario->second) sum += cases_[place].takes;
  return sum / static_cast<std::int64_t>(scenario->second.size());
}

Duration Pace::of(Duration expected) const {
  // As if so much had gone as expected: one slow case at the start says little.
  constexpr Duration trusted = std::chrono::seconds(1);
  const double factor = std::chrono::duration<double>(needed_ + trusted) / (expected_ + trusted);
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double, Duration::period>(expected) *
                                              factor);
}

std::string worth_file(std::span<const Worth> cases) {
  std::string lines;
  for (const auto& each : cases) {
    Json line{{"case", each.name}, {"ms", milliseconds(each.takes)}};
    if (each.finds > 0) line["finds"] = each.finds;
    lines += (lines.empty() ? "" : ",\n") + line.dump();
  }
  return "{\"" + std::string(version_key) + "\":" + std::to_string(version) + ",\n\"cases\":[\n" + lines +
         "\n]}\n";
}

Result<Worths> read_worths(std::string_view text, const std::string& where) {
  constexpr auto hint = "'canopen-conform selftest --patterns FILE' makes it";
  // Longer than any case: a sum of them stays a time.
  constexpr std::int64_t longest_ms = 24L * 3600 * 1000;
  std::vector<Worth> out;
  // The one place where exceptions of the JSON library end.
  try {
    const auto json = Json::parse(text);
    if (json.at(version_key).get<int>() != version)
      return fail("the worth of cases, of another version than this program knows", where, hint);
    for (const auto& each : json.at("cases")) {
      Worth one;
      each.at("case").get_to(one.name);
      const auto ms = each.at("ms").get<std::int64_t>();
      if (ms < 0 || ms > longest_ms)
        return fail("case " + std::to_string(out.size() + 1) + " takes " + std::to_string(ms) + " ms", where,
                    hint);
      one.takes = std::chrono::milliseconds(ms);
      one.finds = each.value("finds", std::size_t{0});
      out.push_back(std::move(one));
    }
  } catch (const std::exception& error) {
    return fail("case " + std::to_string(out.size() + 1) + ": " + error.what(), where, hint);
  }
  return Worths(std::move(out));
}

}  // namespace conform::result
