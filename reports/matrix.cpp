// SPDX-License-Identifier: Apache-2.0
#include "reports/matrix.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "reports/csv.hpp"
#include "reports/markdown_parts.hpp"
#include "reports/markdown_text.hpp"
#include "reports/paint.hpp"
#include "reports/phrases.hpp"
#include "reports/tally.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports {
namespace {

using result::Verdict;

std::string_view words_of(const std::optional<Verdict>& verdict) {
  return verdict ? verdict_words(*verdict) : std::string_view("not judged");
}

/// Something to look at: not met, not decided, or only with a waiver.
bool is_trouble(const MatrixRow& row) {
  const auto worst = row.worst();
  return worst && *worst > Verdict::pass;
}

}  // namespace

std::optional<Verdict> MatrixRow::worst() const {
  std::optional<Verdict> out;
  for (const auto& each : verdicts) {
    if (each) out = out ? result::worst(*out, *each) : *each;
  }
  return out;
}

bool MatrixRow::differs() const {
  return std::ranges::any_of(verdicts, [this](const auto& each) { return each != verdicts.front(); });
}

Matrix::Matrix(std::vector<MatrixColumn> columns) : columns_(std::move(columns)) {
  std::map<std::string, MatrixRow> by_id;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const auto& run = *columns_[i].run;
    for (const auto& each : requirement_verdicts(run)) {
      const auto* info = run.requirement(each.id);
      if (info == nullptr) continue;
      auto& row = by_id[each.id];
      if (row.info == nullptr) row.info = info;
      row.verdicts.resize(columns_.size());
      row.verdicts[i] = each.verdict;
    }
  }
  for (auto& [id, row] : by_id) rows_.push_back(std::move(row));
}

result::Counts Matrix::counts(std::size_t column) const {
  result::Counts out;
  for (const auto& row : rows_) {
    if (row.verdicts[column]) out.add(*row.verdicts[column]);
  }
  return out;
}

int Matrix::exit_code() const {
  std::vector<int> codes;
  for (const auto& each : columns_) codes.push_back(result::exit_code(*each.run));
  const auto any = [&codes](auto&& is) { return std::ranges::any_of(codes, is); };
  if (any([](int code) { return code == 1; })) return 1;
  if (const auto ended = std::ranges::find_if(codes, [](int code) { return code > 3; }); ended != codes.end())
    return *ended;
  if (any([](int code) { return code == 3; })) return 3;
  // A device to which nothing applies beside others that were judged is told in the table.
  return any([](int code) { return code == 0; }) ? 0 : 2;
}

std::string matrix_text(const Matrix& matrix, const Style& style) {
  std::size_t width = 6;
  std::vector<std::string> names;
  for (const auto& each : matrix.columns()) {
    names.push_back(clip(log_safe(each.name), 50));
    width = std::max(width, columns(names.back()));
  }
  std::string out = "Devices\n-------\n";
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto& run = *matrix.columns()[i].run;
    const auto counts = matrix.counts(i);
    const auto ink = counts.fail > 0                                         ? Verdict::fail
                     : counts.error + counts.inconclusive > 0 || run.aborted ? Verdict::inconclusive
                                                                             : Verdict::pass;
    out +=
        fmt::format("{}  {}\n", pad_right(names[i], width), paint(counts_text(counts), ink_of(ink), style));
    if (run.aborted) {
      for (const auto& line : wrap("ended early: " + log_safe(*run.aborted), style.width - 4))
        out += "    " + line + "\n";
    }
  }
  bool heading = false;
  for (const auto& row : matrix.rows()) {
    if (!is_trouble(row)) continue;
    if (!heading)
      out += "\nRequirements that not every device meets\n----------------------------------------\n";
    heading = true;
    for (const auto& line : wrap(prose(row.info->id + "  " + row.info->statement), style.width))
      out += line + "\n";
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto& verdict = row.verdicts[i];
      out += fmt::format("    {}  {}\n", pad_right(names[i], width),
                         paint(words_of(verdict), ink_of(verdict.value_or(Verdict::not_applicable)), style));
    }
  }
  return out + fmt::format("\nexit code  {}\n", matrix.exit_code());
}

std::string matrix_csv(const Matrix& matrix) {
  std::vector<std::string> cells{"requirement", "level", "clause", "area"};
  for (const auto& each : matrix.columns()) cells.push_back(each.name);
  std::string out = csv_line(cells);
  for (const auto& row : matrix.rows()) {
    cells = {row.info->id, row.info->level, row.info->clause, row.info->area};
    for (const auto& verdict : row.verdicts) cells.emplace_back(words_of(verdict));
    out += csv_line(cells);
  }
  return out;
}

std::string matrix_markdown(const Matrix& matrix) {
  std::string out = "# CANopen conformance of several devices\n\n| device | requirements |\n|---|---|\n";
  for (std::size_t i = 0; i < matrix.columns().size(); ++i) {
    const auto& column = matrix.columns()[i];
    out += fmt::format("| {} | {}{} |\n", escaped(column.name, 100), counts_text(matrix.counts(i)),
                       column.run->aborted ? "; ended early: " + escaped(*column.run->aborted) : "");
  }
  const auto shown = [](const MatrixRow& row) { return is_trouble(row) || row.differs(); };
  if (std::ranges::none_of(matrix.rows(), shown))
    return out + "\nEvery requirement is met alike by all of them.\n";
  out += "\n## Requirements that are not met alike\n\n| requirement |";
  std::string rule = "\n|---|";
  for (const auto& each : matrix.columns()) {
    out += " " + escaped(each.name, 40) + " |";
    rule += "---|";
  }
  out += rule + "\n";
  for (const auto& row : matrix.rows()) {
    if (!shown(row)) continue;
    out += fmt::format("| {} {} |", escaped(row.info->id, 40), escaped(prose(row.info->statement), 200));
    for (const auto& verdict : row.verdicts)
      out += fmt::format(" {0}{1}{0} |", verdict == Verdict::fail ? "**" : "", words_of(verdict));
    out += "\n";
  }
  return out;
}

}  // namespace conform::reports
