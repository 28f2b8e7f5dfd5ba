// SPDX-License-Identifier: Apache-2.0
// result.json: all that a run found, as one document for other programs, and for `report` and `compare`
// later. Its shape is schema/result.schema.json; the version changes when a reader of the older one would be
// misled.
#pragma once

#include <string>
#include <string_view>

#include "base/error.hpp"
#include "result/run_result.hpp"

namespace conform::reports {

inline constexpr int result_version = 1;

/// One line per case, requirement, cause and measurement, so that two documents can be compared line by line.
/// What follows from the cases (verdict, counts, causes, requirements with their verdicts) is said as well: a
/// reader needs no rule of ours. Times are nanoseconds of the bus, bytes hexadecimal, and a text that is no
/// UTF-8 is {"hex": "..."}.
[[nodiscard]] std::string result_json(const result::RunResult& run);

/// Whether the text begins as such a document; a journal does not.
[[nodiscard]] bool is_result_json(std::string_view text);
/// Error: no such document, or one of a later version; `where` names it.
[[nodiscard]] Result<result::RunResult> read_result_json(std::string_view text, const std::string& where);

}  // namespace conform::reports
