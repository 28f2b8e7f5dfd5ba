// SPDX-License-Identifier: Apache-2.0
#include "result/compare_steps.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/text.hpp"

namespace conform::result {
namespace {

/// A step without the value that it writes, which may be drawn: "download 2002h:01".
std::string_view step_shape(std::string_view step) { return step.substr(0, step.find(" = ")); }

constexpr std::array<std::uint16_t, 8> restless{0x1001, 0x1002, 0x1003, 0x1010,
                                                0x1011, 0x1013, 0x1023, 0x1025};

}  // namespace

bool is_decided(Verdict verdict) {
  return verdict == Verdict::pass || verdict == Verdict::waived || verdict == Verdict::warn ||
         verdict == Verdict::fail;
}

bool is_restless(Index index) { return std::ranges::find(restless, index.value()) != restless.end(); }

bool tells_of_absence(std::string_view kind) {
  return kind.find("abort 0602 0000h") != std::string_view::npos;
}

bool tells_of_restless(const CaseResult& one) {
  if (tells_of_absence(one.reason)) return false;
  return std::ranges::any_of(restless, [&](std::uint16_t index) {
    return one.reason.find(to_string(Index(index))) != std::string::npos;
  });
}

std::optional<std::string> answer_kind(std::string_view step, std::string_view actual) {
  if (actual.starts_with("abort ")) return std::string(actual);
  if (actual.starts_with("confirmed")) return "confirmed";
  if (actual.starts_with("error code ")) return std::string(actual);
  // "EMCY 8210h (PDO too short), error register 11h": the register may hold another error beside it.
  if (actual.starts_with("EMCY ")) return std::string(actual.substr(0, actual.find(',')));
  if (actual.starts_with("no answer")) return "no answer";
  if (actual.find(" values: ") != std::string_view::npos) return std::nullopt;  // of a step played for many
  if (step.starts_with("upload ")) return "a value";
  return std::nullopt;
}

std::optional<Multiplexer> uploaded(std::string_view step) {
  constexpr std::string_view verb = "upload ";
  if (!step.starts_with(verb)) return std::nullopt;
  const auto rest = step.substr(verb.size());
  // Behind a comma a step says how it departs from a usual transfer.
  if (rest.find(',') != std::string_view::npos) return std::nullopt;
  return parse_multiplexer(rest.substr(0, rest.find(' ')));
}

std::string_view value_of(std::string_view actual) { return actual.substr(0, actual.find(" (")); }

SeenByStep seen_in(const RunResult& run) {
  SeenByStep out;
  for (const auto& one : run.cases) {
    // Monitors judge whatever came by; what decided is another frame in every run.
    if (one.suite == "monitor") continue;
    for (const auto& judgement : one.judgements) {
      if (!is_decided(judgement.verdict)) continue;
      const auto add = [&](std::string_view step, std::string_view actual) {
        out.try_emplace({one.name(), judgement.requirement, step_shape(step)},
                        Seen{&one, judgement.verdict, judgement.requirement, step, actual});
      };
      for (const auto& finding : judgement.findings) add(finding.step, finding.actual);
      if (judgement.decided_by) add(judgement.decided_by->step, judgement.decided_by->actual);
    }
  }
  return out;
}

}  // namespace conform::result
