// SPDX-License-Identifier: Apache-2.0
// Several results as one: the parts of a run that were played at the same time, on machines of their own.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "result/properties.hpp"
#include "result/run_result.hpp"

namespace conform::result {

/// A result, and what the user calls it: its file.
struct NamedRun {
  std::string name;
  RunResult run;
  std::string page{};  ///< its HTML report, as absolute path, where there is one
};

/// Which part of how many parts a result is (`run --shard 2/5`); nothing: it is a whole run.
struct PartOfRun {
  std::size_t number = 1, of = 1;
};
[[nodiscard]] std::optional<PartOfRun> part_of_run(const RunResult& run);

/// Who was tested, as far as the device itself says so: the node, 1018h and the names of 1008h to 100Ah. Runs
/// of one device agree in it.
[[nodiscard]] std::string identity_of(const RunResult& run);

/// One result as if the parts had been played one after the other, in the order of their numbers. A monitor
/// watched every part: what it found adds up, and the worst counts. A part that is missing or stopped early
/// ends the whole early. Likenesses are left to who knows the patterns. Error: parts of different runs, or
/// one part twice; `parts` is not empty.
[[nodiscard]] Result<RunResult> merge_parts(std::span<const NamedRun> parts);

}  // namespace conform::result
