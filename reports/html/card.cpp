// SPDX-License-Identifier: Apache-2.0
#include "reports/html/card.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/shell_word.hpp"
#include "base/text.hpp"
#include "reports/html/difference.hpp"
#include "reports/html/markup.hpp"
#include "reports/html/timeline.hpp"
#include "reports/phrases.hpp"
#include "reports/text_tools.hpp"
#include "result/properties.hpp"

namespace conform::reports::html {
namespace {

using result::CaseResult;
using result::Finding;
using result::RunResult;
using result::Verdict;

constexpr std::size_t value_limit = 2000;

std::string told(const RunResult& run, std::string_view name) {
  const auto* const value = result::value_of(run, name);
  return value == nullptr ? std::string() : *value;
}

std::string values(const std::vector<std::string>& all) {
  std::string out;
  for (const auto& each : all) out += fmt::format("<li>{}</li>\n", clipped(each, value_limit));
  return out.empty() ? out : fmt::format("<ul class=\"values\">\n{}</ul>\n", out);
}

/// Where one text was expected and a similar one came: the part of it that differs, marked.
std::string actual_text(const Finding& finding) {
  const std::string came = clip(printable(finding.actual), value_limit);
  const std::string wanted = finding.accepts.size() == 1 ? printable(finding.accepts.front()) : std::string();
  // Of "unchanged: "abc"" only the quoted part is a value.
  const auto from = wanted.find('"');
  if (from == std::string::npos || !came.starts_with('"')) return text(came);
  const std::string_view value = std::string_view(wanted).substr(from);
  const auto [begin, end] = shared_ends(came, value);
  if (begin + end < 4 || begin + end >= came.size()) return text(came);
  const std::string_view view = came;
  return fmt::format("{}<mark>{}</mark>{}", text(view.substr(0, begin)),
                     text(view.substr(begin, came.size() - begin - end)),
                     text(view.substr(came.size() - end)));
}

std::string grades(const RunResult& run, const Finding& finding) {
  std::string expected;
  if (!finding.accepts.empty()) expected += "<h5>passes</h5>\n" + values(finding.accepts);
  if (!finding.tolerates.empty()) expected += "<h5>tolerated</h5>\n" + values(finding.tolerates);
  if (!expected.empty())
    expected += fmt::format("<h5>{}</h5>\n<p>{}</p>\n", otherwise_of(run, finding).label,
                            otherwise_of(run, finding).words);
  std::string came = fmt::format("<p class=\"came\">{}</p>\n", actual_text(finding));
  if (!finding.actual_bytes.empty()) {
    came += "<pre>";
    for (const auto& row : byte_rows(finding.actual_bytes)) came += text(row) + "\n";
    came += "</pre>\n";
  }
  return fmt::format("<div class=\"versus\"><div class=\"expected\"><h4>Expected</h4>\n{}</div>"
                     "<div class=\"actual\"><h4>Actual</h4>\n{}</div></div>\n",
                     expected.empty() ? "<p class=\"quiet\">see the rule</p>\n" : expected, came);
}

std::string rule(const Book& book, const Finding& finding) {
  if (finding.requirement.empty()) return "none: this step only prepares the case";
  const auto* info = book.run().requirement(finding.requirement);
  std::string out = fmt::format("<b>{}</b>", book.requirement_link(finding.requirement));
  if (info == nullptr) return out;
  if (!info->clause.empty()) out += ", " + sentence(info->clause);
  if (!info->level.empty()) out += fmt::format(" ({})", sentence(info->level));
  return out + "<br/>" + sentence(info->statement);
}

}  // namespace

std::string repeat_command(const RunResult& run, const CaseResult& one, const std::string& during,
                           const std::string& requirement) {
  std::string out = "canopen-conform run";
  const std::string interface = told(run, "can.interface");
  if (run.started_utc_ns == 0 && (interface.empty() || interface == "simulated")) {
    out += " --simulate";
    for (const char* kind : {"defect", "variant"}) {
      const std::string list = told(run, fmt::format("simulation.{}s", kind));
      for (const auto word : split(list, ' ')) {
        if (!word.empty()) out += fmt::format(" --{} {}", kind, shell_word(word));
      }
    }
  } else {
    if (!interface.empty()) out += " -i " + shell_word(interface);
    if (const auto node = told(run, "dut.node_id"); !node.empty()) out += " -n " + shell_word(node);
  }
  if (const auto description = told(run, "dut.description"); !description.empty())
    out += " --eds " + shell_word(description);
  // The profile of the reference node is taken by itself.
  const auto used = told(run, "input.profile");
  // The digest stands behind its name.
  const auto profile = used.substr(0, used.rfind(' '));
  if (!profile.empty() && !profile.ends_with("devices/reference-node.yaml"))
    out += " --device " + shell_word(profile);
  if (const auto allowed = told(run, "run.allowed"); !allowed.empty())
    out += " --allow " + shell_word(allowed);
  if (const auto seed = told(run, "run.seed"); !seed.empty()) out += " --seed " + shell_word(seed);
  if (one.suite != "monitor") return out + " " + shell_word(one.name());
  // A monitor is no case of its own: it judges whatever goes on, also before the first case.
  if (std::ranges::any_of(run.cases, [&](const CaseResult& each) { return each.name() == during; }))
    return out + " " + shell_word(during);
  return requirement.empty() ? out : out + " -r " + shell_word(requirement);
}

std::string card(const Book& book, const LocatedFinding& located) {
  const Finding& finding = *located.finding;
  const CaseResult& one = *located.owner;
  const std::string position = position_text(finding.position.file.empty() ? one.position : finding.position);
  std::string out = "<dl class=\"facts\">\n";
  out += fact("Rule", rule(book, finding));
  out += fact("Case", fmt::format("{}<br/>{}", book.case_link(one), sentence(one.title)));
  if (!finding.during.empty()) out += fact("During", book.case_link(finding.during));
  out += fact("Before", clipped(join(finding.prepared, "; "), value_limit));
  out += fact("Step", clipped(finding.step, value_limit));
  out += fact("Why", sentence(finding.reason));
  if (!finding.declared_at.empty()) out += fact("Described", text(finding.declared_at));
  if (!one.cct.empty()) out += fact("CiA's tool", "case " + text(join(one.cct, ", ")));
  out += "</dl>\n";
  out += grades(book.run(), finding);
  out += frames(book, one, finding);
  out += "<dl class=\"facts\">\n";
  if (!position.empty()) out += fact("Scenario", fmt::format("<code>{}</code>", text(position)));
  out +=
      fact("Repeat", fmt::format("<code class=\"copy\">{}</code>",
                                 text(repeat_command(book.run(), one, finding.during, finding.requirement))));
  return out + "</dl>\n";
}

}  // namespace conform::reports::html
