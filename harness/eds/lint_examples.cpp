// SPDX-License-Identifier: Apache-2.0
#include "eds/lint_examples.hpp"

#include <algorithm>
#include <vector>

#include "base/text.hpp"
#include "eds/lint_examples_tables.hpp"

namespace conform::eds {
namespace {

struct NoExample {
  std::string_view code, reason;
};
constexpr NoExample without_example[] = {
    {"EDS276", "it takes hundreds of objects with CompactSubObj, or a name of many kilobytes"},
};

}  // namespace

std::span<const LintExample> lint_examples() {
  static const auto all = [] {
    std::vector<LintExample> out;
    for (const auto& table :
         {forms_examples, objects_examples, pdos_examples, values_examples, parameters_examples,
          mapping_examples, modules_examples, services_examples, files_examples, xml_examples})
      out.insert(out.end(), table.begin(), table.end());
    std::ranges::sort(out, {}, &LintExample::code);
    return out;
  }();
  return all;
}

const LintExample* find_example(std::string_view code) {
  const auto all = lint_examples();
  const auto found = std::ranges::find(all, code, &LintExample::code);
  return found == all.end() ? nullptr : &*found;
}

std::string_view why_no_example(std::string_view code) {
  const auto* found = std::ranges::find(without_example, code, &NoExample::code);
  return found == std::end(without_example) ? std::string_view() : found->reason;
}

std::string shown(std::string_view example) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  std::string out;
  if (example.starts_with(byte_order_mark)) {
    out = "\\xEF\\xBB\\xBF";
    example.remove_prefix(byte_order_mark.size());
  }
  std::string text;
  for (std::size_t i = 0; i < example.size(); ++i) {
    if (example[i] != '\r') {
      text += example[i];
      continue;
    }
    text += "\\r";
    if (!example.substr(i + 1).starts_with('\n')) text += '\n';
  }
  return out + printable(text, true);
}

}  // namespace conform::eds
