// SPDX-License-Identifier: Apache-2.0
// The section `run:` of a profile, and that the schema for editors knows it.
#include "device/run_settings.hpp"

#include <fstream>
#include <iterator>

#include "catch.hpp"
#include "device/profile.hpp"

using namespace conform;
using namespace conform::device;

namespace {

struct Read {
  std::vector<RunSetting> settings;
  std::string messages;
};

Read read(std::string_view text) {
  const auto source = yaml::make_source("device.yaml", text);
  yaml::Diagnostics diagnostics(source);
  const auto root = yaml::load(*source, diagnostics);
  REQUIRE(root.has_value());
  yaml::Fields fields(*root, diagnostics, "profile");
  Read out;
  out.settings = read_run_settings(fields.optional("run"));
  fields.finish();
  out.messages = diagnostics.render();
  return out;
}

}  // namespace

TEST_CASE("options of a run stand in a profile as flags, words and lists") {
  const auto found =
      read("run:\n  strict: true\n  slow: false\n  allow: config\n  exclude: [a, b]\n  select: c\n");
  CHECK(found.messages.empty());
  REQUIRE(found.settings.size() == 5);
  CHECK(found.settings[0].key == "select");
  CHECK(found.settings[0].words == std::vector<std::string>{"c"});
  CHECK(found.settings[0].line == 6);
  CHECK(found.settings[1].words == std::vector<std::string>{"a", "b"});
  CHECK(found.settings[2].words == std::vector<std::string>{"config"});
  CHECK(found.settings[3].words == std::vector<std::string>{"true"});
  CHECK(found.settings[4].words == std::vector<std::string>{"false"});
  CHECK(read("{}").settings.empty());
  CHECK(read("run:\n  shuffle: true\n").settings.front().words == std::vector<std::string>{"true"});
  CHECK(read("run:\n  shuffle: 11h\n").settings.front().words == std::vector<std::string>{"17"});
  CHECK(read("run:\n  shuffle: wild\n").messages.find("shuffle") != std::string::npos);
}

TEST_CASE("an option that a profile cannot have is told at its place") {
  const auto unknown = read("run:\n  strct: true\n");
  CHECK(unknown.messages.find("device.yaml:2:3") != std::string::npos);
  CHECK(unknown.messages.find("strict") != std::string::npos);
  CHECK(read("run:\n  strict: maybe\n").messages.find("strict") != std::string::npos);
  CHECK(read("run: all\n").settings.empty());
  const auto source = yaml::make_source("device.yaml", "format: 1\nname: x\nnode: 1\nrun: {simulat: true}\n");
  yaml::Diagnostics diagnostics(source);
  const auto root = yaml::load(*source, diagnostics);
  REQUIRE(root.has_value());
  static_cast<void>(load_profile(*root, diagnostics));
  CHECK(diagnostics.has_errors());
}

TEST_CASE("the schema for editors knows every option of a run") {
  std::ifstream file(CONFORM_SOURCE_DIR "/suites/schema/device.schema.json");
  const std::string schema{std::istreambuf_iterator<char>(file), {}};
  for (const auto& each : run_keys()) {
    INFO(each.key);
    CHECK(schema.find("\"" + std::string(each.key) + "\": {") != std::string::npos);
  }
}
