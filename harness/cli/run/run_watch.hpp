// SPDX-License-Identifier: Apache-2.0
// Who listens to a run on the command line: the console, the journal, the growing captures.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/run/run_reports.hpp"
#include "engine/observer.hpp"
#include "journal/writer.hpp"
#include "reports/console.hpp"
#include "result/worth.hpp"

namespace conform::cli {

class RunWatch final : public engine::Observer {
 public:
  struct Console {
    bool live = false;   ///< a terminal: the running case is shown
    bool quiet = false;  ///< only what did not pass
    reports::Style style;
    const result::Worths* worths = nullptr;  ///< by which the time that is left is told; outlives this
    std::optional<Duration> budget{};        ///< the run ends within it
  };
  /// Adds what only the command line knows to a result that goes into the journal.
  using Complete = std::function<void(result::RunResult&)>;

  RunWatch(Console console, RunReports& reports, journal::Writer* journal, Complete complete)
      : console_(console), reports_(reports), journal_(journal), complete_(std::move(complete)) {}

  void recorded(const can::CapturedFrame& frame) override;
  void waited(BusTime now) override;
  void planned(const result::RunResult& run, const std::vector<bool>& to_play) override;
  void case_begun(const result::RunResult& run, std::size_t index) override;
  void case_ended(const result::RunResult& run, std::size_t index) override;
  void changing(Multiplexer object, const Bytes& before) override;
  void commanding(Multiplexer object) override;
  void put_back(Multiplexer object, const Bytes& value) override;

  /// Which entries the run has changed so far, and whether they hold again what they held.
  [[nodiscard]] const std::vector<result::Change>& changes() const { return changes_; }

 private:
  /// "0:41, 3 min left"; empty where nothing is known of the cases.
  [[nodiscard]] std::string times() const;

  Console console_;
  RunReports& reports_;
  journal::Writer* journal_;
  Complete complete_;
  result::Counts counts_;  ///< of the cases that ended
  std::string running_;
  BusTime now_;
  std::optional<BusTime> begin_;    ///< of the first frame or silence
  std::vector<Duration> expected_;  ///< of each case; none where it is not to be played
  Duration to_come_{};              ///< of those that have not ended
  BusTime case_begin_;
  result::Pace pace_;
  std::vector<result::Change> changes_;
};

}  // namespace conform::cli
