// SPDX-License-Identifier: Apache-2.0
// The default SDO channel on the bus: runs the passive transfers of `canopen` against time.
#pragma once

#include <optional>

#include "canopen/sdo_transfer.hpp"
#include "engine/recorder.hpp"
#include "steps/session.hpp"

namespace conform::engine {

class SdoChannel {
 public:
  SdoChannel(Recorder& recorder, NodeId node, Duration timeout, Duration quiet)
      : recorder_(recorder), node_(node), timeout_(timeout), quiet_(quiet) {}

  [[nodiscard]] Result<steps::SdoAnswer> upload(Multiplexer object, std::optional<Duration> timeout);
  [[nodiscard]] Result<steps::SdoAnswer> download(Multiplexer object, Bytes data,
                                                  canopen::SdoDownload::Mode mode,
                                                  std::optional<Duration> timeout);
  /// How many bytes the entry holds, as the answer to the initiate request tells; the transfer is not carried
  /// through. nullopt: it cannot be read.
  [[nodiscard]] Result<std::optional<std::uint64_t>> held_bytes(Multiplexer object);
  /// The state of the server's channel is unknown: abort before the next transfer. After a time-out or a
  /// broken answer late ones may follow, so the channel rests as well; after a conversation a short pause is
  /// enough.
  void dirty(bool late_answers) {
    state_ = late_answers || state_ == State::late_answers ? State::late_answers : State::open;
  }
  [[nodiscard]] bool is_open() const { return state_ == State::open; }
  [[nodiscard]] bool expects_late_answers() const { return state_ == State::late_answers; }
  /// Ends what is open and lets late answers pass; nothing to do on an idle channel.
  [[nodiscard]] Result<void> make_idle();
  /// Requests of the latest transfer: index of the first, stamp of the last frame we sent.
  [[nodiscard]] std::size_t first_request() const { return first_request_; }
  [[nodiscard]] BusTime last_request() const { return last_request_; }

 private:
  template <typename Transfer>
  [[nodiscard]] Result<steps::SdoAnswer> run(Transfer transfer, Multiplexer object,
                                             std::optional<Duration> timeout);

  Recorder& recorder_;
  NodeId node_;
  Duration timeout_, quiet_;
  enum class State : std::uint8_t { idle, open, late_answers } state_ = State::idle;
  std::size_t first_request_ = 0;
  BusTime last_request_{};
};

}  // namespace conform::engine
