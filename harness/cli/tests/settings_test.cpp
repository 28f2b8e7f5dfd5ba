// SPDX-License-Identifier: Apache-2.0
// Command line before environment before profile before default.
#include "cli/run/settings.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "catch.hpp"
#include "cli/commands/run_options.hpp"
#include "device/run_settings.hpp"

using namespace conform;
using namespace conform::cli;

namespace {

using Words = std::vector<std::string>;

struct Given {
  Words words;
  std::map<std::string, std::string> environment{};
};

MergedLine merge(Given given) {
  given.words.insert(given.words.begin(), "canopen-conform");
  std::vector<char*> arguments;
  for (auto& word : given.words) arguments.push_back(word.data());
  return merge_settings(arguments, [&given](const std::string& name) {
    const auto found = given.environment.find(name);
    return found == given.environment.end() ? nullptr : found->second.c_str();
  });
}

Setting setting(const MergedLine& line, std::string_view option) {
  const auto found = std::ranges::find(line.settings, option, &Setting::option);
  REQUIRE(found != line.settings.end());
  return *found;
}

/// The command as the parser makes it.
RunCommand parsed(const MergedLine& line) {
  RunOptions options;
  CLI::App app;
  options.add_to(app);
  app.parse(Words(line.words.rbegin(), line.words.rend() - 2));
  return options.command;
}

/// A profile in a folder of its own.
struct ProfileFile {
  explicit ProfileFile(const std::string& run) {
    std::filesystem::create_directories(folder);
    std::ofstream(path()) << "format: 1\nname: x\nnode: 9\ninterface: can7\n" << run;
  }
  ~ProfileFile() { std::filesystem::remove_all(folder); }
  [[nodiscard]] std::string path() const { return folder + "/p.yaml"; }
  std::string folder = std::string(CONFORM_BINARY_DIR) + "/settings-test";
};

}  // namespace

TEST_CASE("an option comes from the command line before the environment before the profile") {
  const ProfileFile file("run:\n  allow: nvm\n  seed: 3\n  strict: true\n  color: never\n  junit: out.xml\n");
  const auto line = merge({{"run", "--device", file.path(), "--allow", "config"},
                           {{"CANOPEN_CONFORM_ALLOW", "motion"},
                            {"CANOPEN_CONFORM_SEED", "7"},
                            {"CANOPEN_CONFORM_EXCLUDE", "a, b"},
                            {"CANOPEN_CONFORM_COLOR", ""}}});
  CHECK(setting(line, "allow").origin == "command line");
  CHECK(setting(line, "seed").origin == "CANOPEN_CONFORM_SEED");
  CHECK(setting(line, "strict").origin == file.path() + ":8");
  CHECK(setting(line, "node").words == Words{"9"});
  CHECK(setting(line, "interface").origin == file.path());
  CHECK(setting(line, "quiet").origin == "default");
  const auto command = parsed(line);
  CHECK(command.allow == "config");
  CHECK(command.seed == 7);
  CHECK(command.strict);
  CHECK(command.color == "never");
  CHECK(command.exclude == Words{"a", "b"});
  // The run itself reads these where they stand; and the folder of the profile is where its paths begin.
  CHECK(command.interface.empty());
  CHECK_FALSE(command.node);
  CHECK(command.reports.at("junit") == file.folder + "/out.xml");
  CHECK(std::ranges::find(line.told, "--seed=7") != line.told.end());
  CHECK(std::ranges::find(line.told, "--strict=true") == line.told.end());
  const auto table = config_table(line);
  CHECK(table.find("command line\n") != std::string::npos);
  CHECK(table.find("color") != std::string::npos);
}

TEST_CASE("a flag of the profile is taken back by the command line") {
  const ProfileFile file("run: {strict: true, simulate: true}\n");
  CHECK_FALSE(parsed(merge({{"run", "-d", file.path(), "--strict=false"}})).strict);
  // Who names an interface does not mean the simulation.
  const auto real = parsed(merge({{"run", "-d", file.path(), "-i", "can0"}}));
  CHECK_FALSE(real.simulate);
  CHECK(real.interface == "can0");
  const auto simulated = merge({{"run", "-d", file.path()}});
  CHECK(parsed(simulated).simulate);
  CHECK(setting(simulated, "interface").words.empty());
}

TEST_CASE("options that need each other may come from different places") {
  const auto line = merge({{"run", "--simulate", "--until-fail"}, {{"CANOPEN_CONFORM_REPEAT", "5"}}});
  CHECK(parsed(line).choice.repeat == 5);
  CHECK(parsed(line).choice.until_fail);
  const auto select =
      parsed(merge({{"run", "--simulate"}, {{"CANOPEN_CONFORM_SELECT", "cia301/sdo,cia305"}}}));
  CHECK(select.select == Words{"cia301/sdo", "cia305"});
  // Where the program's own suites are is said by a variable that is no option.
  const auto own =
      parsed(merge({{"run", "--simulate"},
                    {{"CANOPEN_CONFORM_SUITES", "shipped"}, {"CANOPEN_CONFORM_OWN_SUITES", "mine"}}}));
  CHECK(own.suites == Words{"mine"});
}

TEST_CASE("a random order is drawn by the seed of the run, or by a number of its own") {
  const auto plain = parsed(merge({{"run", "--simulate", "--shuffle", "cia301/sdo"}}));
  CHECK(plain.shuffle == "true");
  CHECK(plain.select == Words{"cia301/sdo"});
  CHECK(parsed(merge({{"run", "--simulate", "--shuffle=7"}})).shuffle == "7");
  CHECK(parsed(merge({{"run", "--simulate"}, {{"CANOPEN_CONFORM_SHUFFLE", "7"}}})).shuffle == "7");
  CHECK(parsed(merge({{"run", "--simulate"}, {{"CANOPEN_CONFORM_SHUFFLE", "true"}}})).shuffle == "true");
  const ProfileFile file("run: {simulate: true, shuffle: true}\n");
  CHECK(parsed(merge({{"run", "-d", file.path()}})).shuffle == "true");
  CHECK_THROWS_AS(parsed(merge({{"run", "--simulate", "--shuffle=seven"}})), CLI::ParseError);
}

TEST_CASE("a mistake is told with the place it comes from") {
  const auto line = merge({{"run", "--simulate", "--repeat", "2"}, {{"CANOPEN_CONFORM_STRICT", "maybe"}}});
  CHECK(origins_in("Could not convert: --strict = maybe", line) ==
        "--strict comes from CANOPEN_CONFORM_STRICT\n");
  CHECK(origins_in("Could not convert: --repeat = x", line).empty());
  CHECK(origins_in("--strict-more", line).empty());
}

TEST_CASE("other commands, and lines with mistakes, stay as they are") {
  CHECK(merge({{"list"}, {{"CANOPEN_CONFORM_SEED", "7"}}}).words == Words{"canopen-conform", "list"});
  const auto wrong = merge({{"run", "--sed", "7"}});
  CHECK(wrong.words == Words{"canopen-conform", "run", "--sed", "7"});
  CHECK(wrong.settings.empty());
  const ProfileFile file("run: {strct: true}\n");
  CHECK_FALSE(parsed(merge({{"run", "-d", file.path()}})).strict);
}

TEST_CASE("every option of a run can stand in the profile, but for those it has keys of its own for") {
  RunOptions options;
  CLI::App app;
  options.add_to(app);
  std::set<std::string> on_the_line,
      in_the_profile{"device", "interface", "node", "nodes", "eds", "show-config", "help"};
  for (const auto* option : app.get_options())
    on_the_line.insert(option->get_lnames().empty() ? option->get_name() : option->get_lnames().front());
  for (const auto& each : device::run_keys()) in_the_profile.insert(std::string(each.key));
  CHECK(on_the_line == in_the_profile);
}
