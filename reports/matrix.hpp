// SPDX-License-Identifier: Apache-2.0
// Several devices side by side: what each of them makes of each requirement. A rack, a product line, one
// firmware on four boards.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reports/console.hpp"
#include "result/run_result.hpp"

namespace conform::reports {

/// A column: a device, or a run of it.
struct MatrixColumn {
  std::string name;  ///< raw, told apart from the others; every writer sanitises
  const result::RunResult* run = nullptr;
  std::string report{};  ///< its html_report(), as the page finds it from its folder on; empty: none
};

/// A row: a requirement, and its verdict in each column; none: the run did not judge it.
struct MatrixRow {
  const result::RequirementInfo* info = nullptr;  ///< never null
  std::vector<std::optional<result::Verdict>> verdicts;

  /// The worst of them; none: nobody judged it.
  [[nodiscard]] std::optional<result::Verdict> worst() const;
  /// Some device does what another does not.
  [[nodiscard]] bool differs() const;
};

class Matrix {
 public:
  /// The runs outlive it.
  explicit Matrix(std::vector<MatrixColumn> columns);

  [[nodiscard]] const std::vector<MatrixColumn>& columns() const { return columns_; }
  /// By id.
  [[nodiscard]] const std::vector<MatrixRow>& rows() const { return rows_; }
  /// Requirements of a column by verdict.
  [[nodiscard]] result::Counts counts(std::size_t column) const;
  /// 1: a device fails; else 130 or 143: a run was ended; else 3: something is open; 2: nothing was judged in
  /// any of them.
  [[nodiscard]] int exit_code() const;

 private:
  std::vector<MatrixColumn> columns_;
  std::vector<MatrixRow> rows_;
};

/// For a terminal: a line for each device, and the requirements that some device does not meet.
[[nodiscard]] std::string matrix_text(const Matrix& matrix, const Style& style);
/// RFC 4180: requirement, level, clause, area, and a column for each device.
[[nodiscard]] std::string matrix_csv(const Matrix& matrix);
/// The devices, and the requirements that are not met alike by all of them.
[[nodiscard]] std::string matrix_markdown(const Matrix& matrix);
/// A document like that of a run (html/html.hpp). Where a device has a report, its name leads there, and what
/// is not met to the requirement in it.
[[nodiscard]] std::string matrix_html(const Matrix& matrix);

}  // namespace conform::reports
