// SPDX-License-Identifier: Apache-2.0
#include "cli/proof/explained.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "base/files.hpp"
#include "base/text.hpp"

namespace conform::cli {
namespace {

constexpr std::array reasons{"equivalent:", "no rule:", "open:"};

/// file, function, original, mutated, reason; empty: not of this form.
std::optional<Explanation> parse_line(std::string_view line) {
  Explanation out;
  const auto parts = split(line, '`');
  // What is quoted holds no backtick, for C++ has none.
  if (parts.size() != 5 || trim(parts[2]) != "->") return std::nullopt;
  const auto blank = parts[0].find(' ');
  if (blank == std::string_view::npos) return std::nullopt;
  out.file = parts[0].substr(0, blank);
  out.function = trim(parts[0].substr(blank));
  out.original = parts[1];
  out.mutated = parts[3];
  out.reason = trim(parts[4]);
  const auto begins = [&](std::string_view kind) {
    return out.reason.starts_with(kind) && !trim(std::string_view(out.reason).substr(kind.size())).empty();
  };
  if (out.function.empty() || std::ranges::none_of(reasons, begins)) return std::nullopt;
  return out;
}

}  // namespace

bool Explanation::is_of(const Mutant& mutant) const {
  const auto fits = [](std::string_view pattern, std::string_view text) {
    return pattern == "*" || pattern == text;
  };
  return file == mutant.file && fits(function, mutant.function) && fits(original, mutant.original) &&
         fits(mutated, mutant.mutated);
}

// What no rule forbids may still be seen, as a feature that is there or not, or in a warning.
bool Explanation::explains(Fate fate) const {
  return fate == Fate::survived || fate == Fate::not_reached ||
         (fate == Fate::noticed && reason.starts_with("no rule:"));
}

Result<std::vector<Explanation>> parse_explanations(std::string_view text) {
  std::vector<Explanation> out;
  int number = 0;
  for (const auto line : split(text, '\n')) {
    ++number;
    if (trim(line).empty() || line.starts_with('#')) continue;
    auto parsed = parse_line(line);
    if (!parsed) {
      return std::unexpected(
          Error{.what = fmt::format("line {} is no explanation of a mutant", number),
                .where = "explained.txt",
                .hint = "FILE FUNCTION `ORIGINAL` -> `MUTATED` equivalent: (or no rule:, open:) REASON"});
    }
    parsed->line = number;
    out.push_back(std::move(*parsed));
  }
  return out;
}

Result<std::vector<Explanation>> explanations_of(const MutantBuild& build) {
  const auto text = read_file(std::string(build.explained), 1U << 20U);
  if (!text) return std::unexpected(text.error());
  return parse_explanations(*text);
}

std::vector<std::string> explain(std::vector<MutantFate>& fates, std::span<const Mutant> all,
                                 const std::vector<Explanation>& explanations) {
  std::map<std::uint32_t, MutantFate*> run;
  for (auto& fate : fates) run[fate.mutant->number] = &fate;
  std::vector<std::string> stale;
  for (const auto& explanation : explanations) {
    bool meant = false, needed = false;
    for (const auto& mutant : all) {
      if (!explanation.is_of(mutant)) continue;
      meant = true;
      const auto found = run.find(mutant.number);
      if (found == run.end()) {
        needed = true;  // perhaps; it was not tried
      } else if (explanation.explains(found->second->fate)) {
        needed = true;
        if (found->second->explained.empty()) found->second->explained = explanation.reason;
      }
    }
    if (!needed) {
      stale.push_back(fmt::format("line {} ({} {} `{}` -> `{}`): {}", explanation.line, explanation.file,
                                  explanation.function, explanation.original, explanation.mutated,
                                  meant ? "is noticed" : "there is no such mutant"));
    }
  }
  return stale;
}

std::string explanation_key(const Mutant& mutant) {
  return fmt::format("{} {} `{}` -> `{}`", mutant.file, mutant.function, mutant.original, mutant.mutated);
}

}  // namespace conform::cli
