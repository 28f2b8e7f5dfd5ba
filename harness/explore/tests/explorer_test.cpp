// SPDX-License-Identifier: Apache-2.0
#include "explore/explorer.hpp"

#include <algorithm>
#include "catch.hpp"

#include "explore/tests/device.hpp"

using namespace conform;
using namespace conform::explore;

namespace {

SearchResult search_for(const std::string& defect, std::size_t actions, std::uint64_t seed = 1) {
  SearchOptions options;
  options.seed = seed;
  options.most_actions = actions;
  options.most_findings = 2;
  options.most_tries = 100;
  options.repeats = 1;
  std::vector<std::string> defects;
  if (!defect.empty()) defects.push_back(defect);
  const auto bench = bench_of(defects);
  const auto words = words_of_the_standard();
  auto out = search(bench, words, options);
  REQUIRE(out);
  return std::move(*out);
}

bool names(const SearchResult& result, std::string_view requirement) {
  return std::ranges::any_of(result.findings, [&](const Finding& each) {
    return each.assigned && each.assigned->requirement == requirement;
  });
}

}  // namespace

TEST_CASE("the same seed draws the same conversation, another one another") {
  const auto words = words_of_the_standard();
  CHECK(draw(words, 7, 50) == draw(words, 7, 50));
  CHECK(draw(words, 7, 50) != draw(words, 8, 50));
  CHECK(draw(words, 7, 50).size() >= 50);
}

TEST_CASE("a device that is as its model shows no difference") {
  const auto result = search_for("", 1000);
  CHECK(result.findings.empty());
  CHECK(result.actions >= 1000);
}

TEST_CASE("the same seed finds the same") {
  const auto one = search_for("sdo-served-in-stopped", 1000, 3),
             other = search_for("sdo-served-in-stopped", 1000, 3);
  REQUIRE(one.findings.size() == other.findings.size());
  for (std::size_t i = 0; i < one.findings.size(); ++i)
    CHECK(one.findings[i].conversation == other.findings[i].conversation);
}

TEST_CASE("a defect is found without any scenario, in few actions, and its requirement is named") {
  const std::pair<const char*, const char*> defects[] = {
      {"sdo-served-in-stopped", "SDO-GEN-15"},
      {"nmt-start-ignored", "NMT-FSA-01"},
      {"unknown-ccs-silent", "SDO-ERR-02"},
  };
  for (const auto& [defect, requirement] : defects) {
    INFO(defect);
    const auto result = search_for(defect, 20'000);
    REQUIRE(!result.findings.empty());
    CHECK(result.findings.front().conversation.size() <= 6);
    CHECK(!result.findings.front().is_flaky());
    CHECK(names(result, requirement));
  }
}

TEST_CASE("a budget of actions ends the search") {
  const auto result = search_for("", 500);
  CHECK(result.actions >= 500);
  CHECK(result.actions < 700);
}

TEST_CASE("a device without PDOs, and one with nothing at all, are talked about to the end") {
  auto words = words_of_the_standard();
  for (const bool nothing : {false, true}) {
    std::erase_if(words.entries,
                  [&](const device::Entry& entry) { return nothing || entry.mux.index >= Index(0x1400); });
    for (std::uint64_t seed = 1; seed <= 300; ++seed) CHECK(draw(words, seed, 60).size() < 200);
    SearchOptions options;
    options.most_actions = 500;
    REQUIRE(search(bench_of({}), words, options));
  }
}

TEST_CASE("what a legal choice explains is no finding, and the choice is told") {
  const auto words = words_of_the_standard();
  SearchOptions options;
  options.most_actions = 3000;
  options.offer = offer_of({"boot-up-200ms", "boot-up-at-once", "sdo-turnaround-90ms", "boot-up-2s"});
  const auto search_with = [&](const std::vector<std::string>& variants) {
    auto bench = bench_of({});
    bench.device = reference_node({}, variants);
    const auto out = search(bench, words, options);
    REQUIRE(out);
    return *out;
  };
  const auto plain = search_with({});
  CHECK(plain.findings.empty());
  CHECK(plain.chosen.empty());
  for (const auto* id : {"boot-up-2s", "boot-up-at-once", "sdo-turnaround-90ms"}) {
    INFO(id);
    const auto result = search_with({id});
    CHECK(result.findings.empty());
    CHECK(result.chosen == std::vector<std::string>{id});
  }
  const auto both = search_with({"sdo-turnaround-90ms", "boot-up-200ms"});
  CHECK(both.findings.empty());
  CHECK(both.chosen.size() == 2);
}

TEST_CASE("a choice that the device contradicts later was none, and is not learnt again") {
  using namespace std::chrono_literals;
  const Conversation talk{nmt(NodeId(5), 0x82), wait(300ms), upload({Index(0x1000), SubIndex(0)})};
  const auto offer = offer_of({"boot-up-2s"});
  auto bench = bench_of({});
  Adapter adapter(bench, offer);
  bench.device = reference_node({}, {"boot-up-2s"});
  const auto slow = play(bench, talk, true);
  REQUIRE(slow);
  REQUIRE(slow->difference);
  CHECK(adapter.learn(talk, *slow) == Choices{0});
  bench.device = reference_node({});
  const auto quick = play(bench, talk, true);
  REQUIRE(quick);
  REQUIRE(quick->difference);
  CHECK(adapter.learn(talk, *quick) == Choices{});
  CHECK(adapter.chosen().empty());
  CHECK_FALSE(adapter.learn(talk, *slow).has_value());
}

TEST_CASE("a model that is to explain a device is no slower than it") {
  // What a device does too early would be late answers of such a model, whatever it is.
  auto bench = bench_of({});
  bench.model = reference_node({}, {"sdo-turnaround-90ms"});
  const Conversation talk{upload({Index(0x1000), SubIndex(0)})};
  const auto patient = play(bench, talk);
  REQUIRE(patient);
  CHECK_FALSE(patient->difference.has_value());
  bench.model_may_be_slower = false;
  const auto strict = play(bench, talk);
  REQUIRE(strict);
  REQUIRE(strict->difference.has_value());
  CHECK(strict->difference->what == Difference::What::late);
}

TEST_CASE("a defect is found behind the legal choices of its device") {
  auto bench = bench_of({});
  bench.device = reference_node({"sdo-served-in-stopped"}, {"boot-up-200ms"});
  SearchOptions options;
  options.most_actions = 20'000;
  options.most_findings = 2;
  options.offer = offer_of({"boot-up-200ms", "boot-up-at-once", "boot-up-2s"});
  const auto result = search(bench, words_of_the_standard(), options);
  REQUIRE(result);
  CHECK(names(*result, "SDO-GEN-15"));
  CHECK(result->chosen == std::vector<std::string>{"boot-up-200ms"});
}

TEST_CASE("what a device did is held against another model without asking it again") {
  using namespace std::chrono_literals;
  const NodeId node(5);
  const Conversation conversations[] = {
      {download({Index(0x1017), SubIndex(0)}, {0x32, 0}), wait(200ms), nmt(node, 1), wait(100ms)},
      {nmt(node, 0x82), wait(100ms), upload({Index(0x1000), SubIndex(0)}),
       upload({Index(0x1018), SubIndex(1)})},
  };
  for (const auto* id : {"heartbeat-at-state-change", "boot-up-200ms"}) {
    for (const auto& conversation : conversations) {
      INFO(id << ", " << conversation.size() << " actions");
      auto bench = bench_of({});
      unsigned made = 0;
      bench.device = [&made, make = reference_node({}, {id})] {
        ++made;
        return make();
      };
      const auto kept = play(bench, conversation, true);
      REQUIRE(kept);
      REQUIRE(kept->recording);
      CHECK(made == 1);
      const auto same = play(bench, conversation, *kept->recording);
      REQUIRE(same);
      CHECK(same->difference.has_value() == kept->difference.has_value());
      bench.model = reference_node({}, {id});
      const auto right = play(bench, conversation, *kept->recording);
      REQUIRE(right);
      CHECK_FALSE(right->difference.has_value());
      CHECK(made == 1);
    }
  }
}

TEST_CASE("four bytes of a server that tells no length may be fewer") {
  const Answer told{.kind = Answer::Kind::confirmed, .data = {7, 0}},
      open{.kind = Answer::Kind::confirmed, .data = {7, 0, 0, 0}, .size_told = false},
      other{.kind = Answer::Kind::confirmed, .data = {8, 0, 0, 0}, .size_told = false};
  CHECK(told.same_as(open));
  CHECK(open.same_as(told));
  CHECK_FALSE(told.same_as(other));
  auto long_one = open;
  long_one.size_told = true;
  CHECK_FALSE(told.same_as(long_one));
}

TEST_CASE("what is waited for behind the abort of a former transfer is not the time of the device") {
  // It names the transfer that it ends, so that the answer to the new request is waited for in vain.
  auto bench = bench_of({});
  bench.device = reference_node({}, {"sdo-busy-names-transfer"});
  bench.model = bench.device;
  auto talk = upload({Index(0x1008), SubIndex(0)}, Transfer::block);
  talk.fault = "new initiate after segment 1";
  const Conversation conversation{talk};
  const auto played = play(bench, conversation);
  REQUIRE(played);
  REQUIRE(played->answers.size() == 1);
  const auto& answer = played->answers.front();
  CHECK(answer.kind == Answer::Kind::aborted);
  CHECK(answer.taken > std::chrono::seconds(1));
  CHECK(answer.answered < std::chrono::milliseconds(20));
}

TEST_CASE("no choice is learnt that changes what the device was seen to hold") {
  // Silence where a TPDO is due would be explained by a device that has none by default; this one has.
  auto bench = bench_of({"nmt-start-ignored"});
  SearchOptions options;
  options.most_actions = 5000;
  options.most_findings = 6;
  options.offer = offer_of({"tpdos-not-valid"});
  auto words = words_of_the_standard();
  device::Entry cob_id;
  cob_id.mux = {Index(0x1800), SubIndex(1)};
  cob_id.claimed = true;
  words.entries.push_back(cob_id);
  const auto result = search(bench, words, options);
  REQUIRE(result);
  CHECK(result->chosen.empty());
}

TEST_CASE("a device that says nothing is not explained by one that only takes long") {
  using namespace std::chrono_literals;
  const Conversation talk{download({Index(0x1017), SubIndex(0)}, {100, 0}, Transfer::block)};
  const auto offer = offer_of({"sdo-block-download-erases"});
  auto bench = bench_of({});
  Adapter adapter(bench, offer);
  auto played = play(bench, talk, true);
  REQUIRE(played);
  auto silence = *played->recording;
  silence.answers = {{.kind = Answer::Kind::silence, .taken = 3s}};
  silence.ends = {silence.booted + 3s};
  silence.end = silence.booted + 3300ms;
  played->recording = std::make_shared<const Recording>(silence);
  const auto held = play(bench, talk, silence);
  REQUIRE(held);
  REQUIRE(held->difference);
  played->difference = held->difference;
  CHECK_FALSE(adapter.learn(talk, *played).has_value());
}
