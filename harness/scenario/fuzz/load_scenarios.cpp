// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: no text may crash, hang or exhaust the loader of scenario, requirement and profile files.
// Its seeds are the corpus of the tests.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "scenario/loader.hpp"
#include "scenario/query.hpp"
#include "scenario/selection.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace conform;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto source = yaml::make_source("fuzz.yaml", text);
  yaml::Diagnostics diagnostics(source);
  const auto root = yaml::load(*source, diagnostics);
  if (root) {
    static const scenario::Catalogue nothing;
    (void)scenario::load_scenarios(*root, diagnostics, "fuzz.yaml", nothing);
    (void)scenario::load_requirements(*root, diagnostics, "fuzz.yaml");
  }
  (void)diagnostics.render();
  // The words behind the YAML, without it.
  (void)scenario::Query::parse(text);
  (void)steps::Condition::parse(text);
  (void)steps::Expression::parse(text);
  (void)scenario::matches_pattern(text, "cia301/dictionary/1003-error-history/non-zero-write[02h]");
  return 0;
}
