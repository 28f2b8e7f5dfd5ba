// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: what the quick reader takes, and the careful one too without a word, becomes the same
// tree. But for blanks and line breaks of texts: where lines are folded, yaml-cpp counts empty ones wrong.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/check.hpp"
#include "yaml/careful_reader.hpp"
#include "yaml/quick_reader.hpp"
#include "yaml/tests/dump.hpp"
#include "yaml/text_check.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace conform::yaml;
  const auto source = make_source("fuzz.yaml", std::string_view(reinterpret_cast<const char*>(data), size));
  Diagnostics said(source);
  if (!check_text(*source, said) || !said.empty()) return 0;
  Diagnostics scratch(source);
  const auto quick = read_quickly(*source, scratch);
  if (!quick) return 0;
  const auto careful = read_carefully(*source, said);
  if (!said.empty() || !careful) return 0;  // stricter than YAML, or mistaken
  CONFORM_CHECK(dump(*quick, Blanks::left_out) == dump(*careful, Blanks::left_out));
  return 0;
}
