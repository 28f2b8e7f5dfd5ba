// SPDX-License-Identifier: Apache-2.0
#include "cli/run/run_source.hpp"

#include <utility>

#include "base/files.hpp"
#include "cli/suite_folder.hpp"
#include "journal/reader.hpp"
#include "reports/result_json.hpp"

namespace conform::cli {
namespace {

constexpr std::uint64_t largest = std::uint64_t{4} << 30U;

}  // namespace

Result<RunSource> read_run(const std::string& path) {
  auto text = read_file(path, largest);
  if (!text) return std::unexpected(text.error());
  if (reports::is_result_json(*text)) {
    auto run = reports::read_result_json(*text, path);
    if (!run) return std::unexpected(run.error());
    return RunSource{std::move(*run)};
  }
  auto journal = journal::read(path, *text);
  if (!journal) return std::unexpected(journal.error());
  if (!journal->finished) name_known_mistakes(journal->run, journal->header.suites);
  auto& header = journal->header;
  return RunSource{std::move(journal->run), std::move(header.reports), std::move(header.profile),
                   std::move(header.eds)};
}

Result<RunSource> read_run_with_cases(const std::string& path) {
  auto source = read_run(path);
  if (!source) return source;
  if (source->run.cases.empty()) {
    return fail("the run has no cases to compare" +
                    (source->run.aborted ? ": " + *source->run.aborted : std::string()),
                path, "a result of 'run --json', or the journal of a run");
  }
  return source;
}

Result<result::RunResult> read_run_to_compare(const std::string& path) {
  auto source = read_run_with_cases(path);
  if (!source) return std::unexpected(source.error());
  return std::move(source->run);
}

}  // namespace conform::cli
