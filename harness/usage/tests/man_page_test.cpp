// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>

#include "catch.hpp"
#include "usage/manual.hpp"
#include "usage/roff.hpp"

using namespace conform;

namespace {

struct Sample {
  CLI::App app{"A program"};
  std::string name;
  bool quiet = false;

  Sample() {
    auto* play = app.add_subcommand("play", "Play .cases, 'all' of them");
    auto* name_option = play->add_option("-n,--name", name, "Name that --quiet needs")->type_name("NAME");
    play->add_flag("--quiet", quiet, "Print less")->needs(name_option);
    app.add_subcommand("guard", "For the program itself")->group("");
  }
};

usage::Manual manual() {
  return {.program = "program",
          .summary = "a program",
          .pages = {{"", {}, {{"0", "all is well"}}, {"It plays."}},
                    {"play", {{"program play -n x", "one"}}, {{"1", "it lost"}}}},
          .environment = [](CLI::App&) { return std::vector<usage::Entry>{{"PROGRAM_NAME", "as --name"}}; }};
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("text means nothing to roff but itself") {
  CHECK(usage::roff_text(".it's a \\ of \"x\" well-known") == "\\&.it\\(aqs a \\e of \\(dqx\\(dq well-known");
  CHECK(usage::roff_text("with --all-objects (-q)") == "with \\-\\-all\\-objects (\\-q)");
  CHECK(usage::roff_literal("a-b ~ ^ `") == "a\\-b \\(ti \\(ha \\(ga");
  CHECK(usage::roff_text("\xC3\xA4\xE2\x80\xA6\xF0\x9F\x98\x80") == "\\[u00E4]\\[u2026]\\[u1F600]");
}

TEST_CASE("each command that is not hidden has a page with its options") {
  Sample sample;
  const auto pages = usage::man_pages(sample.app, manual(), "2027-03-31", "1.2.3");
  REQUIRE(pages.size() == 2);
  CHECK(pages[0].name == "program.1");
  CHECK(pages[1].name == "program-play.1");
  const auto& whole = pages[0].text;
  CHECK(has(whole, ".TH PROGRAM 1 \"2027-03-31\""));
  CHECK(has(whole, ".SH NAME\nprogram \\- a program\n"));
  CHECK(has(whole, ".SH COMMANDS\n.TP\n\\fBprogram\\-play\\fR(1)\n"));
  CHECK_FALSE(has(whole, "guard"));
  const auto& play = pages[1].text;
  CHECK(has(play, "program\\-play \\- play .cases, \\(aqall\\(aq of them\n"));
  CHECK(has(play, ".TP\n\\fB\\-n\\fR, \\fB\\-\\-name\\fR \\fINAME\\fR\nName that \\-\\-quiet needs.\n"));
  CHECK(has(play, "Print less.\nIt needs \\fB\\-\\-name\\fR.\n"));
  CHECK(has(play, ".SH EXIT STATUS\n.TP\n\\fB1\\fR\nit lost.\n"));
  CHECK(has(play, ".SH ENVIRONMENT\n.TP\n\\fBPROGRAM_NAME\\fR\nas \\-\\-name.\n"));
  CHECK(has(play, ".SH EXAMPLES\n.TP\n\\fBprogram play \\-n x\\fR\none.\n"));
  CHECK(has(play, ".SH SEE ALSO\n\\fBprogram\\fR(1)\n"));
}

TEST_CASE("the help of a command ends with its examples") {
  Sample sample;
  usage::add_examples(sample.app, manual());
  const auto help = sample.app.get_subcommand("play")->help();
  CHECK(has(help, "Examples:\n  program play -n x\n      one\n"));
  CHECK_FALSE(has(sample.app.help(), "Examples"));
  CHECK(usage::example_list(manual()) == "0\tprogram play -n x\n");
}
