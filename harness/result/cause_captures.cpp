// SPDX-License-Identifier: Apache-2.0
#include "result/cause_captures.hpp"

#include <algorithm>

namespace conform::result {
namespace {

constexpr std::string_view beginning = "cause-", ending = ".pcapng";
/// Long enough for every id of the suites, and short enough for every file system.
constexpr std::size_t longest_part = 100;

/// Letters, digits, '.' and '_' as they are; whatever is between them is one '-'.
std::string safe(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_';
    if (plain) {
      out += c;
    } else if (!out.empty() && out.back() != '-') {
      out += '-';
    }
  }
  if (out.size() > longest_part) out.resize(longest_part);
  while (!out.empty() && (out.back() == '-' || out.back() == '.')) out.pop_back();
  return out;
}

}  // namespace

std::string capture_name(const Cause& cause, std::size_t number) {
  auto digits = std::to_string(number);
  if (digits.size() < 2) digits.insert(0, "0");
  std::string out = std::string(beginning) + digits;
  for (const auto& part : {safe(cause.primary.finding->requirement), safe(cause.primary.owner->name())}) {
    if (!part.empty()) out += "-" + part;
  }
  return out + std::string(ending);
}

bool is_capture_name(std::string_view name) {
  if (!name.starts_with(beginning) || !name.ends_with(ending) ||
      name.size() < beginning.size() + 2 + ending.size())
    return false;
  const auto digits = name.substr(beginning.size(), 2);
  return std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; });
}

const CaseResult* case_of(const Cause& cause, const RunResult& run) {
  const auto& owner = *cause.primary.owner;
  if (!cause.primary.is_monitor()) return owner.first_frame < owner.end_frame ? &owner : nullptr;
  const auto& during = cause.primary.finding->during;
  if (during.empty()) return nullptr;
  const auto found = std::ranges::find_if(run.cases, [&](const CaseResult& one) {
    return one.first_frame < one.end_frame && one.name() == during;
  });
  return found == run.cases.end() ? nullptr : &*found;
}

std::optional<FrameRange> frames_of(const Cause& cause, const RunResult& run) {
  std::optional<FrameRange> out;
  const auto include = [&out](std::size_t first, std::size_t end) {
    if (!out) out = FrameRange{first, end};
    out->first = std::min(out->first, first);
    out->end = std::max(out->end, end);
  };
  if (const auto* one = case_of(cause, run)) include(one->first_frame, one->end_frame);
  for (const auto& frame : cause.primary.finding->evidence)
    include(frame.capture_index, frame.capture_index + 1);
  return out;
}

}  // namespace conform::result
