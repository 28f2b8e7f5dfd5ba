// SPDX-License-Identifier: Apache-2.0
#include "usage/complete.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "catch.hpp"
#include "usage/model.hpp"
#include "usage/shells.hpp"

using namespace conform;

namespace {

/// A program with one of each kind.
struct Sample {
  CLI::App app{"A program"};
  std::string text, file, folder, color, id;
  std::vector<std::string> ids, many, select;
  int number = 0;
  bool flag = false, other = false;

  Sample() {
    auto* play = app.add_subcommand("play", "Play cases");
    play->add_option("select", select, "Cases")->type_name("ID");
    play->add_option("--file", file, "A file")->type_name("RESULT|JOURNAL");
    play->add_option("--folder", folder, "A folder")->type_name("FOLDER");
    play->add_option("-c,--color", color, "Colours")
        ->check(CLI::IsMember({"auto", "always", "never"}).description(""))
        ->type_name("WHEN");
    play->add_option("--profile", number, "A profile")
        ->check(CLI::IsMember({301, 401}).description(""))
        ->type_name("PROFILE");
    play->add_option("--defect", ids, "A defect; repeatable")->allow_extra_args(false)->type_name("ID");
    play->add_option("--many", many, "Several at once")->type_name("ID");
    auto* flag_option = play->add_flag("-q,--quiet", flag, "Print less");
    play->add_flag("-v,--verbose", other, "Print more")->excludes(flag_option);
    play->add_option("--count", number, "A number")->check(CLI::Range(1, 5))->type_name("NUMBER");
    app.add_subcommand("guard", "For the program itself")->group("");
    auto* eds = app.add_subcommand("eds", "Descriptions");
    eds->add_subcommand("lint", "Mistakes")->add_option("files", ids, "Files")->type_name("FILE");
    eds->add_subcommand("new", "Begin one");
  }
};

std::optional<std::vector<usage::Candidate>> values(const usage::Place& place) {
  const auto name = usage::name_of(*place.option);
  if (name == "--defect" || name == "--many")
    return std::vector<usage::Candidate>{{"one", "The first"}, {"only", ""}};
  if (name == "select")
    return std::vector<usage::Candidate>{
        {"cia/sdo/upload/a", "A"}, {"cia/sdo/upload/b", ""}, {"cia/c", ""}, {"monitor", ""}};
  return std::nullopt;
}

/// The words offered behind this line, with blanks between; a file or folder as <files>, <folders>.
std::string offered(std::vector<std::string> words) {
  Sample sample;
  const auto current = words.back();
  words.pop_back();
  const auto found = usage::complete(sample.app, words, current, values);
  if (found.kind == usage::Completion::Kind::files) return "<files>";
  if (found.kind == usage::Completion::Kind::folders) return "<folders>";
  std::vector<std::string> out;
  for (const auto& each : found.words) out.push_back(each.word);
  return join(out, " ");
}

std::string answer(std::vector<std::string> question) {
  Sample sample;
  return usage::completion_answer(sample.app, question, values);
}

}  // namespace

TEST_CASE("commands are completed, also those of commands, but not the hidden ones") {
  CHECK(offered({""}) == "play eds");
  CHECK(offered({"p"}) == "play");
  CHECK(offered({"g"}).empty());
  CHECK(offered({"eds", ""}) == "lint new");
  CHECK(offered({"eds", "lint", ""}) == "<files>");
}

TEST_CASE("options are completed, without those that are there or excluded") {
  CHECK(offered({"play", "--f"}) == "--file --folder");
  CHECK(offered({"play", "--file", "x", "--f"}) == "--folder");
  CHECK(offered({"play", "--defect", "one", "--d"}) == "--defect");
  CHECK(offered({"play", "--quiet", "--v"}).empty());
  CHECK(offered({"play", "-q", "--v"}).empty());
  CHECK(offered({"play", "--he"}) == "--help");
  CHECK(offered({"play", "--", "--f"}).empty());
  // Where no argument can stand.
  CHECK(offered({"eds", "new", ""}) == "--help");
}

TEST_CASE("values are completed: closed sets, files, folders, and what the program knows") {
  CHECK(offered({"play", "--color", "a"}) == "auto always");
  CHECK(offered({"play", "-c", "n"}) == "never");
  CHECK(offered({"play", "--color=n"}) == "--color=never");
  CHECK(offered({"play", "--profile", ""}) == "301 401");
  CHECK(offered({"play", "--file", ""}) == "<files>");
  CHECK(offered({"play", "--file=x"}) == "<files>");
  CHECK(offered({"play", "--folder", "x"}) == "<folders>");
  CHECK(offered({"play", "--defect", "on"}) == "one only");
  CHECK(offered({"play", "--defect", "onl"}) == "only");
  CHECK(offered({"play", "--count", ""}).empty());
  CHECK(offered({"play", "--unknown=", ""}) == "cia/ monitor");
}

TEST_CASE("an option takes as many words as the parser gives it") {
  CHECK(offered({"play", "--defect", "one", "mon"}) == "monitor");
  CHECK(offered({"play", "--many", "one", "on"}) == "one only");
  CHECK(offered({"play", "--many", "one", "--file", "x", "mon"}) == "monitor");
}

TEST_CASE("ids with slashes are completed folder by folder") {
  CHECK(offered({"play", ""}) == "cia/ monitor");
  CHECK(offered({"play", "cia/"}) == "cia/sdo/ cia/c");
  // A folder that is the only one leaves nothing to choose.
  CHECK(offered({"play", "cia/s"}) == "cia/sdo/upload/a cia/sdo/upload/b");
  CHECK(offered({"play", "cia/sdo/upload/b"}) == "cia/sdo/upload/b");
  CHECK(offered({"play", "x", "cia/c"}) == "cia/c");
}

TEST_CASE("a line is taken apart as a shell does it") {
  using Words = std::vector<std::string>;
  CHECK(usage::words_of_line("a  b") == Words{"a", "b"});
  CHECK(usage::words_of_line("a b ") == Words{"a", "b", ""});
  CHECK(usage::words_of_line("a 'b c' \"d\\\"e\" f\\ g") == Words{"a", "b c", "d\"e", "f g"});
  CHECK(usage::words_of_line("a 'b c") == Words{"a", "b c"});
  CHECK(usage::words_of_line("a '' ") == Words{"a", "", ""});
  CHECK(usage::words_of_line("a \\") == Words{"a", ""});
  CHECK(usage::words_of_line("") == Words{""});
}

TEST_CASE("a shell is answered with what it has to replace") {
  CHECK(answer({"words", "play", "--defect", "on"}) == "words\none\tThe first\nonly\n");
  CHECK(answer({"words", "play", "cia/"}) == "words\ncia/sdo/\ncia/c\n");
  CHECK(answer({"words", "play", "c"}) == "words\ncia/sdo/\ncia/c\n");
  CHECK(answer({"words", "play", "--file", ""}) == "files\n");
  CHECK(answer({"words", "play", "--folder=x"}) == "folders\n");
  // readline ends words at "=", and sees quotes.
  CHECK(answer({"bash", "n", "program play --color=n"}) == "words\nnever\n");
  CHECK(answer({"bash", "", "program play --color="}) == "words\nauto\nalways\nnever\n");
  CHECK(answer({"bash", "'n", "program play --color='n"}) == "words\nnever\n");
  CHECK(answer({"bash", "", "program "}) == "words\nplay\neds\n");
  CHECK(answer({"bash", "program", "program"}) == "words\n");
  CHECK(answer({}) == "words\n");
  CHECK(answer({"words"}) == "words\n");
}

TEST_CASE("a closed set is read from the parser, whatever it is made of") {
  Sample sample;
  auto* play = sample.app.get_subcommand("play");
  using Words = std::vector<std::string>;
  CHECK(usage::closed_set_of(*play->get_option("--color")) == Words{"auto", "always", "never"});
  CHECK(usage::closed_set_of(*play->get_option("--profile")) == Words{"301", "401"});
  CHECK(usage::closed_set_of(*play->get_option("--count")).empty());
  CHECK(usage::closed_set_of(*play->get_option("--file")).empty());
}
