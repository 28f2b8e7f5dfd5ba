// SPDX-License-Identifier: Apache-2.0
// A scripted SDO server on the simulated bus: the device of the engine's tests, independent of the reference
// node.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/check.hpp"
#include "base/text.hpp"
#include "can/simulated_bus.hpp"
#include "catch.hpp"
#include "device/profile.hpp"
#include "engine/engine.hpp"
#include "scenario/catalogue.hpp"
#include "scenario/loader.hpp"
#include "yaml/loader.hpp"

namespace conform::engine::testing {

/// Serves expedited SDO out of a map; every write is kept. `before` may swallow a request or answer it
/// differently.
class ScriptedDevice : public can::Participant {
 public:
  using Intercept = std::function<bool(ScriptedDevice&, const can::Frame&, BusTime)>;

  std::map<std::uint32_t, std::vector<std::uint8_t>> entries{
      {0x100000, {0x91, 0x01, 0x00, 0x00}},
      {0x100100, {0x00}},
      {0x101700, {0x00, 0x00}},
      {0x101800, {0x01}},
      {0x101801, {1, 0, 0, 0}},
      {0x101400, {0x81, 0, 0, 0}},
  };
  std::vector<std::string> writes;  ///< "1017h = E8 03"
  std::vector<std::uint8_t> nmt;    ///< command specifiers received
  Intercept before;
  std::function<void(ScriptedDevice&)> on_reset;
  bool dead = false;
  BusTime silent_until{};  ///< it is starting
  Duration latency{};      ///< of SDO answers

  void attach(Sender sender, BusTime) override { send_ = std::move(sender); }
  void on_time(BusTime now) override {
    while (!later_.empty() && later_.begin()->first <= now) send_(later_.extract(later_.begin()).mapped());
  }
  [[nodiscard]] std::optional<BusTime> next_wakeup() const override {
    return later_.empty() ? std::nullopt : std::optional(later_.begin()->first);
  }
  void send(const can::Frame& frame) {
    if (frame.id == 0x581 && latency > Duration(0)) {
      send_at(now_ + latency, frame);
    } else {
      send_(frame);
    }
  }
  void send_at(BusTime time, const can::Frame& frame) { later_.emplace(time, frame); }

  void on_frame(const can::Frame& frame, BusTime now) override {
    if (dead || now < silent_until) return;
    now_ = now;
    if (frame.is_data(CanId(0x000)) && frame.size() == 2) {
      nmt.push_back(frame.data[0]);
      if (frame.data[0] >= 0x81 && on_reset) on_reset(*this);
      if (frame.data[0] >= 0x81) send(can::data_frame(CanId(0x701), {0x00}));
      return;
    }
    if (!frame.is_data(CanId(0x601)) || frame.size() != 8) return;
    if (before && before(*this, frame, now)) return;
    serve(frame);
  }

  void serve(const can::Frame& frame) {
    const auto command = frame.data[0];
    if (command == 0x80) return;
    const auto key =
        static_cast<std::uint32_t>((frame.data[2] << 16U) | (frame.data[1] << 8U) | frame.data[3]);
    const auto found = entries.find(key);
    if (found == entries.end()) return abort(frame, 0x06020000);
    if (command == 0x40) {
      auto answer = frame;
      answer.id = 0x581;
      answer.data[0] = static_cast<std::uint8_t>(0x43 | ((4 - found->second.size()) << 2U));
      std::fill(answer.data.begin() + 4, answer.data.end(), std::uint8_t{0});
      std::copy(found->second.begin(), found->second.end(), answer.data.begin() + 4);
      return send(answer);
    }
    if ((command & 0xF3U) != 0x23) return abort(frame, 0x05040001);
    const auto size = 4U - ((command >> 2U) & 3U);
    if (size != found->second.size()) return abort(frame, 0x06070010);
    found->second.assign(frame.data.begin() + 4, frame.data.begin() + 4 + size);
    writes.push_back(to_string(Index(static_cast<std::uint16_t>(key >> 8U))) + " = " +
                     hex_bytes(found->second));
    auto answer = frame;
    answer.id = 0x581;
    answer.data = {0x60, frame.data[1], frame.data[2], frame.data[3]};
    send(answer);
  }

  void abort(const can::Frame& request, std::uint32_t code) {
    auto answer = request;
    answer.id = 0x581;
    answer.data[0] = 0x80;
    const auto bytes = to_le(code, 4);
    std::copy(bytes.begin(), bytes.end(), answer.data.begin() + 4);
    send(answer);
  }

 private:
  Sender send_;
  BusTime now_{};
  std::multimap<BusTime, can::Frame> later_;
};

/// Catalogue of three made-up rules, so that tests do not depend on the real one.
inline const scenario::Catalogue& catalogue() {
  static const scenario::Catalogue loaded = [] {
    std::vector<std::string> problems;
    auto out =
        scenario::Catalogue::load(std::string(CONFORM_SOURCE_DIR) + "/harness/engine/tests/suites", problems);
    CONFORM_CHECK(out.has_value() && problems.empty());
    return *out;
  }();
  return loaded;
}

/// A case that writes 1017h, to put in front of others.
inline const std::string change_1017 = R"(
  - id: change
    title: t
    risk: config
    steps:
      - download: {object: 1017h:00, value: 1000}
        checks: T-MUST
)";

/// Scenarios out of YAML text; mistakes fail the test with their diagnostics.
inline scenario::Suite suite_of(const std::string& text, const scenario::Catalogue& rules = catalogue()) {
  const auto source = yaml::make_source("test.yaml", "format: 1\ntitle: Test\nscenarios:\n" + text);
  yaml::Diagnostics diagnostics(source);
  const auto root = yaml::load(*source, diagnostics);
  scenario::Suite out;
  if (root) out.files.push_back(scenario::load_scenarios(*root, diagnostics, "test.yaml", rules));
  INFO(diagnostics.render());
  REQUIRE(!diagnostics.has_errors());
  return out;
}

struct Outcome {
  result::RunResult run;
  can::Capture capture;

  [[nodiscard]] const result::CaseResult& only() const {
    REQUIRE(run.cases.size() == 1);
    return run.cases.front();
  }
  [[nodiscard]] result::Verdict verdict_of(const std::string& requirement, std::size_t index = 0) const {
    REQUIRE(index < run.cases.size());
    for (const auto& judgement : run.cases[index].judgements) {
      if (judgement.requirement == requirement) return judgement.verdict;
    }
    FAIL("no judgement of " << requirement);
    return result::Verdict::error;
  }
};

/// Tests write to these application objects; nothing else from 2000h on may be written.
inline device::Profile writing_profile() {
  auto profile = device::default_profile(NodeId(1));
  profile.safe_objects = {{Index(0x2000), SubIndex(0)}, {Index(0x2010), SubIndex(0)}};
  return profile;
}

/// Runs `scenarios` against the device with node-ID 1 and short time-outs.
inline Outcome play(can::SimulatedBus& bus, ScriptedDevice& device, const std::string& scenarios,
                    RunOptions options = {}, const device::Profile& profile = writing_profile()) {
  bus.attach(device, "scripted device");
  const auto suite = suite_of(scenarios);
  Outcome out;
  out.run = run(bus.transport(), profile, suite, catalogue(), options, out.capture);
  return out;
}

inline Outcome play(ScriptedDevice& device, const std::string& scenarios, RunOptions options = {}) {
  can::SimulatedBus bus;
  return play(bus, device, scenarios, options);
}

}  // namespace conform::engine::testing
