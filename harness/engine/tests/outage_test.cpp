// SPDX-License-Identifier: Apache-2.0
// A bus that goes away in the middle of a run: only the case that met it is lost, and nothing stays changed.
#include <atomic>

#include "bench.hpp"

using namespace conform;
using namespace conform::engine;
using namespace conform::engine::testing;
using namespace std::chrono_literals;
using result::Verdict;

namespace {

/// Goes away with a frame of the harness, and comes back by itself. Nobody hears what passes meanwhile.
class FlakyTransport final : public can::Transport {
 public:
  using When = std::function<bool(const can::Frame&)>;
  explicit FlakyTransport(can::Transport& inner) : inner_(inner) {}
  BusTime now() const override { return inner_.now(); }
  Result<void> send(const can::Frame& frame) override {
    if (!is_away() && when && when(frame)) {
      away_until_ = inner_.now() + lasts;
      met_ = true;
    }
    if (is_away()) return std::unexpected(down());
    return inner_.send(frame);
  }
  Result<std::optional<can::BusEvent>> receive(BusTime deadline) override {
    if (is_away()) return std::unexpected(down());
    return inner_.receive(deadline);
  }
  Result<bool> come_back(BusTime deadline) override {
    const auto until = std::min(deadline, away_until_);
    while (inner_.now() < until) (void)inner_.receive(until);
    if (waits != nullptr) waits->store(2);
    if (is_away()) return false;
    outages_ += std::exchange(met_, false) ? 1 : 0;
    return true;
  }
  can::BusHealth health() override {
    can::BusHealth out;
    out.outages = outages_;
    return out;
  }
  can::TransportInfo info() const override { return inner_.info(); }

  When when;
  Duration lasts = 2s;
  std::atomic<int>* waits = nullptr;  ///< a signal that comes while the harness waits

 private:
  static Error down() { return {"the interface went down", "can0", "sudo ip link set can0 up"}; }
  bool is_away() const { return inner_.now() < away_until_; }

  can::Transport& inner_;
  BusTime away_until_{};
  bool met_ = false;
  std::uint64_t outages_ = 0;
};

constexpr std::string_view three_cases = R"(
  - id: a
    title: t
    risk: config
    steps:
      - download: {object: 1017h:00, value: 1000}
        checks: T-MUST
  - id: b
    title: t
    risk: config
    steps:
      - download: {object: 1017h:00, value: 2000}
      - upload: {object: 1018h:01}
        checks: T-MUST
        expect: {value: 1}
  - id: c
    title: t
    risk: config
    steps:
      - download: {object: 1017h:00, value: 3000}
        checks: T-MUST
)";

struct Bench {
  can::SimulatedBus bus;
  ScriptedDevice device;
  FlakyTransport transport{bus.transport()};
  RunOptions options;

  Outcome play(std::string_view scenarios = three_cases) {
    bus.attach(device, "scripted device");
    Outcome out;
    out.run = run(transport, writing_profile(), suite_of(std::string(scenarios)), catalogue(), options,
                  out.capture);
    return out;
  }
};

bool writes_1017(const can::Frame& frame) {
  return frame.id == 0x601 && frame.data[0] == 0x2B && frame.data[1] == 0x17;
}
bool writes_2000_ms(const can::Frame& frame) {
  return writes_1017(frame) && frame.data[4] == 0xD0 && frame.data[5] == 0x07;
}
/// Of case b, behind its write.
FlakyTransport::When behind_the_write_of_b() {
  return [wrote = false, done = false](const can::Frame& frame) mutable {
    wrote = wrote || writes_2000_ms(frame);
    const bool now = wrote && !done && frame.id == 0x601 && frame.data[0] == 0x40;
    done = done || now;
    return now;
  };
}

bool told(const Outcome& out, std::string_view what) {
  return std::ranges::any_of(
      out.run.notes, [what](const std::string& note) { return note.find(what) != std::string::npos; });
}

}  // namespace

TEST_CASE("a bus that comes back costs the case that met it and no other, and its change is put back") {
  Bench bench;
  bench.transport.when = behind_the_write_of_b();
  const auto out = bench.play();
  CHECK_FALSE(out.run.aborted.has_value());
  REQUIRE(out.run.cases.size() >= 3);
  CHECK(out.run.cases[0].verdict == Verdict::pass);
  CHECK(out.run.cases[1].verdict == Verdict::error);
  CHECK(out.run.cases[1].finished);
  CHECK(out.run.cases[1].reason.find("the interface went down") != std::string::npos);
  CHECK(out.run.cases[2].verdict == Verdict::pass);
  CHECK(bench.device.entries[0x101700] == std::vector<std::uint8_t>{0, 0});
  CHECK(told(out, "the bus was away once, for 2 s together"));
  CHECK_FALSE(told(out, "put back"));
}

TEST_CASE("a bus that goes away again while values are put back does not keep them changed") {
  Bench bench;
  // The first write of b, and the first two that are to undo it.
  bench.transport.when = [first = behind_the_write_of_b(), away = 0,
                          begun = false](const can::Frame& frame) mutable {
    if (first(frame)) return begun = true;
    return begun && writes_1017(frame) && away++ < 2;
  };
  const auto out = bench.play();
  CHECK_FALSE(out.run.aborted.has_value());
  CHECK(out.run.cases[1].verdict == Verdict::error);
  CHECK(out.run.cases[2].verdict == Verdict::pass);
  CHECK(bench.device.entries[0x101700] == std::vector<std::uint8_t>{0, 0});
  CHECK(told(out, "the bus was away 3 times"));
}

TEST_CASE("an outage before a case takes nothing from it") {
  Bench bench;
  const auto scenarios = R"(
  - id: reset
    title: t
    risk: config
    steps:
      - nmt: reset communication
      - upload: {object: 1018h:01}
        checks: T-MUST
        expect: {value: 1}
)" + std::string(three_cases);
  // Behind the reset, the next case begins with Enter pre-operational.
  bench.transport.when = [reset = false, done = false](const can::Frame& frame) mutable {
    reset = reset || (frame.id == 0 && frame.data[0] == 0x82);
    const bool now = reset && !done && frame.id == 0 && frame.data[0] == 0x80;
    done = done || now;
    return now;
  };
  const auto out = bench.play(scenarios);
  CHECK_FALSE(out.run.aborted.has_value());
  REQUIRE(out.run.cases.size() >= 4);
  for (const auto i : {0U, 1U, 2U, 3U}) CHECK(out.run.cases[i].verdict == Verdict::pass);
  CHECK(told(out, "the bus was away once"));
}

TEST_CASE("an outage in the preparation of a run is waited for, and the preparation begins anew") {
  Bench bench;
  int uploads = 0;
  bench.transport.when = [&uploads](const can::Frame& frame) {
    return frame.id == 0x601 && frame.data[0] == 0x40 && ++uploads == 20;
  };
  const auto out = bench.play();
  CHECK_FALSE(out.run.aborted.has_value());
  for (const auto i : {0U, 1U, 2U}) CHECK(out.run.cases[i].verdict == Verdict::pass);
  CHECK(told(out, "the bus was away once"));
}

TEST_CASE("a device that was stopped when the bus went away is not asked in vain") {
  Bench bench;
  bool stopped = false;
  bench.device.before = [&stopped](ScriptedDevice&, const can::Frame&, BusTime) { return stopped; };
  bench.transport.when = [&](const can::Frame& frame) {
    if (frame.id == 0) stopped = frame.data[0] == 0x02;
    return stopped && frame.id == 0x601;
  };
  const auto out = bench.play(R"(
  - id: stops
    title: t
    risk: config
    steps:
      - nmt: stop
      - upload: {object: 1018h:01}
        checks: T-MUST
)" + std::string(three_cases));
  CHECK_FALSE(out.run.aborted.has_value());
  CHECK(out.run.cases[0].verdict == Verdict::error);
  for (const auto i : {1U, 2U, 3U}) CHECK(out.run.cases[i].verdict == Verdict::pass);
  CHECK(out.run.elapsed < 5s);
}

TEST_CASE("a bus that stays away longer than the user waits ends the run, and no case is judged by it") {
  Bench bench;
  bench.transport.when = behind_the_write_of_b();
  bench.transport.lasts = 1h;
  const auto out = bench.play();
  REQUIRE(out.run.aborted.has_value());
  CHECK(out.run.aborted->find("the interface went down") != std::string::npos);
  CHECK(out.run.cases[0].verdict == Verdict::pass);
  CHECK(out.run.cases[1].verdict == Verdict::error);
  CHECK_FALSE(out.run.cases[2].finished);
  CHECK(out.run.elapsed < 15s);
  CHECK(told(out, "not put back"));
}

TEST_CASE("a device that is gone when the bus is back is said to be gone") {
  Bench bench;
  bench.transport.when = [&bench, inner = behind_the_write_of_b()](const can::Frame& frame) mutable {
    const bool now = inner(frame);
    bench.device.dead = bench.device.dead || now;
    return now;
  };
  const auto out = bench.play();
  REQUIRE(out.run.aborted.has_value());
  CHECK(out.run.cases[1].verdict == Verdict::error);
  CHECK_FALSE(out.run.cases[2].finished);
  for (const auto& each : out.run.cases) CHECK(each.verdict != Verdict::fail);
}

TEST_CASE("a user who does not want to wait for the bus may stop the run") {
  Bench bench;
  std::atomic<int> signal = 0;
  bench.transport.when = behind_the_write_of_b();
  bench.transport.lasts = 1h;
  bench.transport.waits = &signal;
  bench.options.stop = &signal;
  bench.options.bus_patience = 2h;
  const auto out = bench.play();
  REQUIRE(out.run.aborted.has_value());
  CHECK(out.run.elapsed < 30s);
  CHECK_FALSE(out.run.cases[2].finished);
}
