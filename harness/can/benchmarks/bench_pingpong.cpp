// SPDX-License-Identifier: Apache-2.0
// Round trips per second on a CAN interface against a forked responder of raw system calls: first with epoll
// and read/write and nothing else, the yardstick, then with time stamps, then through SocketCanTransport.
//   bench_pingpong INTERFACE [ROUND TRIPS [raw|node]]
// raw: only the second, with time stamps; node: the same, but node 5 on the bus answers.
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <signal.h>
#include <sys/epoll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "can/socketcan_transport.hpp"

using namespace conform;
using namespace conform::can;

namespace {

constexpr canid_t request_id = 0x605;
constexpr canid_t answer_id = 0x585;

[[noreturn]] void die(const std::string& why) {
  std::fprintf(stderr, "bench_pingpong: %s\n", why.c_str());
  std::exit(1);
}

int open_raw(const std::string& name, canid_t wanted) {
  const int fd = ::socket(PF_CAN, SOCK_RAW, CAN_RAW);
  const can_filter filter{.can_id = wanted, .can_mask = CAN_SFF_MASK | CAN_EFF_FLAG | CAN_RTR_FLAG};
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(::if_nametoindex(name.c_str()));
  if (fd < 0 || ::setsockopt(fd, SOL_CAN_RAW, CAN_RAW_FILTER, &filter, sizeof filter) != 0 ||
      ::bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    die("cannot open a socket on " + name);
  }
  return fd;
}

// Waits with epoll, as an event-driven device does, and answers each request with its own bytes.
[[noreturn]] void respond(int fd) {
  const int poller = ::epoll_create1(0);
  epoll_event wanted{};
  wanted.events = EPOLLIN;
  ::epoll_ctl(poller, EPOLL_CTL_ADD, fd, &wanted);
  for (;;) {
    epoll_event event{};
    if (::epoll_wait(poller, &event, 1, -1) < 0) continue;
    can_frame frame{};
    if (::read(fd, &frame, sizeof frame) != static_cast<ssize_t>(sizeof frame)) ::_exit(1);
    frame.can_id = answer_id;
    if (::write(fd, &frame, sizeof frame) != static_cast<ssize_t>(sizeof frame)) ::_exit(1);
  }
}

void measure(const char* what, int count, const std::function<void()>& round_trip) {
  for (int i = 0; i < 100; ++i) round_trip();
  std::vector<double> micros;
  micros.reserve(static_cast<std::size_t>(count));
  const auto start = std::chrono::steady_clock::now();
  auto last = start;
  for (int i = 0; i < count; ++i) {
    round_trip();
    const auto current = std::chrono::steady_clock::now();
    micros.push_back(std::chrono::duration<double, std::micro>(current - last).count());
    last = current;
  }
  const double elapsed = std::chrono::duration<double>(last - start).count();
  std::ranges::sort(micros);
  const auto at = [&](double part) {
    return micros[static_cast<std::size_t>(part * static_cast<double>(count - 1))];
  };
  std::printf("%-26s %8.0f round trips/s, p50 %6.1f us, p99 %6.1f us, max %8.1f us\n", what, count / elapsed,
              at(0.5), at(0.99), at(1.0));
  std::fflush(stdout);
}

/// A raw socket and its epoll instance, for as long as one measurement takes.
struct RawClient {
  RawClient(const std::string& interface, bool stamps) : fd(open_raw(interface, answer_id)) {
    const int on = 1;
    if (stamps) {
      ::setsockopt(fd, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on);
      ::setsockopt(fd, SOL_SOCKET, SO_RXQ_OVFL, &on, sizeof on);
    }
    epoll_event wanted{};
    wanted.events = EPOLLIN;
    ::epoll_ctl(poller, EPOLL_CTL_ADD, fd, &wanted);
    frame.can_id = request_id;
    frame.len = 8;
    frame.data[0] = 0x40;  // an upload of 1000h:00, so that a real node can answer
    frame.data[2] = 0x10;
  }
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;
  ~RawClient() {
    ::close(poller);
    ::close(fd);
  }
  [[nodiscard]] bool answered_within(int milliseconds) const {
    epoll_event event{};
    return ::write(fd, &frame, sizeof frame) == static_cast<ssize_t>(sizeof frame) &&
           ::epoll_wait(poller, &event, 1, milliseconds) == 1;
  }
  void send_and_wait() const {
    if (!answered_within(1000)) die("a raw round trip failed");
  }

  int fd;
  int poller = ::epoll_create1(0);
  can_frame frame{};
};

void measure_read(const std::string& name, int count) {
  const RawClient client(name, false);
  measure("raw epoll and read/write:", count, [&] {
    client.send_and_wait();
    can_frame answer{};
    if (::read(client.fd, &answer, sizeof answer) != static_cast<ssize_t>(sizeof answer))
      die("a raw read failed");
  });
}

// The same with what a verdict needs: time stamps and loss counters come as control messages.
void measure_recvmsg(const std::string& name, int count) {
  const RawClient client(name, true);
  measure("raw epoll and recvmsg:", count, [&] {
    client.send_and_wait();
    can_frame answer{};
    alignas(cmsghdr) std::array<char, 128> control;
    iovec vector{.iov_base = &answer, .iov_len = sizeof answer};
    msghdr message{};
    message.msg_iov = &vector;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    if (::recvmsg(client.fd, &message, 0) != static_cast<ssize_t>(sizeof answer)) die("a raw recvmsg failed");
  });
}

void measure_transport(const std::string& name, int count) {
  auto transport = SocketCanTransport::open(name);
  if (!transport) die(transport.error().text());
  const Frame request = data_frame(CanId(request_id), {0x40, 0, 0x10, 0, 0, 0, 0, 0});
  measure("SocketCanTransport:", count, [&] {
    if (!(*transport)->send(request)) die("a send failed");
    const BusTime deadline = (*transport)->now() + std::chrono::seconds(1);
    for (;;) {
      const auto event = (*transport)->receive(deadline);
      if (!event || !*event) die("a round trip through the transport failed");
      if ((*event)->direction == Direction::received && (*event)->frame.id == answer_id) return;
    }
  });
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view what = argc > 3 ? argv[3] : "all";
  if (argc < 2 || argc > 4 || (what != "all" && what != "raw" && what != "node")) {
    die("usage: bench_pingpong INTERFACE [ROUND TRIPS [raw|node]]");
  }
  const std::string name = argv[1];
  const int count = argc > 2 ? std::max(std::atoi(argv[2]), 2) : 20'000;
  if (const auto facts = preflight(name); !facts) die(facts.error().text());
  if (what == "node") {
    // A node that has just started hears nothing before its boot-up message.
    const RawClient probe(name, false);
    for (int tries = 0; !probe.answered_within(20); ++tries) {
      if (tries == 100) die("node 5 does not answer");
    }
    measure_recvmsg(name, count);
    return 0;
  }

  const int responder_socket = open_raw(name, request_id);
  const pid_t parent = ::getpid();
  const pid_t responder = ::fork();
  if (responder < 0) die("cannot start the responder");
  if (responder == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // never outlive the measurement
    if (::getppid() != parent) ::_exit(1);
    respond(responder_socket);
  }
  ::close(responder_socket);

  if (what == "all") measure_read(name, count);
  measure_recvmsg(name, count);
  if (what == "all") measure_transport(name, count);
  ::kill(responder, SIGKILL);
  ::waitpid(responder, nullptr, 0);
}
