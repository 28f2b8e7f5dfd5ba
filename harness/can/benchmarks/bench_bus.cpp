// SPDX-License-Identifier: Apache-2.0
// Frames per second of the simulated bus: request and answer between the harness and one or many nodes.
//   bench_bus [FRAMES]
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <deque>

#include "can/frame_time.hpp"
#include "can/simulated_bus.hpp"

using namespace conform;
using namespace conform::can;

namespace {

// Answers one identifier, ignores all others, has a timer that never fires.
class Responder final : public Participant {
 public:
  explicit Responder(std::uint32_t node) : node_(node) {}
  void attach(Sender sender, BusTime now) override {
    sender_ = std::move(sender);
    wakeup_ = now + std::chrono::hours(1'000'000);
  }
  void on_frame(const Frame& frame, BusTime) override {
    if (!frame.is_data(CanId(0x600 + node_))) return;
    Frame answer = frame;
    answer.id = 0x580 + node_;
    sender_(answer);
  }
  void on_time(BusTime) override {}
  [[nodiscard]] std::optional<BusTime> next_wakeup() const override { return wakeup_; }

 private:
  std::uint32_t node_;
  Sender sender_;
  BusTime wakeup_{};
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void run(std::uint32_t nodes, std::uint64_t frames) {
  std::deque<Responder> responders;
  SimulatedBus bus;
  for (std::uint32_t node = 1; node <= nodes; ++node) bus.attach(responders.emplace_back(node));
  Transport& transport = bus.transport();
  Frame request = data_frame(CanId(0x601), {0x40, 0x00, 0x10, 0x00, 0, 0, 0, 0});
  const auto start = std::chrono::steady_clock::now();
  while (bus.frame_count() < frames) {
    store_le(std::span(request.data).last(4), bus.frame_count());
    if (!transport.send(request)) std::abort();
    for (int i = 0; i < 2; ++i) {
      const auto event = transport.receive(bus.now() + std::chrono::seconds(1));
      if (!event || !*event) std::abort();
    }
  }
  const double elapsed = seconds_since(start);
  const double rate = static_cast<double>(bus.frame_count()) / elapsed;
  const double simulated = std::chrono::duration<double>(bus.now().time_since_epoch()).count();
  std::printf("%3u node(s): %10.0f frames/s, %6.1f ns/frame, %6.0f times real time at 500 kbit/s\n", nodes,
              rate, 1e9 / rate, simulated / elapsed);
}

void run_lengths(std::uint64_t frames) {
  Frame frame = data_frame(CanId(0x601), {0x40, 0x00, 0x10, 0x00, 0, 0, 0, 0});
  std::uint64_t bits = 0;
  const auto start = std::chrono::steady_clock::now();
  for (std::uint64_t i = 0; i < frames; ++i) {
    store_le(std::span(frame.data).last(4), i);
    bits += frame_bits(frame);
  }
  const double elapsed = seconds_since(start);
  std::printf("frame length:  %10.0f frames/s, %6.1f ns/frame (%llu bits)\n",
              static_cast<double>(frames) / elapsed, elapsed * 1e9 / static_cast<double>(frames),
              static_cast<unsigned long long>(bits));
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t frames = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 4'000'000;
  run_lengths(frames);
  run(1, frames);
  run(2, frames);
  run(10, frames / 2);
  run(126, frames / 10);
}
