// SPDX-License-Identifier: Apache-2.0
// The parser of steps: what verbs have in common, names and where they are known, and the verb table itself.
#include <algorithm>

#include "catch.hpp"
#include "steps/step.hpp"
#include "steps/tests/fake_session.hpp"
#include "yaml/loader.hpp"

namespace {

using namespace conform;
using namespace conform::steps;

struct Parsed {
  std::vector<Step> steps;
  std::string said;  ///< "line:column message" of each mistake
};

Parsed parse(const std::string& text, NameCheck names = {}) {
  const auto source = yaml::make_source("x.yaml", text);
  yaml::Diagnostics diagnostics(source);
  const auto root = yaml::load(*source, diagnostics);
  REQUIRE(root);
  ParseContext context{diagnostics, {}, {}, std::move(names), {"RULE-09"}, {}};
  context.requirement = [](std::string_view id) {
    return id.starts_with("RULE-") ? std::optional(std::string(id)) : std::nullopt;
  };
  context.all_requirements = [] { return std::vector<std::string_view>{"RULE-01"}; };
  context.check_query = [](std::string_view) { return Result<void>(); };
  Parsed out;
  out.steps = parse_steps(yaml::Field(&*root, diagnostics, "'steps'"), context);
  for (const auto& each : diagnostics.sorted()) {
    out.said +=
        to_string(each.begin) + " " + each.message + (each.hint.empty() ? "" : "; " + each.hint) + "\n";
  }
  return out;
}

TEST_CASE("A step has one verb, its expectation and what stands beside it") {
  const auto out = parse("- upload: {object: 1017h:00, save: before}\n"
                         "  as: first\n"
                         "  when: 1017h is present\n"
                         "  unless: 1017h:00 may change by itself\n"
                         "  checks: [RULE-01, RULE-02]\n"
                         "  expect: ok\n"
                         "  warn: abort any\n"
                         "- download: {object: 1017h:00, value: $before}\n");
  REQUIRE(out.said.empty());
  REQUIRE(out.steps.size() == 2);
  const auto& first = out.steps[0];
  CHECK(first.verb == "upload");
  CHECK(first.label == "first");
  CHECK(first.when);
  CHECK(first.unless);
  CHECK(first.expectation.given);
  CHECK(first.expectation.checks == std::vector<std::string>{"RULE-01", "RULE-02"});
  CHECK(first.expectation.warn.size() == 1);
  CHECK(first.position == yaml::Position{1, 3});
  REQUIRE(first.action->object() != nullptr);
  CHECK(first.action->object()->text() == "1017h:00");
  // Set-up decides nothing, also where the scenario has a default.
  CHECK(out.steps[1].expectation.checks.empty());
}

TEST_CASE("An expectation without checks decides the default of the scenario") {
  const auto out = parse("- upload: 1000h:00\n  expect: ok\n- upload: 1001h:00\n  fail: abort any\n");
  REQUIRE(out.steps.size() == 2);
  CHECK(out.steps[0].expectation.checks == std::vector<std::string>{"RULE-09"});
  CHECK(out.steps[1].expectation.checks == std::vector<std::string>{"RULE-09"});
}

TEST_CASE("Names are known behind the step that gives them, and in no other branch or walk") {
  CHECK(parse("- upload: $entry\n", {"entry"}).said.empty());
  CHECK(parse("- upload: $entry\n").said ==
        "1:11 unknown name $entry; names come from save, for_each, over and let\n");
  CHECK(parse("- download: {object: 1017h:00, value: $before}\n- upload: {object: 1017h:00, save: before}\n")
            .said == "1:39 unknown name $before; names come from save, for_each, over and let\n");
  CHECK(parse("- over: {code: [1, 2]}\n  steps:\n    - download: {object: 1017h:00, value: $code}\n")
            .said.empty());
  CHECK(
      parse("- over: {code: [1]}\n  steps:\n    - wait: 1 s\n- download: {object: 1017h:00, value: $code}\n")
          .said == "4:39 unknown name $code; names come from save, for_each, over and let\n");
  CHECK(
      parse(
          "- upload: 1000h:00\n  either:\n    - if: ok\n      steps:\n        - upload: {object: 1001h:00, save: inner}\n"
          "    - if: abort any\n      steps:\n        - download: {object: 1017h:00, value: $inner}\n")
          .said == "8:47 unknown name $inner; names come from save, for_each, over and let\n");
  CHECK(parse("- wait: $profile.boot_time\n").said.empty());
}

TEST_CASE("A conversation as alternative decides what its step decides, unless it says otherwise") {
  const auto out = parse("- talk: |\n    > 600+N: 40 00 10 00 ..\n  checks: RULE-01\n  either:\n"
                         "    - talk: |\n        < 580+N: 43 ..\n"
                         "    - checks: RULE-02\n      talk: |\n        silence 580+N for 100 ms\n");
  REQUIRE(out.said.empty());
  REQUIRE(out.steps.size() == 1);
  REQUIRE(out.steps[0].branches.size() == 2);
  CHECK(out.steps[0].branches[1].steps[0].expectation.checks == std::vector<std::string>{"RULE-02"});
}

TEST_CASE("A conversation as alternative is about the entry of its step") {
  const std::string step =
      "- talk: {object: 1008h:00, frames: \"> 600+N: 40 {m} ..\"}\n  either:\n    - talk: \"< 580+N: 41 {m} ..\"\n";
  const auto out = parse(step);
  CHECK(out.said.empty());
  REQUIRE(out.steps.size() == 1);
  REQUIRE(out.steps[0].branches.size() == 1);
  REQUIRE(out.steps[0].branches[0].steps[0].action->object() != nullptr);
  CHECK(out.steps[0].branches[0].steps[0].action->object()->text() == "1008h:00");
  // Steps of a branch stand for themselves.
  CHECK(parse(step + "      steps:\n        - talk: \"> 600+N: 40 {m} ..\"\n")
            .said.starts_with("5:30 {m} needs the object"));
}

TEST_CASE("A walk takes values, ranges and named sets") {
  const auto out = parse("- over: {id: [1, 2 + 3, 10..20, restricted CAN-IDs, entries with readable]}\n"
                         "  steps:\n    - send: {id: $id}\n");
  REQUIRE(out.said.empty());
  REQUIRE(out.steps.size() == 1);
  REQUIRE(out.steps[0].walk);
  CHECK(out.steps[0].walk->name == "id");
  CHECK(out.steps[0].walk->values.size() == 2);
  CHECK(out.steps[0].walk->ranges.size() == 1);
  CHECK(out.steps[0].walk->sets.size() == 2);
  CHECK(out.steps[0].walk->steps.size() == 1);
}

TEST_CASE("Unusable steps are left out and the others are kept") {
  const auto out = parse("- uplaod: 1000h:00\n- upload: 1001h:00\n- upload: nothing\n");
  CHECK(out.steps.size() == 1);
  CHECK(out.said == "1:3 unknown verb or key 'uplaod' in a step; did you mean 'upload'?\n"
                    "3:11 'nothing' is not an object; write 1003h:00, $object or 1003h:$count\n");
}

TEST_CASE("Every verb of the table has a summary, parameters and an example that it can read") {
  for (const auto& verb : verbs()) {
    CAPTURE(std::string(verb.name));
    CHECK(verb.summary.ends_with('.'));
    CHECK_FALSE(verb.parameters.empty());
    const auto out = parse(std::string(verb.example) + "\n",
                           {"code", "depth", "pdo", "word", "count", "object", "before"});
    // The ids of the examples are those of the real catalogue, which this test does not know.
    std::string other;
    for (const auto line : split(out.said, '\n')) {
      if (!line.empty() && line.find("unknown requirement") == std::string_view::npos)
        other += std::string(line) + "\n";
    }
    CHECK(other.empty());
    CHECK_FALSE(out.steps.empty());
    CHECK(std::ranges::any_of(out.steps, [&](const Step& step) { return step.verb == verb.name; }));
  }
}

TEST_CASE("Verbs are found by their name only") {
  REQUIRE(find_verb("upload") != nullptr);
  CHECK(find_verb("upload")->name == "upload");
  CHECK(find_verb("Upload") == nullptr);
  CHECK(find_verb("") == nullptr);
}

TEST_CASE("A time is fixed, the profile's, or that several times") {
  const auto source =
      yaml::make_source("x.yaml", "a: 1.5 s\nb: $profile.boot_time\nc: T_SDO\nd: T_NONE\ne: 2 T_NMT\n"
                                  "f: 2 T_NONE\ng: 0 T_NMT\nh: 2 x T_NMT\n");
  yaml::Diagnostics diagnostics(source);
  const auto root = yaml::load(*source, diagnostics);
  REQUIRE(root);
  const auto time = [&](const char* key) {
    return parse_time_at(yaml::Field(root->find(key), diagnostics, key));
  };
  auto profile = device::default_profile(NodeId(5));
  profile.boot_time = std::chrono::seconds(7);
  CHECK(time("a")->resolve(profile) == std::chrono::milliseconds(1500));
  CHECK(time("b")->resolve(profile) == std::chrono::seconds(7));
  CHECK(time("c")->resolve(profile) == profile.sdo_timeout);
  CHECK(time("e")->resolve(profile) == 2 * profile.nmt_time);
  CHECK(time("e")->text() == "2 T_NMT");
  CHECK(time("b")->text() == "$profile.boot_time");
  for (const auto* wrong : {"d", "f", "g", "h"}) CHECK_FALSE(time(wrong));
}

}  // namespace
