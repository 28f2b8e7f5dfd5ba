// SPDX-License-Identifier: Apache-2.0
// What is taken out of a capture to be replayed, and how two sets of answers are compared.
#include <algorithm>
#include <optional>

#include "can/simulated_bus.hpp"
#include "catch.hpp"
#include "cli/proof/selftest.hpp"
#include "cli/replay/differences.hpp"
#include "cli/replay/permission.hpp"
#include "cli/replay/player.hpp"
#include "cli/replay/replay_text.hpp"
#include "cli/replay/section.hpp"
#include "node/powered_node.hpp"
#include "replay_trace.hpp"
#include "shipped.hpp"

using namespace conform;
using namespace conform::cli;
using namespace conform::cli::testing;
using namespace std::chrono_literals;

TEST_CASE("a case is found by its comments, from its preparation until it is put back") {
  Trace trace;
  trace.ask(0, mark("a", CasePart::begin)).ask(1, mark("a", CasePart::end));
  trace.ask(2, mark("b", CasePart::preparation)).ask(3);
  trace.ask(4, mark("b", CasePart::step, 1) + "; " + mark("b", CasePart::begin))
      .ask(5, mark("b", CasePart::end));
  trace.ask(6, mark("b", CasePart::putting_back)).ask(7);
  trace.ask(8, mark("c", CasePart::preparation)).ask(9, mark("c", CasePart::begin));
  const auto& frames = trace.capture.frames();
  const auto b = section_of_case(frames, "b", "x.pcapng");
  REQUIRE(b);
  CHECK(b->first == 2);
  CHECK(b->end == 8);
  const auto a = section_of_case(frames, "a", "x.pcapng");
  REQUIRE(a);
  CHECK(a->first == 0);
  CHECK(a->end == 2);
  CHECK(section_of_case(frames, "c", "x.pcapng")->end == 10);
  CHECK(cases_in(frames) == std::vector<std::string>{"a", "b", "c"});
}

TEST_CASE("of a case that was tried again the last try is taken, and of one that was cut off its steps") {
  Trace twice;
  twice.ask(0, mark("a", CasePart::step, 1)).ask(1, mark("a", CasePart::step, 2));
  twice.ask(2, mark("a", CasePart::putting_back)).ask(3, mark("a", CasePart::preparation));
  twice.ask(4, mark("a", CasePart::begin))
      .ask(5, mark("a", CasePart::step, 2))
      .ask(6, mark("a", CasePart::end));
  CHECK(section_of_case(twice.capture.frames(), "a", {})->first == 3);
  Trace cut;
  cut.ask(0, mark("b", CasePart::begin)).ask(1, mark("b", CasePart::end));
  cut.ask(2, mark("a", CasePart::step, 1))
      .ask(3, mark("a", CasePart::step, 2))
      .ask(4, std::string(can::cases_are_over));
  const auto found = section_of_case(cut.capture.frames(), "a", {});
  REQUIRE(found);
  CHECK(found->first == 2);
  CHECK(found->end == 4);
}

TEST_CASE("of a case that the capture holds in part it is told what is not there") {
  const auto missing = [](const Trace& trace) {
    const auto section = section_of_case(trace.capture.frames(), "a", {});
    REQUIRE(section);
    return section->missing;
  };
  Trace whole, no_end, no_begin, steps, beheaded, only_end;
  whole.ask(0, mark("a", CasePart::begin))
      .ask(1, mark("a", CasePart::end))
      .ask(2, mark("b", CasePart::begin));
  CHECK(missing(whole).empty());
  no_end.ask(0, mark("a", CasePart::begin)).ask(1, mark("a", CasePart::step, 1));
  REQUIRE(missing(no_end).size() == 1);
  CHECK(missing(no_end)[0].contains("where the case ends"));
  no_begin.ask(1, mark("a", CasePart::step, 3)).ask(2, mark("a", CasePart::end));
  REQUIRE(missing(no_begin).size() == 1);
  CHECK(missing(no_begin)[0].contains("before step 3"));
  steps.ask(0, mark("a", CasePart::preparation)).ask(1, mark("a", CasePart::step, 1));
  steps.ask(2, mark("b", CasePart::step, 1));
  CHECK(missing(steps).size() == 2);
  beheaded.ask(0, mark("a", CasePart::cleanup, 1)).ask(1, mark("a", CasePart::end));
  REQUIRE(missing(beheaded).size() == 1);
  CHECK(missing(beheaded)[0].contains("none of its steps"));
  only_end.ask(0, mark("a", CasePart::end));
  const auto none = section_of_case(only_end.capture.frames(), "a", {});
  REQUIRE_FALSE(none);
  CHECK(none.error().what.contains("only the end"));
}

TEST_CASE("a case that is not there is an error that says what one may have meant") {
  Trace trace;
  trace.ask(0);
  const auto none = section_of_case(trace.capture.frames(), "a", "x.pcapng");
  REQUIRE_FALSE(none);
  CHECK(none.error().hint.find("--frames") != std::string::npos);
  trace.ask(1, mark("cia301/sdo/upload[1000h:00]", CasePart::begin));
  const auto near = section_of_case(trace.capture.frames(), "cia301/sdo/upload", "x.pcapng");
  REQUIRE_FALSE(near);
  CHECK(near.error().hint == "name the instance as well: cia301/sdo/upload[1000h:00]");
}

TEST_CASE("frames are named by numbers as Wireshark counts") {
  Trace trace;
  trace.ask(0).ask(1).ask(2);
  const auto section = section_of_numbers(trace.capture.frames(), "2-3", "x.pcapng");
  REQUIRE(section);
  CHECK(section->first == 1);
  CHECK(section->end == 3);
  CHECK(section_of_numbers(trace.capture.frames(), "2", "x.pcapng")->end == 2);
  for (const auto* wrong : {"", "0-1", "3-2", "2-4", "a-b", "1-", "-2", "1-2-3", "99999999999999999999"})
    CHECK_FALSE(section_of_numbers(trace.capture.frames(), wrong, "x.pcapng"));
}

TEST_CASE("what is heard belongs to the request that it answers, also where other frames go out in between") {
  Trace trace;
  trace.ask(1)
      .add(Direction::transmitted, 0x77E, {5})
      .answer(1, 1)
      .heartbeat(5)
      .ask(2)
      .answer(2, 2)
      .answer(2, 2);
  trace.add(Direction::transmitted, 0x000, {0x82, 5}).heartbeat(0).heartbeat(0x7F);
  const auto side = trace.side();
  const auto& sent = side.dialogue.sent;
  REQUIRE(sent.size() == 4);
  CHECK(sent[0].answers == std::vector<std::size_t>{2});
  CHECK(sent[1].answers.empty());
  CHECK(sent[2].answers == std::vector<std::size_t>{5, 6});
  CHECK(sent[3].answers == std::vector<std::size_t>{8});
  CHECK(side.dialogue.unasked == std::vector<std::size_t>{3, 9});
  CHECK(side.dialogue.turns.size() == 8);
}

TEST_CASE("an answer that was stamped before the echo of its request belongs to this request") {
  Trace trace;
  trace.ask(1).answer(1, 1).answer(2, 2);
  trace.add(Direction::transmitted, 0x605, {0x40, 0x18, 0x10, 2, 0, 0, 0, 0}, {}, 5us);
  const auto side = trace.side();
  CHECK(side.dialogue.sent[0].answers == std::vector<std::size_t>{1});
  CHECK(side.dialogue.sent[1].answers == std::vector<std::size_t>{2});
}

TEST_CASE("the same answers are the same, whenever they come") {
  Trace then, now;
  then.ask(1).answer(1, 7).heartbeat(0x7F).ask(2).answer(2, 8);
  now.ask(1).heartbeat(0x7F).answer(1, 7).ask(2).answer(2, 8);
  const auto out = compared(then, now);
  CHECK_FALSE(out.differs());
  REQUIRE(out.unasked.size() == 1);
  CHECK(out.unasked[0].not_compared == "when each comes");
}

TEST_CASE("another answer, none, and one too many each differ where they are") {
  Trace then, now;
  then.ask(1).answer(1, 7).ask(2).answer(2, 8).ask(3).answer(3, 9).ask(4);
  now.ask(1).answer(1, 7).ask(2).answer(2, 18).ask(3).ask(4).answer(4, 1);
  const auto out = compared(then, now);
  CHECK(out.exchanges_that_differ() == 3);
  CHECK_FALSE(out.exchanges[0].differs());
  REQUIRE(out.exchanges[1].answers.size() == 1);
  CHECK(out.exchanges[1].answers[0].fields ==
        std::vector<canopen::FieldDifference>{{"data", "08 00 00 00", "12 00 00 00"}});
  CHECK_FALSE(out.exchanges[2].answers[0].now);
  CHECK_FALSE(out.exchanges[3].answers[0].then);
  const auto then_side = then.side(), now_side = now.side();
  const auto text = replay_text(out, then_side, now_side, {}, true);
  CHECK(text.find("field data 08 00 00 00 -> 12 00 00 00") != std::string::npos);
  CHECK(text.find("now   nothing") != std::string::npos);
  CHECK(text.find("1018h:01") == std::string::npos);
  CHECK(replay_summary(out) == "differs: 3 of 4 frames answered otherwise");
}

TEST_CASE("silence then and now is no comparison, an answer or what comes unasked is one") {
  Trace silent, answered, heard;
  silent.ask(1);
  answered.ask(1).answer(1, 7);
  heard.ask(1).heartbeat(0x7F).heartbeat(0x7F);
  const auto nothing = compared(silent, silent);
  CHECK_FALSE(nothing.compares_something());
  CHECK(replay_summary(nothing).starts_with("nothing was compared"));
  CHECK(compared(silent, answered).compares_something());
  CHECK(compared(answered, answered).compares_something());
  CHECK(compared(heard, heard).compares_something());
  CHECK(replay_summary(compared(heard, heard)) == "same: 1 frame with the same answers");
}

TEST_CASE("a clock that is read legally tells another time") {
  Trace then, now;
  for (auto* const trace : {&then, &now}) {
    trace->add(Direction::transmitted, 0x605, {0x40, 0x13, 0x10, 0, 0, 0, 0, 0});
    trace->add(Direction::received, 0x585,
               {0x43, 0x13, 0x10, 0, trace == &then ? std::uint8_t{1} : std::uint8_t{9}, 0, 0, 0});
  }
  const auto out = compared(then, now);
  CHECK_FALSE(out.differs());
  CHECK(out.exchanges[0].answers[0].not_compared == "1013h counts time");
}

TEST_CASE("an emergency that does not come, and a heartbeat of another state or pace, differ") {
  Trace then, now;
  then.ask(1).answer(1, 7).add(Direction::received, 0x085, {0x10, 0x81, 0x11, 0, 0, 0, 0, 0});
  now.ask(1).answer(1, 7);
  for (int i = 0; i < 10; ++i) {
    then.heartbeat(0x7F, 100ms);
    now.heartbeat(0x05, 200ms);
  }
  const auto out = compared(then, now);
  CHECK(out.exchanges_that_differ() == 0);
  CHECK(out.unasked_that_differ() == 2);
  const auto heartbeat = std::ranges::find(out.unasked, "heartbeat of node 5", &Unasked::kind);
  REQUIRE(heartbeat != out.unasked.end());
  CHECK(heartbeat->differences.size() == 3);  // a state that is gone, one that is new, and the pace
}

TEST_CASE("an answer to what was asked before the section begins is not missed") {
  Trace then, now;
  then.add(Direction::transmitted, 0x000, {0x80, 5}).answer(9, 9).ask(1).answer(1, 7);
  now.add(Direction::transmitted, 0x000, {0x80, 5}).ask(1).answer(1, 7);
  CHECK_FALSE(compared(then, now).differs());
  CHECK(compared(now, then).differs());
}

TEST_CASE("guarding goes on with any toggle bit, but it must change, and begins with 0 behind a reset") {
  const auto guarded = [](std::initializer_list<std::uint8_t> answers,
                          std::optional<std::uint8_t> behind_reset = {}) {
    Trace out;
    const auto ask = [&out](std::uint8_t answer) {
      out.time += 1ms;
      out.capture.add({.frame = can::remote_frame(CanId(0x705), 1),
                       .time = out.time,
                       .direction = Direction::transmitted,
                       .comment = {}});
      out.heartbeat(answer);
    };
    for (const auto answer : answers) ask(answer);
    if (behind_reset) {
      out.add(Direction::transmitted, 0x000, {0x82, 5}).heartbeat(0);
      ask(*behind_reset);
    }
    return out;
  };
  CHECK_FALSE(compared(guarded({0x7F, 0xFF}), guarded({0xFF, 0x7F})).differs());
  CHECK(compared(guarded({0x7F, 0xFF}), guarded({0xFF, 0xFF})).exchanges_that_differ() == 1);
  CHECK(compared(guarded({0xFF, 0x7F, 0xFF}), guarded({0x7F, 0x7F, 0x7F})).exchanges_that_differ() == 1);
  CHECK_FALSE(compared(guarded({0xFF, 0x7F, 0x7F}), guarded({0x7F, 0x7F, 0x7F})).differs());
  CHECK_FALSE(compared(guarded({0x7F}, 0x7F), guarded({0xFF}, 0x7F)).differs());
  CHECK(compared(guarded({0x7F}, 0x7F), guarded({0x7F}, 0xFF)).exchanges_that_differ() == 1);
}

TEST_CASE(
    "segments of a block download that the device does not take are not sent: they could write anything") {
  Trace then;
  // Initiate, a segment that looks like a download to 5000h, the last one, their acknowledge, the end.
  then.add(Direction::transmitted, 0x601, {0xC0, 0x40, 0x10, 0, 0, 0, 0, 0});
  then.add(Direction::received, 0x581, {0xA0, 0x40, 0x10, 0, 1, 0, 0, 0});
  then.add(Direction::transmitted, 0x601, {0x2F, 0x00, 0x50, 0, 1, 0, 0, 0});
  then.add(Direction::transmitted, 0x601, {0xB0, 0, 0, 0, 0, 0, 0, 0});
  then.add(Direction::received, 0x581, {0xA2, 0x30, 1, 0, 0, 0, 0, 0});
  then.add(Direction::transmitted, 0x601, {0xC1, 0, 0, 0, 0, 0, 0, 0});
  then.add(Direction::received, 0x581, {0xA1, 0, 0, 0, 0, 0, 0, 0});
  then.add(Direction::transmitted, 0x601, {0x40, 0x00, 0x10, 0, 0, 0, 0, 0});
  then.add(Direction::received, 0x581, {0x43, 0x00, 0x10, 0, 0x91, 0x01, 0x0F, 0});
  const auto& profile = shipped::reference();
  const Side side(then.capture.frames(), 0, then.capture.size(), profile.node);
  // It might leave the transfer: the tier has to cover what the segment would be then.
  const auto refused = may_replay(side, profile, steps::Tier::config);
  REQUIRE_FALSE(refused);
  CHECK(refused.error().text().contains("frame 3"));
  auto device = refnode::PoweredNode::create({.node_id = profile.node.value()});
  REQUIRE(device.has_value());
  can::SimulatedBus bus;
  bus.attach(**device, "reference node");
  engine::Recorder recorder(bus.transport(), nullptr);
  REQUIRE(recorder.wait_until(recorder.now() + 2s));
  // The node has no object 1040h.
  const auto played = play(recorder, side, profile, {});
  REQUIRE(played.has_value());
  CHECK(played->skipped == std::vector<std::size_t>{1, 2});
  const Side now(recorder.capture().frames(), played->first, played->end, profile.node);
  const auto out = compare_replay(side, now, profile.node, played->skipped);
  REQUIRE(out.has_value());
  REQUIRE(out->exchanges.size() == 5);
  CHECK(out->exchanges[0].differs());
  CHECK_FALSE(out->exchanges[1].now);
  CHECK_FALSE(out->exchanges[2].now);
  CHECK_FALSE(out->exchanges[4].differs());
  CHECK(replay_text(*out, side, now, {}, true).find("not sent: the transfer was over") != std::string::npos);
}

TEST_CASE("a replay of which frames are missing is an error and no difference") {
  Trace then, now;
  then.ask(1).answer(1, 7).ask(2).answer(2, 8);
  now.ask(1).answer(1, 7);
  CHECK_FALSE(compare_replay(then.side(), now.side(), node));
}

TEST_CASE("nothing is sent that the tier or the profile forbids") {
  const auto& profile = shipped::reference();
  const auto id = 0x600U + profile.node.value();
  const auto verdict = [&](std::uint32_t can_id, std::initializer_list<std::uint8_t> bytes, steps::Tier tier,
                           const device::Profile& known) {
    Trace trace;
    trace.add(Direction::transmitted, can_id, bytes);
    const Side side(trace.capture.frames(), 0, 1, known.node);
    return may_replay(side, known, tier);
  };
  CHECK(verdict(id, {0x40, 0, 0x10, 0, 0, 0, 0, 0}, steps::Tier::read_only, profile));
  const auto write = verdict(id, {0x2F, 0x17, 0x10, 0, 1, 0, 0, 0}, steps::Tier::read_only, profile);
  REQUIRE_FALSE(write);
  CHECK(write.error().where == "frame 1");
  CHECK(write.error().hint.starts_with("--allow config"));
  CHECK(verdict(id, {0x2F, 0x17, 0x10, 0, 1, 0, 0, 0}, steps::Tier::config, profile));
  CHECK_FALSE(verdict(0x000, {1, profile.node.value()}, steps::Tier::config, profile));
  CHECK(verdict(0x000, {1, profile.node.value()}, steps::Tier::motion, profile));
  auto guarded = profile;
  guarded.untouchable.push_back({Index(0x1017), SubIndex(0)});
  CHECK_FALSE(verdict(id, {0x2F, 0x17, 0x10, 0, 1, 0, 0, 0}, steps::Tier::motion, guarded));
  CHECK_FALSE(verdict(id, {0x2F, 0x00, 0x50, 0, 1, 0, 0, 0}, steps::Tier::motion,
                      device::default_profile(profile.node)));
}

namespace {

/// The run of one scenario against the reference node with a defect, and what a node answers to the same
/// frames.
struct Replayed {
  SimulatedRun run;
  std::string name;
  Section section;
  can::Capture capture;
  Played played;

  Replayed(const std::string& scenario, const std::vector<std::string>& then,
           const std::vector<std::string>& now) {
    engine::RunOptions options;
    options.comment_parts = true;
    options.plan.selection.patterns = {scenario};
    auto done = simulate({.defects = then}, shipped::reference(), shipped::suites().suite,
                         shipped::suites().catalogue, options, 1);
    REQUIRE(done.has_value());
    run = std::move(*done);
    const auto& frames = run.capture.frames();
    const auto choose = [&](result::Verdict verdict) {
      return std::ranges::find_if(run.result.cases, [verdict](const result::CaseResult& one) {
        return one.verdict == verdict && one.suite != "monitor" && one.first_frame < one.end_frame;
      });
    };
    auto one = choose(result::Verdict::fail);
    if (one == run.result.cases.end()) one = choose(result::Verdict::pass);
    REQUIRE(one != run.result.cases.end());
    name = one->name();
    auto found = section_of_case(frames, name, {});
    INFO((found ? std::string() : found.error().text()));
    REQUIRE(found.has_value());
    section = *found;
    const auto& profile = shipped::reference();
    auto device = refnode::PoweredNode::create({.node_id = profile.node.value(), .defects = now});
    REQUIRE(device.has_value());
    can::SimulatedBus bus;
    bus.attach(**device, "reference node");
    engine::Recorder recorder(bus.transport(), nullptr);
    REQUIRE(recorder.wait_until(recorder.now() + 2s));
    const Side recorded(frames, section.first, section.end, profile.node);
    const auto done_now = play(recorder, recorded, profile, {});
    INFO((done_now ? std::string() : done_now.error().text()));
    REQUIRE(done_now.has_value());
    played = *done_now;
    capture = std::move(recorder.capture());
  }
  [[nodiscard]] ReplayComparison compare() const {
    const auto id = shipped::reference().node;
    const Side then(run.capture.frames(), section.first, section.end, id);
    const Side now(capture.frames(), played.first, played.end, id);
    const auto out = compare_replay(then, now, id, played.skipped);
    INFO((out ? std::string() : out.error().text()));
    REQUIRE(out.has_value());
    INFO(replay_text(*out, then, now, {}, true));
    return *out;
  }
};

}  // namespace

TEST_CASE("a failure replays: the same device answers the same, a right one otherwise") {
  struct Row {
    const char* scenario;
    const char* defect;
  };
  for (const auto& [scenario, defect] :
       {Row{"cia301/dictionary/1003-error-history/non-zero-write", "1003-nonzero-write-accepted"},
        Row{"cia301/sdo/upload", "sdo-double-response"},
        Row{"cia301/sdo/block-upload", "block-upload-numbers-from-0"}}) {
    INFO(scenario << " with " << defect);
    const Replayed same(scenario, {defect}, {defect});
    CHECK_FALSE(same.compare().differs());
    const Replayed other(scenario, {defect}, {});
    CHECK(other.compare().exchanges_that_differ() > 0);
  }
}

TEST_CASE("every frame of a replay goes out in its order and as far apart as then") {
  const Replayed replayed("cia301/sdo/segmented-upload", {}, {});
  const auto& frames = replayed.run.capture.frames();
  const auto id = shipped::reference().node;
  const Side then(frames, replayed.section.first, replayed.section.end, id);
  const Side now(replayed.capture.frames(), replayed.played.first, replayed.played.end, id);
  REQUIRE(then.dialogue.sent.size() == now.dialogue.sent.size());
  REQUIRE(then.dialogue.sent.size() > 1);
  for (std::size_t i = 1; i < then.dialogue.sent.size(); ++i) {
    const auto gap = [i](const Side& side) {
      return side.at(side.dialogue.sent[i].index).time - side.at(side.dialogue.sent[i - 1].index).time;
    };
    // Turnarounds of the simulated node are drawn anew.
    CHECK(std::abs((gap(then) - gap(now)).count()) < Duration(1ms).count());
  }
}

TEST_CASE("the frames of a run name the case and the step they belong to") {
  const Replayed replayed("cia301/dictionary/1003-error-history/non-zero-write", {}, {});
  const auto& frames = replayed.run.capture.frames();
  std::size_t steps = 0;
  for (auto i = replayed.section.first; i < replayed.section.end; ++i) {
    for (const auto& each : can::case_marks(frames[i].comment.view())) {
      CHECK(each.name == replayed.name);
      if (each.part != CasePart::step) continue;
      ++steps;
      CHECK(each.number > 0);
      CHECK_FALSE(each.words.empty());
    }
  }
  CHECK(steps > 0);
}

TEST_CASE("no frame is let through for what the capture says that it belongs to") {
  const auto& profile = shipped::reference();
  const auto refused = [&profile](const Trace& then) {
    const Side side(then.capture.frames(), 0, then.capture.size(), profile.node);
    return !may_replay(side, profile, steps::Tier::config).has_value();
  };
  // "save" to 1010h:01, alone and behind what makes it look like a segment of a block download.
  const auto store = [](Trace& trace, std::uint32_t id = 0x601) {
    trace.add(Direction::transmitted, id, {0x23, 0x10, 0x10, 1, 0x73, 0x61, 0x76, 0x65});
  };
  Trace alone, received, own, sent_as_answer;
  store(alone);
  received.add(Direction::received, 0x581, {0xA0, 0x17, 0x10, 0, 7, 0, 0, 0});
  store(received);
  own.add(Direction::transmitted, 0x601, {0xC2, 0, 0x10, 0, 4, 0, 0, 0});
  own.add(Direction::received, 0x581, {0xA0, 0, 0x10, 0, 0x7F, 0, 0, 0});
  store(own);
  sent_as_answer.add(Direction::transmitted, 0x601, {0xA3, 0, 0, 0, 0, 0, 0, 0});
  sent_as_answer.add(Direction::transmitted, 0x581, {0x2F, 0x10, 0x10, 1, 0, 0, 0, 0});
  CHECK(refused(alone));
  CHECK(refused(received));
  CHECK(refused(own));
  CHECK(refused(sent_as_answer));
}
