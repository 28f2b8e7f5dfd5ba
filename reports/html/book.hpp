// SPDX-License-Identifier: Apache-2.0
// What all sections of a page know of the run: its causes, who breaks what, and the name under which each
// thing is linked to.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "reports/beside.hpp"
#include "reports/cause_lines.hpp"
#include "reports/tally.hpp"
#include "result/causes.hpp"
#include "result/run_result.hpp"

namespace conform::reports::html {

/// What of a run stands on the page: all of it, or findings of it alone, so that there is nothing to link to.
enum class Extent : unsigned char { whole, excerpt };

class Book {
 public:
  /// `run` must outlive it. `prefix`: of the names that it gives to elements, where a page tells of two runs.
  explicit Book(const result::RunResult& run, Beside beside = {}, Extent extent = Extent::whole,
                std::string prefix = "d");

  [[nodiscard]] const result::RunResult& run() const { return run_; }
  [[nodiscard]] const Beside& beside() const { return beside_; }
  [[nodiscard]] const std::vector<result::Cause>& causes() const { return causes_; }
  [[nodiscard]] const std::vector<RequirementVerdict>& requirements() const { return requirements_; }
  /// Cases that can judge a requirement, in the order of the run.
  [[nodiscard]] const std::vector<const result::CaseResult*>& cases_of(const std::string& requirement) const;
  /// The cause that explains a case, or that a requirement is violated by; nullptr: none.
  [[nodiscard]] const result::Cause* cause_of(const result::CaseResult& one) const;
  [[nodiscard]] const result::Cause* cause_of(const std::string& requirement) const;
  /// 1 for the heaviest.
  [[nodiscard]] std::size_t number_of(const result::Cause& cause) const;

  // Links; a requirement or case that the page does not hold is text.
  [[nodiscard]] std::string anchor(const result::CaseResult& one) const;
  [[nodiscard]] std::string anchor(const std::string& requirement) const;
  [[nodiscard]] std::string anchor(const result::Cause& cause) const;
  [[nodiscard]] std::string case_link(const result::CaseResult& one) const;
  [[nodiscard]] std::string case_link(const std::string& name) const;
  [[nodiscard]] std::string requirement_link(const std::string& requirement) const;
  [[nodiscard]] std::string cause_link(const result::Cause& cause) const;
  /// Cases as links, instances of one scenario together: "cia301/sdo/upload [1000h:00] [1001h:00]".
  [[nodiscard]] std::string case_list(const std::vector<const result::CaseResult*>& cases) const;

  /// A name for an element that none had before: "d1", "d2" ...
  [[nodiscard]] std::string fresh_id() const;

 private:
  const result::RunResult& run_;
  Beside beside_;
  Extent extent_;
  std::string prefix_;
  std::vector<result::Cause> causes_;
  CauseOfCase by_case_;
  std::vector<RequirementVerdict> requirements_;
  std::map<std::string, std::vector<const result::CaseResult*>> cases_of_;
  std::map<std::string, const result::Cause*> by_requirement_;
  std::map<std::string, std::string> anchors_;
  std::map<std::string, const result::CaseResult*> by_name_;
  mutable std::size_t drawn_ = 0;
};

}  // namespace conform::reports::html
