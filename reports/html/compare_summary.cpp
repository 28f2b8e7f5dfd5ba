// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "reports/html/bar.hpp"
#include "reports/html/compare_sections.hpp"
#include "reports/html/facts.hpp"
#include "reports/html/markup.hpp"
#include "reports/phrases.hpp"
#include "reports/tally.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports::html {
namespace {

using result::Comparison;
using result::RunResult;

constexpr std::size_t value_limit = 300;

std::string_view kind_of(const Outcome& outcome, const Comparison& comparison) {
  if (outcome.code == 1) return "fail";
  if (outcome.code != 0) return "inconclusive";
  return comparison.new_causes.empty() && (comparison.is_same() || !comparison.gone_causes.empty()) ? "pass"
                                                                                                    : "warn";
}

std::string capital(std::string_view words) {
  std::string out(words);
  if (!out.empty() && out.front() >= 'a' && out.front() <= 'z')
    out.front() = static_cast<char>(out.front() - 'a' + 'A');
  return out;
}

std::string_view code_words(int code) {
  switch (code) {
    case 0: return "Exit code 0: nothing that the new run judged is worse than in the old one.";
    case 1: return "Exit code 1: the new run has what the old one did not have.";
    default:
      return "Exit code 3: nothing is known to be worse, but what the old run judged could not be judged again.";
  }
}

/// How many there are of each kind of difference, each with the way to it.
std::string numbers(const Comparison& comparison) {
  struct Number {
    std::string_view section, one, many;
    std::size_t count;
  };
  const Number all[]{
      {"new", "cause is new", "causes are new", comparison.new_causes.size()},
      {"gone", "cause is gone", "causes are gone", comparison.gone_causes.size()},
      {"turned", "requirement is worse", "requirements are worse", comparison.worse.size()},
      {"turned", "requirement is better", "requirements are better", comparison.better.size()},
      {"turned", "requirement is no longer judged", "requirements are no longer judged",
       comparison.lost.size()},
      {"turned", "requirement is now judged as well", "requirements are now judged as well",
       comparison.gained.size()},
      {"answers", "answer is another one", "answers are other ones", comparison.observed.size()},
      {"answers", "scenario was tried for other objects", "scenarios were tried for other objects",
       comparison.instances.size()},
      {"dictionary", "entry differs", "entries differ", comparison.entries.size()},
      {"times", "time differs", "times differ", comparison.times.size()}};
  std::string out;
  for (const auto& each : all) {
    if (each.count > 0)
      out += fmt::format("<li><b>{}</b> {}</li>\n", each.count,
                         link(each.section, each.count == 1 ? each.one : each.many));
  }
  return out.empty() ? out : fmt::format("<h2>Differences</h2>\n<ul class=\"list\">\n{}</ul>\n", out);
}

std::string shares(std::string_view words, const RunResult& run) {
  const AreaTally total = sum(tally_by_area(run));
  return fmt::format("<h2>{}: {}</h2>\n{}{}", words,
                     counted(total.counts.total() + total.not_judged, "requirement"), bar(total.counts),
                     count_badges(total.counts, total.not_judged));
}

std::string verdict_card(const Compared& page) {
  const auto outcome = outcome_of(page.comparison, page.options.strict);
  std::string out = fmt::format(
      "<div class=\"verdict {}\">\n<p class=\"word\"><span class=\"shape\" aria-hidden=\"true\"></span>{}</p>\n",
      kind_of(outcome, page.comparison), capital(outcome.head));
  for (const auto& part : outcome.parts) out += fmt::format("<p>{}.</p>\n", text(capital(part)));
  out += fmt::format("<p>{}</p>\n", code_words(outcome.code));
  return out + numbers(page.comparison) + shares("Old", page.before.run()) + shares("New", page.after.run()) +
         "</div>\n";
}

std::string cause_list(const Compared& page) {
  std::string items;
  const auto& causes = page.comparison.new_causes;
  for (std::size_t i = 0; i < causes.size(); ++i) {
    const auto& finding = *causes[i].fresh.front().finding;
    items += fmt::format("<li>{} <a href=\"#new-{}\">{}</a> <span class=\"quiet\">{}</span><br/>{}</li>\n",
                         badge(causes[i].verdict), i + 1, clipped(causes[i].cause.about, 200),
                         clipped(finding.requirement, 100), clipped(headline(finding), 200));
  }
  if (items.empty()) return {};
  return fmt::format("<div class=\"panel\">\n<h2>New causes</h2>\n<ol class=\"causes\">\n{}</ol>\n</div>\n",
                     items);
}

/// Facts of both runs; those that differ say so in words, those that do not are said once.
std::string both(const Compared& page) {
  auto facts = facts_of(page.before.run(), page.after.run());
  facts.insert(facts.begin(), {"file", "Result", page.options.old_name, page.options.new_name});
  const auto shown = [](const std::string& value) {
    return value.empty() ? std::string("<span class=\"quiet\">(not there)</span>")
                         : clipped(value, value_limit);
  };
  std::string rows;
  for (const auto& each : facts) {
    if (each.before.empty() && each.after.empty()) continue;
    const auto label = sentence(each.label);
    rows += each.differs()
                ? fmt::format(
                      "<tr class=\"other\"><th scope=\"row\">{} <span class=\"b other\">differs</span></th>"
                      "<td>{}</td><td>{}</td></tr>\n",
                      label, shown(each.before), shown(each.after))
                : fmt::format("<tr><th scope=\"row\">{}</th><td colspan=\"2\">{}</td></tr>\n", label,
                              shown(each.after));
  }
  return table("What was compared", "both", {{"<span class=\"sr\">fact</span>"}, {"old"}, {"new"}}, rows);
}

}  // namespace

Compared::Compared(const Comparison& of, const CompareOptions& how)
    : comparison(of),
      options(how),
      before(*of.before, {}, Extent::excerpt, "old"),
      after(*of.after, {}, Extent::excerpt, "now") {}

std::string compared_summary(const Compared& page) {
  const auto& before = page.before.run().device;
  const auto& after = page.after.run().device;
  const auto name = [](const std::string& device) {
    return device.empty() ? std::string("a device without a name") : clipped(prose(device), 200);
  };
  std::string out =
      fmt::format("<section id=\"summary\" aria-labelledby=\"title\">\n<h1 id=\"title\">{}</h1>\n",
                  before == after ? fmt::format("{}: two runs", name(after))
                                  : fmt::format("{}, compared with {}", name(after), name(before)));
  out += "<div class=\"first\">\n<div>\n" + verdict_card(page) + cause_list(page) + "</div>\n";
  out +=
      fmt::format("<div class=\"panel tested\">\n<h2>What was compared</h2>\n{}</div>\n</div>\n", both(page));
  out +=
      "<p class=\"quiet\">What merely jitters is no difference: times by chance, counts of frames, what a device "
      "counts or measures by itself.</p>\n";
  return out + "</section>\n";
}

}  // namespace conform::reports::html
