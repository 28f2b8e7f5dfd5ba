// SPDX-License-Identifier: Apache-2.0
// What a session sends at most in each tier, whatever a scenario asks of it.
#include "bench.hpp"
#include "engine/run_session.hpp"

using namespace conform;
using namespace conform::engine;
using namespace conform::engine::testing;
using result::Verdict;

TEST_CASE("up to the tier nvm a session sends nothing that is not for the device alone") {
  can::SimulatedBus bus;
  ScriptedDevice device;
  bus.attach(device, "scripted device");
  Recorder recorder(bus.transport(), nullptr);
  auto profile = writing_profile();
  RunSession session(recorder, profile, device::dictionary_of(profile));
  const auto frame = [](std::uint32_t id, std::initializer_list<std::uint8_t> bytes) {
    return can::data_frame(CanId(id), bytes);
  };
  const can::Frame for_others[] = {
      frame(0x000, {0x01, 1}),  // start: outputs may move
      frame(0x000, {0x81, 0}),
      frame(0x000, {0x81, 2}),
      frame(0x000, {0x81}),
      frame(0x000, {0x07, 1}),
      frame(0x080, {}),
      frame(0x100, {0, 0, 0, 0, 0, 0}),
      frame(0x201, {1}),
      frame(0x77E, {5}),
      frame(0x602, {0x40, 0, 0x10, 0, 0, 0, 0, 0}),
      frame(0x6C0, {0x40, 0, 0x10, 0, 0, 0, 0, 0}),
      can::remote_frame(CanId(0x702), 1),
  };
  for (const auto risk : {scenario::Risk::config, scenario::Risk::nvm}) {
    session.begin_case(risk);
    const auto before = recorder.capture().size();
    for (const auto& each : for_others) {
      INFO(each.id << " " << hex_bytes(each.bytes()));
      CHECK_FALSE(session.send(each).has_value());
      CHECK_FALSE(session.produce({"x", each, std::chrono::milliseconds(10), 1}).has_value());
    }
    CHECK_FALSE(session.nmt(canopen::NmtCommand::start).has_value());
    CHECK(recorder.capture().size() == before);
    CHECK(session.send(can::remote_frame(CanId(0x701), 1)).has_value());
    CHECK(session.nmt(canopen::NmtCommand::stop).has_value());
  }
  session.begin_case(scenario::Risk::motion);
  for (const auto& each : for_others) CHECK(session.send(each).has_value());
}

TEST_CASE("from 2000h on only what the profile names is written, whatever the frame looks like") {
  can::SimulatedBus bus;
  ScriptedDevice device;
  bus.attach(device, "scripted device");
  Recorder recorder(bus.transport(), nullptr);
  const auto profile = writing_profile();
  RunSession session(recorder, profile, device::dictionary_of(profile));
  session.begin_case(scenario::Risk::motion);
  const auto sends = [&session](std::initializer_list<std::uint8_t> bytes) {
    return session.send(can::data_frame(CanId(0x601), bytes)).has_value();
  };
  CHECK(sends({0x2F, 0x00, 0x20, 0, 9, 0, 0, 0}));
  CHECK_FALSE(sends({0x2F, 0x01, 0x20, 0, 9, 0, 0, 0}));
  CHECK_FALSE(sends({0x21, 0xFC, 0x4F, 0, 9, 0, 0, 0}));
  CHECK_FALSE(sends({0xC2, 0xFF, 0xFF, 0, 9, 0, 0, 0}));
  CHECK_FALSE(sends({0x2F, 0x01, 0x20}));
  CHECK(sends({0x40, 0x01, 0x20, 0, 0, 0, 0, 0}));
  CHECK_FALSE(
      session.download({Index(0x4FFC), SubIndex(0)}, {0}, canopen::SdoDownload::Mode::automatic, std::nullopt)
          .has_value());
  CHECK(session.is_writable({Index(0x4FFC), SubIndex(0)}).value_or(true) == false);
}

TEST_CASE("a session of read-only risk uploads and sends nothing else") {
  can::SimulatedBus bus;
  ScriptedDevice device;
  bus.attach(device, "scripted device");
  Recorder recorder(bus.transport(), nullptr);
  const auto profile = device::default_profile(NodeId(1));
  RunSession session(recorder, profile, device::dictionary_of(profile));
  session.begin_case(scenario::Risk::read_only);
  const Multiplexer entry{Index(0x1017), SubIndex(0)};
  CHECK(session.upload(entry, std::nullopt).has_value());
  CHECK_FALSE(
      session.download(entry, {1, 0}, canopen::SdoDownload::Mode::automatic, std::nullopt).has_value());
  CHECK_FALSE(session.is_writable(entry).has_value());
  CHECK_FALSE(session.nmt(canopen::NmtCommand::start).has_value());
  CHECK_FALSE(session.send(can::data_frame(CanId(0x080), {})).has_value());
  CHECK_FALSE(session.send(can::data_frame(CanId(0x601), {0x2B, 0x17, 0x10, 0, 1, 0, 0, 0})).has_value());
  CHECK_FALSE(session.send(can::data_frame(CanId(0x601), {0xC2, 0x17, 0x10, 0, 2, 0, 0, 0})).has_value());
  CHECK(session.send(can::data_frame(CanId(0x601), {0x40, 0x17, 0x10, 0, 0, 0, 0, 0})).has_value());
  CHECK(device.writes.empty());
  CHECK(device.nmt.empty());
}

TEST_CASE("a command is not written to find out whether it is writable") {
  ScriptedDevice device;
  device.entries[0x101000] = {1};
  device.entries[0x101001] = {1, 0, 0, 0};
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: config
    when: 1010h:01 is writable
    steps:
      - upload: {object: 1000h:00}
        checks: T-MUST
)");
  CHECK(out.only().verdict == Verdict::pass);
  CHECK(device.writes.empty());
}
