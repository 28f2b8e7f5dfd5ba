// SPDX-License-Identifier: Apache-2.0
// Files made to break a reader, and things that are no files.
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "catch.hpp"
#include "yaml/tests/checked.hpp"

namespace {

using namespace conform::yaml;

std::string repeat(std::string_view text, int times) {
  std::string out;
  for (int i = 0; i < times; ++i) out += text;
  return out;
}

struct Folder {
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "conform-yaml-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    path = name;
  }
  ~Folder() { std::filesystem::remove_all(path); }
  std::string write(const std::string& name, std::string_view text) const {
    std::ofstream(path / name, std::ios::binary) << text;
    return (path / name).string();
  }
  std::filesystem::path path;
};

TEST_CASE("An alias bomb is refused without being expanded") {
  std::string text = "a0: &a0 [x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 12; ++i)
    text += fmt::format("a{0}: &a{0} [{1}]\n", i, repeat(fmt::format("*a{}, ", i - 1), 9));
  const Checked file(text);
  CHECK(file.diagnostics.error_count() == 12 + 11 * 9);
  REQUIRE(file.root);
  CHECK(file.root->find("a11")->items().size() == 9);
  CHECK(file.root->find("a11")->items().at(0).is_null());
}

TEST_CASE("A structure that holds itself is refused") {
  const Checked file("&a [1, *a]\n");
  CHECK(file.diagnostics.error_count() == 2);
  REQUIRE(file.root);
  CHECK(file.root->items().size() == 2);
}

TEST_CASE("Nesting ends at 64 levels, however deep the file goes") {
  CHECK(Checked(repeat("[", 64) + "x" + repeat("]", 64)).messages().empty());
  CHECK(Checked(repeat("[", 65) + "x" + repeat("]", 65)).brief() == "1:65 nested deeper than 64 levels\n");
  CHECK(Checked(repeat("{a: ", 64) + "x" + repeat("}", 64)).messages().empty());
  // The place is the parser's guess where the text never ends; what counts is that it stops.
  for (const char* opening : {"[", "{a: ", "- ", "? ", "[{a: "}) {
    INFO(opening);
    const Checked file(repeat(opening, 100'000));
    CHECK(file.diagnostics.error_count() == 1);
    CHECK(file.brief().ends_with(" nested deeper than 64 levels\n"));
    CHECK_FALSE(file.root);
  }
}

TEST_CASE("More values than any suite needs are refused") {
  const Checked file(fmt::format("[{}a]", repeat("a,", 200'000)));
  CHECK(file.brief() == "1:200000 the file has more than 100000 values; split it\n");
  CHECK_FALSE(file.root);
}

TEST_CASE("A scalar may be large, a text beyond the limit is refused unparsed") {
  const Checked large(fmt::format("a: \"{}\"\n", std::string(900'000, 'x')));
  CHECK(large.messages().empty());
  CHECK(large.root->find("a")->text().size() == 900'000);
  CHECK(Checked(fmt::format("a: {}", std::string(max_file_size, 'x'))).brief() ==
        "1:1 the text is longer than 1000000 bytes; split it\n");
}

TEST_CASE("One line of many values is as quick as many lines") {
  CHECK(Checked(fmt::format("[{}{}]", repeat(", ", 99'000), std::string(700'000, ' '))).messages().empty());
  CHECK(Checked(fmt::format("[{}]", repeat("'', ", 99'000))).messages().empty());
}

TEST_CASE("Thousands of mistakes are counted and the first 200 shown") {
  const Checked file(repeat("yes: 010\n", 10'000));
  CHECK(file.diagnostics.sorted().size() == Diagnostics::limit);
  CHECK(file.diagnostics.error_count() == 29'999);
}

TEST_CASE("What is not text is refused with its place") {
  const std::string nul("a: \"x\0y\"\n", 9);
  CHECK(Checked(nul).messages() == "x.yaml:1:6: error: NUL character; this is not a text file\n"
                                   "    1 | a: \"x\\x00y\"\n"
                                   "      |      ^~~~\n");
  CHECK(Checked("a: 1\nb: \xC3\xA9\xFF\n").brief() ==
        "2:5 byte FFh is not valid UTF-8; save the file as UTF-8\n");
  CHECK(Checked("a: \xC0\xAF\n").diagnostics.error_count() == 2);  // overlong
  CHECK(Checked("a: \xED\xA0\x80\n").has_errors_only());           // surrogate
  CHECK(Checked("a: \xF4\x90\x80\x80\n").has_errors_only());       // above 10FFFFh
  CHECK(Checked("a: \xE2\x82").has_errors_only());                 // cut short
  CHECK(Checked("\xFF\xFE"
                "a")
            .brief() == "1:1 the file is UTF-16; save it as UTF-8\n");
  CHECK(Checked("a: \x04\n").brief() == "1:4 control character 0004h\n");
  CHECK(Checked("a\rb: 1\n").brief() ==
        "1:2 carriage return without line feed; save the file with LF line ends\n");
  CHECK(Checked("a: \xE2\x80\xAEtxt\n").brief() ==
        "1:4 invisible character 202Eh changes the reading direction; remove it\n");
  CHECK(Checked(std::string(100'000, '\xFF')).diagnostics.error_count() <= 20);
}

TEST_CASE("Every cut of a good file ends in a tree or a message") {
  const std::string text =
      "# c\nformat: 1\nscenarios:\n  - id: \"a\\x41\"\n    cct: ['2.10', {a: [b, c]}]\n    talk: |2\n      > x\n\n  - ? k\n    : v\n";
  for (std::size_t size = 0; size <= text.size(); ++size) {
    const Checked file(text.substr(0, size));
    INFO(size);
    CHECK((file.root.has_value() || file.diagnostics.has_errors()));
  }
}

TEST_CASE("Any byte anywhere ends in a tree or a message") {
  const std::string text = "a: [1, {b: 'c'}]\nd: |\n  e\n- \"f\"\n";
  for (std::size_t at = 0; at < text.size(); ++at) {
    for (int byte = 0; byte < 256; ++byte) {
      std::string changed = text;
      changed[at] = static_cast<char>(byte);
      const Checked file(changed);
      if (file.root.has_value() || file.diagnostics.has_errors()) continue;
      FAIL("position " << at << " byte " << byte);
    }
  }
  SUCCEED();
}

TEST_CASE("A file is read and named as asked") {
  const Folder folder;
  const auto path = folder.write("good.yaml", "a: 1\n");
  const auto document = load_file(path, "suites/good.yaml");
  REQUIRE(document);
  CHECK(document->source->name() == "suites/good.yaml");
  CHECK_FALSE(document->diagnostics.has_errors());
  CHECK(document->root->find("a")->text() == "1");
}

TEST_CASE("Mistakes inside a file are no error of the file") {
  const Folder folder;
  const auto document = load_file(folder.write("bad.yaml", "a: [\n"), "bad.yaml");
  REQUIRE(document);
  CHECK_FALSE(document->root);
  CHECK(document->diagnostics.has_errors());
}

TEST_CASE("Many files come back in their order, each with its own mistakes") {
  const Folder folder;
  std::vector<NamedFile> files;
  for (int i = 0; i < 40; ++i) {
    const auto name = std::to_string(i) + ".yaml";
    files.push_back({folder.write(name, i == 7 ? "a: [\n" : "a: " + std::to_string(i) + "\n"), name});
  }
  files[9].path = (folder.path / "missing.yaml").string();
  std::vector<std::string> texts(files.size());
  const auto documents = load_files(files, [&](std::size_t i, const Node& root, Diagnostics& diagnostics) {
    texts[i] = root.find("a")->text();
    if (i == 3) diagnostics.error(root, "of no use");
  });
  REQUIRE(documents.size() == files.size());
  for (std::size_t i = 0; i < documents.size(); ++i) {
    INFO(i);
    CHECK(documents[i].has_value() == (i != 9));
    if (!documents[i]) continue;
    CHECK(documents[i]->source->name() == files[i].name);
    CHECK(documents[i]->diagnostics.has_errors() == (i == 3 || i == 7));
    CHECK(texts[i] == (i == 7 ? "" : std::to_string(i)));
  }
}

TEST_CASE("What is no regular file, or too large a one, is refused at once") {
  const Folder folder;
  CHECK_FALSE(read_source((folder.path / "missing.yaml").string()));
  CHECK_FALSE(read_source(folder.path.string()));
  CHECK_FALSE(read_source("/dev/zero"));
  CHECK_FALSE(read_source("/dev/null"));
  CHECK_FALSE(read_source(""));
  CHECK_FALSE(read_source(std::string("/dev\0/null", 10)));
  const auto pipe = (folder.path / "pipe").string();
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  CHECK_FALSE(read_source(pipe));
  const auto sparse = folder.write("sparse.yaml", "");
  std::filesystem::resize_file(sparse, std::uintmax_t{1} << 30U);
  const auto error = read_source(sparse, "sparse.yaml");
  REQUIRE_FALSE(error);
  CHECK(error.error().where == "sparse.yaml");
  CHECK(read_source(folder.write("limit.yaml", std::string(max_file_size, ' '))));
  CHECK_FALSE(read_source(folder.write("over.yaml", std::string(max_file_size + 1, ' '))));
}

}  // namespace
