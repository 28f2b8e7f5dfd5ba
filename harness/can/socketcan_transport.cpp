// SPDX-License-Identifier: Apache-2.0
#include "can/socketcan_transport.hpp"

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <linux/sock_diag.h>
#include <net/if.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <ctime>
#include <limits>
#include <system_error>
#include <utility>

#include "base/files.hpp"
#include "base/text.hpp"
#include "can/socketcan_frame.hpp"

namespace conform::can {
namespace {

constexpr std::size_t batch_size = 64;

// How far behind the last clock read an own frame's stamp may lie before the clock is asked again.
constexpr Duration fresh = std::chrono::milliseconds(100);

// While the deadline is far away the socket itself waits, for `patience` at first: one system call for
// waiting and reading. The kernel rounds up to its ticks, at most 10 ms.
constexpr Duration patience_of_socket = std::chrono::milliseconds(20);
constexpr Duration far_away = std::chrono::milliseconds(30);

std::string reason(int error) { return std::generic_category().message(error); }

template <typename T>
bool set_option(int fd, int level, int option, const T& value) {
  return ::setsockopt(fd, level, option, &value, sizeof value) == 0;
}

timespec to_timespec(Duration duration) {
  const auto ns = std::max<std::int64_t>(duration.count(), 0);
  timespec out{};
  out.tv_sec = ns / 1'000'000'000;
  out.tv_nsec = ns % 1'000'000'000;
  return out;
}

// Frames that the machine lost between driver and socket: second column of each CPU's line, hexadecimal. The
// counters are of the whole machine, so other traffic may raise them: better to doubt a verdict than to trust
// it.
std::uint64_t backlog_drops() {
  const auto text = read_file("/proc/net/softnet_stat", 1U << 20U);
  if (!text) return 0;
  std::uint64_t sum = 0;
  for (const auto line : split(*text, '\n')) {
    const auto columns = split(line, ' ');
    if (columns.size() < 2) continue;
    std::uint32_t value = 0;
    std::from_chars(columns[1].data(), columns[1].data() + columns[1].size(), value, 16);
    sum += value;
  }
  return sum;
}

}  // namespace

// Everything recvmmsg() needs for one drain, allocated once.
struct SocketCanTransport::Batch {
  struct alignas(cmsghdr) Control {
    std::array<std::uint8_t, CMSG_SPACE(sizeof(timespec)) + CMSG_SPACE(sizeof(std::uint32_t)) + 64> bytes;
  };
  std::array<can_frame, batch_size> frames{};
  std::array<Control, batch_size> controls{};
  std::array<iovec, batch_size> vectors{};
  std::array<mmsghdr, batch_size> messages{};

  Batch() {
    for (std::size_t i = 0; i < batch_size; ++i) {
      vectors[i] = {.iov_base = &frames[i], .iov_len = sizeof frames[i]};
      messages[i].msg_hdr.msg_iov = &vectors[i];
      messages[i].msg_hdr.msg_iovlen = 1;
      reset(i);
    }
  }
  // The kernel shortens the control length to what it wrote.
  void reset(std::size_t i) {
    messages[i].msg_hdr.msg_control = controls[i].bytes.data();
    messages[i].msg_hdr.msg_controllen = controls[i].bytes.size();
  }
};

SocketCanTransport::SocketCanTransport(Descriptor socket, InterfaceFacts facts,
                                       const SocketCanOptions& options, bool is_can)
    : socket_(std::move(socket)),
      facts_(std::move(facts)),
      options_(options),
      is_can_(is_can),
      batch_(std::make_unique<Batch>()) {
  events_.reserve(batch_size * 2);
  info_.name = facts_.name;
  info_.driver = facts_.driver;
  info_.is_virtual = facts_.is_virtual;
  info_.confirms_transmission = facts_.echo;
  info_.bit_rate = facts_.bit_rate;
  info_.epoch_ns = clock_.epoch_ns();
}

SocketCanTransport::~SocketCanTransport() = default;

Result<std::unique_ptr<SocketCanTransport>> SocketCanTransport::open(const std::string& interface_name,
                                                                     const SocketCanOptions& options) {
  auto facts = preflight(interface_name);
  if (!facts) return std::unexpected(facts.error());
  Descriptor socket(::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW));
  if (!socket.valid()) return fail("cannot open a CAN socket: " + reason(errno), interface_name);
  std::unique_ptr<SocketCanTransport> made(
      new SocketCanTransport(std::move(socket), std::move(*facts), options, true));
  if (auto done = made->configure(); !done) return std::unexpected(done.error());
  return made;
}

Result<std::unique_ptr<SocketCanTransport>> SocketCanTransport::from_descriptor(
    int fd, const std::string& name, const SocketCanOptions& options) {
  InterfaceFacts facts;
  facts.name = name;
  facts.driver = "socketpair";
  facts.is_virtual = true;
  facts.up = true;
  Descriptor socket(fd);
  if (!socket.valid()) return fail("is not an open descriptor", name);
  return std::unique_ptr<SocketCanTransport>(
      new SocketCanTransport(std::move(socket), std::move(facts), options, false));
}

Result<void> SocketCanTransport::configure() {
  backlog_drops_at_start_ = backlog_drops();
  const int fd = socket_.get();
  const auto failed = [this](const char* action) {
    return fail(std::string("cannot ") + action + ": " + reason(errno), facts_.name);
  };
  const int wanted = static_cast<int>(std::min<std::uint64_t>(options_.receive_buffer, INT32_MAX / 2));
  if (!set_option(fd, SOL_SOCKET, SO_RCVBUFFORCE, wanted)) set_option(fd, SOL_SOCKET, SO_RCVBUF, wanted);
  int granted = 0;
  socklen_t length = sizeof granted;
  if (::getsockopt(fd, SOL_SOCKET, SO_RCVBUF, &granted, &length) == 0) {
    info_.receive_buffer = static_cast<std::uint64_t>(granted);
  }
  // The smallest send buffer is below the interface's queue length: the socket fills up first, and then
  // poll() tells truly when there is room, instead of ENOBUFS with a writable socket.
  set_option(fd, SOL_SOCKET, SO_SNDBUF, 1);
  if (!set_option(fd, SOL_SOCKET, SO_TIMESTAMPNS, 1)) return failed("switch on kernel time stamps");
  set_option(fd, SOL_SOCKET, SO_RXQ_OVFL, 1);
  const can_err_mask_t errors = CAN_ERR_MASK;
  if (!set_option(fd, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, errors)) return failed("ask for error frames");
  const int own = options_.receive_own ? 1 : 0;
  if (!set_option(fd, SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, own)) return failed("ask for own frames");
  const can_filter everything{.can_id = 0, .can_mask = 0};
  if (!set_option(fd, SOL_CAN_RAW, CAN_RAW_FILTER, everything)) return failed("set the filter");
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = facts_.index;
  if (::bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    return failed("bind the socket to the interface");
  }
  const timeval patience{
      .tv_sec = 0,
      .tv_usec = std::chrono::duration_cast<std::chrono::microseconds>(patience_of_socket).count()};
  may_block_ = set_option(fd, SOL_SOCKET, SO_RCVTIMEO, patience);
  transmit_watch_.reset();
  if (options_.receive_own && !facts_.echo && !facts_.is_virtual)
    transmit_watch_.emplace("/sys/class/net/" + facts_.name + "/statistics");
  return {};
}

bool SocketCanTransport::link_is_up() const {
  if (!is_can_) return true;
  ifreq request{};
  if (::if_indextoname(static_cast<unsigned>(facts_.index), request.ifr_name) == nullptr) return false;
  return ::ioctl(socket_.get(), SIOCGIFFLAGS, &request) == 0 && (request.ifr_flags & IFF_UP) != 0;
}

Error SocketCanTransport::fault(int error) {
  switch (error) {
    case ENETDOWN:
      link_down_ = true;
      return {"the interface went down", facts_.name, up_command(facts_.name, facts_.kind)};
    case ENODEV:
    case ENXIO:
      // The kernel has dropped this socket's filters: even if the interface comes back, it would stay deaf.
      dead_ = Error{"the interface has vanished", facts_.name, "reconnect the adapter"};
      return *dead_;
    case EPIPE:
    case ECONNRESET: dead_ = Error{"the other end has been closed", facts_.name, ""}; return *dead_;
    default: dead_ = Error{"the socket failed: " + reason(error), facts_.name, ""}; return *dead_;
  }
}

// Faults that the kernel reports only once must not turn into silence.
std::optional<Error> SocketCanTransport::not_usable() {
  if (dead_) return dead_;
  if (link_down_) {
    if (!link_is_up()) {
      if (interface_facts(facts_.name)) return fault(ENETDOWN);
      return fault(ENODEV);
    }
    link_down_ = false;
  }
  if (bus_off_now_) {
    const auto facts = is_can_ ? interface_facts(facts_.name) : Result<InterfaceFacts>(facts_);
    // Interfaces without a controller have no state: an error frame somebody injected is all there is.
    const bool has_controller = is_can_ && facts && facts->kind != "vcan" && facts->kind != "vxcan";
    if (has_controller && !facts->bus_off) {
      bus_off_now_ = false;
    } else {
      return Error{"the controller is bus-off", facts_.name,
                   "check wiring, termination and bit rate, then: sudo ip link set " + facts_.name +
                       " type can restart"};
    }
  }
  return std::nullopt;
}

bool SocketCanTransport::usable_again() {
  // Another interface with the same name has taken the place of ours.
  if (link_down_ && !dead_ && !link_is_up()) {
    const auto facts = interface_facts(facts_.name);
    if (facts && facts->index != facts_.index) (void)fault(ENODEV);
  }
  return dead_ ? reopen() : !not_usable();
}

bool SocketCanTransport::reopen() {
  auto facts = preflight(facts_.name);
  if (!facts) return false;
  Descriptor socket(::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW));
  if (!socket.valid()) return false;
  dropped_before_ = health().frames_dropped - controller_overflows_;
  overflow_count_ = 0;
  socket_ = std::move(socket);
  facts_ = std::move(*facts);
  if (!configure()) return false;
  link_down_ = bus_off_now_ = false;
  dead_.reset();
  return true;
}

Result<bool> SocketCanTransport::come_back(BusTime deadline) {
  constexpr Duration between_looks = std::chrono::milliseconds(20);
  if (!is_can_) return std::unexpected(dead_.value_or(Error{"the socket failed", facts_.name, ""}));
  const bool was_away = dead_ || link_down_ || bus_off_now_;
  while (!usable_again()) {
    const auto current = now();
    if (current >= deadline) return false;
    const timespec pause = to_timespec(std::min(between_looks, deadline - current));
    pollfd entry{.fd = options_.wake_descriptor, .events = POLLIN, .revents = 0};
    if (::ppoll(&entry, 1, &pause, nullptr) > 0) return false;
  }
  // The kernel tells the socket of an outage once, also when it has ended.
  int told = 0;
  socklen_t length = sizeof told;
  (void)::getsockopt(socket_.get(), SOL_SOCKET, SO_ERROR, &told, &length);
  if (was_away || told != 0) {
    ++health_.outages;
    if (transmit_watch_) transmit_watch_->forget();
    events_.clear();
    next_event_ = 0;
    echo_expected_ = false;
  }
  return true;
}

Result<bool> SocketCanTransport::wait_for_room(int error, BusTime give_up, bool again) {
  const BusTime current = now();
  if (current >= give_up) return false;
  Duration patience = give_up - current;
  pollfd entry{.fd = socket_.get(), .events = POLLOUT, .revents = 0};
  nfds_t count = 1;
  if (error == ENOBUFS) {
    // The queue of the interface is full though the socket is writable: poll() would return at once, again
    // and again. Nothing announces room here, so look again after some frame times.
    count = 0;
    patience = std::min<Duration>(patience, std::chrono::milliseconds(again ? 20 : 10));
  }
  const timespec timeout = to_timespec(patience);
  if (::ppoll(&entry, count, &timeout, nullptr) < 0 && errno != EINTR) return std::unexpected(fault(errno));
  return true;
}

Result<void> SocketCanTransport::send(const Frame& frame) {
  if (frame.error) return fail("error frames are made by the controller and cannot be sent", facts_.name);
  if (auto error = not_usable()) return std::unexpected(*error);
  const can_frame raw = to_kernel(frame);
  std::optional<BusTime> give_up;
  bool stale_error_seen = false;
  for (;;) {
    const BusTime handed_over = is_can_ ? BusTime{} : now();
    if (::send(socket_.get(), &raw, sizeof raw, MSG_NOSIGNAL | MSG_DONTWAIT) ==
        static_cast<ssize_t>(sizeof raw)) {
      if (!is_can_ && options_.receive_own) {
        last_stamp_ = std::max(last_stamp_, handed_over);
        events_.push_back({frame, last_stamp_, Direction::transmitted});
      }
      echo_expected_ = is_can_ && options_.receive_own;
      if (transmit_watch_) transmit_watch_->took(std::max(last_now_, last_stamp_));
      return {};
    }
    const int error = errno;
    if (error == EINTR) continue;
    if (error == ENETDOWN && !stale_error_seen && link_is_up()) {
      stale_error_seen = true;  // left over from an outage that has ended: delivered once, to the first write
      continue;
    }
    if (error != EAGAIN && error != ENOBUFS) return std::unexpected(fault(error));
    const bool again = give_up.has_value();
    if (!again) {
      ++health_.transmit_retries;
      give_up = now() + options_.send_bound;
    }
    const auto room = wait_for_room(error, *give_up, again);
    if (!room) return std::unexpected(room.error());
    if (!*room) {
      return fail("the transmit queue stayed full for " + to_string(options_.send_bound), facts_.name,
                  "does another node acknowledge? check wiring, termination, bit rate and bus load");
    }
  }
}

Result<bool> SocketCanTransport::wait_until(BusTime deadline) {
  const BusTime current = now();
  if (current >= deadline) return false;
  const timespec timeout = to_timespec(deadline - current);
  std::array<pollfd, 3> entries{{{.fd = socket_.get(), .events = POLLIN, .revents = 0},
                                 {.fd = clock_.watch_descriptor(), .events = POLLIN, .revents = 0},
                                 {.fd = options_.wake_descriptor, .events = POLLIN, .revents = 0}}};
  const int ready = ::ppoll(entries.data(), entries.size(), &timeout, nullptr);
  if (ready < 0) {
    if (errno == EINTR) return true;
    return std::unexpected(fault(errno));
  }
  if (entries[1].revents != 0) clock_.check_clock();
  return ready > 0 && entries[2].revents == 0;
}

Result<void> SocketCanTransport::drain(Look look) {
  if (next_event_ == events_.size()) {
    events_.clear();
    next_event_ = 0;
  }
  const int count = ::recvmmsg(socket_.get(), batch_->messages.data(), batch_size,
                               look == Look::patient ? MSG_WAITFORONE : MSG_DONTWAIT, nullptr);
  if (count < 0) {
    if (errno == EAGAIN || errno == EINTR) return {};
    return std::unexpected(fault(errno));
  }
  std::optional<BusTime> current;  // read once, and only when needed
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    auto done = take(i, current);
    batch_->reset(i);
    if (!done) return done;
  }
  return {};
}

Result<void> SocketCanTransport::take(std::size_t index, std::optional<BusTime>& current) {
  mmsghdr& message = batch_->messages[index];
  const can_frame& raw = batch_->frames[index];
  if (message.msg_len == 0) return std::unexpected(fault(EPIPE));  // only a socket pair has an end
  const bool truncated = (message.msg_hdr.msg_flags & MSG_TRUNC) != 0;
  if (truncated || message.msg_len != sizeof(can_frame) || raw.len > CAN_MAX_DLEN) {
    dead_ = Error{"what arrived is not a classical CAN frame", facts_.name, ""};
    return std::unexpected(*dead_);
  }
  const bool own = is_can_ && (message.msg_hdr.msg_flags & MSG_CONFIRM) != 0;
  std::optional<std::int64_t> kernel_stamp;
  for (cmsghdr* part = CMSG_FIRSTHDR(&message.msg_hdr); part != nullptr;
       part = CMSG_NXTHDR(&message.msg_hdr, part)) {
    if (part->cmsg_level != SOL_SOCKET) continue;
    if (part->cmsg_type == SCM_TIMESTAMPNS) {
      timespec time{};
      std::memcpy(&time, CMSG_DATA(part), sizeof time);
      kernel_stamp = static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
    } else if (part->cmsg_type == SO_RXQ_OVFL) {
      std::memcpy(&overflow_count_, CMSG_DATA(part), sizeof overflow_count_);
    }
  }
  const auto read_clock = [&] {
    if (!current) current = now();
    return *current;
  };
  if (!kernel_stamp) {
    last_stamp_ = std::max(last_stamp_, read_clock());
  } else if (const auto quick = clock_.convert_if_between(*kernel_stamp, last_stamp_, last_now_ + fresh);
             (own || !options_.receive_own) && quick) {
    last_stamp_ = *quick;
  } else {
    last_stamp_ = clock_.convert(*kernel_stamp, last_stamp_, read_clock());
  }
  const Frame frame = from_kernel(raw);
  if (frame.error) note_error_frame(frame);
  if (!own && options_.receive_own) {
    const Duration lateness = read_clock() - last_stamp_;
    health_.worst_lateness = std::max(health_.worst_lateness, lateness);
    if (lateness > host_is_late) ++health_.late_frames;
  }
  events_.push_back({frame, last_stamp_, own ? Direction::transmitted : Direction::received});
  return {};
}

// The clock is not read for it: what was seen last is late enough.
void SocketCanTransport::look_at_what_waits() {
  const auto look = transmit_watch_->next_look();
  const auto known = std::max(last_now_, last_stamp_);
  if (look && known >= *look && transmit_watch_->stands_still(known)) ++health_.transmit_stalls;
}

void SocketCanTransport::note_error_frame(const Frame& frame) {
  ++health_.error_frames;
  if ((frame.id & CAN_ERR_BUSOFF) != 0) {
    bus_off_now_ = true;
    health_.bus_off = true;
    ++health_.bus_offs;
  }
  if ((frame.id & CAN_ERR_RESTARTED) != 0) bus_off_now_ = false;
  if ((frame.id & CAN_ERR_CRTL) != 0 && (frame.data[1] & CAN_ERR_CRTL_RX_OVERFLOW) != 0)
    ++controller_overflows_;
}

Result<std::optional<BusEvent>> SocketCanTransport::receive(BusTime deadline) {
  bool patient = may_block_;
  for (bool last_look = false;;) {
    if (next_event_ < events_.size()) {
      if (events_[next_event_].time > deadline) return std::nullopt;
      return events_[next_event_++];
    }
    if (auto error = not_usable()) return std::unexpected(*error);
    if (last_look) return std::nullopt;
    if (transmit_watch_) look_at_what_waits();
    auto look = Look::at_once;
    if (echo_expected_) {
      echo_expected_ = false;  // most interfaces have it ready: look without asking poll() first
    } else if (patient && std::max(last_now_, last_stamp_) + far_away <= deadline) {
      patient = false;  // after one try poll() takes over, which also hears the other descriptors
      look = Look::patient;
    } else {
      auto until = deadline;
      if (transmit_watch_) until = std::min(deadline, transmit_watch_->next_look().value_or(deadline));
      const auto more_time = wait_until(until);
      if (!more_time) return std::unexpected(more_time.error());
      last_look = !*more_time && (until == deadline || now() < until);
    }
    // A fault behind good frames waits: dead_ and link_down_ report it when the frames have been handed out.
    if (auto done = drain(look); !done && next_event_ == events_.size()) return std::unexpected(done.error());
  }
}

BusHealth SocketCanTransport::health() {
  // SO_RXQ_OVFL comes with the next frame after a loss, SO_MEMINFO at once; both show the same counter.
  std::uint64_t dropped = overflow_count_;
  if (is_can_) {
    std::array<std::uint32_t, SK_MEMINFO_VARS> memory{};
    socklen_t length = sizeof memory;
    if (::getsockopt(socket_.get(), SOL_SOCKET, SO_MEMINFO, memory.data(), &length) == 0 &&
        length > SK_MEMINFO_DROPS * sizeof(std::uint32_t)) {
      dropped = std::max<std::uint64_t>(dropped, memory[SK_MEMINFO_DROPS]);
    }
    const std::uint64_t backlog = backlog_drops();
    if (backlog > backlog_drops_at_start_) dropped += backlog - backlog_drops_at_start_;
  }
  if (transmit_watch_) {
    (void)now();
    look_at_what_waits();
  }
  health_.frames_dropped = dropped_before_ + dropped + controller_overflows_;
  clock_.check_clock();
  health_.clock_stepped = clock_.stepped();
  health_.clock_steps = clock_.steps();
  return health_;
}

}  // namespace conform::can
