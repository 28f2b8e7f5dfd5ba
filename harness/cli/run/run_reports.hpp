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
#include "cli/run/run_bundle.hpp"
#include "journal/writer.hpp"
#include "reports/beside.hpp"
#include "result/run_result.hpp"

namespace conform::cli {

/// What was asked for, as absolute paths: of the formats by their names ("junit"), where an empty path is not
/// asked for, and of the others in `places`.
[[nodiscard]] journal::ReportPaths absolute_paths(const std::map<std::string, std::string>& asked,
                                                  journal::ReportPaths places);

/// `path` from the root on, so that it names the same file in another process; empty stays empty.
[[nodiscard]] std::string absolute(const std::string& path);

class RunReports {
 public:
  explicit RunReports(journal::ReportPaths paths) : paths_(std::move(paths)), bundle_(paths_.bundle) {}

  [[nodiscard]] const journal::ReportPaths& paths() const { return paths_; }
  [[nodiscard]] bool none() const {
    return paths_.reports.empty() && paths_.capture.empty() && paths_.candump.empty() &&
           paths_.captures.empty() && paths_.bundle.empty();
  }
  /// Whether some file is to tell the comments of frames.
  [[nodiscard]] bool keeps_comments() const {
    return !paths_.capture.empty() || !paths_.captures.empty() || bundle_.asked();
  }
  /// One that the user named first, or empty.
  [[nodiscard]] std::string first() const;

  /// Replaces what an earlier run left by files that say that this one has not ended. Error: a path that
  /// cannot be written; `inputs` are files that must not be.
  /// Error: a report or capture that would be taken for a capture of a cause, and be removed or written over.
  [[nodiscard]] Result<void> captures_apart() const;
  [[nodiscard]] Result<void> begin(const std::string& tool, const std::vector<std::string>& inputs);
  /// The run did not even begin; the files say why.
  void not_begun(const std::string& tool, const Error& why);

  /// The bundle is signed with this key: empty, or a file. Error: it is none that can sign.
  [[nodiscard]] Result<void> sign_with(const std::string& key);
  [[nodiscard]] bool has_bundle() const { return bundle_.asked(); }
  /// For the bundle: what the run is made of.
  void take(RunInputs inputs) { bundle_.take(std::move(inputs)); }
  /// The same of a run that begins: from now on it is kept in the bundle's place.
  [[nodiscard]] Result<void> keep(const std::string& tool, RunInputs inputs);

  /// Capture files that grow from now on.
  [[nodiscard]] Result<void> stream(const can::CaptureInfo& info);
  void recorded(const can::CapturedFrame& frame);
  void waited(BusTime now);
  void flush();

  /// Makes every file. What could not be written stands in `run.unwritten` afterwards, and on standard error.
  void write(result::RunResult& run, const can::Capture& capture, const can::CaptureInfo& info);
  /// Makes those that a run was asked for whose process is gone: its capture is what it streamed.
  void write_left(result::RunResult& run);
  /// Makes others of a run that is over. `elsewhere`: captures, or a bundle of the run, where its frames are
  /// if they are to go into a bundle and no capture is named.
  void write_others(result::RunResult& run, const std::vector<std::string>& elsewhere);

 private:
  void put(result::RunResult& run, const std::string& path, ByteView bytes);
  void put(result::RunResult& run, const std::string& path, const std::string& text);
  [[nodiscard]] Result<void> say(const std::string& tool, const std::string& what);
  void write_words(result::RunResult& run);
  [[nodiscard]] reports::Beside beside(const std::string& path) const;
  /// The captures of causes, in their folder and in what is sealed afterwards.
  void write_causes(result::RunResult& run, const can::Capture& capture, const can::CaptureInfo& info,
                    RunBundle::Frames& frames);
  /// The frames of a run that is over, where they were found.
  void take_frames(result::RunResult& run, const Result<can::LoadedCapture>& found,
                   RunBundle::Frames& frames);
  void write_bundle(result::RunResult& run, RunBundle::Frames frames);
  [[nodiscard]] std::vector<std::string> all() const;

  journal::ReportPaths paths_;
  RunBundle bundle_;
  std::optional<can::CaptureStream> pcapng_, candump_;
  bool has_causes_ = false;       ///< the captures of causes are made, and reports name them
  bool frames_are_ours_ = false;  ///< beside the bundle, until they stand in it
};

}  // namespace conform::cli
