// SPDX-License-Identifier: Apache-2.0
// The parts of a proof that one asks for, each with the command that gives it where nobody did.
#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"
#include "cli/pages/mutants_page.hpp"
#include "cli/pages/proof_sections.hpp"
#include "cli/proof/blame.hpp"
#include "cli/proof/explained.hpp"
#include "reports/html/document.hpp"
#include "reports/html/markup.hpp"
#include "reports/html/plots.hpp"
#include "reports/text_tools.hpp"

namespace conform::cli {
namespace {

using namespace reports::html;
using reports::counted;
using reports::prose;

constexpr std::size_t text_limit = 300;

/// What is not shown in the open, the rest to unfold.
std::string lists(std::string_view kind, const std::vector<std::string>& open,
                  const std::vector<std::string>& shown, std::string_view words) {
  std::string out;
  if (!open.empty()) out += fmt::format("<div class=\"group\">\n{}</div>\n", row_lists(kind, open));
  if (!shown.empty())
    out += folded(fmt::format("{} {}", shown.size(), words),
                  fmt::format("<div class=\"group\">\n{}</div>\n", row_lists(kind, shown)));
  return out;
}

std::string one_blame(const ProofBook& book, const Blame& blame) {
  std::string out = fmt::format("<p>{} <b>{}</b> led by {}; violates {}</p>\n", badge("warn", "misblamed"),
                                book.defect_link(blame.defect),
                                blame.causes.empty() ? "nothing" : book.rule_links(blame.causes),
                                book.rule_links(blame.violates));
  const auto reason = reason_of_blame(blame.defect);
  out += fmt::format("<p class=\"by\">{}</p>\n", reason ? sentence(*reason) : "why is not known yet");
  std::string items;
  for (const auto& about : blame.about)
    items += fmt::format("<li>{}</li>\n", clipped(prose(about), text_limit));
  if (!items.empty())
    out += folded(fmt::format("{}<span class=\"sr\"> of {}</span>", counted(blame.causes.size(), "cause"),
                              clipped(blame.defect, text_limit)),
                  fmt::format("<ul class=\"list\">\n{}</ul>\n", items));
  return proof_row(shown_kind::look, out);
}

std::string pairs_words(const std::vector<PairBlame>& pairs) {
  if (pairs.empty()) return {};
  std::string rows;
  for (const auto& pair : pairs) {
    if (!pair.swallowed) continue;
    rows += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", clipped(pair.first, text_limit),
                        clipped(pair.second, text_limit), clipped(prose(join(pair.about, "; ")), 1000));
  }
  auto out = fmt::format(
      "<h3>Two faults at once</h3>\n<p>{} of defects of different parts: {} with one fault that the other hides, {} where one "
      "vanished in the other's cause.</p>\n",
      counted(pairs.size(), "pair"), std::ranges::count_if(pairs, &PairBlame::hidden),
      std::ranges::count_if(pairs, &PairBlame::swallowed));
  if (!rows.empty()) out += table("Swallowed pairs", "pairs", {{"defect"}, {"and"}, {"causes"}}, rows);
  return out;
}

struct Score {
  std::string name;
  MutantScore score;
};

std::string scores(std::string_view name, const std::vector<Score>& all) {
  std::string rows;
  for (const auto& [words, score] : all)
    rows += fmt::format(
        "<tr><th scope=\"row\">{}</th>{}{}{}{}{}{}{}{}<td class=\"num\">{:.1f}</td><td class=\"num\">{:.1f}</td></tr>\n",
        clipped(words, text_limit), number_cell(score.all), number_cell(score.not_reached),
        number_cell(score.explained), number_cell(score.killed), number_cell(score.crashed),
        number_cell(score.hung), number_cell(score.noticed), number_cell(score.survived),
        score.share_noticed(), score.share_failed());
  return table(fmt::format("Mutants by {}", name), "areas",
               {{name},
                {"mutants", true},
                {"not reached", true},
                {"explained", true},
                {"failed", true},
                {"crashed", true},
                {"hung", true},
                {"warned only", true},
                {"survived", true},
                {"noticed, %", true},
                {"failed, %", true}},
               rows);
}

std::vector<Score> scores_by(const std::vector<MutantFate>& fates, const auto& group_of) {
  std::map<std::string, MutantScore> groups;
  for (const auto& fate : fates) groups[std::string(group_of(*fate.mutant))].add(fate);
  std::vector<Score> out;
  for (const auto& [name, score] : groups) out.push_back({name, score});
  out.push_back({"all", score_of(fates)});
  return out;
}

std::string one_mutant(const MutantFate& fate, bool survives) {
  std::string out = fmt::format(
      "<p>{} <b>{}</b> {} line {} {}: <code>{}</code> &#x2192; <code>{}</code></p>\n",
      survives ? badge("fail", fate_name(fate.fate)) : badge("warn", fate_name(fate.fate)),
      fate.mutant->number, text(fate.mutant->file), fate.mutant->line, text(fate.mutant->function),
      clipped(fate.mutant->original, text_limit), clipped(fate.mutant->mutated, text_limit));
  for (const auto& each : {fate.how, fate.explained}) {
    if (!each.empty()) out += fmt::format("<p class=\"by\">{}</p>\n", clipped(prose(each), text_limit));
  }
  return proof_row(survives ? shown_kind::open : shown_kind::look, out);
}

}  // namespace

std::string blame_section(const ProofBook& book) {
  const std::string title = "Blame: one fault, one cause";
  if (!book.proof().has_blame || !book.proof().matrix)
    return section("blame", title, not_asked("canopen-conform selftest --blame --html proof.html"));
  const auto& blames = book.proof().matrix->blames;
  const auto right = static_cast<std::size_t>(std::ranges::count_if(blames, &Blame::single_and_right));
  const auto several =
      std::ranges::count_if(blames, [](const Blame& each) { return each.causes.size() > 1; });
  std::vector<std::string> rows;
  for (const auto& blame : blames) {
    if (!blame.single_and_right()) rows.push_back(one_blame(book, blame));
  }
  const double share =
      blames.empty() ? 100.0 : 100.0 * static_cast<double>(right) / static_cast<double>(blames.size());
  auto out = fmt::format(
      "<p>The whole suite is run against each defect alone; its findings should be one cause, and the requirement named first one "
      "that the defect violates. That is so for <b>{} of {}</b> ({:.1f} %); {} show several causes.</p>\n",
      right, counted(blames.size(), "defect"), share, several);
  const auto named = std::ranges::count_if(blames, &Blame::is_recognised);
  out += fmt::format(
      "<p>At a cause of their runs <b>{} of {}</b> are named, among at most a few known defects that would show alike.</p>\n",
      named, counted(blames.size(), "defect"));
  out += lists("blames", rows, {}, "");
  return section("blame", title, out + pairs_words(book.proof().matrix->pairs),
                 {"misblamed defect", "misblamed defects"});
}

std::string variant_section(const ProofBook& book) {
  const std::string title = "Legal variants: right devices that are different";
  if (!book.proof().variants)
    return section("variants", title, not_asked("canopen-conform selftest --variants --html proof.html"));
  std::vector<std::string> open, shown;
  for (const auto& each : *book.proof().variants) {
    const bool clean = each.complaints.empty();
    std::string out = fmt::format("<p>{} <b>{}</b> {} <span class=\"quiet\">{}</span></p>\n",
                                  clean ? badge("pass", "never failed") : badge("fail", "held against it"),
                                  clipped(each.id, text_limit), clipped(prose(each.summary), text_limit),
                                  clipped(prose(each.legal), text_limit));
    for (const auto& complaint : each.complaints)
      out += fmt::format("<p class=\"by\">{}</p>\n", clipped(prose(complaint.what), text_limit));
    (clean ? shown : open).push_back(proof_row(clean ? shown_kind::shown : shown_kind::open, out));
  }
  const auto words = fmt::format(
      "<p>The whole suite is run against each of {} of the reference node alone: no requirement may fail or stay undecided, and "
      "only what the catalogue tolerates warns. <b>{}</b> are held against the node.</p>\n",
      counted(book.proof().variants->size(), "legal variant"), open.size());
  return section("variants", title, words + lists("variants", open, shown, "never failed"),
                 {"legal variant", "legal variants"});
}

std::string edit_section(const ProofBook& book) {
  const std::string title = "Edits of the dictionary";
  if (!book.proof().edits)
    return section("edits", title, not_asked("canopen-conform selftest --edits --html proof.html"));
  std::vector<std::string> open, shown;
  for (const auto& edit : book.proof().edits->edits) {
    const bool survives = edit.noticed_by.empty();
    std::string out = fmt::format("<p>{} <b>{}</b> {}</p>\n",
                                  survives ? badge("fail", "survives") : badge("pass", "noticed"),
                                  clipped(edit.id, text_limit), clipped(prose(edit.summary), text_limit));
    if (!survives)
      out += fmt::format("<p class=\"by\">by {}</p>\n", clipped(join(edit.noticed_by, ", "), text_limit));
    (survives ? open : shown).push_back(proof_row(survives ? shown_kind::open : shown_kind::shown, out));
  }
  const auto words = fmt::format(
      "<p>Every entry of the dictionary is made wrong in every way: absent, of another length, access or default. "
      "<b>{} of {}</b> are noticed.</p>\n",
      shown.size(), counted(book.proof().edits->edits.size(), "edit"));
  return section("edits", title, words + lists("edits", open, shown, "noticed"), {"edit", "edits"});
}

std::string mutant_section(const ProofBook& book) {
  const std::string title = "Mutants: small mistakes at every place";
  if (!book.proof().mutants)
    return section("mutants", title,
                   not_asked("canopen-conform-mutants selftest --mutants --html proof.html"));
  const auto& fates = *book.proof().mutants;
  const auto sum = score_of(fates);
  auto out = fmt::format(
      "<p>A mutant is made by a program: another comparison, another constant, a statement less, at any place of the reference "
      "node. <b>{} of {}</b> are noticed ({:.1f} %); of those that still run as a node {:.1f} % by a failure. The others are not "
      "reached, or nobody could see them, or no rule forbids them, which is explained for each.</p>\n",
      sum.judged - sum.survived, counted(sum.judged, "mutant"), sum.share_noticed(), sum.share_failed());
  out += "<h3>By part of the node</h3>\n" +
         scores("part", scores_by(fates, [](const Mutant& each) { return each.room(); }));
  out += "<h3>By operator</h3>\n" +
         scores("operator", scores_by(fates, [](const Mutant& each) { return each.kind; }));
  std::vector<std::string> open, look;
  for (const auto& fate : fates) {
    const bool is_explained = !fate.explained.empty() && !fate.explained.starts_with("open:");
    if (fate.fate == Fate::survived && !is_explained) open.push_back(one_mutant(fate, true));
    if (is_explained || fate.fate == Fate::noticed) look.push_back(one_mutant(fate, false));
  }
  if (!open.empty()) out += "<h3>Survivors that a rule forbids</h3>\n";
  out += lists("mutants", open, look, "explained, or noticed without a failure");
  if (!book.proof().stale.empty()) {
    std::string items;
    for (const auto& line : book.proof().stale)
      items += fmt::format("<li>{}</li>\n", clipped(line, text_limit));
    out += fmt::format("<h3>Explanations that explain nobody</h3>\n<ul class=\"list\">\n{}</ul>\n", items);
  }
  return section("mutants", title, out, {"mutant", "mutants"});
}

std::string throughput_section(const ProofBook& book) {
  if (book.proof().throughput.empty()) return {};
  std::string rows;
  for (const auto& [kind, one] : book.proof().throughput) {
    const double share = one.share_of_limit();
    rows += fmt::format(
        "<tr><th scope=\"row\">{}</th>{}{}<td class=\"num\">{}</td><td class=\"num\">{:.0f}</td><td class=\"num\">{:.1f}</td>"
        "<td>{}</td></tr>\n",
        transfer_name(kind), number_cell(one.bytes), number_cell(one.frames),
        reports::brief_duration(one.elapsed), static_cast<double>(one.bytes) / one.seconds(), 100 * share,
        length_bar(share));
  }
  return section(
      "throughput", "Throughput of transfers",
      "<p class=\"quiet\">In virtual time, at 1 Mbit/s, against the reference node: what keeps the bus idle is the "
      "harness.</p>\n" +
          table("SDO transfers", "ranges",
                {{"transfer"},
                 {"bytes", true},
                 {"frames", true},
                 {"bus time", true},
                 {"bytes/s", true},
                 {"of what the frames allow, %", true},
                 {"<span class=\"sr\">drawn</span>"}},
                rows));
}

}  // namespace conform::cli
