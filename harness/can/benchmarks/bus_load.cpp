// SPDX-License-Identifier: Apache-2.0
// The PDOs of other nodes: 512 CAN-IDs (those of the four TPDOs and four RPDOs of nodes 64 to 127), all of
// them once in each period, or as fast as the machine carries them. Until so many seconds have passed, or
// SIGTERM.
//   bus_load INTERFACE PERIOD_US SECONDS
// Prints how many frames it sent. The data of each is its number, from 0.
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t can_ids = 512;
constexpr std::size_t batch = 64;  // handed over with one system call: the PDOs of one function code

volatile std::sig_atomic_t stopped = 0;

[[noreturn]] void die(const std::string& why) {
  std::fprintf(stderr, "bus_load: %s\n", why.c_str());
  std::exit(1);
}

void wait_until(Clock::time_point due) {
  const auto left = std::chrono::duration_cast<std::chrono::nanoseconds>(due - Clock::now()).count();
  const timespec timeout{.tv_sec = left / 1'000'000'000, .tv_nsec = left % 1'000'000'000};
  if (left > 0) ::ppoll(nullptr, 0, &timeout, nullptr);
}

int open_deaf(const std::string& name) {
  const int fd = ::socket(PF_CAN, SOCK_RAW, CAN_RAW);
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(::if_nametoindex(name.c_str()));
  // No filter at all: it receives nothing.
  if (fd < 0 || ::setsockopt(fd, SOL_CAN_RAW, CAN_RAW_FILTER, nullptr, 0) != 0 ||
      ::bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    die("cannot open a socket on " + name);
  }
  return fd;
}

/// The frames of a batch, and what sendmmsg() needs to send them.
class Batch {
 public:
  Batch() {
    for (std::size_t i = 0; i < batch; ++i) {
      vectors_[i] = {.iov_base = &frames_[i], .iov_len = sizeof frames_[i]};
      messages_[i].msg_hdr.msg_iov = &vectors_[i];
      messages_[i].msg_hdr.msg_iovlen = 1;
    }
  }
  /// The number of the frame after the last one that was sent.
  std::uint64_t send(int fd, canid_t first_id, std::uint64_t number) {
    for (std::size_t i = 0; i < batch; ++i) {
      frames_[i].can_id = first_id + static_cast<canid_t>(i);
      frames_[i].len = 8;
      const std::uint64_t own = number + i;
      std::memcpy(frames_[i].data, &own, sizeof own);
    }
    for (std::size_t done = 0; done < batch;) {
      const int sent = ::sendmmsg(fd, &messages_[done], static_cast<unsigned>(batch - done), 0);
      if (sent < 0 && errno == EINTR && stopped == 0) continue;
      if (sent < 0 && errno == ENOBUFS) {
        wait_until(Clock::now() + std::chrono::milliseconds(1));
        continue;
      }
      if (sent < 0 && errno != EINTR) die(std::string("cannot send: ") + std::strerror(errno));
      if (sent < 0) return number;
      done += static_cast<std::size_t>(sent);
      number += static_cast<std::uint64_t>(sent);
    }
    return number;
  }

 private:
  std::array<can_frame, batch> frames_{};
  std::array<iovec, batch> vectors_{};
  std::array<mmsghdr, batch> messages_{};
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) die("usage: bus_load INTERFACE PERIOD_US SECONDS");
  const int fd = open_deaf(argv[1]);
  const auto period = std::chrono::microseconds(std::strtoll(argv[2], nullptr, 10));
  std::signal(SIGTERM, [](int) { stopped = 1; });
  Batch frames;
  std::uint64_t sent = 0;
  const auto begin = Clock::now();
  const auto end = begin + std::chrono::seconds(std::strtoll(argv[3], nullptr, 10));
  for (auto due = begin; stopped == 0 && Clock::now() < end;) {
    // 1C0h to 1FFh, 240h to 27Fh, ... 540h to 57Fh
    for (canid_t part = 0; part < can_ids / batch && stopped == 0; ++part)
      sent = frames.send(fd, 0x1C0U + part * 0x80U, sent);
    // Who was late goes on from now: a bus is not faster for having been busy.
    due = std::max(due + period, Clock::now());
    wait_until(due);
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  std::printf("%llu frames in %.3f s, %.0f frames/s\n", static_cast<unsigned long long>(sent), seconds,
              static_cast<double>(sent) / seconds);
}
