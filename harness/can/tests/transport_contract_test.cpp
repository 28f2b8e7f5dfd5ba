// SPDX-License-Identifier: Apache-2.0
// The contract of Transport on the simulated bus and on SocketCAN's code over a socket pair.
#include <linux/can.h>
#include <sys/socket.h>

#include <array>
#include <thread>

#include "can/simulated_bus.hpp"
#include "can/socket_loop.hpp"
#include "can/socketcan_transport.hpp"
#include "scripted_participant.hpp"
#include "transport_contract.hpp"

using namespace conform;
using namespace conform::can;
using namespace conform::can::testing;
using namespace std::chrono_literals;

namespace {

class SimulatedBench final : public Bench {
 public:
  SimulatedBench() {
    make_echo(node_, 0x605, 0x585);
    bus_.attach(node_);
  }
  Transport& transport() override { return bus_.transport(); }

 private:
  ScriptedParticipant node_;
  SimulatedBus bus_;
};

struct Pair {
  int ours = -1;
  int theirs = -1;
};

Pair make_pair_of_sockets() {
  std::array<int, 2> fds{};
  REQUIRE(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, fds.data()) == 0);
  return {fds[0], fds[1]};
}

std::unique_ptr<SocketCanTransport> must_wrap(int fd, const SocketCanOptions& options = {}) {
  auto made = SocketCanTransport::from_descriptor(fd, "socketpair", options);
  REQUIRE(made.has_value());
  return std::move(*made);
}

// The peer runs in a thread of its own, with the loop that the reference node uses.
class SocketPairBench final : public Bench {
 public:
  SocketPairBench() {
    const Pair pair = make_pair_of_sockets();
    transport_ = must_wrap(pair.ours);
    SocketCanOptions options;
    options.receive_own = false;
    options.wake_descriptor = stop_.descriptor();
    peer_ = must_wrap(pair.theirs, options);
    make_echo(node_, 0x605, 0x585);
    thread_ = std::thread([this] { static_cast<void>(run_participant(node_, *peer_, stop_)); });
  }
  ~SocketPairBench() override {
    stop_.request();
    thread_.join();
  }
  Transport& transport() override { return *transport_; }

 private:
  StopFlag stop_;
  ScriptedParticipant node_;
  std::unique_ptr<SocketCanTransport> transport_;
  std::unique_ptr<SocketCanTransport> peer_;
  std::thread thread_;
};

}  // namespace

TEST_CASE("the simulated bus keeps the contract of a transport") {
  check_transport_contract([] { return std::make_unique<SimulatedBench>(); });
}

TEST_CASE("SocketCAN over a socket pair keeps the contract of a transport") {
  check_transport_contract([] { return std::make_unique<SocketPairBench>(); });
}

TEST_CASE("a closed other end is an error and stays one") {
  const Pair pair = make_pair_of_sockets();
  const auto transport = must_wrap(pair.ours);
  const can_frame last = {.can_id = 0x123, .len = 0, .__pad = 0, .__res0 = 0, .len8_dlc = 0, .data = {}};
  REQUIRE(::send(pair.theirs, &last, sizeof last, 0) == static_cast<ssize_t>(sizeof last));
  ::close(pair.theirs);
  // What arrived before is still delivered.
  const auto event = transport->receive(transport->now() + 1s);
  REQUIRE(event.has_value());
  REQUIRE(event->has_value());
  CHECK((*event)->frame.id == 0x123);
  CHECK(transport->receive(transport->now() + 1s).error().what == "the other end has been closed");
  CHECK(transport->receive(transport->now() + 1s).error().where == "socketpair");
  CHECK_FALSE(transport->send(data_frame(CanId(1), {})).has_value());
}

TEST_CASE("what is not a CAN frame is refused") {
  for (const std::size_t size : {std::size_t{1}, std::size_t{15}, std::size_t{72}}) {
    const Pair pair = make_pair_of_sockets();
    const auto transport = must_wrap(pair.ours);
    const std::array<std::uint8_t, 72> junk{};
    REQUIRE(::send(pair.theirs, junk.data(), size, 0) == static_cast<ssize_t>(size));
    CHECK_FALSE(transport->receive(transport->now() + 1s).has_value());
    ::close(pair.theirs);
  }
  const Pair pair = make_pair_of_sockets();
  const auto transport = must_wrap(pair.ours);
  can_frame long_frame{};
  long_frame.len = 9;
  REQUIRE(::send(pair.theirs, &long_frame, sizeof long_frame, 0) == static_cast<ssize_t>(sizeof long_frame));
  CHECK_FALSE(transport->receive(transport->now() + 1s).has_value());
  ::close(pair.theirs);
}

TEST_CASE("bytes behind the data length do not make equal frames differ") {
  const Pair pair = make_pair_of_sockets();
  const auto transport = must_wrap(pair.ours);
  can_frame raw{};
  raw.can_id = 0x123;
  raw.len = 1;
  raw.data[0] = 7;
  raw.data[5] = 0xEE;
  REQUIRE(::send(pair.theirs, &raw, sizeof raw, 0) == static_cast<ssize_t>(sizeof raw));
  const auto event = transport->receive(transport->now() + 1s);
  REQUIRE(event.has_value());
  CHECK((*event)->frame == data_frame(CanId(0x123), {7}));
  ::close(pair.theirs);
}

TEST_CASE("a full transmit queue is an error after its bound, and counted") {
  const Pair pair = make_pair_of_sockets();
  SocketCanOptions options;
  options.send_bound = 1ms;
  const auto transport = must_wrap(pair.ours, options);
  Result<void> sent;
  for (int i = 0; i < 1'000'000 && sent; ++i) sent = transport->send(data_frame(CanId(1), {}));
  REQUIRE_FALSE(sent.has_value());
  CHECK(sent.error().what == "the transmit queue stayed full for 1 ms");
  CHECK(transport->health().transmit_retries == 1);
  ::close(pair.theirs);
}

TEST_CASE("an error frame that tells of bus-off is delivered and then reported until the restart") {
  const Pair pair = make_pair_of_sockets();
  const auto transport = must_wrap(pair.ours);
  can_frame raw{};
  raw.can_id = CAN_ERR_FLAG | 0x40U;
  raw.len = 8;
  REQUIRE(::send(pair.theirs, &raw, sizeof raw, 0) == static_cast<ssize_t>(sizeof raw));
  const auto event = transport->receive(transport->now() + 1s);
  REQUIRE(event.has_value());
  REQUIRE(event->has_value());
  CHECK((*event)->frame.error);
  CHECK(transport->receive(transport->now() + 1s).error().what == "the controller is bus-off");
  CHECK_FALSE(transport->send(data_frame(CanId(1), {})).has_value());
  CHECK(transport->health().bus_off);
  CHECK(transport->health().error_frames == 1);
  ::close(pair.theirs);
}

TEST_CASE("a wake descriptor ends a long wait") {
  const Pair pair = make_pair_of_sockets();
  StopFlag stop;
  SocketCanOptions options;
  options.wake_descriptor = stop.descriptor();
  const auto transport = must_wrap(pair.ours, options);
  stop.request();
  CHECK_FALSE(transport->receive(transport->now() + 1h).value().has_value());
  ::close(pair.theirs);
}

TEST_CASE("the loop refuses a participant that makes no progress") {
  const Pair pair = make_pair_of_sockets();
  const auto transport = must_wrap(pair.ours);
  ScriptedParticipant node;
  node.wakeup = BusTime{};
  node.when_time = [](ScriptedParticipant&, BusTime) {};
  const StopFlag stop;
  const auto ended = run_participant(node, *transport, stop);
  REQUIRE_FALSE(ended.has_value());
  CHECK(ended.error().what.find("wake-ups") != std::string::npos);
  ::close(pair.theirs);
}

TEST_CASE("the loop sends what the participant wants at its time and stops when asked") {
  const Pair pair = make_pair_of_sockets();
  const auto ours = must_wrap(pair.ours);
  StopFlag stop;
  const auto theirs = must_wrap(pair.theirs);
  ScriptedParticipant node;
  node.wakeup = BusTime{};
  int rounds = 0;
  node.when_time = [&](ScriptedParticipant& self, BusTime now) {
    self.send(data_frame(CanId(0x705), {5}));
    self.wakeup = now + 1ms;
    if (++rounds == 3) stop.request();
  };
  const auto ended = run_participant(node, *theirs, stop);
  REQUIRE(ended.has_value());
  CHECK(ended->sent == 3);
  CHECK(ended->not_sent == 0);
  for (int i = 0; i < 3; ++i) CHECK(receive_ok(*ours, ours->now() + 1s)->frame.id == 0x705);
}

TEST_CASE("the loop confirms what was sent and still listens in between") {
  const Pair pair = make_pair_of_sockets();
  const auto ours = must_wrap(pair.ours);
  const auto theirs = must_wrap(pair.theirs);
  REQUIRE(ours->send(data_frame(CanId(0x605), {})));
  StopFlag stop;
  ScriptedParticipant node;
  node.wakeup = BusTime{};
  node.when_time = [](ScriptedParticipant& self, BusTime) {
    self.wakeup.reset();
    self.send(data_frame(CanId(0x585), {}));
  };
  // Would send for ever; only a received frame ends it.
  node.when_transmitted = [](ScriptedParticipant& self, BusTime) {
    if (self.heard.empty()) self.send(data_frame(CanId(0x585), {}));
  };
  node.when_frame = [&](ScriptedParticipant&, const Frame&, BusTime) { stop.request(); };
  const auto ended = run_participant(node, *theirs, stop);
  REQUIRE(ended.has_value());
  CHECK(ended->received == 1);
  CHECK(ended->sent >= 1);
}

TEST_CASE("an impossible or missing interface is explained with the command to type") {
  CHECK_FALSE(interface_facts("").has_value());
  CHECK_FALSE(interface_facts("a/b").has_value());
  CHECK_FALSE(interface_facts("a-very-long-interface-name").has_value());
  const auto missing = interface_facts("vcan-none");
  REQUIRE_FALSE(missing.has_value());
  CHECK(missing.error().where == "vcan-none");
  CHECK(missing.error().hint.find("sudo ip link add dev vcan-none type vcan") != std::string::npos);
  const auto loopback = interface_facts("lo");
  REQUIRE_FALSE(loopback.has_value());
  CHECK(loopback.error().what.find("not a CAN interface") != std::string::npos);
  CHECK(up_command("can0", "can") == "sudo ip link set can0 up type can bitrate 500000");
  CHECK(up_command("vcan0", "vcan") == "sudo ip link set vcan0 up");
  // Whether the kernel knows CAN or not: there is no such interface, so both answers are errors that say so.
  CHECK_FALSE(SocketCanTransport::open("vcan-none").has_value());
}
