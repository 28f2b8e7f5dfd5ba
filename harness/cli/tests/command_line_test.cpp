// SPDX-License-Identifier: Apache-2.0
#include "cli/run/command_line.hpp"

#include <array>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "base/shell_word.hpp"
#include "catch.hpp"

using namespace conform;

namespace {

/// What a shell makes of the words, each ended by a NUL.
std::string words_by_shell(const std::string& line) {
  const std::string command = "bash -c " + shell_word("printf '%s\\0' " + line);
  std::string out;
  FILE* const pipe = ::popen(command.c_str(), "r");  // NOLINT(cert-env33-c): that is what is tested
  REQUIRE(pipe != nullptr);
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) out += static_cast<char>(c);
  CHECK(::pclose(pipe) == 0);
  return out;
}

}  // namespace

TEST_CASE("a command line comes back from a shell word for word") {
  std::string all;
  for (int byte = 1; byte < 256; ++byte) all += static_cast<char>(byte);
  std::vector<std::string> words{
      "canopen-conform", "--device", "my device's.yaml", "", "$(reboot)", "a\\b", "\"quoted\"",
      "line\nbreak",     "*",        "\xC3\xA4",         all};
  std::vector<char*> arguments;
  std::string expected;
  for (auto& word : words) {
    arguments.push_back(word.data());
    expected += word + '\0';
  }
  const auto line = cli::shell_line(arguments);
  CHECK(words_by_shell(line) == expected);
  // It can be shown: one line, nothing that a terminal obeys.
  CHECK(line.find('\n') == std::string::npos);
  CHECK(line.find('\x1B') == std::string::npos);
}
