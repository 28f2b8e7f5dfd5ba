// SPDX-License-Identifier: Apache-2.0
// The report files of a run: tried before the first frame, never stale, made at the end.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "can/capture.hpp"
#include "can/capture_stream.hpp"
#include "journal/writer.hpp"
#include "result/run_result.hpp"

namespace conform::cli {

/// What was asked for of the formats, by their names: "junit" and a path; an empty one is not asked for.
[[nodiscard]] journal::ReportPaths absolute_paths(const std::map<std::string, std::string>& asked,
                                                  const std::string& capture, const std::string& candump,
                                                  const std::string& captures = {});

/// `path` from the root on, so that it names the same file in another process; empty stays empty.
[[nodiscard]] std::string absolute(const std::string& path);

class RunReports {
 public:
  explicit RunReports(journal::ReportPaths paths) : paths_(std::move(paths)) {}

  [[nodiscard]] const journal::ReportPaths& paths() const { return paths_; }
  [[nodiscard]] bool none() const {
    return paths_.reports.empty() && paths_.capture.empty() && paths_.candump.empty() &&
           paths_.captures.empty();
  }
  /// Whether some file is to tell the comments of frames.
  [[nodiscard]] bool keeps_comments() const { return !paths_.capture.empty() || !paths_.captures.empty(); }
  /// One that the user named first, or empty.
  [[nodiscard]] std::string first() const;

  /// Replaces what an earlier run left by files that say that this one has not ended. Error: a path that
  /// cannot be written; `inputs` are files that must not be.
  [[nodiscard]] Result<void> begin(const std::string& tool, const std::vector<std::string>& inputs);
  /// The run did not even begin; the files say why.
  void not_begun(const std::string& tool, const Error& why);

  /// Capture files that grow from now on.
  [[nodiscard]] Result<void> stream(const can::CaptureInfo& info);
  void recorded(const can::CapturedFrame& frame);
  void waited(BusTime now);
  void flush();

  /// Makes every file. What could not be written stands in `run.unwritten` afterwards, and on standard error.
  void write(result::RunResult& run, const can::Capture& capture, const can::CaptureInfo& info);
  /// Makes them of a run whose process is gone: its capture is what it streamed.
  void write_left(result::RunResult& run);

 private:
  void put(result::RunResult& run, const std::string& path, ByteView bytes);
  void put(result::RunResult& run, const std::string& path, const std::string& text);
  [[nodiscard]] Result<void> say(const std::string& tool, const std::string& what);
  void write_words(result::RunResult& run, const can::Capture& capture);
  void write_causes(result::RunResult& run, const can::Capture& capture, const can::CaptureInfo& info);
  [[nodiscard]] std::vector<std::string> all() const;

  journal::ReportPaths paths_;
  std::optional<can::CaptureStream> pcapng_, candump_;
  bool has_causes_ = false;  ///< the captures of causes are made, and reports name them
};

}  // namespace conform::cli
