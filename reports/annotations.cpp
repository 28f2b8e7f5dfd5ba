// SPDX-License-Identifier: Apache-2.0
#include "reports/annotations.hpp"

#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/fnv1a.hpp"
#include "base/text.hpp"
#include "reports/cause_lines.hpp"
#include "reports/phrases.hpp"
#include "reports/text_tools.hpp"
#include "result/causes.hpp"

namespace conform::reports {
namespace {

using result::Cause;
using result::Verdict;

struct Place {
  std::string file;
  int line = 1;
};

/// The line of the device description that claims what is not so, for that is the user's own file; else the
/// step that judged.
Place place_of(const Cause& cause) {
  const auto& finding = *cause.primary.finding;
  const auto colon = finding.declared_at.rfind(':');
  if (colon != std::string::npos) {
    int line = 0;
    const auto digits = std::string_view(finding.declared_at).substr(colon + 1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), line);
    if (error == std::errc{} && end == digits.data() + digits.size() && line > 0)
      return {finding.declared_at.substr(0, colon), line};
  }
  const auto& position = finding.position.file.empty() ? cause.primary.owner->position : finding.position;
  return {position.file.empty() ? "canopen-conform" : position.file, std::max(position.line, 1)};
}

std::string message_of(const Cause& cause) {
  const auto& finding = *cause.primary.finding;
  return fmt::format("{}: {} ({})", log_safe(finding.requirement), headline(finding), extent(cause));
}

/// Each part ends with a byte that is in no text.
std::string fingerprint(const Cause& cause) {
  auto hash = fnv1a_of_nothing;
  const auto add = [&hash](std::string_view text) { hash = fnv1a("\xFF", fnv1a(text, hash)); };
  const auto& finding = *cause.primary.finding;
  add(finding.requirement);
  add(cause.about);
  add(finding.object ? to_string(*finding.object) : "");
  return fmt::format("{:016x}", hash);
}

}  // namespace

std::string github_text(std::string_view text, bool property) {
  std::string out;
  for (const char c : text) {
    if (c == '%')
      out += "%25";
    else if (c == '\n')
      out += "%0A";
    else if (c == '\r')
      out += "%0D";
    else if (property && c == ':')
      out += "%3A";
    else if (property && c == ',')
      out += "%2C";
    else
      out += c;
  }
  return out;
}

std::string code_quality(const result::RunResult& run) {
  auto issues = nlohmann::json::array();
  for (const auto& cause : result::causes_of(run)) {
    const auto place = place_of(cause);
    issues.push_back({{"description", message_of(cause)},
                      {"check_name", log_safe(cause.primary.finding->requirement)},
                      {"fingerprint", fingerprint(cause)},
                      {"severity", cause.verdict == Verdict::fail ? "major" : "minor"},
                      {"location", {{"path", printable(place.file)}, {"lines", {{"begin", place.line}}}}}});
  }
  return issues.dump(2) + "\n";
}

std::string github_annotations(const result::RunResult& run) {
  std::string out;
  for (const auto& cause : result::causes_of(run)) {
    const auto place = place_of(cause);
    out += fmt::format("::{} file={},line={},title={}::{}\n",
                       cause.verdict == Verdict::fail ? "error" : "warning",
                       github_text(printable(place.file), true), place.line,
                       github_text(log_safe(cause.primary.finding->requirement), true),
                       github_text(message_of(cause), false));
  }
  return out;
}

}  // namespace conform::reports
