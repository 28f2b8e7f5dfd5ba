// SPDX-License-Identifier: Apache-2.0
// Several devices side by side, on one page.
#include <algorithm>
#include <optional>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "reports/html/bar.hpp"
#include "reports/html/book.hpp"
#include "reports/html/document.hpp"
#include "reports/html/markup.hpp"
#include "reports/matrix.hpp"
#include "reports/phrases.hpp"
#include "reports/text_tools.hpp"
#include "result/properties.hpp"

namespace conform::reports {
namespace {

using namespace html;
using result::Verdict;

std::string_view kind_of(const std::optional<Verdict>& verdict) {
  return verdict ? css_class(*verdict) : "na";
}

std::string badge_of(const std::optional<Verdict>& verdict) {
  return verdict ? badge(*verdict) : badge("na", "not judged");
}

/// Where the columns lead to: their own reports.
class Reports {
 public:
  explicit Reports(const Matrix& matrix) {
    links_.reserve(matrix.columns().size());
    for (const auto& each : matrix.columns()) {
      links_.push_back({.path = text(url_path(each.report)), .book = {}});
      if (!each.report.empty()) links_.back().book.emplace(*each.run);
    }
  }

  /// What the device is called, as the link to its report.
  [[nodiscard]] std::string name(std::size_t column, const std::string& words) const {
    const auto& path = links_[column].path;
    return path.empty() ? words : fmt::format("<a href=\"{}\">{}</a>", path, words);
  }
  /// What it makes of a requirement; what is not met leads to the evidence.
  [[nodiscard]] std::string cell(std::size_t column, const MatrixRow& row) const {
    const auto& verdict = row.verdicts[column];
    const auto& [path, book] = links_[column];
    if (!book || !verdict || *verdict <= Verdict::pass) return badge_of(verdict);
    return fmt::format("<a href=\"{}#{}\">{}<span class=\"sr\"> of {}</span></a>", path,
                       book->anchor(row.info->id), badge_of(verdict), clipped(row.info->id, 60));
  }

 private:
  struct Link {
    std::string path;
    std::optional<Book> book;
  };
  std::vector<Link> links_;
};

/// One line for each device: who it is, how it did, and why its run ended, if it did.
std::string device_section(const Matrix& matrix, const Reports& reports) {
  std::string rows;
  for (std::size_t i = 0; i < matrix.columns().size(); ++i) {
    const auto& column = matrix.columns()[i];
    const auto& run = *column.run;
    const auto counts = matrix.counts(i);
    const auto property = [&run](std::string_view name) {
      return clipped(result::property_of(run, name), 60);
    };
    rows += fmt::format(
        "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{} {}{}</td></tr>\n",
        reports.name(i, clipped(column.name, 100)), property("dut.node_id"), property("dut.serial"),
        property("dut.software_version"), bar(counts), count_badges(counts),
        run.aborted ? "<br/>" + badge(Verdict::error) + " ended early: " + clipped(*run.aborted, 300)
                    : std::string());
  }
  return section("devices", "Devices",
                 table("Devices", "devices",
                       {{"Device"}, {"Node"}, {"Serial number"}, {"Software"}, {"Requirements"}}, rows));
}

std::string requirement_rows(const Matrix& matrix, const Reports& reports, const std::string& area) {
  std::string rows;
  for (const auto& row : matrix.rows()) {
    if (row.info->area != area) continue;
    rows += fmt::format("<tr data-v=\"{}\"><th scope=\"row\">{}<br/><span class=\"quiet\">{}</span></th>",
                        kind_of(row.worst()), clipped(row.info->id, 60),
                        clipped(prose(row.info->statement), 400));
    for (std::size_t i = 0; i < row.verdicts.size(); ++i)
      rows += fmt::format("<td>{}</td>", reports.cell(i, row));
    rows += "</tr>\n";
  }
  return rows;
}

std::string requirement_section(const Matrix& matrix, const Reports& reports) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < matrix.columns().size(); ++i)
    names.push_back(reports.name(i, clipped(matrix.columns()[i].name, 40)));
  std::vector<Column> columns{{"Requirement"}};
  for (const auto& each : names) columns.push_back({each});
  std::vector<std::string> areas;
  for (const auto& row : matrix.rows()) {
    if (std::ranges::find(areas, row.info->area) == areas.end()) areas.push_back(row.info->area);
  }
  std::string out;
  for (const auto& area : areas) {
    const auto title = area.empty() ? std::string("(no area)") : clipped(prose(area), 200);
    out += fmt::format("<div class=\"group\">\n<h3>{}</h3>\n{}</div>\n", title,
                       table(title, "matrix", columns, requirement_rows(matrix, reports, area)));
  }
  return section("requirements", "Requirements", out, {"requirement", "requirements"});
}

std::vector<Choice> choices_of(const Matrix& matrix) {
  std::vector<Choice> out;
  for (const auto verdict : {Verdict::fail, Verdict::error, Verdict::inconclusive, Verdict::warn,
                             Verdict::waived, Verdict::pass}) {
    const auto count = static_cast<std::size_t>(
        std::ranges::count_if(matrix.rows(), [&](const MatrixRow& row) { return row.worst() == verdict; }));
    if (count > 0) out.push_back({css_class(verdict), css_class(verdict), verdict_words(verdict), count});
  }
  const auto none = static_cast<std::size_t>(std::ranges::count_if(
      matrix.rows(), [](const MatrixRow& row) { return kind_of(row.worst()) == "na"; }));
  if (none > 0) out.push_back({"na", "na", "not applicable", none});
  return out;
}

}  // namespace

std::string matrix_html(const Matrix& matrix) {
  const auto failing = std::ranges::count_if(
      matrix.columns(), [](const MatrixColumn& each) { return result::exit_code(*each.run) == 1; });
  const Reports reports(matrix);
  std::set<std::string> tools;
  for (const auto& each : matrix.columns()) tools.insert(each.run->tool);
  Document page;
  page.title = fmt::format("{}: {} do not conform", counted(matrix.columns().size(), "device"), failing);
  page.brand = "CANopen conformance of several devices";
  for (const auto& each : tools) page.generator += (page.generator.empty() ? "" : ", ") + clipped(each, 100);
  page.footer = "A cell is the worst verdict of the cases that judged the requirement on that device.";
  if (std::ranges::any_of(matrix.columns(), [](const MatrixColumn& each) { return !each.report.empty(); }))
    page.footer += " What is not met leads to it in the report of the device.";
  page.filter = {"requirements", "verdicts", "requirement, words of it", choices_of(matrix)};
  page.parts = {{"devices", "Devices", device_section(matrix, reports)},
                {"requirements", "Requirements", requirement_section(matrix, reports)}};
  return document(page);
}

}  // namespace conform::reports
