// SPDX-License-Identifier: Apache-2.0
// How a guard request is written.
#include "catch.hpp"
#include "steps/step.hpp"
#include "yaml/loader.hpp"

namespace {

using namespace conform;
using namespace conform::steps;

std::string words_of(const std::string& text) {
  const auto source = yaml::make_source("x.yaml", text);
  yaml::Diagnostics diagnostics(source);
  const auto root = yaml::load(*source, diagnostics);
  REQUIRE(root);
  ParseContext context{diagnostics, {}, {}, {}, {}, {}};
  const auto steps = parse_steps(yaml::Field(&*root, diagnostics, "'steps'"), context);
  return diagnostics.has_errors() || steps.size() != 1 ? "error"
                                                       : std::string(word_of(steps[0].action->need().tier));
}

TEST_CASE("Guard requests are remote frames, which a configuration may send") {
  CHECK(words_of("- guard: once\n") == "config");
  CHECK(words_of("- guard: {count: 10, every: 100 ms, dlc: 0, save: last}\n") == "config");
  CHECK(words_of("- produce: {guard: {every: 10 ms}}\n") == "config");
  CHECK(words_of("- stop: guard\n") != "error");
}

TEST_CASE("Several guard requests need the time between two") {
  CHECK(words_of("- guard: twice\n") == "error");
  CHECK(words_of("- guard: {count: 10}\n") == "error");
  CHECK(words_of("- guard: {count: 0, every: 1 s}\n") == "error");
  CHECK(words_of("- guard: {count: 2, every: 1 s, dlc: 9}\n") == "error");
  CHECK(words_of("- produce: {guard: {}}\n") == "error");
}

}  // namespace
