// SPDX-License-Identifier: Apache-2.0
// What a replay leaves on the bus: transfers that stay open, stamps that run wild, and slaves that LSS would
// hit.
#include <algorithm>
#include <atomic>
#include <functional>
#include <optional>

#include "can/simulated_bus.hpp"
#include "catch.hpp"
#include "cli/proof/selftest.hpp"
#include "cli/replay/lss_state.hpp"
#include "cli/replay/open_transfers.hpp"
#include "cli/replay/player.hpp"
#include "cli/replay/section.hpp"
#include "cli/replay/stamps.hpp"
#include "engine/sdo_channel.hpp"
#include "node/powered_node.hpp"
#include "replay_trace.hpp"
#include "shipped.hpp"

using namespace conform;
using namespace conform::cli;
using namespace conform::cli::testing;
using namespace std::chrono_literals;

namespace {

/// A transfer with the reference node, and what becomes of its replay.
struct Transferred {
  static constexpr Multiplexer domain{Index(0x2000), SubIndex(0x0F)};
  can::Capture then, now;
  Played played;
  std::optional<Error> stopped;
  std::vector<can::Frame> heard;  ///< by the node, in the replay

  Transferred(canopen::SdoRequest request,
              const std::function<void(Transferred&, can::SimulatedBus&, std::atomic<int>&)>& trouble,
              const std::vector<std::string>& variants = {}) {
    const auto& profile = shipped::reference();
    const auto on_bus = [&](const std::vector<std::string>& varied, const auto& act) {
      auto device = refnode::PoweredNode::create({.node_id = profile.node.value(), .variants = varied});
      REQUIRE(device.has_value());
      can::SimulatedBus bus;
      bus.attach(**device, "reference node");
      std::atomic<int> stop{0};
      engine::Recorder recorder(bus.transport(), &stop);
      REQUIRE(recorder.wait_until(recorder.now() + 2s));
      act(recorder, bus, stop);
    };
    on_bus({}, [&](engine::Recorder& recorder, can::SimulatedBus&, std::atomic<int>&) {
      engine::SdoChannel channel(recorder, profile.node, profile.sdo_timeout, profile.quiet_time);
      first_ = recorder.capture().size();
      const steps::SdoJob job{.request = std::move(request)};
      const auto answers = channel.run({&job, 1});
      REQUIRE(answers.has_value());
      REQUIRE(answers->front().kind == steps::SdoAnswer::Kind::confirmed);
      then = recorder.capture();
    });
    on_bus(variants, [&](engine::Recorder& recorder, can::SimulatedBus& bus, std::atomic<int>& stop) {
      trouble(*this, bus, stop);
      auto done = play(recorder, side(), profile, {});
      if (done) {
        played = std::move(*done);
      } else {
        stopped = done.error();
      }
      stop = 0;
      // As the bus has it, behind all that is on its way.
      REQUIRE(recorder.wait_until(recorder.now() + 100ms));
      now = recorder.capture();
    });
  }
  [[nodiscard]] Side side() const { return {then.frames(), first_, then.size(), shipped::reference().node}; }
  [[nodiscard]] std::size_t aborts() const {
    return static_cast<std::size_t>(std::ranges::count_if(now.frames(), [](const can::CapturedFrame& each) {
      return each.direction == Direction::transmitted && each.frame.is_data(CanId(0x601)) &&
             each.frame.data[0] == 0x80;
    }));
  }
  [[nodiscard]] std::size_t sent() const {
    return static_cast<std::size_t>(
        std::ranges::count(now.frames(), Direction::transmitted, &can::CapturedFrame::direction));
  }

 private:
  std::size_t first_ = 0;
};

canopen::SdoRequest block_download(std::size_t bytes) {
  return {.upload = false, .object = Transferred::domain, .data = Bytes(bytes, 0x2F), .block = true};
}

/// Loses the n-th frame of the replay on its way to the device.
auto losing(std::uint64_t number) {
  return [number](Transferred&, can::SimulatedBus& bus, std::atomic<int>&) {
    bus.drop_frame(bus.frame_count() + number);
  };
}

/// Asks for a stop when so many frames of a replay were sent.
class Stopper final : public can::Participant {
 public:
  Stopper(std::size_t frames, std::atomic<int>& stop) : left_(frames), stop_(stop) {}
  void attach(Sender, BusTime) override {}
  void on_frame(const can::Frame& frame, BusTime) override {
    if (frame.id == 0x601 && left_ > 0 && --left_ == 0) stop_ = 2;
  }
  void on_time(BusTime) override {}
  [[nodiscard]] std::optional<BusTime> next_wakeup() const override { return std::nullopt; }

 private:
  std::size_t left_;
  std::atomic<int>& stop_;
};

}  // namespace

TEST_CASE("a block download that loses nothing is replayed to its end") {
  const Transferred whole(block_download(2000), [](auto&, auto&, auto&) {});
  CHECK(whole.played.skipped.empty());
  CHECK(whole.played.notes.empty());
  CHECK(whole.aborts() == 0);
}

TEST_CASE(
    "a segment that is lost ends the transfer: nothing that the device takes for something else is sent") {
  // Frame 1 initiates, 2 is its answer, and segments follow: one in the middle of the first sub-block is
  // lost.
  for (const auto& variants : {std::vector<std::string>{}, {"sdo-gap-at-once"}}) {
    const Transferred lost(block_download(2000), losing(40), variants);
    REQUIRE(lost.played.notes.size() == 1);
    INFO(lost.played.notes[0]);
    CHECK(lost.played.notes[0].contains("acknowledges segment 37, and acknowledged 127 then"));
    CHECK(lost.played.aborts.size() == 1);
    CHECK(lost.aborts() == 1);
    const auto side = lost.side();
    const auto skipped = lost.played.skipped.size();
    CHECK(skipped > (variants.empty() ? 150U : 200U));
    CHECK(lost.sent() == side.dialogue.sent.size() - skipped + 1);
    const auto& node_id = shipped::reference().node;
    const Side now(lost.now.frames(), lost.played.first, lost.played.end, node_id);
    const auto compared_now = compare_replay(side, now, node_id, lost.played.skipped, lost.played.aborts);
    INFO((compared_now ? std::string() : compared_now.error().text()));
    REQUIRE(compared_now);
    CHECK(compared_now->differs());
  }
}

TEST_CASE("a replay that is stopped aborts the transfer that it leaves open, and says what was not sent") {
  std::optional<Stopper> stopper;
  const auto stop_after = [&stopper](std::size_t frames) {
    return [&stopper, frames](Transferred&, can::SimulatedBus& bus, std::atomic<int>& stop) {
      stopper.emplace(frames, stop);
      bus.attach(*stopper, "stopper");
    };
  };
  const canopen::SdoRequest upload{.upload = true, .object = Transferred::domain};
  for (const auto& request : {upload, block_download(500)}) {
    const Transferred cut(request, stop_after(5));
    REQUIRE(cut.stopped);
    INFO(cut.stopped->text());
    CHECK(cut.stopped->what == engine::stopped);
    CHECK(cut.stopped->hint.contains("the transfer that was open was aborted: 2000h:0F on 601h"));
    CHECK(cut.aborts() == 1);
    const auto side = cut.side();
    const auto first = side.dialogue.sent[cut.sent() - 1].index + 1,
               last = side.dialogue.sent.back().index + 1;
    CHECK(cut.stopped->hint.contains("frames " + std::to_string(first) + " to " + std::to_string(last) +
                                     " were not sent"));
  }
}

TEST_CASE("frames that end within a transfer leave none open") {
  Trace begun;
  begun.add(Direction::transmitted, 0x601, {0x40, 0x00, 0x20, 0x0F, 0, 0, 0, 0});
  const auto& profile = shipped::reference();
  const Side side(begun.capture.frames(), 0, 1, profile.node);
  auto device = refnode::PoweredNode::create({.node_id = profile.node.value()});
  REQUIRE(device.has_value());
  can::SimulatedBus bus;
  bus.attach(**device, "reference node");
  engine::Recorder recorder(bus.transport(), nullptr);
  REQUIRE(recorder.wait_until(recorder.now() + 2s));
  const auto played = play(recorder, side, profile, {});
  REQUIRE(played);
  REQUIRE(played->notes.size() == 1);
  CHECK(played->notes[0].contains("2000h:0F on 601h"));
  const auto& frames = recorder.capture().frames();
  CHECK(std::ranges::count(frames, can::data_frame(CanId(0x601), {0x80, 0x00, 0x20, 0x0F, 0, 0, 0, 8}),
                           &can::CapturedFrame::frame) == 1);
}

TEST_CASE("a transfer is open until its last frame, its abort or a reset") {
  const auto open = [](std::initializer_list<std::initializer_list<std::uint8_t>> frames) {
    // Alternately ours and the server's; an empty one is left out.
    OpenTransfers out;
    bool ours = true;
    for (const auto& bytes : frames) {
      if (bytes.size() > 0 && ours) out.sent(can::data_frame(CanId(0x605), bytes));
      if (bytes.size() > 0 && !ours) out.received(can::data_frame(CanId(0x585), bytes));
      ours = !ours;
    }
    return out.all().size() == 1;
  };
  using Bytes8 = std::initializer_list<std::uint8_t>;
  const Bytes8 upload{0x40, 0, 0x20, 1, 0, 0, 0, 0}, download{0x21, 0, 0x20, 1, 9, 0, 0, 0};
  const Bytes8 blocks_down{0xC2, 0, 0x20, 1, 9, 0, 0, 0}, blocks_up{0xA0, 0, 0x20, 1, 9, 0, 0, 0};
  CHECK(open({upload}));
  CHECK(open({upload, {0x41, 0, 0x20, 1, 9, 0, 0, 0}, {0x60, 0, 0, 0, 0, 0, 0, 0}}));
  CHECK_FALSE(open({upload, {0x43, 0, 0x20, 1, 9, 0, 0, 0}}));
  CHECK_FALSE(open({upload, {0x80, 0, 0x20, 1, 0, 0, 2, 6}}));
  CHECK_FALSE(open({upload, {}, {0x80, 0, 0x20, 1, 0, 0, 0, 8}}));
  CHECK_FALSE(open({{0x2F, 0, 0x20, 1, 9, 0, 0, 0}, {0x60, 0, 0x20, 1, 0, 0, 0, 0}}));
  CHECK(open(
      {download, {0x60, 0, 0x20, 1, 0, 0, 0, 0}, {0x00, 1, 2, 3, 4, 5, 6, 7}, {0x20, 0, 0, 0, 0, 0, 0, 0}}));
  CHECK_FALSE(open(
      {download, {0x60, 0, 0x20, 1, 0, 0, 0, 0}, {0x0B, 8, 9, 0, 0, 0, 0, 0}, {0x20, 0, 0, 0, 0, 0, 0, 0}}));
  CHECK(open({blocks_down, {0xA4, 0, 0x20, 1, 127, 0, 0, 0}, {0x01, 1, 2, 3, 4, 5, 6, 7}, {}, {0x82, 8, 9}}));
  CHECK_FALSE(open({blocks_down,
                    {0xA4, 0, 0x20, 1, 127, 0, 0, 0},
                    {0x81, 1, 2, 3, 4, 5, 6, 7},
                    {0xA2, 1, 127, 0, 0, 0, 0, 0},
                    {0xD5, 0, 0, 0, 0, 0, 0, 0},
                    {0xA1, 0, 0, 0, 0, 0, 0, 0}}));
  CHECK(open(
      {blocks_up, {0xC6, 0, 0x20, 1, 7, 0, 0, 0}, {0xA3, 0, 0, 0, 0, 0, 0, 0}, {0x81, 1, 2, 3, 4, 5, 6, 7}}));
  CHECK_FALSE(open({blocks_up,
                    {0xC6, 0, 0x20, 1, 7, 0, 0, 0},
                    {0xA3, 0, 0, 0, 0, 0, 0, 0},
                    {0x81, 1, 2, 3, 4, 5, 6, 7},
                    {0xA2, 1, 127, 0, 0, 0, 0, 0},
                    {0xC1, 0, 0, 0, 0, 0, 0, 0},
                    {0xA1, 0, 0, 0, 0, 0, 0, 0}}));
  OpenTransfers reset;
  reset.sent(can::data_frame(CanId(0x605), upload));
  reset.sent(can::data_frame(CanId(0x606), upload));
  reset.sent(can::data_frame(CanId(0x000), {0x82, 5}));
  REQUIRE(reset.all().size() == 1);
  CHECK(reset.all()[0].request == CanId(0x606));
  reset.received(can::data_frame(CanId(0x706), {0}));
  CHECK(reset.all().empty());
}

namespace {

Result<void> bounded(const Trace& trace) { return gaps_are_bounded(trace.side()); }

}  // namespace

TEST_CASE("a gap that no case has is refused with both frames, whatever lies in it") {
  Trace usual, years, in_steps;
  usual.ask(1).answer(1, 7).add(Direction::transmitted, 0x605, {0x40, 0, 0x10, 0, 0, 0, 0, 0}, {}, 1h);
  CHECK(bounded(usual));
  years.ask(1).answer(1, 7);
  years.add(Direction::transmitted, 0x605, {0x40, 0, 0x10, 0, 0, 0, 0, 0}, {}, 24h * 365 * 290);
  const auto refused = bounded(years);
  REQUIRE_FALSE(refused);
  CHECK(refused.error().what.contains("frame 3 (at 9145440000.002000 s)"));
  CHECK(refused.error().what.contains("frame 2 (at 0.002000 s)"));
  in_steps.ask(1).heartbeat(5, 40min).heartbeat(5, 40min);
  REQUIRE_FALSE(bounded(in_steps));
  CHECK(bounded(in_steps).error().what.contains("frame 3 "));
  CHECK(bounded(in_steps).error().what.contains("frame 1 "));
}

TEST_CASE("stamps at the ends of what can be counted neither overflow nor make a replay wait") {
  Trace trace;
  const auto at = [&trace](BusTime time) {
    trace.capture.add({.frame = can::data_frame(CanId(0x605), {0x40, 0, 0x10, 0, 0, 0, 0, 0}),
                       .time = time,
                       .direction = Direction::transmitted,
                       .comment = {}});
  };
  at(BusTime::max());
  at(BusTime::min());
  at(BusTime::max());
  CHECK_FALSE(bounded(trace));
  CHECK_FALSE(set_back_note(trace.side()).empty());
  Trace back;
  back.ask(1).answer(1, 7);
  back.add(Direction::transmitted, 0x605, {0x40, 0, 0x10, 0, 0, 0, 0, 0}, {}, -24h * 365 * 200);
  back.ask(2);
  CHECK(bounded(back));
  const auto side = back.side();
  CHECK(set_back_note(side).starts_with("the stamps run back at frame 3, by "));
  const SteadyTimes times(side.frames, side.first, side.end);
  CHECK(times.at(2) == times.at(1));
  CHECK(times.at(3) - times.at(2) == 1ms);
  Trace jitter;
  jitter.ask(1).answer(1, 7).add(Direction::transmitted, 0x605, {0x40, 0, 0x10, 0, 0, 0, 0, 0}, {}, -20us);
  CHECK(set_back_note(jitter.side()).empty());
}

TEST_CASE("a slave is not configured by LSS before a frame has said which one") {
  Trace trace;
  const auto lss = [&trace](std::initializer_list<std::uint8_t> bytes) {
    trace.add(Direction::transmitted, 0x7E5, bytes);
  };
  const auto known = [&trace](std::size_t first) {
    return lss_state_is_known({trace.capture.frames(), first - 1, trace.capture.size(), node}, node);
  };
  lss({0x04, 0, 0, 0, 0, 0, 0, 0});                                                      // 1: all to waiting
  for (std::uint8_t part = 0x40; part < 0x44; ++part) lss({part, 1, 0, 0, 0, 0, 0, 0});  // 2 to 5: select one
  lss({0x5E, 0, 0, 0, 0, 0, 0, 0});                                                      // 6: its node-ID
  lss({0x11, 9, 0, 0, 0, 0, 0, 0});                                                      // 7: another one
  lss({0x17, 0, 0, 0, 0, 0, 0, 0});                                                      // 8: stored
  CHECK(known(1));
  CHECK(known(2));
  for (std::size_t first = 3; first <= 8; ++first) {
    INFO(first);
    const auto refused = known(first);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().hint.starts_with("begin with frame 2"));
    CHECK(refused.error().where == "frame " + std::to_string(std::max<std::size_t>(first, 6)));
  }
  Trace alone;
  alone.add(Direction::transmitted, 0x7E5, {0x11, 9, 0, 0, 0, 0, 0, 0});
  const auto refused = lss_state_is_known(alone.side(), node);
  REQUIRE_FALSE(refused);
  CHECK(refused.error().hint.contains("nor does any other frame"));
  for (const auto& [id, bytes] :
       {std::pair(0x000U, Bytes{0x82, 5}), std::pair(0x7E5U, Bytes{4, 1, 0, 0, 0, 0, 0, 0}),
        std::pair(0x7E5U, Bytes{0x51, 0, 0, 0, 0, 0x80, 0, 0})}) {
    Trace told;
    told.capture.add(
        can::CapturedFrame{.frame = can::data_frame(CanId(id), bytes), .direction = Direction::transmitted});
    told.add(Direction::transmitted, 0x7E5, {0x11, 9, 0, 0, 0, 0, 0, 0});
    CHECK(lss_state_is_known(told.side(), node));
  }
}

TEST_CASE("every case of the LSS suites says itself in which state the slaves are") {
  engine::RunOptions options;
  options.comment_parts = true;
  options.plan.selection.patterns = {"cia305"};
  const auto run =
      simulate({}, shipped::reference(), shipped::suites().suite, shipped::suites().catalogue, options, 1);
  REQUIRE(run.has_value());
  const auto& frames = run->capture.frames();
  std::size_t with_lss = 0;
  for (const auto& name : cases_in(frames)) {
    INFO(name);
    const auto section = section_of_case(frames, name, {});
    REQUIRE(section);
    const auto id = shipped::reference().node;
    const Side side(frames, section->first, section->end, id);
    const auto known = lss_state_is_known(side, id);
    INFO((known ? std::string() : known.error().text()));
    CHECK(known);
    with_lss += std::ranges::any_of(side.dialogue.sent,
                                    [&](const Sent& sent) { return side.at(sent.index).frame.id == 0x7E5; });
  }
  CHECK(with_lss > 5);
}
