// SPDX-License-Identifier: Apache-2.0
// Whatever a run sends stays within its tier, and every case within its own. The table of
// docs/live-devices.md is read here once more, from bytes, and shares nothing with the guard that enforces
// it.
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "catch.hpp"
#include "cli/proof/selftest.hpp"
#include "cli/proof/variant_profile.hpp"
#include "device/profile.hpp"
#include "node/node.hpp"
#include "shipped.hpp"

using namespace conform;
namespace shipped = cli::shipped;

namespace {

constexpr int read_only = 0, config = 1, nvm = 2, motion = 3;
constexpr std::array<steps::Tier, 4> tiers = {steps::Tier::read_only, steps::Tier::config, steps::Tier::nvm,
                                              steps::Tier::motion};

/// Reads what is sent to one node, in the order of the bus.
class Reading {
 public:
  Reading(std::uint32_t node, std::set<std::uint32_t> named) : node_(node), named_(std::move(named)) {}

  /// The tier that the table asks for. `forbidden` gets a write that no tier allows.
  int tier(const can::Frame& frame, std::string& forbidden) {
    if (frame.extended) return motion;
    if (frame.remote) {
      for (const std::uint32_t base : {0x80U, 0x180U, 0x280U, 0x380U, 0x480U, 0x580U, 0x600U, 0x700U}) {
        if (frame.id == base + node_) return config;
      }
      return motion;
    }
    if (frame.id == 0) {
      if (frame.dlc != 2 || frame.data[1] != node_) return motion;
      const bool tame =
          frame.data[0] == 2 || frame.data[0] == 128 || frame.data[0] == 129 || frame.data[0] == 130;
      return tame ? config : motion;
    }
    if (frame.id == 0x7E5) return layer_setting(frame);
    return frame.id == 0x600 + node_ ? request(frame, forbidden) : motion;
  }

  void heard(const can::Frame& frame) {
    if (!frame.remote && frame.id == 0x580 + node_ && frame.dlc > 0 && frame.data[0] == 0x80)
      in_blocks_ = false;
  }

 private:
  static int layer_setting(const can::Frame& frame) {
    const unsigned command = frame.dlc == 8 ? frame.data[0] : 0U;
    if (command == 0x17) return nvm;
    const bool selects = (command == 0x04 && frame.data[1] == 0) || (command >= 0x40 && command <= 0x43);
    const bool identifies = command >= 0x46 && command <= 0x4C;
    const bool inquires = command >= 0x5A && command <= 0x5E;
    return selects || identifies || inquires || command == 0x11 || command == 0x13 ? config : motion;
  }

  int request(const can::Frame& frame, std::string& forbidden) {
    const unsigned command = frame.dlc == 0 ? 0U : frame.data[0];
    const bool ends = (command & 0xE3U) == 0xC1 || (command == 0x80 && frame.dlc == 8);
    if (in_blocks_) {  // segments, which begin with a sequence number
      in_blocks_ = !ends;
      return config;
    }
    if (frame.dlc == 8) {
      // 40h-5Fh upload, 60h-7Fh its segments, 80h-9Fh abort, A0h-BFh block upload
      if (command >= 0x40 && command < 0xC0) return read_only;
    }
    const bool initiates =
        (command >= 0x20 && command < 0x40) || (command >= 0xC0 && command < 0xE0 && command % 2 == 0);
    if (!initiates || frame.dlc < 3) return config;
    in_blocks_ = command >= 0xC0;
    const std::uint32_t index = frame.data[1] + (std::uint32_t{frame.data[2]} << 8U);
    const std::uint32_t sub = frame.dlc > 3 ? frame.data[3] : 0U;
    if (index >= 0x2000 && !named_.contains(index << 8U | sub))
      forbidden = "a write to " + std::to_string(index);
    if (index == 0x1010 || index == 0x1011) return sub == 0 ? config : nvm;
    return index >= 0x1F50 && index <= 0x1F5F ? motion : config;
  }

  std::uint32_t node_;
  std::set<std::uint32_t> named_;
  bool in_blocks_ = false;
};

std::uint32_t key(Multiplexer object) {
  return (std::uint32_t{object.index.value()} << 8U) | object.sub.value();
}

/// What the profile names: nothing else from 2000h on may be written.
std::set<std::uint32_t> named_by(const device::Profile& profile) {
  std::set<std::uint32_t> out;
  for (const auto object : profile.safe_objects) out.insert(key(object));
  for (const auto& error : profile.errors) {
    for (const auto& write : {error.raise, error.clear}) {
      if (write) out.insert(key(write->object));
    }
  }
  if (profile.store_fault) {
    out.insert(key(profile.store_fault->arm.object));
    out.insert(key(profile.store_fault->disarm.object));
  }
  return out;
}

bool raises_errors(const std::vector<steps::Step>& list) {
  return std::ranges::any_of(list, [](const steps::Step& step) {
    if (step.verb == "raise_error" || step.verb == "clear_error" || step.verb == "fill_history") return true;
    if (step.walk && raises_errors(step.walk->steps)) return true;
    return std::ranges::any_of(step.branches, [](const auto& branch) { return raises_errors(branch.steps); });
  });
}

struct CaseTier {
  int tier = read_only;
  bool raises = false;
};

const std::map<std::string, CaseTier>& case_tiers() {
  static const std::map<std::string, CaseTier> known = [] {
    std::map<std::string, CaseTier> out;
    for (const auto& file : shipped::suites().suite.files) {
      for (const auto& each : file.scenarios)
        out[each.id] = {static_cast<int>(each.risk),
                        raises_errors(each.steps) || raises_errors(each.cleanup)};
    }
    return out;
  }();
  return known;
}

/// Everything that was sent beyond its tier: by a case beyond its own, between cases beyond that of the run.
std::vector<std::string> beyond(const cli::SimulatedRun& run, const device::Profile& profile, int allowed) {
  std::vector<std::string> out;
  Reading reading(profile.node.value(), named_by(profile));
  const auto& frames = run.capture.frames();
  std::size_t at = 0;
  const auto read_until = [&](std::size_t end, int most, bool raises, const std::string& name) {
    for (; at < end; ++at) {
      const auto& [frame, time, direction, comment] = frames[at];
      if (direction != can::Direction::transmitted) {
        reading.heard(frame);
        continue;
      }
      std::string forbidden;
      const int needs = reading.tier(frame, forbidden);
      // A trigger may be the heartbeat of a node that is played: the run must allow it, not the scenario.
      const bool plays = raises && allowed == motion && (frame.id == 0x77D || frame.id == 0x77E);
      if (forbidden.empty() && (needs <= most || plays)) continue;
      if (out.size() < 20)
        out.push_back(name + ": " + std::to_string(frame.id) + "#" + hex_bytes(frame.bytes()) + " needs " +
                      std::to_string(needs) + " of " + std::to_string(most) + " " + forbidden);
    }
  };
  for (const auto& each : run.result.cases) {
    if (each.end_frame <= each.first_frame) continue;
    const auto known = case_tiers().find(each.id);
    if (known == case_tiers().end()) continue;
    read_until(each.first_frame, allowed, false, "between cases");
    read_until(each.end_frame, known->second.tier, known->second.raises, each.name());
  }
  read_until(frames.size(), allowed, false, "between cases");
  for (const auto& each : run.result.cases) {
    for (const auto& finding : each.setup_findings) {
      if (finding.actual.find("must not") != std::string::npos)
        out.push_back(each.name() + ": " + finding.actual);
    }
  }
  return out;
}

cli::SimulatedRun play(const cli::NodeSwitches& switches, const device::Profile& profile, int allowed) {
  engine::RunOptions options;
  options.plan.allowed = tiers[static_cast<std::size_t>(allowed)];
  options.plan.slow = true;
  auto run =
      cli::simulate(switches, profile, shipped::suites().suite, shipped::suites().catalogue, options, 1);
  INFO((run ? std::string() : run.error().text()));
  REQUIRE(run.has_value());
  return std::move(*run);
}

using Lines = std::vector<std::string>;

}  // namespace

TEST_CASE("the reading of the table tells frames apart") {
  Reading reading(5, {0x200001});
  std::string forbidden;
  const auto tier = [&](std::uint32_t id, std::initializer_list<std::uint8_t> bytes) {
    return reading.tier(can::data_frame(CanId(id), bytes), forbidden);
  };
  CHECK(tier(0x605, {0x40, 0x00, 0x20, 0x01, 0, 0, 0, 0}) == read_only);
  CHECK(tier(0x605, {0x40, 0x00, 0x20, 0x01}) == config);
  CHECK(tier(0x605, {0x2B, 0x17, 0x10, 0x00, 1, 0, 0, 0}) == config);
  CHECK(tier(0x605, {0x23, 0x10, 0x10, 0x01, 's', 'a', 'v', 'e'}) == nvm);
  CHECK(tier(0x606, {0x40, 0x00, 0x10, 0x00, 0, 0, 0, 0}) == motion);
  CHECK(tier(0x000, {0x81, 5}) == config);
  CHECK(tier(0x000, {0x01, 5}) == motion);
  CHECK(tier(0x000, {0x81}) == motion);
  CHECK(tier(0x000, {0x81, 0}) == motion);
  for (const std::uint32_t id : {0x80U, 0x100U, 0x205U, 0x6C0U, 0x77EU}) CHECK(tier(id, {}) == motion);
  CHECK(tier(0x7E5, {0x5E, 0, 0, 0, 0, 0, 0, 0}) == config);
  CHECK(tier(0x7E5, {0x17, 0, 0, 0, 0, 0, 0, 0}) == nvm);
  for (const int command : {0x15, 0x44, 0x4F, 0x51, 0xFF})
    CHECK(tier(0x7E5, {static_cast<std::uint8_t>(command), 0, 0, 0, 0, 0, 0, 0}) == motion);
  CHECK(tier(0x7E5, {0x04, 1}) == motion);
  CHECK(tier(0x7E5, {0x04, 1, 0, 0, 0, 0, 0, 0}) == motion);
  CHECK(tier(0x605, {0x2B, 0x00, 0x20, 0x01, 1, 0, 0, 0}) == config);
  CHECK(forbidden.empty());
  CHECK(tier(0x605, {0x2B, 0x00, 0x20, 0x02, 1, 0, 0, 0}) == config);
  CHECK_FALSE(forbidden.empty());
}

TEST_CASE("a run sends nothing beyond the tier that it allows, nor a case beyond its own") {
  const auto profile = shipped::reference();
  for (const int allowed : {read_only, config, nvm, motion}) {
    INFO("allowed: " << steps::word_of(tiers[static_cast<std::size_t>(allowed)]));
    const auto run = play({}, profile, allowed);
    CHECK(beyond(run, profile, allowed) == Lines{});
    CHECK(std::ranges::any_of(run.result.cases,
                              [](const auto& each) { return each.verdict == result::Verdict::pass; }));
  }
}

TEST_CASE("without a profile nothing from 2000h on is written at any tier") {
  const auto profile = device::default_profile(NodeId(77));
  REQUIRE(named_by(profile).empty());
  for (const int allowed : {config, motion})
    CHECK(beyond(play({}, profile, allowed), profile, allowed) == Lines{});
}

TEST_CASE("a device that does wrong does not lead a run out of its tier") {
  const auto profile = shipped::reference();
  for (const std::string defect :
       {"missing-object-wrong-abort", "1003-nonzero-write-accepted", "ro-write-accepted", "1014-lock-missing",
        "sdo-double-response", "1010-wrong-signature-accepted", "1000-is-u16", "1003-oldest-first"}) {
    INFO("defect: " << defect);
    for (const int allowed : {config, motion})
      CHECK(beyond(play({.defects = {defect}}, profile, allowed), profile, allowed) == Lines{});
  }
}

TEST_CASE("nor does a legal one with habits of its own") {
  for (const std::vector<std::string>& variants : {std::vector<std::string>{"1018-vendor-only", "1800-const"},
                                                   {"1017-absent"},
                                                   {"tpdo-event-driven-only"},
                                                   {"lss-absent"}}) {
    auto profile = shipped::reference();
    auto node = refnode::Node::create({.node_id = profile.node.value(), .defects = {}, .variants = variants});
    REQUIRE(node.has_value());
    profile = cli::profile_of_variants(profile, (*node)->dictionary(), variants);
    for (const int allowed : {config, motion})
      CHECK(beyond(play({.variants = variants}, profile, allowed), profile, allowed) == Lines{});
  }
}
