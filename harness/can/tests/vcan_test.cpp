// SPDX-License-Identifier: Apache-2.0
// SocketCanTransport on a real interface of the kernel, named by CONFORM_TEST_CAN (exit code 77: skipped).
// Faults are tried on a virtual interface of our own, where the machine lets us create one; other interfaces
// stay untouched.
#include <fcntl.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <thread>

#include "base/files.hpp"
#include "can/socket_loop.hpp"
#include "can/socketcan_frame.hpp"
#include "can/socketcan_transport.hpp"
#include "scripted_participant.hpp"
#include "transport_contract.hpp"

using namespace conform;
using namespace conform::can;
using namespace conform::can::testing;
using namespace std::chrono_literals;

namespace {

[[noreturn]] void skip(const std::string& why) {
  std::printf("skipped: %s\n", why.c_str());
  std::fflush(stdout);
  std::_Exit(77);
}

std::string interface_under_test() {
  const char* const name = std::getenv("CONFORM_TEST_CAN");
  if (name == nullptr || *name == '\0') {
    skip(
        "CONFORM_TEST_CAN names no interface; try: scripts/with-vcan env CONFORM_TEST_CAN=vcan0 ctest -L vcan");
  }
  if (const auto facts = preflight(name); !facts) skip(facts.error().text());
  return name;
}

std::unique_ptr<SocketCanTransport> must_open(const std::string& name, const SocketCanOptions& options = {}) {
  auto made = SocketCanTransport::open(name, options);
  if (!made) FAIL(made.error().text());
  return std::move(*made);
}

bool run(const std::string& command) { return std::system((command + " 2>/dev/null").c_str()) == 0; }

// The kernel that is an ordinary process: a machine that is ours alone, where clock and modules may be
// touched.
bool in_user_mode_linux() {
  const auto cpu = read_file("/proc/cpuinfo", 1U << 20U);
  return cpu && cpu->find("User Mode Linux") != std::string::npos;
}

// There is no modprobe in the guest; a module that is loaded already is no problem.
void load_module(const std::string& path) {
  utsname system{};
  ::uname(&system);
  const std::string file = std::string("/usr/lib/uml/modules/") + system.release + "/kernel/" + path;
  const Descriptor fd(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (fd.valid()) ::syscall(SYS_finit_module, fd.get(), "", 0);
}

// A vcan interface for one test case; usable() is false where we may not create one.
class OwnInterface {
 public:
  OwnInterface() : name_("cfm" + std::to_string(::getpid() % 100'000)) {
    usable_ = run("ip link add dev " + name_ + " type vcan") && run("ip link set " + name_ + " up");
    if (!usable_) std::printf("not tried: no permission to create a virtual interface\n");
  }
  OwnInterface(const OwnInterface&) = delete;
  OwnInterface& operator=(const OwnInterface&) = delete;
  ~OwnInterface() { run("ip link del " + name_); }
  [[nodiscard]] bool usable() const { return usable_; }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  std::string name_;
  bool usable_ = false;
};

// A plain socket: what another program on the same interface is.
class RawSocket {
 public:
  explicit RawSocket(const std::string& name) : fd_(::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW)) {
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(::if_nametoindex(name.c_str()));
    REQUIRE(::bind(fd_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  }
  void send(const Frame& frame) const {
    const can_frame raw = to_kernel(frame);
    REQUIRE(::write(fd_.get(), &raw, sizeof raw) == static_cast<ssize_t>(sizeof raw));
  }

 private:
  Descriptor fd_;
};

class LiveBench final : public Bench {
 public:
  explicit LiveBench(const std::string& name) : transport_(must_open(name)) {
    SocketCanOptions options;
    options.receive_own = false;
    options.wake_descriptor = stop_.descriptor();
    peer_ = must_open(name, options);  // bound before the first request leaves
    make_echo(node_, 0x605, 0x585);
    thread_ = std::thread([this] { static_cast<void>(run_participant(node_, *peer_, stop_)); });
  }
  ~LiveBench() override {
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

TEST_CASE("SocketCAN on a real interface keeps the contract of a transport") {
  const std::string name = interface_under_test();
  check_transport_contract([&] { return std::make_unique<LiveBench>(name); });
}

TEST_CASE("the transport reports the facts of its interface") {
  const auto transport = must_open(interface_under_test());
  const auto info = transport->info();
  CHECK_FALSE(info.driver.empty());
  CHECK(info.receive_buffer > 0);
  CHECK(info.epoch_ns > 1'600'000'000'000'000'000);
  if (info.driver == "vcan") {
    CHECK(info.is_virtual);
    CHECK(info.bit_rate == 0);
  }
}

TEST_CASE("only a vcan that no gateway routes to another kind of interface counts as virtual") {
  interface_under_test();
  const OwnInterface own;
  if (!own.usable()) return;
  CHECK(interface_facts(own.name())->is_virtual);
  const std::string pair = own.name() + "x", between = own.name() + "v";
  if (!run("ip link add dev " + pair + " type vxcan peer name " + own.name() + "y")) return;
  run("ip link set " + pair + " up");
  CHECK_FALSE(interface_facts(pair)->is_virtual);
  const bool routes = run("ip link add dev " + between + " type vcan") &&
                      run("ip link set " + between + " up") &&
                      run("cangw -A -s " + own.name() + " -d " + between);
  if (routes) {
    CHECK(interface_facts(own.name())->is_virtual);
    REQUIRE(run("cangw -A -s " + between + " -d " + pair));
    CHECK_FALSE(interface_facts(own.name())->is_virtual);
    CHECK(interface_facts(own.name())->routed_to == pair);
    CHECK_FALSE(interface_facts(between)->is_virtual);
    REQUIRE(run("cangw -D -s " + between + " -d " + pair));
    CHECK(interface_facts(own.name())->is_virtual);
  } else {
    std::printf("not tried: cangw cannot make a route\n");
  }
  run("ip link del " + between);
  run("ip link del " + pair);
}

TEST_CASE("frames of other programs carry kernel stamps, whenever they are read") {
  const auto transport = must_open(interface_under_test());
  const RawSocket other(transport->info().name);
  const BusTime before = transport->now();
  other.send(data_frame(CanId(0x123), {1}));
  const BusTime after = transport->now();
  // Reading late must not make the stamp late.
  CHECK_FALSE(receive_ok(*transport, before - 1ns).has_value());
  while (transport->now() < after + 30ms) {
  }
  const auto event = receive_ok(*transport, transport->now());
  REQUIRE(event.has_value());
  CHECK(event->direction == Direction::received);
  CHECK(event->time >= before);
  CHECK(event->time <= after + 25ms);
}

TEST_CASE("look-alike frames are held as they are") {
  interface_under_test();
  const OwnInterface own;
  if (!own.usable()) return;
  const auto transport = must_open(own.name());
  const RawSocket other(own.name());
  Frame frame =
      data_frame(CanId(0x12345), {1, 2, 3, 4, 5, 6, 7, 8});  // too large for 11 bits, not marked as 29 bits
  frame.dlc = 13;
  other.send(frame);
  const auto event = receive_ok(*transport, transport->now() + 10s);
  REQUIRE(event.has_value());
  CHECK(event->frame == frame);
}

TEST_CASE("an error frame is delivered and counted, bus-off is an error") {
  interface_under_test();
  const OwnInterface own;
  if (!own.usable()) return;
  const auto transport = must_open(own.name());
  const RawSocket other(own.name());
  Frame frame;
  frame.error = true;
  frame.id = 0x40;
  frame.dlc = 8;
  other.send(frame);
  const auto event = receive_ok(*transport, transport->now() + 10s);
  REQUIRE(event.has_value());
  CHECK(event->frame == frame);
  CHECK(transport->health().error_frames == 1);
  CHECK(transport->health().bus_off);
  CHECK_FALSE(transport->receive(transport->now() + 10s).has_value());
}

TEST_CASE("every frame is received or counted as dropped") {
  interface_under_test();
  const OwnInterface own;
  if (!own.usable()) return;
  SocketCanOptions options;
  options.receive_buffer = 4096;
  const auto transport = must_open(own.name(), options);
  const RawSocket other(own.name());
  constexpr std::uint64_t count = 3000;
  for (std::uint64_t i = 0; i < count; ++i) other.send(data_frame(CanId(0x123), {}));
  std::uint64_t received = 0;
  while (receive_ok(*transport, transport->now() + 50ms)) ++received;
  CHECK(received < count);
  CHECK(received + transport->health().frames_dropped >= count);
}

TEST_CASE(
    "with the usual buffer a burst of ten thousand frames arrives, save what the machine's backlog counts as lost") {
  interface_under_test();
  const OwnInterface own;
  if (!own.usable()) return;
  const auto transport = must_open(own.name());
  if (transport->info().receive_buffer < 16U << 20U) return;  // no permission for a large buffer
  const RawSocket other(own.name());
  for (int i = 0; i < 10'000; ++i) other.send(data_frame(CanId(0x123), {}));
  std::uint64_t received = 0;
  while (receive_ok(*transport, transport->now() + 50ms)) ++received;
  CHECK(received + transport->health().frames_dropped >= 10'000);
  CHECK(received >= 5'000);
}

TEST_CASE("an interface that goes down is an error with the command to type, and works again when up") {
  interface_under_test();
  const OwnInterface own;
  if (!own.usable()) return;
  const auto transport = must_open(own.name());
  REQUIRE(run("ip link set " + own.name() + " down"));
  for (int i = 0; i < 3; ++i) {
    const auto event = transport->receive(transport->now() + 10s);
    REQUIRE_FALSE(event.has_value());
    CHECK(event.error().hint == "sudo ip link set " + own.name() + " up");
    CHECK_FALSE(transport->send(data_frame(CanId(1), {})).has_value());
  }
  CHECK(preflight(own.name()).error().what == "the interface is down");
  REQUIRE(run("ip link set " + own.name() + " up"));
  REQUIRE(transport->send(data_frame(CanId(1), {})));
  CHECK(receive_ok(*transport, transport->now() + 10s).has_value());
}

TEST_CASE("a deleted interface is an error that stays, even if one of the same name comes back") {
  interface_under_test();
  const OwnInterface own;
  if (!own.usable()) return;
  const auto transport = must_open(own.name());
  REQUIRE(run("ip link del " + own.name()));
  REQUIRE_FALSE(transport->receive(transport->now() + 10s).has_value());
  REQUIRE(run("ip link add dev " + own.name() + " type vcan"));
  REQUIRE(run("ip link set " + own.name() + " up"));
  const auto event = transport->receive(transport->now() + 10s);
  REQUIRE_FALSE(event.has_value());
  CHECK(event.error().what == "the interface has vanished");
  CHECK_FALSE(transport->send(data_frame(CanId(1), {})).has_value());
}

TEST_CASE("a bus that went away is waited for, counted, and used again when its link is up") {
  interface_under_test();
  const OwnInterface own;
  if (!own.usable()) return;
  const auto transport = must_open(own.name());
  CHECK(transport->come_back(transport->now()).value());
  CHECK(transport->health().outages == 0);
  for (std::uint64_t round = 1; round <= 3; ++round) {
    REQUIRE(run("ip link set " + own.name() + " down"));
    REQUIRE_FALSE(transport->receive(transport->now() + 10s).has_value());
    const auto begin = transport->now();
    CHECK_FALSE(transport->come_back(begin + 50ms).value());
    CHECK(transport->now() - begin >= 50ms);
    REQUIRE(run("ip link set " + own.name() + " up"));
    REQUIRE(transport->come_back(transport->now() + 10s).value());
    CHECK(transport->health().outages == round);
    // Nothing is left of the outage, neither for the next wait nor for the next frame.
    CHECK_FALSE(transport->receive(transport->now() + 1ms).value().has_value());
    REQUIRE(transport->send(data_frame(CanId(1), {})));
    CHECK(receive_ok(*transport, transport->now() + 10s).has_value());
  }
}

TEST_CASE("an interface that was deleted is opened anew when one of its name is there") {
  interface_under_test();
  const OwnInterface own;
  if (!own.usable()) return;
  const auto transport = must_open(own.name());
  const auto before = transport->now();
  for (std::uint64_t round = 1; round <= 3; ++round) {
    REQUIRE(run("ip link del " + own.name()));
    // Noticed at once, or when the new one is there already.
    if (round != 2) REQUIRE_FALSE(transport->receive(transport->now() + 10s).has_value());
    if (round != 2) CHECK_FALSE(transport->come_back(transport->now() + 50ms).value());
    REQUIRE(run("ip link add dev " + own.name() + " type vcan"));
    REQUIRE(run("ip link set " + own.name() + " up"));
    if (round == 2) REQUIRE_FALSE(transport->receive(transport->now() + 10s).has_value());
    REQUIRE(transport->come_back(transport->now() + 10s).value());
    CHECK(transport->health().outages == round);
    REQUIRE(transport->send(data_frame(CanId(1), {})));
    const auto echo = receive_ok(*transport, transport->now() + 10s);
    REQUIRE(echo.has_value());
    CHECK(echo->time > before);
  }
}

TEST_CASE("a slow interface makes sends wait for room instead of failing") {
  interface_under_test();
  const OwnInterface own;
  if (!own.usable()) return;
  if (in_user_mode_linux()) load_module("net/sched/sch_tbf.ko");
  // A classical frame counts 16 bytes here: 1,000 frames per second, a queue of ten.
  if (!run("tc qdisc add dev " + own.name() + " root tbf rate 128kbit burst 32 limit 160")) {
    std::printf("not tried: the kernel has no tbf queue\n");
    return;
  }
  const auto transport = must_open(own.name());
  for (std::uint8_t i = 0; i < 60; ++i) REQUIRE(transport->send(data_frame(CanId(0x123), {i})));
  CHECK(transport->health().transmit_retries > 0);
  for (std::uint8_t i = 0; i < 60; ++i) {
    const auto event = receive_ok(*transport, transport->now() + 10s);
    REQUIRE(event.has_value());
    CHECK(event->frame.data[0] == i);
    CHECK(event->direction == Direction::transmitted);
  }
}

TEST_CASE("setting the clock of the machine is noticed and moves no stamp") {
  const std::string name = interface_under_test();
  if (!in_user_mode_linux()) return;
  const auto transport = must_open(name);
  const RawSocket other(name);
  timespec real{};
  ::clock_gettime(CLOCK_REALTIME, &real);
  timespec later = real;
  later.tv_sec += 3600;

  const BusTime start = transport->now();
  other.send(data_frame(CanId(0x123), {1}));
  REQUIRE(::clock_settime(CLOCK_REALTIME, &later) == 0);
  other.send(data_frame(CanId(0x123), {2}));
  const auto first = receive_ok(*transport, start + 60s);
  const auto second = receive_ok(*transport, start + 60s);
  ::clock_settime(CLOCK_REALTIME, &real);
  other.send(data_frame(CanId(0x123), {3}));
  const auto third = receive_ok(*transport, start + 60s);
  REQUIRE((first && second && third));
  CHECK(first->time >= start);
  CHECK(second->time >= first->time);
  CHECK(third->time >= second->time);
  CHECK(third->time < start + 60s);
  CHECK(transport->health().clock_stepped);
}
