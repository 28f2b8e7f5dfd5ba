// SPDX-License-Identifier: Apache-2.0
// What a case works with and whom it concerns: conditions that listen to the bus, entries that are looked
// for.
#include "bench.hpp"
#include "device/standard_objects.hpp"

using namespace conform;
using namespace conform::engine;
using namespace conform::engine::testing;
using namespace std::chrono_literals;
using result::Verdict;

namespace {

/// Sends one frame, some time after the beginning.
class Talker final : public can::Participant {
 public:
  Talker(can::Frame frame, Duration after) : frame_(frame), after_(after) {}
  void attach(Sender sender, BusTime now) override {
    sender_ = std::move(sender);
    due_ = now + after_;
  }
  void on_frame(const can::Frame&, BusTime) override {}
  void on_time(BusTime) override {
    if (due_) sender_(frame_);
    due_.reset();
  }
  [[nodiscard]] std::optional<BusTime> next_wakeup() const override { return due_; }

 private:
  can::Frame frame_;
  Duration after_;
  Sender sender_;
  std::optional<BusTime> due_;
};

/// A DOMAIN at 2001h:00, or another of 20xxh, with segmented transfer, in front of the scripted device.
struct Buffer {
  std::uint8_t low_byte_of_index = 0x01;
  std::vector<std::uint8_t> content;
  std::size_t capacity = 64;
  std::size_t window = 0;  ///< not 0: reads back so many bytes, whatever was written
  std::vector<std::size_t> written;

  bool serve(ScriptedDevice& device, const can::Frame& request) {
    auto answer = request;
    answer.id = 0x581;
    answer.data.fill(0);
    const auto reply = [&] {
      device.send(answer);
      return true;
    };
    const auto command = request.data[0];
    if (command == 0x80) reading_ = writing_ = false;
    if ((command & 0xE0U) == 0x60 && reading_) {
      const auto n = std::min<std::size_t>(7, content.size() - at_);
      std::copy_n(content.begin() + static_cast<std::ptrdiff_t>(at_), n, answer.data.begin() + 1);
      at_ += n;
      reading_ = at_ < content.size();
      answer.data[0] = static_cast<std::uint8_t>((command & 0x10U) | ((7 - n) << 1U) | (reading_ ? 0U : 1U));
      return reply();
    }
    if ((command & 0xE0U) == 0x00 && writing_) {
      const auto n = 7U - ((command >> 1U) & 7U);
      incoming_.insert(incoming_.end(), request.data.begin() + 1, request.data.begin() + 1 + n);
      if ((command & 1U) != 0) store();
      answer.data[0] = static_cast<std::uint8_t>(0x20U | (command & 0x10U));
      return reply();
    }
    if (request.data[1] != low_byte_of_index || request.data[2] != 0x20 || request.data[3] != 0) return false;
    std::copy_n(request.data.begin() + 1, 3, answer.data.begin() + 1);
    if (command == 0x40) {
      reading_ = true;
      at_ = 0;
      answer.data[0] = 0x41;
      answer.data[4] = static_cast<std::uint8_t>(content.size());
      answer.data[5] = static_cast<std::uint8_t>(content.size() >> 8U);
      return reply();
    }
    if ((command & 0xE0U) != 0x20) return false;
    const auto size = load_le(request.bytes().subspan(4));
    if (command == 0x21 && size > capacity) {
      device.abort(request, 0x06070012);
      return true;
    }
    incoming_.clear();
    writing_ = (command & 2U) == 0;
    if (!writing_) {
      incoming_.assign(request.data.begin() + 4, request.data.begin() + 8 - ((command >> 2U) & 3U));
      store();
    }
    answer.data[0] = 0x60;
    return reply();
  }

 private:
  void store() {
    written.push_back(incoming_.size());
    if (window != 0) {
      std::ranges::copy(incoming_, content.begin());
    } else {
      content = incoming_;
    }
    writing_ = false;
  }
  bool reading_ = false, writing_ = false;
  std::size_t at_ = 0;
  std::vector<std::uint8_t> incoming_;
};

/// A device with these buffers.
Outcome play_with(const std::vector<Buffer*>& buffers, const std::string& scenarios,
                  const RunOptions& options = {}) {
  can::SimulatedBus bus;
  ScriptedDevice device;
  device.before = [&](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    return std::ranges::any_of(buffers, [&](Buffer* buffer) { return buffer->serve(self, frame); });
  };
  auto profile = device::default_profile(NodeId(1));
  for (const auto* buffer : buffers) {
    device::Entry entry;
    entry.mux = {Index(0x2000U + buffer->low_byte_of_index), SubIndex(0)};
    entry.name = "Buffer";
    entry.type = canopen::DataType::domain;
    entry.claimed = true;
    profile.objects.push_back(entry);
    profile.safe_objects.push_back(entry.mux);
  }
  return play(bus, device, scenarios, options, profile);
}
Outcome play_with(Buffer& buffer, const std::string& scenarios, const RunOptions& options = {}) {
  return play_with(std::vector<Buffer*>{&buffer}, scenarios, options);
}

std::string scenario_with(const std::string& given, const std::string& risk = "config") {
  return "  - id: a\n    title: t\n    risk: " + risk + "\n    given: {buffer: " + given +
         "}\n    steps:\n      - upload: {object: $buffer}\n        checks: T-MUST\n        expect: {size: 0..}\n";
}
const std::string writes = "entries with safe and access rw and not fixed size and holding 29.. bytes";
const std::string reads = "entries with readable and not fixed size and holding 15.. bytes";

const std::string when_alone = R"(
  - id: a
    title: t
    when: nobody else is heard on the bus
    steps:
      - upload: {object: 1000h:00}
        checks: T-MUST
)";

Verdict verdict_beside(const can::Frame& frame, Duration after) {
  can::SimulatedBus bus;
  ScriptedDevice device;
  Talker talker(frame, after);
  bus.attach(talker, "talker");
  return play(bus, device, when_alone).only().verdict;
}

}  // namespace

TEST_CASE("Nobody else is heard as long as only the device sends, on CAN-IDs that are its own") {
  ScriptedDevice device;
  CHECK(play(device, when_alone).only().verdict == Verdict::pass);
  // By its node-ID, and by what its entries hold.
  CHECK(verdict_beside(can::data_frame(CanId(0x181), {1}), 10ms) == Verdict::pass);
  CHECK(verdict_beside(can::data_frame(CanId(0x701), {5}), 10ms) == Verdict::pass);
}

TEST_CASE("Somebody who is heard within the first seconds makes the device one of several") {
  CHECK(verdict_beside(can::data_frame(CanId(0x707), {5}), 10ms) == Verdict::not_applicable);
  CHECK(verdict_beside(can::data_frame(CanId(0x707), {5}), 4s) == Verdict::not_applicable);
  CHECK(verdict_beside(can::data_frame(CanId(0x607), {0x40, 0, 0x10, 0, 0, 0, 0, 0}), 4s) ==
        Verdict::not_applicable);
  CHECK(verdict_beside(can::data_frame(CanId(0x000), {1, 7}), 4s) == Verdict::not_applicable);
}

TEST_CASE("A CAN-ID that the device holds in a valid COB-ID is its own") {
  can::SimulatedBus bus;
  ScriptedDevice device;
  device.entries[0x180000] = {2};
  device.entries[0x180001] = {0x34, 0x02, 0, 0};
  device.entries[0x180101] = {0x35, 0x02, 0, 0x80};
  SECTION("valid") {
    Talker talker(can::data_frame(CanId(0x234), {1}), 10ms);
    bus.attach(talker, "talker");
    CHECK(play(bus, device, when_alone).only().verdict == Verdict::pass);
  }
  SECTION("not valid") {
    Talker talker(can::data_frame(CanId(0x235), {1}), 10ms);
    bus.attach(talker, "talker");
    CHECK(play(bus, device, when_alone).only().verdict == Verdict::not_applicable);
  }
}

TEST_CASE("How many bytes an entry takes is found out by writing them, and what it held is put back") {
  Buffer empty;
  const auto outcome = play_with(empty, scenario_with(writes));
  CHECK(outcome.only().verdict == Verdict::pass);
  CHECK(empty.written == std::vector<std::size_t>{29, 0});
  CHECK(empty.content.empty());
}

TEST_CASE("Of several DOMAINs that with the least in it is filled, and an empty one last") {
  Buffer empty, large, small;
  empty.low_byte_of_index = 0x02;
  large.low_byte_of_index = 0x03;
  large.content.assign(90, 0x43);
  small.content.assign(9, 0x44);
  const auto outcome = play_with({&empty, &large, &small}, scenario_with(writes));
  CHECK(outcome.only().verdict == Verdict::pass);
  CHECK(small.written == std::vector<std::size_t>{29, 9});
  CHECK(large.written.empty());
  CHECK(empty.written.empty());
}

TEST_CASE("An empty entry is filled for a scenario that reads, where the run may write") {
  Buffer empty;
  CHECK(play_with(empty, scenario_with(reads, "read-only")).only().verdict == Verdict::pass);
  CHECK(empty.content.empty());
  RunOptions careful;
  careful.plan.allowed = scenario::Risk::read_only;
  Buffer untouched;
  const auto outcome = play_with(untouched, scenario_with(reads, "read-only"), careful);
  CHECK(outcome.only().verdict == Verdict::not_applicable);
  CHECK(outcome.only().reason ==
        "the device has no readable string or DOMAIN of 15 bytes or more: 2001h:00 holds 0");
  CHECK(untouched.written.empty());
}

TEST_CASE("An entry that is too small says so, and what is wanted instead") {
  Buffer small;
  small.capacity = 16;
  small.content.assign(16, 0x41);
  const auto outcome = play_with(small, scenario_with(writes));
  CHECK(outcome.only().verdict == Verdict::not_applicable);
  CHECK(outcome.only().reason.starts_with("the device has no writable string or DOMAIN of 29 bytes or more: "
                                          "2001h:00 takes no 29 bytes: abort 0607 0012h"));
  REQUIRE(outcome.only().wants.size() == 1);
  CHECK(outcome.only().wants[0].text ==
        "a writable string or DOMAIN of 29 bytes or more, named in safe_objects");
  CHECK(small.content == std::vector<std::uint8_t>(16, 0x41));
}

TEST_CASE("A window of fixed length is taken where there is no store, and is as it was afterwards") {
  Buffer window;
  window.window = window.capacity = 100;
  window.content.assign(100, 0x42);
  CHECK(play_with(window, scenario_with(writes)).only().verdict == Verdict::pass);
  CHECK(window.content == std::vector<std::uint8_t>(100, 0x42));
}

TEST_CASE("A condition that does not hold names the entry and the answer of the device") {
  ScriptedDevice device;
  const auto outcome = play(device, R"(
  - id: a
    title: t
    when: 1000h:00 is present and 1800h:01 is present
    steps:
      - upload: {object: 1000h:00}
        checks: T-MUST
)");
  CHECK(outcome.only().verdict == Verdict::not_applicable);
  CHECK(outcome.only().reason == "1800h:01 is absent: abort 0602 0000h (object does not exist)");
}

TEST_CASE("An entry whose answer breaks the protocol has not been tried") {
  ScriptedDevice device;
  device.before = [](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if (frame.data[0] != 0x40 || frame.data[1] != 0x14) return false;
    self.send(can::data_frame(CanId(0x581), {0x43, 0x14, 0x10, 0x05, 0, 0, 0, 0}));
    return true;
  };
  const auto outcome = play(device, R"(
  - id: a
    title: t
    when: 1014h:00 is writable
    risk: config
    steps:
      - upload: {object: 1000h:00}
        checks: T-MUST
)");
  CHECK(outcome.only().verdict == Verdict::inconclusive);
  CHECK(outcome.only().reason.find("cannot be tried") != std::string::npos);
}

TEST_CASE("A case in which no step applied says which conditions left them out") {
  ScriptedDevice device;
  const auto outcome = play(device, R"(
  - id: a
    title: t
    steps:
      - upload: {object: 1000h:00}
        when: 1010h:01 is present
        checks: T-MUST
        expect: ok
      - over: {object: entries with index 2000h..2FFFh and integer}
        steps:
          - upload: {object: $object}
            checks: T-MUST
            expect: ok
)");
  CHECK(outcome.only().verdict == Verdict::not_applicable);
  CHECK(outcome.only().reason ==
        "the device has no integer with index 2000h..2FFFh; 1010h:01 is absent: abort 0602 0000h (object "
        "does not exist)");
}

TEST_CASE("of a device that can map PDOs anew a PDO is fixed where its description fixes what that takes") {
  for (const auto access : {device::Access::rw, device::Access::constant}) {
    ScriptedDevice device;
    device.entries[0x180000] = {2};
    device.entries[0x180001] = {0x81, 1, 0, 0};
    device.entries[0x1A0000] = {1};
    device.entries[0x1A0001] = {8, 0, 0, 0x60};
    auto profile = device::default_profile(NodeId(1));
    profile.claims.insert("variable mapping");
    for (const auto mux :
         {Multiplexer{Index(0x1A00), SubIndex(0)}, Multiplexer{Index(0x1A00), SubIndex(1)}}) {
      auto entry = *device::standard_entry(mux);
      entry.access = mux.sub == SubIndex(1) ? access : device::Access::rw;
      entry.access_open = false;
      entry.described = entry.claimed = true;
      profile.objects.push_back(entry);
    }
    can::SimulatedBus bus;
    const auto out = play(bus, device, R"(
  - id: remaps
    title: t
    risk: config
    when: 1A00h has a variable mapping
    steps:
      - upload: {object: 1A00h:01}
        checks: T-MUST
)",
                          {}, profile);
    if (access == device::Access::rw) {
      CHECK(out.verdict_of("T-MUST") == Verdict::pass);
    } else {
      CHECK(out.only().verdict == Verdict::not_applicable);
      CHECK_THAT(out.only().reason, Catch::Contains("1A00h:01 is const"));
    }
  }
}
