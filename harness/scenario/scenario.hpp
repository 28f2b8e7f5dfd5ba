// SPDX-License-Identifier: Apache-2.0
// The model of a scenario file.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "result/run_result.hpp"
#include "steps/step.hpp"

namespace conform::scenario {

/// The tier of a scenario.
using Risk = steps::Tier;

/// The state a scenario needs beyond the usual baseline.
enum class Fresh : std::uint8_t { none, communication, node };

/// One value of for_each: literal expressions, or a row of several names.
struct Row {
  std::string name;  ///< of the instance; stable between runs
  std::map<std::string, std::string, std::less<>>
      texts;  ///< variable -> expression, object or word as written
};

/// for_each: rows written out, or a query over the dictionary ("entries with access ro").
struct ForEach {
  std::string variable;  ///< of a query
  std::string query;     ///< empty: rows
  std::vector<Row> rows;
};

/// An entry a scenario needs and looks for: the first of a query that the device has (and that is long
/// enough).
struct Given {
  std::string name;
  std::string query;  ///< "entries with readable and holding 15.. bytes"
};

struct Scenario {
  std::string id;  ///< "cia301/dictionary/1003-error-history/non-zero-write"
  std::string title;
  std::string about;
  std::string suite;  ///< file path without extension
  result::SourcePosition position;
  std::vector<std::string> cct;
  std::vector<Given> given;  ///< found before `when` is asked; not applicable when one is missing
  std::optional<steps::Condition> when;
  std::optional<ForEach> for_each;
  std::uint64_t sample = 0;  ///< most instances of a query, 0: all
  Risk risk = Risk::read_only;
  Fresh fresh = Fresh::none;
  bool basic = false;           ///< judged first, and even when the device answers no SDO request at all
  bool slow = false;            ///< takes long on a real bus: held back there unless asked for
  steps::Channels establishes;  ///< channels that this scenario judges first, for the others
  steps::Channels rests_on;     ///< channels without which it could not tell anything
  std::vector<steps::Step> steps;
  std::vector<steps::Step> cleanup;
  std::vector<std::string>
      requirements;  ///< ids its expectations decide, sorted; "$name" ones resolved per row
};

/// One file; scenarios share its source for diagnostics.
struct ScenarioFile {
  std::string path;   ///< relative to the suites
  std::string shown;  ///< what messages and reports call it
  std::string title;
  std::string about;
  std::vector<Scenario> scenarios;
};

}  // namespace conform::scenario
