// SPDX-License-Identifier: Apache-2.0
#include "result/pattern_file.hpp"

#include <exception>
#include <map>

#include "result/run_json.hpp"

namespace conform::result {
namespace {

constexpr const char* version_key = "canopen_conform_patterns";
constexpr int version = 1;

/// By deviation, because many rules are broken in the same way: {"no answer": ["SDO-GEN-01", ...]}.
Json signs_json(const Footprint& footprint) {
  Json out = Json::object();
  for (const auto& [requirement, deviation] : footprint.signs) out[deviation].push_back(requirement);
  return out;
}

Pattern pattern_of(const Json& json) {
  Pattern out;
  json.at("name").get_to(out.name);
  json.at("summary").get_to(out.summary);
  json.at("lead").get_to(out.footprint.lead);
  for (const auto& [deviation, requirements] : json.at("shows").items()) {
    for (const auto& requirement : requirements)
      out.footprint.signs.emplace(requirement.get<std::string>(), deviation);
  }
  if (json.contains("in")) json.at("in").get_to(out.footprint.cases);
  return out;
}

}  // namespace

std::string pattern_file(std::span<const Pattern> patterns) {
  std::string lines;
  for (const auto& each : patterns) {
    Json line{{"name", each.name},
              {"summary", each.summary},
              {"lead", each.footprint.lead},
              {"shows", signs_json(each.footprint)}};
    if (!each.footprint.cases.empty()) line["in"] = each.footprint.cases;
    lines += (lines.empty() ? "" : ",\n") + line.dump();
  }
  return "{\"" + std::string(version_key) + "\":" + std::to_string(version) + ",\n\"patterns\":[\n" + lines +
         "\n]}\n";
}

Result<std::vector<Pattern>> read_patterns(std::string_view text, const std::string& where) {
  std::vector<Pattern> out;
  // The one place where exceptions of the JSON library end.
  try {
    const auto json = Json::parse(text);
    if (json.at(version_key).get<int>() != version)
      return fail("patterns of another version than this program knows", where,
                  "'canopen-conform selftest --patterns FILE' makes them");
    for (const auto& each : json.at("patterns")) {
      try {
        out.push_back(pattern_of(each));
      } catch (const std::exception& error) {
        return fail("pattern " + std::to_string(out.size() + 1) + " is none: " + error.what(), where);
      }
    }
  } catch (const std::exception& error) {
    return fail(std::string("is no file of patterns: ") + error.what(), where,
                "'canopen-conform selftest --patterns FILE' makes them");
  }
  return out;
}

}  // namespace conform::result
