// SPDX-License-Identifier: Apache-2.0
// Every file of corpus/bad with its complete diagnostics beside it, and every file of corpus/good with none.
// New expected texts: canopen-conform lint --suites .. FILE, in corpus/bad, without the last line.
#include <algorithm>
#include <filesystem>

#include "base/files.hpp"
#include "catch.hpp"
#include "scenario/loader.hpp"

namespace {

using namespace conform;
namespace fs = std::filesystem;

const std::string corpus = CONFORM_SOURCE_DIR "/harness/scenario/tests/corpus";

scenario::Catalogue catalogue() {
  std::vector<std::string> problems;
  auto out = scenario::Catalogue::load(corpus, problems);
  REQUIRE(out);
  REQUIRE(problems.empty());
  return std::move(*out);
}

std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> out;
  for (const auto& entry : fs::directory_iterator(corpus + "/" + folder)) {
    if (entry.path().extension() == ".yaml") out.push_back(entry.path().filename().string());
  }
  std::ranges::sort(out);
  return out;
}

std::string diagnostics_of(yaml::Document& document, const std::string& name,
                           const scenario::Catalogue& known) {
  if (document.root) {
    if (document.root->find("requirements") != nullptr) {
      (void)scenario::load_requirements(*document.root, document.diagnostics, name);
    } else {
      (void)scenario::load_scenarios(*document.root, document.diagnostics, name, known);
    }
  }
  return document.diagnostics.render();
}

std::string diagnostics_of_text(const std::string& text) {
  const auto source = yaml::make_source("x.yaml", text);
  yaml::Document document{source, yaml::Diagnostics(source), std::nullopt};
  document.root = yaml::load(*source, document.diagnostics);
  return diagnostics_of(document, "x.yaml", catalogue());
}

std::string scenario_of(const std::string& steps) {
  return "format: 1\ntitle: Corpus\nscenarios:\n  - id: one\n    title: One\n    steps:\n" + steps;
}

TEST_CASE("Every bad file gets exactly the diagnostics written beside it") {
  const auto known = catalogue();
  const auto files = files_in("bad");
  REQUIRE(files.size() >= 30);
  for (const auto& file : files) {
    CAPTURE(file);
    auto document = yaml::load_file(corpus + "/bad/" + file, file);
    REQUIRE(document);
    const auto said = diagnostics_of(*document, "bad/" + file, known);
    CHECK(document->diagnostics.has_errors());
    const auto expected =
        read_file(corpus + "/bad/" + file.substr(0, file.size() - 5) + ".txt", yaml::max_file_size);
    REQUIRE(expected);
    CHECK(said == *expected);
  }
}

TEST_CASE("Every good file is read without a word") {
  const auto known = catalogue();
  for (const auto& file : files_in("good")) {
    CAPTURE(file);
    auto document = yaml::load_file(corpus + "/good/" + file, file);
    REQUIRE(document);
    CHECK(diagnostics_of(*document, "good/" + file, known).empty());
  }
}

TEST_CASE("A file that is too deep is refused where it becomes too deep") {
  std::string steps;
  std::string indent = "      ";
  for (int i = 0; i < 40; ++i) {
    steps += indent + "- over: {a: [1]}\n" + indent + "  steps:\n";
    indent += "    ";
  }
  steps += indent + "- wait: 1 s\n";
  const auto said = diagnostics_of_text(scenario_of(steps));
  CHECK(said.find("error: nested deeper than 64 levels") != std::string::npos);
}

TEST_CASE("A file that is too large is refused before it is read") {
  const auto path = fs::temp_directory_path() / "conform-corpus-too-large.yaml";
  REQUIRE(write_file_atomically(path.string(), "# " + std::string(yaml::max_file_size, 'x') + "\n"));
  const auto document = yaml::load_file(path.string());
  fs::remove(path);
  REQUIRE_FALSE(document);
  CHECK(document.error().what.find("larger than") != std::string::npos);
}

TEST_CASE("Deeply nested parentheses and negations end with a message, not with the stack") {
  for (const auto& text : {std::string(100'000, '('), std::string(100'000, '~'), std::string(999, '(')}) {
    const auto said =
        diagnostics_of_text(scenario_of("      - download: {object: 1017h:00, value: \"" + text + "\"}\n"));
    CHECK(said.find("error: ") != std::string::npos);
  }
  std::string negations;
  for (int i = 0; i < 20'000; ++i) negations += "not ";
  CHECK(diagnostics_of_text(scenario_of("      - require: " + negations + "1003h is present\n"))
            .find("error: ") != std::string::npos);
}

TEST_CASE("Hundreds of mistakes are counted, but not all printed") {
  std::string steps;
  for (int i = 0; i < 1000; ++i) steps += "      - wait: " + std::to_string(i + 1) + "\n";
  const auto said = diagnostics_of_text(scenario_of(steps));
  CHECK(said.find("x.yaml: 800 more not shown") != std::string::npos);
}

TEST_CASE("Every prefix of a good file is read without a crash") {
  for (const auto& file : files_in("good")) {
    const auto text = read_file(corpus + "/good/" + file, yaml::max_file_size);
    REQUIRE(text);
    for (std::size_t size = 0; size < text->size(); size += 7)
      (void)diagnostics_of_text(text->substr(0, size));
  }
}

}  // namespace
