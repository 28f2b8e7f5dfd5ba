// SPDX-License-Identifier: Apache-2.0
// Who listens to a run on the command line: the console, the journal, the growing captures.
#pragma once

#include <functional>

#include "cli/run/run_reports.hpp"
#include "engine/observer.hpp"
#include "journal/writer.hpp"
#include "reports/console.hpp"

namespace conform::cli {

class RunWatch final : public engine::Observer {
 public:
  struct Console {
    bool live = false;   ///< a terminal: the running case is shown
    bool quiet = false;  ///< only what did not pass
    reports::Style style;
  };
  /// Adds what only the command line knows to a result that goes into the journal.
  using Complete = std::function<void(result::RunResult&)>;

  RunWatch(Console console, RunReports& reports, journal::Writer* journal, Complete complete)
      : console_(console), reports_(reports), journal_(journal), complete_(std::move(complete)) {}

  void recorded(const can::CapturedFrame& frame) override;
  void waited(BusTime now) override;
  void planned(const result::RunResult& run) override;
  void case_begun(const result::RunResult& run, std::size_t index) override;
  void case_ended(const result::RunResult& run, std::size_t index) override;
  void changing(Multiplexer object, const Bytes& before) override;
  void commanding(Multiplexer object) override;
  void put_back(Multiplexer object, const Bytes& value) override;

  /// Which entries the run has changed so far, and whether they hold again what they held.
  [[nodiscard]] const std::vector<result::Change>& changes() const { return changes_; }

 private:
  Console console_;
  RunReports& reports_;
  journal::Writer* journal_;
  Complete complete_;
  result::Counts counts_;  ///< of the cases that ended
  std::string running_;
  BusTime now_;
  std::vector<result::Change> changes_;
};

}  // namespace conform::cli
