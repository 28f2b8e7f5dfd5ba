// SPDX-License-Identifier: Apache-2.0
#include "reports/tap.hpp"

#include <fmt/format.h>

#include "reports/phrases.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports {
namespace {

using result::CaseResult;
using result::RunResult;
using result::Verdict;

/// '#' begins a directive, and '\' escapes it.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : log_safe(text)) {
    if (c == '#' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

/// In double quotes, as YAML reads it.
std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : log_safe(text)) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

std::string waived_reason(const CaseResult& one) {
  for (const auto& judgement : one.judgements) {
    if (!judgement.waived.empty()) return judgement.waived;
  }
  return {};
}

std::string diagnosis(const CaseResult& one) {
  std::string out = "  ---\n  verdict: " + std::string(result::to_string(one.verdict)) + "\n";
  out += "  message: " + quoted(headline(one)) + "\n";
  const auto all = findings_of(one);
  const auto worst = std::ranges::max_element(all, {}, &LocatedFinding::verdict);
  const auto place =
      worst == all.end() ? position_text(one.position) : position_text(worst->finding->position);
  if (worst != all.end() && !worst->finding->requirement.empty())
    out += "  requirement: " + quoted(worst->finding->requirement) + "\n";
  if (!place.empty()) out += "  at: " + quoted(place) + "\n";
  return out + "  ...\n";
}

}  // namespace

std::string tap(const RunResult& run) {
  std::string out = "TAP version 13\n";
  out += fmt::format("1..{}\n", run.cases.size());
  std::size_t number = 0;
  for (const CaseResult& one : run.cases) {
    const auto line = [&](std::string_view word) {
      return fmt::format("{} {} - {}", word, ++number, escaped(one.name()));
    };
    switch (one.verdict) {
      case Verdict::pass: out += line("ok") + "\n"; break;
      case Verdict::warn: out += line("ok") + "\n# warning: " + log_safe(headline(one)) + "\n"; break;
      case Verdict::not_applicable: out += line("ok") + " # SKIP " + escaped(prose(one.reason)) + "\n"; break;
      case Verdict::waived:
        out +=
            line("not ok") + " # todo waived: " + escaped(prose(waived_reason(one))) + "\n" + diagnosis(one);
        break;
      case Verdict::fail:
      case Verdict::inconclusive:
      case Verdict::error: out += line("not ok") + "\n" + diagnosis(one); break;
    }
  }
  if (run.aborted) out += "Bail out! " + escaped(prose(*run.aborted)) + "\n";
  return out;
}

}  // namespace conform::reports
