// SPDX-License-Identifier: Apache-2.0
// The bundle of a run: its place is held from before the first frame on, by an archive that is not sealed and
// has what the run is made of. It is sealed when the run has ended.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "bundle/keys.hpp"
#include "can/capture.hpp"
#include "cli/run/cause_captures.hpp"
#include "cli/run/run_inputs.hpp"
#include "journal/writer.hpp"
#include "result/run_result.hpp"

namespace conform::cli {

class RunBundle {
 public:
  /// `path`: empty where none is asked for, and nothing is done then.
  explicit RunBundle(std::string path) : path_(std::move(path)) {}

  [[nodiscard]] bool asked() const { return !path_.empty(); }
  /// Where frames are kept while they come, if the user names no place for them.
  [[nodiscard]] std::string frames() const { return asked() ? path_ + ".frames.pcapng" : std::string(); }

  void sign_with(bundle::PrivateKey key) { key_.emplace(std::move(key)); }
  void take(RunInputs inputs) { inputs_ = std::move(inputs); }
  /// Takes what the bundle at its place holds, where nothing was taken: of a run whose process is gone.
  void take_held(const result::RunResult& run);

  /// An archive that is not sealed, and says why.
  [[nodiscard]] Result<void> hold(const std::string& tool, const std::string& why) const;

  struct Frames {
    std::optional<std::string> pcapng{};   ///< absent: left out
    std::optional<std::string> candump{};  ///< where it was asked for
    std::string why_not{};                 ///< without pcapng
    std::vector<CauseCapture> causes{};    ///< a part of them for each cause
  };
  /// The reports that `asked` names, result.json, HTML, JUnit and Markdown in any case; frames and inputs.
  [[nodiscard]] Result<void> seal(const result::RunResult& run, const journal::ReportPaths& asked,
                                  Frames frames) const;

 private:
  std::string path_;
  std::optional<bundle::PrivateKey> key_;
  std::optional<RunInputs> inputs_;
};

}  // namespace conform::cli
