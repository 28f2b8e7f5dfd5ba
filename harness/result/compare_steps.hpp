// SPDX-License-Identifier: Apache-2.0
// How a comparison reads the words of a step and of what came of it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

#include "base/strong.hpp"
#include "result/run_result.hpp"

namespace conform::result {

/// A device was asked and answered: passed, waived, warned or failed.
[[nodiscard]] bool is_decided(Verdict verdict);

/// Entries that a device changes by itself: errors, clocks, the reply of a command, the state of a store.
[[nodiscard]] bool is_restless(Index index);
/// Whether a condition asked for such an entry: it held or not by what had happened before.
[[nodiscard]] bool tells_of_restless(const CaseResult& one);
/// "abort 0602 0000h ...": there or not there is no matter of what had happened before.
[[nodiscard]] bool tells_of_absence(std::string_view kind);

/// What kind of answer it was, with what is the same in every run: an abort code, an error code. none: it
/// tells of times, counts or values of the process only.
[[nodiscard]] std::optional<std::string> answer_kind(std::string_view step, std::string_view actual);
/// The object of "upload 1018h:01 by block", and no other step.
[[nodiscard]] std::optional<Multiplexer> uploaded(std::string_view step);
/// A value without how it was transferred: "1.00" of "1.00 (1 segments in 1 sub-blocks, ...)".
[[nodiscard]] std::string_view value_of(std::string_view actual);

/// The step that decided, or that was found wanting.
struct Seen {
  const CaseResult* owner = nullptr;
  Verdict verdict = Verdict::pass;
  std::string_view requirement, step, actual;
};
/// By case, requirement and step, whatever value that writes; of several of one key the first. Points into
/// the run. Monitors judge whatever came by, another frame in every run: none of them.
using SeenByStep = std::map<std::tuple<std::string, std::string_view, std::string_view>, Seen>;
[[nodiscard]] SeenByStep seen_in(const RunResult& run);

}  // namespace conform::result
