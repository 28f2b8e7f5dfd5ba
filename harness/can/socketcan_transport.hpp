// SPDX-License-Identifier: Apache-2.0
// A real or virtual CAN interface of Linux: raw socket, kernel stamps, no frame lost without being counted.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "can/descriptor.hpp"
#include "can/realtime_stamps.hpp"
#include "can/socketcan_interface.hpp"
#include "can/transmit_watch.hpp"
#include "can/transport.hpp"

namespace conform::can {

struct SocketCanOptions {
  std::uint64_t receive_buffer =
      64U << 20U;  ///< bytes asked for; without CAP_NET_ADMIN the kernel grants less
  /// Own frames come back. A device does not want them, and nobody asks it when exactly a frame came.
  bool receive_own = true;
  int wake_descriptor = -1;  ///< when readable, receive() returns before its deadline; not owned
  Duration send_bound = std::chrono::milliseconds(500);  ///< how long send() waits for a full transmit queue
};

/// BusTime 0 is the moment of opening and runs with CLOCK_MONOTONIC.
class SocketCanTransport final : public Transport {
 public:
  /// Opens the interface after preflight().
  [[nodiscard]] static Result<std::unique_ptr<SocketCanTransport>> open(const std::string& interface_name,
                                                                        const SocketCanOptions& options = {});
  /// Takes over one end of a SOCK_SEQPACKET socket pair that carries `struct can_frame`, as a bus of two.
  /// There is no kernel echo: it is made up when the frame has been handed over, so it proves nothing.
  [[nodiscard]] static Result<std::unique_ptr<SocketCanTransport>> from_descriptor(
      int fd, const std::string& name = "socketpair", const SocketCanOptions& options = {});

  ~SocketCanTransport() override;
  [[nodiscard]] BusTime now() const override { return last_now_ = clock_.now(); }
  [[nodiscard]] Result<void> send(const Frame& frame) override;
  [[nodiscard]] Result<std::optional<BusEvent>> receive(BusTime deadline) override;
  /// An interface that was deleted, as that of an adapter which is plugged out, is opened anew by its name.
  /// Returns early when the wake descriptor is readable.
  [[nodiscard]] Result<bool> come_back(BusTime deadline) override;
  [[nodiscard]] BusHealth health() override;
  [[nodiscard]] TransportInfo info() const override { return info_; }

 private:
  struct Batch;

  SocketCanTransport(Descriptor socket, InterfaceFacts facts, const SocketCanOptions& options, bool is_can);
  [[nodiscard]] Result<void> configure();
  enum class Look : std::uint8_t { at_once, patient };
  [[nodiscard]] Result<void> drain(Look look);
  [[nodiscard]] Result<void> take(std::size_t index, std::optional<BusTime>& current);
  void note_error_frame(const Frame& frame);
  [[nodiscard]] std::optional<Error> not_usable();
  [[nodiscard]] Error fault(int error);
  [[nodiscard]] bool link_is_up() const;
  /// One look whether the bus can be used; an interface that is another one now is opened.
  [[nodiscard]] bool usable_again();
  [[nodiscard]] bool reopen();
  /// False when the deadline has passed or the wake descriptor is readable.
  [[nodiscard]] Result<bool> wait_until(BusTime deadline);
  [[nodiscard]] Result<bool> wait_for_room(int error, BusTime give_up, bool again);
  void look_at_what_waits();

  Descriptor socket_;
  InterfaceFacts facts_;
  SocketCanOptions options_;
  bool is_can_;
  TransportInfo info_;
  RealtimeStamps clock_;
  std::unique_ptr<Batch> batch_;
  std::vector<BusEvent> events_;  // read and not yet handed out; bounded by the batch
  std::size_t next_event_ = 0;
  BusTime last_stamp_{};
  // Clock reads are system calls on some machines; the last one often is good enough to judge a stamp by.
  mutable BusTime last_now_{};
  bool may_block_ = false;      // the socket has a time limit of its own
  bool echo_expected_ = false;  // something was sent, so a look at the socket is worth while before waiting
  BusHealth health_;
  std::uint32_t overflow_count_ = 0;  // SO_RXQ_OVFL as of the last frame
  std::uint64_t dropped_before_ = 0;  // by sockets that were closed because their interface had vanished
  std::uint64_t controller_overflows_ = 0;  // error frames that say so
  std::uint64_t backlog_drops_at_start_ = 0;
  bool link_down_ = false;
  bool bus_off_now_ = false;
  std::optional<Error> dead_;
  std::optional<TransmitWatch> transmit_watch_;  // where the echo of a frame does not prove that it was sent
};

}  // namespace conform::can
