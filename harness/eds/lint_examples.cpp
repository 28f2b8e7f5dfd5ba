// SPDX-License-Identifier: Apache-2.0
#include "eds/lint_examples.hpp"

#include <algorithm>
#include <vector>

#include "eds/lint_examples_tables.hpp"

namespace conform::eds {

std::span<const LintExample> lint_examples() {
  static const auto all = [] {
    std::vector<LintExample> out;
    for (const auto& table : {forms_examples, objects_examples, pdos_examples, values_examples,
                              parameters_examples, mapping_examples, modules_examples, services_examples})
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

}  // namespace conform::eds
