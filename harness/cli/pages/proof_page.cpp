// SPDX-License-Identifier: Apache-2.0
#include "cli/pages/proof_page.hpp"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "cli/pages/mutants_page.hpp"
#include "cli/pages/proof_sections.hpp"
#include "reports/html/bar.hpp"
#include "reports/html/document.hpp"
#include "reports/html/facts.hpp"
#include "reports/html/markup.hpp"
#include "reports/text_tools.hpp"

namespace conform::cli {
namespace {

using namespace reports::html;
using reports::counted;

/// One line of the summary: what was shown, and whether all of it was.
struct Claim {
  bool holds = false;
  std::string_view section;
  std::string words;
};

std::vector<Claim> claims_of(const ProofBook& book) {
  const Proof& proof = book.proof();
  std::vector<Claim> out;
  if (proof.matrix) {
    const auto& matrix = *proof.matrix;
    const auto counts = matrix.conformant.counts();
    out.push_back(
        {counts.fail + counts.warn + counts.inconclusive + counts.error == 0, "defects",
         fmt::format("the conformant node: {} pass, {} warn, {} fail, {} inconclusive, {} not applicable",
                     counts.pass, counts.warn, counts.fail, counts.inconclusive + counts.error,
                     counts.not_applicable)});
    const auto survivors = matrix.survivors().size();
    out.push_back({survivors == 0, "defects",
                   fmt::format("{} of {} killed by a requirement that they violate",
                               matrix.defects.size() - survivors, counted(matrix.defects.size(), "defect"))});
    if (!proof.is_part)
      out.push_back({matrix.unproven.empty(), "rules",
                     fmt::format("{} proven, {} judged but unproven",
                                 counted(matrix.proven.size(), "requirement"), matrix.unproven.size())});
  }
  if (proof.matrix && proof.has_blame) {
    const auto& blames = proof.matrix->blames;
    const auto right = static_cast<std::size_t>(std::ranges::count_if(blames, &Blame::single_and_right));
    out.push_back({right == blames.size(), "blame",
                   fmt::format("{} of {} show one cause, led by a requirement that they violate", right,
                               counted(blames.size(), "defect"))});
  }
  if (proof.variants) {
    const auto clean = static_cast<std::size_t>(std::ranges::count_if(
        *proof.variants, [](const VariantVerdict& each) { return each.complaints.empty(); }));
    out.push_back(
        {clean == proof.variants->size(), "variants",
         fmt::format("{} of {} are never failed", clean, counted(proof.variants->size(), "legal variant"))});
  }
  if (proof.edits) {
    const auto survivors = proof.edits->survivors().size();
    out.push_back({survivors == 0, "edits",
                   fmt::format("{} of {} of the dictionary noticed", proof.edits->edits.size() - survivors,
                               counted(proof.edits->edits.size(), "edit"))});
  }
  if (proof.mutants) {
    const auto score = score_of(*proof.mutants);
    out.push_back({score.survived == 0, "mutants",
                   fmt::format("{} of {} noticed ({:.1f} %)", score.judged - score.survived,
                               counted(score.judged, "mutant"), score.share_noticed())});
  }
  return out;
}

std::string facts(const Proof& proof) {
  const auto add = [](std::string_view label, const std::string& value) {
    return fact(label, clipped(value, 500));
  };
  std::string out = add("Tool", proof.tool);
  for (const auto& each : proof.suites)
    out += add(each.name == "suite.digest" ? "Digest of the suite" : "Own scenarios", each.value);
  out += add("Seed", std::to_string(proof.seed));
  if (proof.started_utc_ns != 0) out += add("Started", reports::utc_timestamp(proof.started_utc_ns));
  out += add("Exit code", std::to_string(proof.exit_code));
  return out + fact("Command", fmt::format("<code class=\"copy\">{}</code>", text(proof.command)));
}

std::vector<Choice> choices_of(const std::string& content) {
  const auto count = [&](std::string_view value) {
    const auto part = fmt::format(" data-v=\"{}\"", value);
    std::size_t found = 0;
    for (auto at = content.find(part); at != std::string::npos; at = content.find(part, at + 1)) ++found;
    return found;
  };
  std::vector<Choice> out;
  for (const auto& [value, kind, words] : {std::tuple(shown_kind::open, "fail", "not shown"),
                                           std::tuple(shown_kind::look, "warn", "to be looked at"),
                                           std::tuple(shown_kind::shown, "pass", "shown")}) {
    if (const auto rows = count(value); rows > 0) out.push_back({value, kind, words, rows});
  }
  return out;
}

}  // namespace

std::string proof_summary(const ProofBook& book) {
  const Proof& proof = book.proof();
  const auto claims = claims_of(book);
  const bool holds = std::ranges::all_of(claims, &Claim::holds);
  // Some deviations are known and explained: the exit code says whether it is enough.
  const std::string_view kind = proof.exit_code != 0 ? "fail" : holds ? "pass" : "warn";
  const std::string_view word = proof.exit_code != 0 ? "Not proven"
                                : holds              ? "Proven"
                                                     : "Proven, with known exceptions";
  std::string items;
  for (const auto& claim : claims)
    items += fmt::format(
        "<li>{} {}</li>\n",
        claim.holds ? badge("pass", "holds") : badge(proof.exit_code != 0 ? "fail" : "warn", "not all"),
        link(claim.section, claim.words));
  std::string out =
      "<section id=\"summary\" aria-labelledby=\"title\">\n<h1 id=\"title\">What the suite is proven to find</h1>\n"
      "<div class=\"first\">\n<div>\n";
  out += fmt::format(
      "<div class=\"verdict {}\">\n<p class=\"word\"><span class=\"shape\" aria-hidden=\"true\"></span>{}</p>\n"
      "<p>A suite can be wrong in two ways: it passes a wrong device, or it fails a right one. It was run against the "
      "reference node, which conforms, and against the same node made wrong on purpose.{}</p>\n<ul class=\"claims\">\n{}</ul>\n</div>\n",
      kind, word, proof.is_part ? " Only a part was asked for." : "", items);
  out += fmt::format(
      "</div>\n<div class=\"panel tested\">\n<h2>What was run</h2>\n<dl class=\"facts\">\n{}</dl>\n</div>\n</div>\n",
      facts(proof));
  return out + "</section>\n";
}

std::string proof_page(const Proof& proof) {
  const ProofBook book(proof);
  Document page;
  page.title = "What the suite is proven to find";
  page.brand = "CANopen conformance, proof";
  page.generator = clipped(proof.tool, 200);
  page.footer = fmt::format("{}, seed {}.", page.generator, proof.seed);
  page.parts = {{"summary", "Summary", proof_summary(book)},
                {"areas", "Areas", area_section(book)},
                {"blame", "Blame", blame_section(book)},
                {"variants", "Legal variants", variant_section(book)},
                {"edits", "Edits", edit_section(book)},
                {"mutants", "Mutants", mutant_section(book)},
                {"throughput", "Throughput", throughput_section(book)},
                {"rules", "Requirements", rule_section(book)},
                {"defects", "Defects", defect_section(book)}};
  std::string content;
  for (const auto& part : page.parts) content += part.content;
  page.filter = {"requirements, defects, edits and mutants", "outcomes", "defect, requirement, case, area",
                 choices_of(content)};
  return document(page);
}

}  // namespace conform::cli
