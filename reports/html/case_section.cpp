// SPDX-License-Identifier: Apache-2.0
// Every case of the run: what passed as a plain row with the step that decided it, so that a pass can be
// checked as well; what did not as a card to unfold.
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "reports/html/card.hpp"
#include "reports/html/document.hpp"
#include "reports/html/markup.hpp"
#include "reports/html/sections.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports::html {
namespace {

using result::CaseResult;
using result::Judgement;
using result::Verdict;

constexpr std::size_t text_limit = 300;
constexpr std::size_t step_limit = 160;  // of what passed: enough to find it in the scenario

std::string step_text(const result::DecidingStep& decided) {
  std::string out = clipped(decided.step, step_limit);
  // "require A -> holds: A" need not say A twice.
  const auto colon = decided.actual.find(": ");
  const bool again = colon != std::string::npos && decided.step.ends_with(decided.actual.substr(colon + 2));
  const auto actual = again ? decided.actual.substr(0, colon) : decided.actual;
  if (!actual.empty()) out += " &#x2192; " + clipped(actual, step_limit);
  return decided.frame ? out + fmt::format(", frame {}", frame_number(*decided.frame)) : out;
}

/// "SDO-GEN-01, SDO-GEN-13: upload 1000h:00 -> ..., frame 1388": judgements that one step has decided,
/// together.
std::string judgements(const Book& book, const CaseResult& one) {
  std::vector<std::pair<std::string, std::string>> lines;  // what decided, and of what
  for (const Judgement& judgement : one.judgements) {
    if (!judgement.findings.empty()) continue;  // told by its card
    std::string what;
    if (judgement.verdict != Verdict::pass) what += badge(judgement.verdict) + " ";
    if (!judgement.waived.empty()) what += "waived: " + clipped(prose(judgement.waived), text_limit) + " ";
    if (!judgement.reason.empty()) what += clipped(prose(judgement.reason), text_limit) + " ";
    if (judgement.decided_by) what += step_text(*judgement.decided_by);
    if (what.empty()) what = judgement.verdict == Verdict::pass ? "by the whole trace" : "";
    const auto known = std::ranges::find(lines, what, &std::pair<std::string, std::string>::first);
    const auto id = book.requirement_link(judgement.requirement);
    if (known == lines.end()) {
      lines.emplace_back(what, id);
    } else {
      known->second += ", " + id;
    }
  }
  std::string out;
  for (const auto& [what, ids] : lines) out += fmt::format("<p class=\"by\">{}: {}</p>\n", ids, what);
  return out;
}

/// What is to be told beside the findings: the reason, what it rests on, the requirements that nobody judged.
std::string remarks(const Book& book, const CaseResult& one) {
  std::string out;
  const bool silent = one.verdict == Verdict::pass;
  if (!silent && !one.reason.empty()) out += fmt::format("<p>{}</p>\n", clipped(prose(one.reason), 1000));
  if (const auto* cause = book.cause_of(one); cause != nullptr)
    out += fmt::format("<p>{}: {}</p>\n", book.cause_link(*cause), clipped(cause->about, text_limit));
  if (!one.rests_on.empty())
    out += fmt::format("<p>rests on {}, which is violated</p>\n", book.requirement_link(one.rests_on));
  if (!one.tried.empty()) out += fmt::format("<p>tried {}</p>\n", clipped(prose(one.tried), text_limit));
  for (const auto& want : one.wants)
    out += fmt::format("<p>wants {}</p>\n", clipped(prose(want.text), text_limit));
  if (one.judgements.empty() && !one.requirements.empty()) {
    std::string ids;
    for (const auto& id : one.requirements) ids += (ids.empty() ? "" : ", ") + book.requirement_link(id);
    out += fmt::format("<p class=\"by\">would judge {}</p>\n", ids);
  }
  return out;
}

std::string cards(const Book& book, const CaseResult& one) {
  std::string out;
  for (const auto& located : findings_of(one)) {
    const auto& finding = *located.finding;
    const auto title = fmt::format("{} {}{}", badge(located.verdict),
                                   finding.requirement.empty() ? std::string(located.setup ? "set-up: " : "")
                                                               : clipped(finding.requirement, 100) + ": ",
                                   clipped(headline(finding), text_limit));
    const auto* cause = book.cause_of(one);
    // Told in full once: where the cause is.
    if (cause != nullptr && cause->primary.finding == &finding) {
      out += fmt::format("<p>{}; in full under {}</p>\n", title, book.cause_link(*cause));
    } else {
      out += folded(title, card(book, located));
    }
  }
  return out;
}

std::string row(const Book& book, const CaseResult& one) {
  // The suite stands above the row.
  std::string name = one.name();
  if (!one.suite.empty() && name.starts_with(one.suite + "/")) name.erase(0, one.suite.size() + 1);
  const bool ran = one.finished || one.end > one.begin;
  return fmt::format(
      "<li id=\"{}\" data-v=\"{}\">\n<p class=\"head\">{} <b>{}</b> {}{}</p>\n{}{}{}</li>\n",
      book.anchor(one), css_class(one.verdict), badge(one.verdict), clipped(name, text_limit),
      clipped(prose(one.title), text_limit),
      ran ? fmt::format(" <span class=\"time\">{}</span>", brief_duration(one.end - one.begin)) : "",
      remarks(book, one), judgements(book, one), cards(book, one));
}

}  // namespace

std::string case_section(const Book& book) {
  const auto& cases = book.run().cases;
  if (cases.empty()) return {};
  std::vector<std::pair<std::string, std::vector<const CaseResult*>>> suites;
  std::map<std::string, std::size_t> known;
  for (const CaseResult& one : cases) {
    const auto [at, fresh] = known.emplace(one.suite, suites.size());
    if (fresh) suites.emplace_back(one.suite, std::vector<const CaseResult*>{});
    suites[at->second].second.push_back(&one);
  }
  std::string out;
  const auto quiet = std::ranges::count_if(cases, [](const CaseResult& one) {
    return one.verdict == Verdict::pass || one.verdict == Verdict::not_applicable;
  });
  if (quiet > 0)
    out += fmt::format(
        "<p class=\"on-paper\">On paper {} left out, passed or not applicable; the page itself has them, and "
        "the list of requirements says which decided.</p>\n",
        quiet == 1 ? "1 case is" : fmt::format("{} cases are", quiet));
  for (const auto& [suite, members] : suites) {
    out += fmt::format("<div class=\"group\">\n<h3>{} <span class=\"quiet\">{}</span></h3>\n",
                       suite.empty() ? "(no suite)" : clipped(suite, text_limit),
                       counted(members.size(), "case"));
    std::vector<std::string> rows;
    for (const auto* one : members) rows.push_back(row(book, *one));
    out += row_lists("cases", rows) + "</div>\n";
  }
  return section("cases", "Cases", out, {"case", "cases"});
}

}  // namespace conform::reports::html
