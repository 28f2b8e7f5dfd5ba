// SPDX-License-Identifier: Apache-2.0
#include "cli/pages/proof_words.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "cli/proof/blame.hpp"

namespace conform::cli {

std::string matrix_words(const KillMatrix& matrix, bool verbose, bool is_part) {
  const auto counts = matrix.conformant.counts();
  std::string out = fmt::format(
      "conformant node: {} pass, {} warn, {} fail, {} inconclusive, {} error, {} not applicable\n",
      counts.pass, counts.warn, counts.fail, counts.inconclusive, counts.error, counts.not_applicable);
  for (const auto& each : matrix.conformant.cases) {
    using result::Verdict;
    if (each.verdict == Verdict::pass || each.verdict == Verdict::not_applicable) continue;
    out += fmt::format("  {} {} {}\n", to_string(each.verdict), each.name(), each.reason);
    for (const auto& judgement : each.judgements) {
      for (const auto& finding : judgement.findings) {
        out += fmt::format("    {} {}: {} -> {} ({})\n", judgement.requirement, to_string(finding.verdict),
                           finding.step, finding.actual, finding.reason);
      }
    }
    for (const auto& finding : each.setup_findings)
      out += fmt::format("    set-up: {} -> {}\n", finding.step, finding.actual);
  }
  for (const auto& note : matrix.conformant.notes) out += "  note: " + note + "\n";
  for (const auto& defect : matrix.defects) {
    const bool killed = !defect.killed_by.empty();
    if (killed && !verbose) continue;
    out += fmt::format("{} {}: {}\n", killed ? "killed  " : "SURVIVES", defect.id, defect.summary);
    out += fmt::format("    violates {}\n", join(defect.violates, ", "));
    for (const auto& how : defect.killed_by) out += "    by " + how + "\n";
    if (!defect.bystanders.empty()) out += "    also worse: " + join(defect.bystanders, ", ") + "\n";
    for (const auto& id : defect.unknown) out += "    unknown requirement " + id + "\n";
  }
  out += fmt::format("{} of {} defects killed; {} requirements proven, {} judged but unproven\n",
                     matrix.defects.size() - matrix.survivors().size(), matrix.defects.size(),
                     matrix.proven.size(), matrix.unproven.size());
  if (verbose && !is_part && !matrix.unproven.empty())
    out += "unproven: " + join(matrix.unproven, ", ") + "\n";
  return out;
}

std::string blame_words(const std::vector<Blame>& blames, bool verbose) {
  std::string out;
  std::size_t right = 0, several = 0;
  for (const auto& blame : blames) {
    if (blame.single_and_right()) ++right;
    if (blame.causes.size() > 1) ++several;
    if (blame.single_and_right() && !verbose) continue;
    out += fmt::format("{} {}: {}\n", blame.single_and_right() ? "blamed  " : "MISBLAMED", blame.defect,
                       join(blame.causes, ", "));
    for (const auto& about : blame.about) out += "    " + about + "\n";
    if (const auto reason = reason_of_blame(blame.defect)) out += fmt::format("    why: {}\n", *reason);
  }
  return out +
         fmt::format(
             "{} of {} defects ({:.1f} %) show one cause whose first rule they violate; {} show several\n",
             right, blames.size(), 100.0 * static_cast<double>(right) / static_cast<double>(blames.size()),
             several);
}

std::string recognised_words(const std::vector<Blame>& blames, bool verbose) {
  std::string out;
  std::size_t recognised = 0, first = 0;
  for (const auto& blame : blames) {
    if (blame.is_recognised()) ++recognised;
    if (!blame.named.empty() && blame.named.front() == blame.defect) ++first;
    if (verbose && !blame.is_recognised())
      out += fmt::format("NOT NAMED {}: {}\n", blame.defect,
                         blame.named.empty() ? "nothing" : join(blame.named, ", "));
  }
  const auto share = [&blames](std::size_t count) {
    return 100.0 * static_cast<double>(count) / static_cast<double>(blames.size());
  };
  return out + fmt::format("{} of {} defects ({:.1f} %) are named by their patterns, {} ({:.1f} %) first\n",
                           recognised, blames.size(), share(recognised), first, share(first));
}

std::string pair_words(const std::vector<PairBlame>& pairs) {
  std::string out;
  for (const auto& pair : pairs) {
    if (!pair.swallowed) continue;
    out += fmt::format("SWALLOWED {} + {}\n", pair.first, pair.second);
    for (const auto& about : pair.about) out += "    " + about + "\n";
  }
  return out +
         fmt::format("{} pairs of defects: {} of them with one fault that the other hides, {} swallowed\n",
                     pairs.size(), std::ranges::count_if(pairs, &PairBlame::hidden),
                     std::ranges::count_if(pairs, &PairBlame::swallowed));
}

std::string edit_words(const EditMatrix& matrix, bool verbose) {
  std::string out;
  for (const auto& edit : matrix.edits) {
    const bool survives = edit.noticed_by.empty();
    if (survives || verbose)
      out += fmt::format("{} {}: {}\n", survives ? "SURVIVES" : "noticed ", edit.id, edit.summary);
    if (!survives && verbose) out += "    by " + join(edit.noticed_by, ", ") + "\n";
  }
  const auto survivors = matrix.survivors().size();
  return out + fmt::format("{} of {} edits of the dictionary noticed\n", matrix.edits.size() - survivors,
                           matrix.edits.size());
}

std::string variant_words(const std::vector<VariantVerdict>& variants, bool verbose) {
  std::string out;
  std::size_t clean = 0;
  for (const auto& each : variants) {
    if (each.complaints.empty()) ++clean;
    if (each.complaints.empty() && !verbose) continue;
    out += fmt::format("{} {}: {}\n", each.complaints.empty() ? "right " : "FAILED", each.id, each.summary);
    for (const auto& complaint : each.complaints)
      out += fmt::format("    {}\n{}", complaint.what, complaint.details);
  }
  return out + fmt::format("{} of {} legal variants are never failed\n", clean, variants.size());
}

std::string proof_markdown(const KillMatrix& matrix) {
  std::string out =
      "# Proof: what each defect of the reference node is caught by\n\n"
      "Generated by `canopen-conform selftest --markdown`; a test checks that it is up to date. A defect counts as caught\n"
      "only by the expectation of a requirement it violates.\n\n"
      "| defect | what is wrong | caught by |\n|---|---|---|\n";
  for (const auto& defect : matrix.defects) {
    out += fmt::format("| `{}` | {} | {} |\n", defect.id, defect.summary,
                       defect.proves.empty() ? "**nothing**" : join(defect.proves, ", "));
  }
  if (matrix.unproven.empty()) {
    out += "\n## Unproven requirements (0)\n\nA defect proves each requirement that the suite judges.\n";
    return out;
  }
  out += fmt::format(
      "\n## Unproven requirements ({})\n\nJudged by the suite, but no defect proves the judgement yet:\n\n",
      matrix.unproven.size());
  for (const auto& id : matrix.unproven) out += "- " + id + "\n";
  return out;
}

std::string blame_page(const KillMatrix& matrix) {
  const auto right = std::ranges::count_if(matrix.blames, &Blame::single_and_right);
  auto out = fmt::format(
      "# Blame: one fault, one cause\n\n"
      "Generated by `canopen-conform selftest --blame --blame-page`. The whole suite is run against each defect of the reference node\n"
      "alone; its findings should be [one cause](decisions/0002-one-cause-one-finding.md), and the rule named first one that the defect breaks.\n"
      "That is so for {} of {} defects ({:.1f} %). These are the others.\n\n"
      "| defect | causes, by their first rule | why |\n|---|---|---|\n",
      right, matrix.blames.size(),
      100.0 * static_cast<double>(right) / static_cast<double>(matrix.blames.size()));
  for (const auto& blame : matrix.blames) {
    if (blame.single_and_right()) continue;
    out += fmt::format("| `{}` | {} | {} |\n", blame.defect, join(blame.causes, ", "),
                       reason_of_blame(blame.defect).value_or("not known yet"));
  }
  return out;
}

}  // namespace conform::cli
