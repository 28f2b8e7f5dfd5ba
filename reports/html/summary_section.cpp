// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"
#include "reports/html/bar.hpp"
#include "reports/html/facts.hpp"
#include "reports/html/markup.hpp"
#include "reports/html/outcomes.hpp"
#include "reports/html/sections.hpp"
#include "reports/phrases.hpp"
#include "reports/text_tools.hpp"
#include "result/properties.hpp"

namespace conform::reports::html {
namespace {

using result::RunResult;

/// "7 requirements; what was found has 3 causes"
std::string violated_words(const Book& book) {
  const auto violated = sum(tally_by_area(book.run())).counts.fail;
  if (violated == 0) return "The device violates at least one requirement.";
  return fmt::format(
      "The device violates {}; what was found comes from {}, as far as can be told from outside.",
      counted(violated, "requirement"), counted(book.causes().size(), "cause"));
}

/// What must not be taken for a verdict about a product.
std::string simulation_words(const RunResult& run) {
  const auto* defects = result::value_of(run, "simulation.defects");
  if (defects == nullptr || defects->empty()) return {};
  return fmt::format(
      "<p><b>No product was tested:</b> this is the simulated reference node with {} switched on.</p>\n",
      counted(split(*defects, ' ').size(), "known defect"));
}

std::string verdict_sentence(const Book& book, int code) {
  const RunResult& run = book.run();
  switch (code) {
    case 0:
      if (const auto waived = run.waived(); !waived.empty())
        return fmt::format("What was judged conforms, but for {} accepted as known: {}.",
                           counted(waived.size(), "violated requirement"), text(join(waived, ", ")));
      return "Everything that was judged conforms.";
    case 1: return violated_words(book);
    case 2:
      return run.without_time() ? "Nothing that was selected fits into the budget, so nothing was judged."
                                : "Nothing selected applies to this device, so nothing was judged.";
    case 3:
      return run.aborted ? "The run stopped early. No requirement is known to be violated."
                         : "No requirement is known to be violated, but not everything could be judged.";
    default: return "The run was interrupted; this is what it had found until then.";
  }
}

struct Banner {
  std::string_view kind, words;
};

Banner banner_of(const RunResult& run, int code) {
  switch (code) {
    case 0:
      return run.waived().empty() ? Banner{"pass", "Conforms"} : Banner{"warn", "Conforms, with waivers"};
    case 1: return {"fail", "Does not conform"};
    case 2: return {"inconclusive", "Nothing was judged"};
    default: return {"inconclusive", "Not fully judged"};
  }
}

std::string verdict_card(const Book& book) {
  const RunResult& run = book.run();
  const int code = result::exit_code(run);
  const auto [kind, words] = banner_of(run, code);
  const AreaTally total = sum(tally_by_area(run));
  std::string out = fmt::format(
      "<div class=\"verdict {}\">\n<p class=\"word\"><span class=\"shape\" aria-hidden=\"true\"></span>{}</p>\n<p>{}</p>\n",
      kind, words, verdict_sentence(book, code));
  out += simulation_words(run);
  if (run.aborted)
    out += fmt::format("<p><b>Stopped early:</b> {}</p>\n", clipped(prose(*run.aborted), 1000));
  out += fmt::format("<h2>{}</h2>\n{}{}", counted(total.counts.total() + total.not_judged, "requirement"),
                     bar(total.counts), count_badges(total.counts, total.not_judged));
  out += fmt::format("<h2>{}</h2>\n{}{}", counted(run.cases.size(), "case"), bar(run.counts()),
                     count_badges(run.counts()));
  return out + "</div>\n";
}

std::string facts(const RunResult& run) {
  std::string out;
  for (const auto& each : facts_of(run)) {
    const auto value = clipped(each.value, 1000);
    // Features by the dozen would push everything else off the first screen.
    if (each.name == "input.claims") {
      out += fact(sentence(each.label), folded("which, and by which file", "<p>" + value + "</p>\n"));
    } else {
      out += fact(sentence(each.label), value);
    }
  }
  return out;
}

std::string causes_list(const Book& book) {
  if (book.causes().empty()) return {};
  std::string items;
  for (const auto& cause : book.causes()) {
    const auto& finding = *cause.primary.finding;
    const auto known = likenesses(book.run(), cause);
    const auto like =
        known.empty()
            ? std::string()
            : fmt::format("<br/><span class=\"quiet\">Looks like <code>{}</code>: {}</span>",
                          clipped(known.front()->name, 100), clipped(prose(known.front()->summary), 200));
    items += fmt::format("<li>{} <a href=\"#{}\">{}</a> <span class=\"quiet\">{}, {}</span><br/>{}{}</li>\n",
                         badge(cause.verdict), book.anchor(cause), clipped(cause.about, 200),
                         clipped(finding.requirement, 100), text(extent(cause)),
                         clipped(headline(finding), 200), like);
  }
  return fmt::format(
      "<div class=\"panel\">\n<h2>Causes, the heaviest first</h2>\n<ol class=\"causes\">\n{}</ol>\n</div>\n",
      items);
}

/// The outcomes of the other tool counted, and where they are told one by one.
std::string compared_panel(const Book& book) {
  const auto& compared = book.run().compared;
  if (compared.empty()) return {};
  std::string counts;
  for (const std::string_view outcome : outcomes_of_the_other_tool()) {
    const auto number = std::ranges::count(compared, outcome, &result::ComparedCase::outcome);
    if (number > 0) counts += fmt::format("<li><b>{}</b> {}</li>\n", number, outcome_badge(outcome));
  }
  return fmt::format("<div class=\"panel\">\n<h2>{}</h2>\n<ul class=\"counts\">\n{}</ul>\n</div>\n",
                     link("compared", "What CiA's tool would say"), counts);
}

/// What would have more judged, the most rewarding first.
std::string wants_panel(const RunResult& run) {
  const auto wants = tally_wants(run);
  const auto counts = run.counts();
  if (counts.not_applicable == 0) return {};
  constexpr std::size_t shown = 4;
  std::string items;
  for (std::size_t i = 0; i < std::min(wants.size(), shown); ++i)
    items += fmt::format("<li><b>{}</b>: {}</li>\n", counted(wants[i].cases, "case"),
                         clipped(prose(wants[i].want.text), 200));
  if (wants.size() > shown) items += fmt::format("<li>and {} more</li>\n", wants.size() - shown);
  const auto title = items.empty()
                         ? fmt::format("{} not applicable, and why", counted(counts.not_applicable, "case"))
                         : std::string("What to give to have more judged");
  return fmt::format("<div class=\"panel\">\n<h2>{}</h2>\n{}</div>\n", link("coverage", title),
                     items.empty() ? items : fmt::format("<ul class=\"list\">\n{}</ul>\n", items));
}

}  // namespace

std::string summary_section(const Book& book) {
  const RunResult& run = book.run();
  std::string out =
      fmt::format("<section id=\"summary\" aria-labelledby=\"title\">\n<h1 id=\"title\">{}</h1>\n",
                  run.device.empty() ? "CANopen conformance" : clipped(prose(run.device), 200));
  out += "<div class=\"first\">\n<div>\n" + verdict_card(book) + causes_list(book) + compared_panel(book) +
         wants_panel(run) + "</div>\n";
  out += fmt::format(
      "<div class=\"panel tested\">\n<h2>What was tested</h2>\n<dl class=\"facts\">\n{}</dl>\n</div>\n</div>\n",
      facts(run));
  if (!run.notes.empty() || !run.unwritten.empty()) {
    out += "<ul class=\"notes\">\n";
    for (const auto& note : run.notes) out += fmt::format("<li>{}</li>\n", clipped(prose(note), 1000));
    for (const auto& each : run.unwritten)
      out += fmt::format("<li>not written: {}</li>\n", clipped(each, 1000));
    out += "</ul>\n";
  }
  out +=
      "<p class=\"quiet\">This report comes from a test against CiA 301. It is no certificate, and none of CiA.</p>\n";
  return out + "</section>\n";
}

}  // namespace conform::reports::html
