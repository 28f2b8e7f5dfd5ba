// SPDX-License-Identifier: Apache-2.0
// A RunResult as JSON and back, every member of it. The only place that lists the members: one that is new in
// result/run_result.hpp does not compile until it is named here.
#pragma once

#include <nlohmann/json.hpp>

#include "result/run_result.hpp"

namespace conform::result {

using Json = nlohmann::json;

/// Strings that are no UTF-8 (a device may send anything) become {"hex": "..."}.
[[nodiscard]] Json text_json(const std::string& text);
[[nodiscard]] std::string text_of(const Json& json);
[[nodiscard]] std::string hex_text(ByteView bytes);
[[nodiscard]] Bytes hex_value(const std::string& text);

[[nodiscard]] Json to_json(const CaseResult& one);
[[nodiscard]] Json to_json(const EntryFacts& entry);
[[nodiscard]] Json to_json(const RunResult& run);
/// All but the cases.
[[nodiscard]] Json without_cases(const RunResult& run);

// These throw nlohmann's exceptions where the JSON has another shape; what is missing keeps its default.
void from_json(const Json& json, CaseResult& one);
void from_json(const Json& json, RunResult& run);

}  // namespace conform::result
