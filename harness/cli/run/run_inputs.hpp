// SPDX-License-Identifier: Apache-2.0
// What a run was made of, beside the program: suites, profile, description, waivers. Kept as it was read, for
// a file may be another one when the run has ended.
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "bundle/manifest.hpp"
#include "bundle/seal.hpp"
#include "cli/suite_folder.hpp"
#include "result/run_result.hpp"

namespace conform::cli {

/// The roles of these files in a bundle.
namespace role {
inline constexpr const char* result = "result";
inline constexpr const char* report = "report";
inline constexpr const char* capture = "capture";
inline constexpr const char* suite = "suite";
inline constexpr const char* own_suite = "own suite";
inline constexpr const char* profile = "profile";
inline constexpr const char* description = "description";
inline constexpr const char* waivers = "waivers";
inline constexpr const char* recording = "recording";  ///< the trace that `judge` was given, as it was
}  // namespace role

/// A file that the run was told to use, by the name it was called.
struct UsedFile {
  std::string role, path;
};

struct RunInputs {
  std::vector<bundle::Content> contents{};
  std::vector<bundle::LeftOut> left_out{};  ///< what the run used as well
};

/// Reads these files. Error: one of them cannot be read any more.
[[nodiscard]] Result<RunInputs> take_files(const std::vector<UsedFile>& files);
/// Adds all files of the suites.
[[nodiscard]] Result<void> add_suites(RunInputs& inputs, const SuiteFolders& folders);

/// So that a report says which files were used, and who makes a bundle later can tell whether they still are
/// the same: "dut.description_digest" (SHA-256), "input.profile" and "input.waivers" (path, SHA-256).
[[nodiscard]] std::vector<result::Property> input_properties(const RunInputs& inputs,
                                                             const std::vector<UsedFile>& files);

/// What a run uses, read before it begins, and what its reports tell of it. `whole`: with the suites, for a
/// bundle.
struct TakenInputs {
  RunInputs inputs;
  std::vector<result::Property> told;
};
[[nodiscard]] Result<TakenInputs> take_inputs(const std::vector<UsedFile>& files, const SuiteFolders& suites,
                                              bool whole);

/// The inputs of a run that is over, by what its properties tell, as far as they are still there and the
/// same; of the others, why not. `profile` and `eds`: where they were then, if it is known better.
[[nodiscard]] RunInputs inputs_of(const result::RunResult& run, const std::string& profile,
                                  const std::string& eds);

/// A property that tells all of them at once: "bundle.inputs", a SHA-256 over names and digests.
[[nodiscard]] result::Property digest_of(const RunInputs& inputs);
/// Those that stand in a bundle, sealed or not yet. Error: it is none, or not one of this run.
[[nodiscard]] Result<RunInputs> inputs_in(const std::string& bundle, const result::RunResult& run);

}  // namespace conform::cli
