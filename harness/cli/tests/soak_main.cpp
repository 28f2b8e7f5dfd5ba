// SPDX-License-Identifier: Apache-2.0
// soak: a day on a simulated bus that another node fills to the last bit, run after run in one process, while
// frames get lost, error frames come and the power fails. What must hold all the time: no false failure, no
// frame unaccounted for, and memory that does not grow.
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/random.hpp"
#include "base/text.hpp"
#include "can/error_frame.hpp"
#include "cli/proof/selftest.hpp"
#include "cli/suite_folder.hpp"
#include "device/profile.hpp"

namespace {

using namespace conform;
using namespace std::chrono_literals;

/// Sends whenever the bus is free: the least urgent frame there is, of another network on the same wire, so
/// that every other one waits for one frame at most.
class Filler final : public can::Participant {
 public:
  void attach(Sender sender, BusTime) override {
    sender_ = std::move(sender);
    sender_(can::data_frame(CanId(0x733), {0x7F}));  // a heartbeat: the device is not alone
    next();
  }
  void on_frame(const can::Frame&, BusTime) override {}
  void on_transmitted(BusTime) override { next(); }
  void on_time(BusTime) override {}
  [[nodiscard]] std::optional<BusTime> next_wakeup() const override { return std::nullopt; }

 private:
  void next() {
    auto frame = can::data_frame(CanId(0), {0x55, 0xAA, 0x55, 0xAA, 0x55, 0xAA, 0x55, 0xAA});
    frame.id = 0x1FFFFFFF;
    frame.extended = true;
    sender_(frame);
  }
  Sender sender_;
};

struct Settings {
  double hours = 24;
  std::uint64_t seed = 1;
};

struct Tally {
  Duration bus_time{};
  std::uint64_t rounds = 0, frames = 0, unaccounted = 0, lost = 0;
  std::uint64_t passed = 0, failed = 0, warned = 0, undecided = 0;
  std::uint64_t memory_at_first = 0, memory = 0;  ///< in use, in kB
};

/// What the program has taken and not given back. Resident memory is no measure: a machine takes pages away
/// and gives them back as it likes.
std::uint64_t memory_in_use_kb() {
  const auto heap = ::mallinfo2();
  return (heap.uordblks + heap.hblkhd) / 1024;
}

/// Faults of the host and of the bus at random times of the run.
void plan_faults(can::SimulatedBus& bus, std::uint64_t& random) {
  for (int i = 0; i < 20; ++i) bus.drop_at_harness(1 + next_random(random) % 2'000'000);
  constexpr std::uint32_t bus_off = 0x040, restarted = 0x100;
  constexpr std::uint32_t classes[] = {0x008, 0x004, 0x080, bus_off};  // protocol, controller, bus error
  for (int i = 0; i < 8; ++i) {
    const auto at = BusTime(std::chrono::milliseconds(next_random(random) % 900'000));
    const auto error_class = classes[next_random(random) % std::size(classes)];
    bus.inject_error_frame(at, error_class);
    if (error_class == bus_off) bus.inject_error_frame(at + 150ms, restarted);
  }
}

/// Frames of the bus that are neither in the capture nor counted as lost.
std::uint64_t unaccounted_in(const can::SimulatedBus& bus, const can::Capture& capture, std::uint64_t lost) {
  std::uint64_t held = lost;
  for (std::size_t i = 0; i < capture.size(); ++i) {
    // A frame whose echo was lost is in the capture all the same, as sent.
    const bool only_sent = capture.frames()[i].comment.view().find("lost its echo") != std::string_view::npos;
    if (!capture.frames()[i].frame.error && !only_sent) ++held;
  }
  const auto sent = bus.frame_count();
  return sent > held ? sent - held : held - sent;
}

Result<void> play_round(const cli::LoadedSuites& suites, const device::Profile& profile,
                        std::uint64_t& random, Tally& tally) {
  auto node = refnode::PoweredNode::create({.node_id = profile.node.value()});
  if (!node) return std::unexpected(node.error());
  can::SimulatedBus::Options bus_options;
  bus_options.seed = next_random(random);
  can::SimulatedBus bus(bus_options);
  Filler filler;
  bus.attach(**node, "reference node");
  bus.attach(filler, "filler");
  plan_faults(bus, random);
  engine::RunOptions options;
  options.plan.seed = next_random(random);
  options.plan.shuffle = options.plan.seed;
  cli::give_power_switch(options, bus, **node);
  can::Capture capture;
  const auto run = engine::run(bus.transport(), profile, suites.suite, suites.catalogue, options, capture);
  const auto counts = run.counts();
  const auto lost = bus.transport().health().frames_dropped;
  ++tally.rounds;
  tally.bus_time += bus.now().time_since_epoch();
  tally.frames += bus.frame_count();
  tally.lost += lost;
  tally.unaccounted += unaccounted_in(bus, capture, lost);
  tally.passed += counts.pass;
  tally.failed += counts.fail;
  tally.warned += counts.warn;
  tally.undecided += counts.inconclusive + counts.error;
  for (const auto& each : run.cases) {
    if (each.verdict != result::Verdict::fail && each.verdict != result::Verdict::warn) continue;
    std::puts(fmt::format("run {}: {} {}", tally.rounds, to_string(each.verdict), each.name()).c_str());
    for (const auto& judgement : each.judgements) {
      for (const auto& finding : judgement.findings)
        std::puts(fmt::format("  {}: {}: {}", judgement.requirement, finding.step, finding.actual).c_str());
    }
  }
  if (run.aborted) std::puts(fmt::format("run {}: {}", tally.rounds, *run.aborted).c_str());
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Runs the suite over and over on a full simulated bus with faults of host and bus."};
  Settings settings;
  std::string suites_folder;
  app.add_option("--hours", settings.hours, "of bus time")->capture_default_str();
  app.add_option("--seed", settings.seed, "of faults, orders and buses")->capture_default_str();
  app.add_option("--suites", suites_folder, "folder of the suites");
  CLI11_PARSE(app, argc, argv);
  const auto root = cli::find_suites(suites_folder);
  if (!root) return std::puts(root.error().text().c_str()), 2;
  const auto suites = cli::load_suites(*root, false);
  if (!suites) return std::puts(suites.error().text().c_str()), 2;
  auto reference = device::load_profile_file(*root + "/devices/reference-node.yaml");
  if (!reference) return std::puts(reference.error().text().c_str()), 2;
  reference->profile.claims.erase("only node on the bus");

  Tally tally;
  std::uint64_t random = settings.seed;
  const auto end = std::chrono::duration<double, std::ratio<3600>>(settings.hours);
  while (tally.bus_time < end) {
    if (auto played = play_round(*suites, reference->profile, random, tally); !played)
      return std::puts(played.error().text().c_str()), 2;
    tally.memory = memory_in_use_kb();
    // The first runs warm up what a process keeps.
    if (tally.rounds <= 2) tally.memory_at_first = tally.memory;
  }
  const double hours = std::chrono::duration<double, std::ratio<3600>>(tally.bus_time).count();
  const auto grown = tally.memory > tally.memory_at_first ? tally.memory - tally.memory_at_first : 0;
  std::puts(
      fmt::format("{:.1f} hours of bus time, {} runs, {} frames ({:.0f} a second), {} of them lost by the "
                  "host, {} unaccounted for; {} cases passed, {} failed, {} warned, {} left open; {} kB "
                  "more memory than after two runs (seed {})",
                  hours, tally.rounds, tally.frames,
                  static_cast<double>(tally.frames) / std::max(hours * 3600, 1.0), tally.lost,
                  tally.unaccounted, tally.passed, tally.failed, tally.warned, tally.undecided, grown,
                  settings.seed)
          .c_str());
  constexpr std::uint64_t most_grown_kb = 1024;
  return tally.failed + tally.unaccounted == 0 && tally.passed > 0 && grown <= most_grown_kb ? 0 : 1;
}
