// SPDX-License-Identifier: Apache-2.0
#include "cli/pages/proof_sections.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"
#include "reports/html/bar.hpp"
#include "reports/html/document.hpp"
#include "reports/html/markup.hpp"
#include "reports/text_tools.hpp"

namespace conform::cli {
namespace {

using namespace reports::html;
using reports::counted;
using reports::prose;

constexpr std::size_t text_limit = 300;

std::string group(const std::string& title, const std::string& rows) {
  return rows.empty() ? rows : fmt::format("<div class=\"group\">\n<h3>{}</h3>\n{}</div>\n", title, rows);
}

std::string one_defect(const ProofBook& book, const DefectVerdict& defect, const std::string& id) {
  const bool killed = !defect.killed_by.empty();
  const auto* blame = book.blame_of(defect.id);
  const bool is_led_wrong = blame != nullptr && !blame->single_and_right();
  std::string out =
      fmt::format("<p>{} <b>{}</b> {}</p>\n", killed ? badge("pass", "killed") : badge("fail", "survives"),
                  clipped(defect.id, text_limit), clipped(prose(defect.summary), text_limit));
  out += fmt::format("<p class=\"by\">violates {}", book.rule_links(defect.violates));
  for (const auto& unknown : defect.unknown)
    out += fmt::format(" <b>{}, which the catalogue does not have</b>", clipped(unknown, text_limit));
  out += "</p>\n";
  if (killed) {
    out += fmt::format("<p class=\"by\">killed by {}", clipped(defect.killed_by.front(), text_limit));
    if (defect.killed_by.size() > 1) out += fmt::format(" and {} more", defect.killed_by.size() - 1);
    out += "</p>\n";
  }
  if (blame != nullptr) {
    out += fmt::format("<p class=\"by\">{} {}", is_led_wrong ? badge("warn", "led by") : "led by",
                       blame->causes.empty() ? "nothing" : book.rule_link(blame->causes.front()));
    if (blame->causes.size() > 1)
      out += fmt::format(", the first of {}", counted(blame->causes.size(), "cause"));
    out += "</p>\n";
  }
  if (defect.killed_by.size() > 1 || !defect.bystanders.empty()) {
    std::string items;
    for (const auto& how : defect.killed_by) items += fmt::format("<li>{}</li>\n", clipped(how, text_limit));
    std::string inside = fmt::format("<ul class=\"list\">\n{}</ul>\n", items);
    if (!defect.bystanders.empty())
      inside += fmt::format("<p>also worse: {}</p>\n", book.rule_links(defect.bystanders));
    out += folded(
        fmt::format("everything that shows it<span class=\"sr\">, {}</span>", clipped(defect.id, text_limit)),
        inside);
  }
  const auto kind = !killed ? shown_kind::open : is_led_wrong ? shown_kind::look : shown_kind::shown;
  return proof_row(kind, out, id);
}

std::string one_rule(const ProofBook& book, const scenario::Requirement& rule, bool is_proven,
                     const std::string& id) {
  std::string out = fmt::format("<p>{} <b>{}</b> {} <span class=\"quiet\">{}, {}</span></p>\n",
                                is_proven ? badge("pass", "proven") : badge("fail", "unproven"),
                                clipped(rule.id, text_limit), clipped(prose(rule.statement), 1000),
                                sentence(rule.clause), sentence(rule.level));
  const auto& proofs = book.proofs_of(rule.id);
  if (!proofs.empty()) {
    std::string items;
    for (const auto* defect : proofs)
      items += fmt::format("<li>{} {}</li>\n", book.defect_link(defect->id),
                           clipped(prose(defect->summary), text_limit));
    out += folded(fmt::format("{}<span class=\"sr\"> that prove {}</span>", counted(proofs.size(), "defect"),
                              clipped(rule.id, text_limit)),
                  fmt::format("<ul class=\"list\">\n{}</ul>\n", items));
  }
  return proof_row(is_proven ? shown_kind::shown : shown_kind::open, out, id);
}

const std::string no_area = "(no area)";

}  // namespace

std::string proof_row(std::string_view kind, const std::string& content, const std::string& id) {
  return fmt::format("<li{} data-v=\"{}\">\n{}</li>\n", id.empty() ? "" : fmt::format(" id=\"{}\"", id), kind,
                     content);
}

std::string not_asked(std::string_view command) {
  return fmt::format("<p>Not asked for in this run. <code class=\"copy\">{}</code></p>\n", command);
}

ProofBook::ProofBook(const Proof& proof) : proof_(proof) {
  if (!proof.matrix) return;
  const auto& matrix = *proof.matrix;
  for (const auto& blame : matrix.blames) blames_.emplace(blame.defect, &blame);
  for (std::size_t i = 0; i < matrix.defects.size(); ++i) {
    const auto& defect = matrix.defects[i];
    defect_numbers_.emplace(defect.id, i + 1);
    for (const auto& rule : defect.proves) proofs_[rule].push_back(&defect);
  }
  for (const auto& rule : proof.catalogue->all()) {
    const bool is_proven = std::ranges::binary_search(matrix.proven, rule.id);
    // Of a few defects nothing follows for the rules of the others.
    if (!is_proven && (proof.is_part || !std::ranges::binary_search(matrix.unproven, rule.id))) continue;
    rule_numbers_.emplace(rule.id, rules_.size() + 1);
    rules_.emplace_back(&rule, is_proven);
  }
  for (const auto& rule : proof.catalogue->all()) {
    const bool is_used = rule_numbers_.contains(rule.id) ||
                         std::ranges::any_of(matrix.defects, [&](const DefectVerdict& each) {
                           return !each.violates.empty() && each.violates.front() == rule.id;
                         });
    if (is_used && std::ranges::find(areas_, rule.area) == areas_.end()) areas_.push_back(rule.area);
  }
  const auto is_homeless = [&](const DefectVerdict& each) { return area_of(each) == no_area; };
  if (std::ranges::any_of(matrix.defects, is_homeless)) areas_.push_back(no_area);
}

const Blame* ProofBook::blame_of(const std::string& defect) const {
  const auto found = blames_.find(defect);
  return found == blames_.end() ? nullptr : found->second;
}

const std::string& ProofBook::area_of(const DefectVerdict& defect) const {
  if (defect.violates.empty()) return no_area;
  const auto* rule = proof_.catalogue->find(defect.violates.front());
  return rule == nullptr ? no_area : rule->area;
}

const std::vector<const DefectVerdict*>& ProofBook::proofs_of(const std::string& rule) const {
  static const std::vector<const DefectVerdict*> none;
  const auto found = proofs_.find(rule);
  return found == proofs_.end() ? none : found->second;
}

std::string ProofBook::rule_link(const std::string& rule) const {
  const auto found = rule_numbers_.find(rule);
  const auto shown = clipped(rule, text_limit);
  return found == rule_numbers_.end() ? shown : link(fmt::format("r{}", found->second), shown);
}

std::string ProofBook::rule_links(const std::vector<std::string>& rules) const {
  std::vector<std::string> all;
  for (const auto& rule : rules) all.push_back(rule_link(rule));
  return join(all, ", ");
}

std::string ProofBook::defect_link(const std::string& defect) const {
  const auto found = defect_numbers_.find(defect);
  const auto shown = clipped(defect, text_limit);
  return found == defect_numbers_.end() ? shown : link(fmt::format("d{}", found->second), shown);
}

std::string area_section(const ProofBook& book) {
  if (!book.proof().matrix) return {};
  std::string rows;
  for (const auto& area : book.areas()) {
    result::Counts rules;
    for (const auto& [rule, is_proven] : book.rules()) {
      if (rule->area == area) ++(is_proven ? rules.pass : rules.fail);
    }
    std::size_t defects = 0, killed = 0;
    for (const auto& defect : book.proof().matrix->defects) {
      if (book.area_of(defect) != area) continue;
      ++defects;
      if (!defect.killed_by.empty()) ++killed;
    }
    rows += fmt::format(
        "<tr><th scope=\"row\">{}</th><td>{}</td>{}{}<td class=\"num{}\">{}</td>{}{}<td class=\"num{}\">{}</td></tr>\n",
        clipped(prose(area), text_limit), bar(rules), number_cell(rules.total()), number_cell(rules.pass),
        rules.fail == 0 ? " zero" : " is-fail", rules.fail, number_cell(defects), number_cell(killed),
        defects == killed ? " zero" : " is-fail", defects - killed);
  }
  const auto words =
      "<p class=\"quiet\">A requirement is proven where at least one defect that violates it is caught by its own "
      "expectation. A defect stands where the first requirement that it violates stands.</p>\n";
  return section("areas", "Kill matrix by area",
                 words + table("Requirements and defects by area", "areas",
                               {{"area"},
                                {"<span class=\"sr\">shares</span>"},
                                {"judged", true},
                                {"proven", true},
                                {"unproven", true},
                                {"defects", true},
                                {"killed", true},
                                {"survive", true}},
                               rows));
}

std::string defect_section(const ProofBook& book) {
  if (!book.proof().matrix)
    return section("defects", "Defects", not_asked("canopen-conform selftest --html proof.html"));
  const auto& defects = book.proof().matrix->defects;
  std::string out;
  for (const auto& area : book.areas()) {
    std::vector<std::string> rows;
    for (std::size_t i = 0; i < defects.size(); ++i) {
      if (book.area_of(defects[i]) == area)
        rows.push_back(one_defect(book, defects[i], fmt::format("d{}", i + 1)));
    }
    if (rows.empty()) continue;
    out += group(fmt::format("{} <span class=\"quiet\">{}</span>", clipped(prose(area), text_limit),
                             counted(rows.size(), "defect")),
                 row_lists("defects", rows));
  }
  if (!book.proof().has_blame)
    out =
        "<p class=\"quiet\">Which requirement leads the report of each defect was not asked for: --blame tells it.</p>\n" +
        out;
  return section("defects", "Defects", out, {"defect", "defects"});
}

std::string rule_section(const ProofBook& book) {
  std::string out;
  for (const bool is_proven : {false, true}) {
    for (const auto& area : book.areas()) {
      std::vector<std::string> rows;
      for (std::size_t i = 0; i < book.rules().size(); ++i) {
        const auto& [rule, proven] = book.rules()[i];
        if (rule->area == area && proven == is_proven)
          rows.push_back(one_rule(book, *rule, proven, fmt::format("r{}", i + 1)));
      }
      if (rows.empty()) continue;
      const auto title = is_proven ? std::string() : std::string("Unproven: ");
      out += group(title + clipped(prose(area), text_limit), row_lists("requirements", rows));
    }
  }
  return section("rules", "Requirements", out, {"requirement", "requirements"});
}

}  // namespace conform::cli
