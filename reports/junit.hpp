// SPDX-License-Identifier: Apache-2.0
// JUnit XML in the strict shape that Jenkins (junit and xUnit plugins), GitLab, Azure and the GitHub actions
// read.
#pragma once

#include <span>
#include <string>

#include "result/run_result.hpp"

namespace conform::reports {

struct JUnitOptions {
  /// In front of every class name ("drive-a.cia301.sdo"): keeps the reports of several devices of one
  /// pipeline apart.
  std::string class_prefix;
  /// In front of every scenario file ("suites/"): CI systems want paths from the root of the repository.
  std::string source_prefix;
};

/// One <testsuite> per suite file, one <testcase> per case; described by reports/junit.xsd. Verdicts become:
/// fail <failure>; error, inconclusive and not run <error>; not applicable <skipped>; a warning passes and
/// says so in <system-out>. A run without cases becomes one <error>, so that an empty report is never green.
[[nodiscard]] std::string junit(const result::RunResult& run, const JUnitOptions& options = {});

struct JUnitDevice {
  const result::RunResult* run = nullptr;
  JUnitOptions options;  ///< with a class_prefix of its own
};
/// The same of several devices in one file, one after the other.
[[nodiscard]] std::string junit_of_several(std::span<const JUnitDevice> devices);

}  // namespace conform::reports
