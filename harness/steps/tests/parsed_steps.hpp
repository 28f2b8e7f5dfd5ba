// SPDX-License-Identifier: Apache-2.0
// Steps as a scenario writes them, for tests that carry out one.
#pragma once

#include <string>
#include <vector>

#include "catch.hpp"
#include "steps/step.hpp"
#include "yaml/loader.hpp"

namespace conform::steps {

/// The steps of the list; none when there is a mistake in it.
inline std::vector<Step> parsed_steps(const std::string& text) {
  const auto source = yaml::make_source("x.yaml", text);
  yaml::Diagnostics diagnostics(source);
  const auto root = yaml::load(*source, diagnostics);
  REQUIRE(root);
  ParseContext context{diagnostics, {}, {}, {}, {}, {}};
  auto steps = parse_steps(yaml::Field(&*root, diagnostics, "'steps'"), context);
  return diagnostics.has_errors() ? std::vector<Step>() : std::move(steps);
}

/// The only step of the list.
inline Step parsed_step(const std::string& text) {
  auto steps = parsed_steps(text);
  REQUIRE(steps.size() == 1);
  return std::move(steps[0]);
}

}  // namespace conform::steps
