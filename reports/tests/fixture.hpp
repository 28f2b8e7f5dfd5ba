// SPDX-License-Identifier: Apache-2.0
// Constructed runs for the tests of the writers: every verdict once, and the worst strings a device can send.
#pragma once

#include <string>

#include "result/run_result.hpp"

namespace conform::reports::testing {

/// A small run with every verdict, evidence, notes and properties; what the samples show.
[[nodiscard]] result::RunResult sample_run();
/// The sample run on a device whose every string is `text`.
[[nodiscard]] result::RunResult hostile_run(const std::string& text);
/// All 256 bytes, broken UTF-8, markup, terminal and CI commands, marks that reorder text.
[[nodiscard]] std::string hostile_text();
/// A run that ended before its cases: two were planned, none was run.
[[nodiscard]] result::RunResult aborted_run();

}  // namespace conform::reports::testing
