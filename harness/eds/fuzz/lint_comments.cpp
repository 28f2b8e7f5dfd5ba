// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: no comment for the lint may crash or hang its reader, or take away what it does not name.
// The input is a description, or, where it is none, what stands behind "lint:" in comments of an EDS and of
// an XDD.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "base/check.hpp"
#include "eds/lint.hpp"
#include "eds/lint_comments.hpp"
#include "eds/lint_policy.hpp"
#include "eds/read.hpp"

namespace {

using namespace conform;

bool is_about_comments(const eds::Finding& finding) {
  return std::ranges::find(eds::comment_rules.rules, finding.rule) != eds::comment_rules.rules.end();
}

void look_at(std::string_view text, const eds::EdsFile& file) {
  const auto comments = eds::read_lint_comments(text, file);
  for (const auto& allowed : comments.allowed) {
    CONFORM_CHECK(allowed.rule != nullptr && allowed.at.known());
    CONFORM_CHECK(allowed.whole_file || allowed.from <= allowed.to);
  }
  for (const auto& finding : comments.findings) {
    CONFORM_CHECK(is_about_comments(finding) && finding.at.known());
    CONFORM_CHECK(!finding.message.empty() && finding.message.size() < 1000);
  }
  const auto all = eds::lint(file);
  const auto left = eds::apply({}, all, text, file);
  const auto about_comments =
      static_cast<std::size_t>(std::ranges::count_if(left.findings, is_about_comments));
  // Nothing is lost: a finding is told, or counted as allowed.
  CONFORM_CHECK(left.findings.size() - about_comments + left.left_out + left.allowed ==
                all.findings.size() + all.left_out);
  CONFORM_CHECK(std::ranges::is_sorted(left.findings, {}, &eds::Finding::at));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (const auto file = eds::read(text, "fuzz.eds")) {
    look_at(text, *file);
    return 0;
  }
  const auto ini =
      "; lint:" + std::string(text) + "\n[2000]\n; lint: " + std::string(text) + "\nDataType=05\n";
  if (const auto file = eds::read(ini, "fuzz.eds")) look_at(ini, *file);
  const auto xml = "<!-- lint:" + std::string(text) +
                   "--><ISO15745ProfileContainer><!-- lint: " + std::string(text) +
                   "--></ISO15745ProfileContainer>";
  if (const auto file = eds::read(xml, "fuzz.xdd")) look_at(xml, *file);
  return 0;
}
