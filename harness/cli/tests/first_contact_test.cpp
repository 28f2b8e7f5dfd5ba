// SPDX-License-Identifier: Apache-2.0
// A profile that `init` writes is one that a run takes, leaves no trace in the device, and holds nothing
// against a right one.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "base/in_parallel.hpp"
#include "base/text.hpp"
#include "can/simulated_bus.hpp"
#include "catch.hpp"
#include "cli/first_contact/acquaintance.hpp"
#include "cli/first_contact/claims.hpp"
#include "cli/first_contact/profile_text.hpp"
#include "cli/proof/legal_variants.hpp"
#include "device/profile.hpp"
#include "engine/engine.hpp"
#include "engine/recorder.hpp"
#include "engine/run_session.hpp"
#include "node/powered_node.hpp"
#include "shipped.hpp"
#include "variants/variant.hpp"
#include "yaml/loader.hpp"

using namespace conform;
using namespace conform::cli;
using namespace std::chrono_literals;

namespace {

constexpr NodeId node_id{5};

struct Look {
  Acquaintance device;
  can::Capture frames;
};

Result<Look> look_at(const std::vector<std::string>& variants, steps::Tier allow = steps::Tier::read_only) {
  auto node = refnode::PoweredNode::create(
      {.node_id = node_id.value(), .defects = {}, .storage = {}, .variants = variants});
  if (!node) return std::unexpected(node.error());
  can::SimulatedBus bus(can::SimulatedBus::Options{});
  bus.attach(**node, "reference node");
  const auto profile = device::default_profile(node_id);
  engine::Recorder recorder(bus.transport(), nullptr);
  engine::RunSession session(recorder, profile, device::dictionary_of(profile));
  session.allow(allow);
  FirstLook how;
  how.ranges = {{0x1000, 0x1FFF}, {0x2000, 0x2010}, {0x2F00, 0x2F20}, {0x6000, 0x64FF}};
  how.allow = allow;
  auto device = get_to_know(session, how);
  if (!device) return std::unexpected(device.error());
  return Look{std::move(*device), recorder.capture()};
}

/// With the suggestions, as they stand behind '#'.
std::string taken(const std::string& text) {
  std::string out;
  for (const auto line : split(text, '\n')) {
    const bool suggestion = line.starts_with("#  -") || (line.starts_with('#') && !line.starts_with("# "));
    out += std::string(suggestion ? line.substr(1) : line) + "\n";
  }
  return out;
}

struct Loaded {
  device::Profile profile;
  std::string messages;
};

Loaded load(const std::string& text) {
  const auto source = yaml::make_source("device.yaml", text);
  yaml::Diagnostics diagnostics(source);
  const auto root = yaml::load(*source, diagnostics);
  Loaded out;
  if (root) out.profile = device::load_profile(*root, diagnostics);
  out.messages = diagnostics.render();
  return out;
}

/// What the suite holds against a node that is as its profile says: nothing.
std::string complaints(const std::vector<std::string>& variants, steps::Tier allow) {
  const auto look = look_at(variants, allow);
  if (!look) return look.error().what;
  const auto text = profile_text(look->device, {"", "in a test"});
  const auto loaded = load(text);
  if (!loaded.messages.empty()) return loaded.messages + text;
  auto node = refnode::PoweredNode::create(
      {.node_id = node_id.value(), .defects = {}, .storage = {}, .variants = variants});
  can::SimulatedBus bus(can::SimulatedBus::Options{});
  bus.attach(**node, "reference node");
  can::Capture capture;
  const auto run = engine::run(bus.transport(), loaded.profile, shipped::suites().suite,
                               shipped::suites().catalogue, {}, capture);
  std::string out;
  for (const auto& each : complaints_of(run, may_warn_with(variants, shipped::suites().catalogue)))
    out += each.what + "\n" + each.details + "\n";
  return out;
}

std::vector<std::string> shown(const Acquaintance& device) {
  std::vector<std::string> out;
  for (const auto& each : claims_of(device).shown) out.emplace_back(each.feature);
  return out;
}

bool contains(const std::vector<std::string>& all, std::string_view word) {
  return std::ranges::find(all, word) != all.end();
}

}  // namespace

TEST_CASE("a first look only uploads, unless more is allowed") {
  const auto look = look_at({});
  REQUIRE(look.has_value());
  for (const auto& each : look->frames.frames()) {
    if (each.direction != can::Direction::transmitted) continue;
    CHECK(steps::need_of(each.frame, node_id).tier == steps::Tier::read_only);
  }
  CHECK_FALSE(look->device.boot_time);
  CHECK_FALSE(look->device.lss);
  CHECK(contains(shown(look->device), "heartbeat producer"));
  CHECK(contains(shown(look->device), "segmented sdo"));
  CHECK_FALSE(contains(shown(look->device), "lss"));
}

TEST_CASE("a first look that may configure measures the start, and still writes no value") {
  const auto look = look_at({"boot-up-200ms"}, steps::Tier::config);
  REQUIRE(look.has_value());
  REQUIRE(look->device.boot_time.has_value());
  CHECK(*look->device.boot_time >= 200ms);
  CHECK(*look->device.boot_time < 300ms);
  for (const auto word : {"lss", "lss identify remote slave", "block sdo"}) {
    INFO(word);
    CHECK(contains(shown(look->device), word));
  }
  CHECK(look->device.node_guarding);
  // Download responses: only the block download was begun, which is given up.
  for (const auto& each : look->frames.frames()) {
    if (each.direction == can::Direction::received && each.frame.is_data(CanId(0x585)))
      CHECK((each.frame.data[0] >> 5U) != 3);
  }
  CHECK(profile_text(look->device, {"can0", "in a test"}).find("\nboot_time: 500 ms\n") != std::string::npos);
}

TEST_CASE("the profile says what was found, and takes its own suggestions") {
  const auto look = look_at({});
  REQUIRE(look.has_value());
  const auto text = profile_text(look->device, {"can0", "in a test"});
  const auto loaded = load(text);
  INFO(text);
  CHECK(loaded.messages.empty());
  CHECK(loaded.profile.name == "canopen-refnode");
  CHECK(loaded.profile.node == node_id);
  CHECK(loaded.profile.interface == "can0");
  CHECK(loaded.profile.identity.vendor == 0x5AFEU);
  CHECK_FALSE(loaded.profile.identity.serial);
  CHECK(loaded.profile.device_info.rpdos == 4U);
  CHECK(loaded.profile.safe_objects.empty());
  CHECK(loaded.profile.wired.empty());
  const auto full = load(taken(text));
  INFO(taken(text));
  CHECK(full.messages.empty());
  CHECK_FALSE(full.profile.safe_objects.empty());
  CHECK_FALSE(full.profile.wired.empty());
  CHECK(full.profile.errors.size() == 1);
  CHECK(full.profile.claimed("variable mapping"));
}

TEST_CASE("a name that YAML would take for something else is kept") {
  Acquaintance device;
  device.node = node_id;
  const std::string name = "it's: #1";
  device.objects.push_back(
      {Index(0x1008), {{{Index(0x1008), SubIndex(0)}, Bytes(name.begin(), name.end()), {}}}});
  const auto loaded = load(profile_text(device, {"", "in a test"}));
  CHECK(loaded.messages.empty());
  CHECK(loaded.profile.name == name);
  device.objects.clear();
  CHECK(load(profile_text(device, {"", "in a test"})).profile.name == "node 5");
}

TEST_CASE("a run with the profile of a first look holds nothing against a right device") {
  for (const auto allow : {steps::Tier::read_only, steps::Tier::config}) CHECK(complaints({}, allow) == "");
  // Every fifth: one out of each group of like ones, and quick enough for CTest.
  constexpr std::size_t stride = 5;
  const auto rows = refnode::variants();
  std::vector<std::string> wrong(rows.size() / stride);
  in_parallel(wrong.size(), 0, [&](std::size_t i) {
    wrong[i] = complaints({std::string(rows[i * stride].id)},
                          i % 2 == 0 ? steps::Tier::read_only : steps::Tier::config);
  });
  for (std::size_t i = 0; i < wrong.size(); ++i) {
    INFO(rows[i * stride].id);
    if (!wrong[i].empty()) FAIL_CHECK(wrong[i]);
  }
}
