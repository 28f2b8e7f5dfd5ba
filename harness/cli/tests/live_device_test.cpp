// SPDX-License-Identifier: Apache-2.0
// Exploration of a device that cannot be made anew: on a simulated bus, but met as one on an interface is.
#include "cli/exploring/live_device.hpp"

#include <algorithm>
#include <atomic>
#include <map>

#include "can/simulated_bus.hpp"
#include "catch.hpp"
#include "cli/exploring/model_description.hpp"
#include "cli/proof/explored.hpp"
#include "cli/proof/variant_profile.hpp"
#include "explore/scenario_text.hpp"
#include "node/powered_node.hpp"
#include "shipped.hpp"

using namespace conform;
namespace shipped = cli::shipped;

namespace {

/// What a journal would hold.
class Watcher final : public engine::Observer {
 public:
  void changing(Multiplexer object, const Bytes& before) override { open.emplace(object, before); }
  void put_back(Multiplexer object, const Bytes& value) override {
    const auto found = open.find(object);
    if (found != open.end() && found->second == value) open.erase(found);
  }
  std::map<Multiplexer, Bytes> open;
};

struct Bench {
  explicit Bench(const std::vector<std::string>& defects, const std::vector<std::string>& variants = {},
                 steps::Tier allowed = steps::Tier::motion)
      : tier(allowed) {
    auto made = refnode::PoweredNode::create(
        {.node_id = shipped::reference().node.value(), .defects = defects, .variants = variants});
    REQUIRE(made.has_value());
    node = std::move(*made);
    auto held = refnode::Node::create({.node_id = shipped::reference().node.value(), .variants = variants});
    REQUIRE(held.has_value());
    profile = cli::profile_of_variants(shipped::reference(), (*held)->dictionary(), variants);
    bus.attach(*node, "device");
    device.emplace(bus.transport(), profile, tier, watcher, stop);
  }

  explore::SearchResult explore(std::size_t actions, std::uint64_t seed = 1) {
    REQUIRE(device->look());
    const auto description = cli::model_description(*device, profile, nullptr);
    REQUIRE(description);
    auto explorable = cli::explorable_of(profile, {.description = *description}, {});
    REQUIRE(explorable);
    cli::meet(*explorable, *device);
    explore::SearchOptions options;
    options.seed = seed;
    options.most_actions = actions;
    options.most_tries = 60;
    options.offer = explorable->offer;
    options.may = [this](const explore::Action& action) { return device->may(action); };
    words = explorable->words;
    auto out = explore::search(explorable->bench, explorable->words, options);
    REQUIRE(out);
    return std::move(*out);
  }

  device::Profile profile;
  steps::Tier tier;
  can::SimulatedBus bus;
  std::unique_ptr<refnode::PoweredNode> node;
  Watcher watcher;
  std::atomic<int> stop{0};
  std::optional<cli::LiveDevice> device;
  explore::Vocabulary words;
};

std::string told(const explore::Finding& finding, const explore::Vocabulary& words) {
  std::string out = finding.assigned ? finding.assigned->requirement : "?";
  for (const auto& action : finding.conversation) out += "; " + explore::describe(action, words.node);
  return out + " -> " + explore::came_text(finding, words) + ", due " + explore::due_text(finding, words);
}

}  // namespace

namespace {

/// Explores a right device: nothing may be blamed, and everything is put back.
void check_right(const std::vector<std::string>& variants, std::size_t actions, std::uint64_t seed) {
  Bench bench({}, variants);
  const auto result = bench.explore(actions, seed);
  for (const auto& finding : result.findings) {
    INFO(told(finding, bench.words));
    CHECK(cli::word_of(finding, shipped::suites().catalogue) != "FAIL");
  }
  CHECK_FALSE(result.ended_by.has_value());
  CHECK(result.episodes > 3);
  const auto left = bench.device->leave();
  REQUIRE(left);
  CHECK(left->empty());
  CHECK(bench.watcher.open.empty());
}

}  // namespace

TEST_CASE("a conformant device that is only reset is not blamed, and left as it was") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    INFO("seed " << seed);
    check_right({}, 4000, seed);
  }
}

TEST_CASE("nor is one that has made legal choices") {
  for (const auto* variant : {"boot-up-200ms", "sdo-turnaround-90ms", "sdo-expedited-without-size"}) {
    INFO(variant);
    check_right({variant}, 1000, 1);
  }
}

TEST_CASE("a defect of a device that is only reset is found and named") {
  Bench bench({"sdo-served-in-stopped"});
  const auto result = bench.explore(3000);
  CHECK(std::ranges::any_of(result.findings, [](const explore::Finding& each) {
    return each.assigned && each.assigned->requirement == "SDO-GEN-15";
  }));
}

namespace {

/// A device that dies of one request, until its power is switched. Keeps what it hears: all of it is sent by
/// the search.
class Mortal final : public can::Participant {
 public:
  explicit Mortal(std::unique_ptr<can::Participant> inner, bool immortal = false)
      : inner_(std::move(inner)), immortal_(immortal) {}
  void attach(Sender sender, BusTime now) override { inner_->attach(std::move(sender), now); }
  void on_frame(const can::Frame& frame, BusTime now) override {
    heard.push_back(frame);
    if (immortal_) return inner_->on_frame(frame, now);
    const bool deadly = frame.id == 0x600U + shipped::reference().node.value() && frame.data[0] == 0x2B &&
                        frame.data[1] == 0x17 && frame.data[2] == 0x10;
    dead = dead || deadly;
    if (!dead) inner_->on_frame(frame, now);
  }
  void on_transmitted(BusTime now) override {
    if (!dead) inner_->on_transmitted(now);
  }
  void on_time(BusTime now) override {
    if (!dead) inner_->on_time(now);
  }
  [[nodiscard]] std::optional<BusTime> next_wakeup() const override {
    return dead ? std::nullopt : inner_->next_wakeup();
  }
  bool dead = false;
  std::vector<can::Frame> heard;

 private:
  std::unique_ptr<can::Participant> inner_;
  bool immortal_;
};

}  // namespace

TEST_CASE(
    "a device that dies is told with the conversation that it died of, and the search ends in good order") {
  Bench bench({});
  bench.bus.unplug(*bench.node);
  Mortal mortal(std::move(bench.node));
  bench.bus.attach(mortal, "mortal");
  const auto result = bench.explore(20000);
  REQUIRE(!result.findings.empty());
  const auto& last = result.findings.back();
  CHECK(last.played.difference->what == explore::Difference::What::gone);
  CHECK(last.conversation.size() == last.played.actions);
  REQUIRE(last.assigned);
  CHECK(last.assigned->requirement == "NMT-BOOT-02");
  REQUIRE(result.ended_by);
  CHECK(result.ended_by->what.find("no boot-up message") != std::string::npos);
  // What the journal says is left for somebody to put back.
  CHECK_FALSE(bench.device->leave().has_value());
}

TEST_CASE("nothing is sent that the tier does not cover, and nothing is ever stored") {
  for (const auto tier : {steps::Tier::config, steps::Tier::nvm, steps::Tier::motion}) {
    INFO(steps::word_of(tier));
    Bench bench({}, {}, tier);
    bench.bus.unplug(*bench.node);
    Mortal device(std::move(bench.node), true);
    bench.bus.attach(device, "device");
    const auto result = bench.explore(6000);
    CHECK(result.episodes > 10);
    std::size_t beyond = 0, stored = 0, of_application = 0, downloads = 0, configured = 0, unseen = 0;
    for (const auto& frame : device.heard) {
      // LSS that configures, switches the bit rate or stores, or that is no command.
      constexpr std::uint8_t lasting[] = {0x11, 0x13, 0x15, 0x17};
      const bool lss = frame.id == 0x7E5 && !frame.remote;
      configured += lss && (frame.dlc != 8 || std::ranges::find(lasting, frame.data[0]) != std::end(lasting));
      // Downloads that are not watched.
      const bool other = frame.id >= 0x680 && frame.id <= 0x6DF && !frame.remote;
      unseen += other && frame.size() > 0 && (frame.data[0] >> 5U == 1 || frame.data[0] >> 5U == 6);
      beyond += steps::need_of(frame, bench.words.node).tier > tier;
      const auto object = steps::download_begun(frame, bench.words.node);
      if (!object) continue;
      ++downloads;
      stored += object->index == Index(0x1010) || object->index == Index(0x1011);
      // An error is raised as the profile says.
      const auto tells = [&](const auto& write) {
        return write && write->object == *object && (frame.data[0] & 0xE2U) == 0x22 &&
               std::ranges::equal(write->bytes, ByteView(frame.data).subspan(4, write->bytes.size()));
      };
      const bool told = std::ranges::any_of(
          bench.profile.errors, [&](const auto& error) { return tells(error.raise) || tells(error.clear); });
      // A segment of a block may look like a request to some object; what is read-only refuses.
      const auto entry = std::ranges::find(bench.profile.objects, *object, &device::Entry::mux);
      const bool takes = entry != bench.profile.objects.end() && entry->writable();
      of_application +=
          takes && steps::is_of_application(object->index) && !bench.profile.is_safe(*object) && !told;
    }
    CHECK(beyond == 0);
    CHECK(stored == 0);
    CHECK(configured == 0);
    CHECK(unseen == 0);
    CHECK(of_application == 0);
    CHECK(downloads > 100);
  }
}
