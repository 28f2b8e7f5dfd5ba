// SPDX-License-Identifier: Apache-2.0
#include "cli/proof/mutants.hpp"

#include <set>

#include "catch.hpp"
#include "cli/pages/mutants_page.hpp"
#include "cli/proof/explained.hpp"

using namespace conform;
using namespace conform::cli;
using result::Verdict;

namespace {

const Verdicts good{{{"A-1", "x"}, Verdict::pass}, {{"A-2", "y"}, Verdict::not_applicable}};
constexpr Mutant first{1, "sdo/crc.cpp", 10, "sdo_crc", "comparison", "i < 8", "i <= 8"};
constexpr Mutant second{2, "sdo/crc.cpp", 11, "sdo_crc", "constant", "i < 8", "i < 9"};
constexpr Mutant third{3, "nmt/nmt_slave.cpp", 7, "NmtSlave::enter", "statement", "f()", "/* nothing */"};
const std::vector<Mutant> all{first, second, third};

std::vector<Explanation> explanations(std::string_view text) {
  auto parsed = parse_explanations(text);
  REQUIRE(parsed.has_value());
  return std::move(*parsed);
}

}  // namespace

TEST_CASE("a verdict that differs is noticed, and a failure is named before it") {
  CHECK(difference(good, good).empty());
  auto other = good;
  other[{"A-1", "x"}] = Verdict::inconclusive;
  CHECK(difference(good, other) == "A-1 inconclusive in x");
  other[{"A-2", "y"}] = Verdict::fail;
  CHECK(difference(good, other) == "!A-2 fail in y");
  CHECK(difference(good, {{{"A-1", "x"}, Verdict::pass}}) == "A-2 not judged in y");
  auto ended = good;
  ended[{"the run", "no time passes"}] = Verdict::error;
  ended[{"A-2", "y"}] = Verdict::inconclusive;
  CHECK(difference(good, ended) == "~no time passes");
  ended[{"A-2", "y"}] = Verdict::fail;
  CHECK(difference(good, ended) == "!A-2 fail in y");
  auto applicable = good;
  applicable[{"A-2", "y"}] = Verdict::pass;
  CHECK(difference(good, applicable) == "A-2 pass in y");
}

TEST_CASE("how a run ended says what became of the mutant") {
  using Kind = Ending::Kind;
  CHECK(fate_of(first, {Kind::returned, ""}).fate == Fate::survived);
  CHECK(fate_of(first, {Kind::returned, "A-1 warn in x"}).fate == Fate::noticed);
  const auto killed = fate_of(first, {Kind::returned, "!A-1 fail in x"});
  CHECK(killed.fate == Fate::killed);
  CHECK(killed.how == "A-1 fail in x");
  const auto ended = fate_of(first, {Kind::returned, "~no time passes"});
  CHECK(ended.fate == Fate::hung);
  CHECK(ended.how == "no time passes");
  CHECK(fate_of(first, {Kind::crashed, "SIGSEGV"}).fate == Fate::crashed);
  CHECK(fate_of(first, {Kind::hung, ""}).fate == Fate::hung);
  CHECK(fate_of(first, {Kind::out_of_memory, ""}).fate == Fate::hung);
}

TEST_CASE("mutants are chosen by number, room and file, and a sample is the same for the same seed") {
  CHECK(chosen(all, {}).size() == 3);
  CHECK(chosen(all, {.only = {"sdo"}}).size() == 2);
  CHECK(chosen(all, {.only = {"3", "nmt"}}).front()->number == 3);
  CHECK(chosen(all, {.only = {"sdo/crc.cpp"}}).size() == 2);
  CHECK(chosen(all, {.seed = 5, .sample = 2}) == chosen(all, {.seed = 5, .sample = 2}));
  std::set<std::uint32_t> drawn;
  for (std::uint64_t seed = 1; seed < 40; ++seed)
    drawn.insert(chosen(all, {.seed = seed, .sample = 1})[0]->number);
  CHECK(drawn.size() == 3);
}

TEST_CASE("a survivor is explained by the words of its place, and a line that explains nobody is named") {
  std::vector<MutantFate> fates{{&first, Fate::survived}, {&second, Fate::killed}};
  const auto stale = explain(fates, all,
                             explanations("# words\n"
                                          "sdo/crc.cpp sdo_crc `i < 8` -> `i <= 8` equivalent: never there\n"
                                          "sdo/crc.cpp sdo_crc `i < 8` -> `i < 9` no rule: was killed\n"
                                          "sdo/crc.cpp sdo_crc `i < 7` -> `*` no rule: is gone\n"
                                          "nmt/nmt_slave.cpp * `*` -> `*` open: was not run\n"));
  CHECK(fates[0].explained == "equivalent: never there");
  REQUIRE(stale.size() == 2);
  CHECK(stale[0].ends_with("is noticed"));
  CHECK(stale[1].ends_with("there is no such mutant"));
  CHECK(explanation_key(first) == "sdo/crc.cpp sdo_crc `i < 8` -> `i <= 8`");
}

TEST_CASE("an explanation says what kind of reason it has") {
  CHECK_FALSE(parse_explanations("sdo/crc.cpp sdo_crc `i < 8` -> `i <= 8` because").has_value());
  CHECK_FALSE(parse_explanations("sdo/crc.cpp sdo_crc `i < 8` -> `i <= 8` equivalent:").has_value());
  CHECK_FALSE(parse_explanations("sdo/crc.cpp `i < 8` -> `i <= 8` equivalent: x").has_value());
}

TEST_CASE("what is explained or not reached counts neither for nor against the suite; a gap counts") {
  MutantScore score;
  score.add({&first, Fate::survived, "", "equivalent: x"});
  score.add({&first, Fate::not_reached});
  score.add({&first, Fate::survived, "", "open: x"});
  score.add({&first, Fate::killed});
  score.add({&first, Fate::noticed});
  score.add({&first, Fate::noticed, "", "no rule: x"});
  score.add({&first, Fate::killed, "", "no rule: x"});
  CHECK(score.all == 7);
  CHECK(score.explained == 2);
  CHECK(score.judged == 4);
  CHECK(score.share_noticed() == 75.0);
  CHECK(score.share_failed() == 50.0);
}

TEST_CASE("a node that crashes or hangs is noticed, and not asked for a failure") {
  MutantScore score;
  score.add({&first, Fate::crashed});
  score.add({&first, Fate::hung});
  score.add({&first, Fate::killed});
  CHECK(score.judged == 3);
  CHECK(score.share_noticed() == 100.0);
  CHECK(score.share_failed() == 100.0);
}

TEST_CASE("another legal device may be noticed without a failure, an equivalent one may not") {
  std::vector<MutantFate> fates{{&first, Fate::noticed}, {&second, Fate::noticed}, {&third, Fate::killed}};
  const auto stale = explain(fates, all,
                             explanations("sdo/crc.cpp sdo_crc `i < 8` -> `i <= 8` no rule: x\n"
                                          "sdo/crc.cpp sdo_crc `i < 8` -> `i < 9` equivalent: x\n"
                                          "nmt/nmt_slave.cpp * `f()` -> `*` no rule: x\n"));
  CHECK(fates[0].explained == "no rule: x");
  CHECK(fates[1].explained.empty());
  CHECK(stale.size() == 2);
}

TEST_CASE("who survived is named, and a program without mutants says so") {
  const std::vector<MutantFate> fates{{&first, Fate::survived}, {&second, Fate::killed, "A-1 fail in x"}};
  CHECK(score_of(fates).survived == 1);
  CHECK(score_of(fates).share_noticed() == 50.0);
  CHECK(mutants_words(fates, false)
            .starts_with("SURVIVES 1 line 10: sdo/crc.cpp sdo_crc `i < 8` -> `i <= 8`\n"));
  CHECK(mutants_page(fates).find("| sdo/crc.cpp sdo_crc | `i < 8` | `i <= 8` | not known yet |") !=
        std::string::npos);
  CHECK(mutant_build() == nullptr);
}
