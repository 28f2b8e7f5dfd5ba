// SPDX-License-Identifier: Apache-2.0
// The way out: every frame the node sends passes here, at once or delayed. Filters may change, repeat, delay
// or drop it.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "base/strong.hpp"
#include "base/time.hpp"
#include "can/frame.hpp"
#include "can/participant.hpp"
#include "device/states.hpp"

namespace refnode {

using conform::BusTime;
using conform::Duration;
using conform::can::Frame;

enum class SdoStep : std::uint8_t {
  upload_initiate,
  upload_segment,
  download_initiate,
  download_segment,
  block_upload_initiate,
  block_upload_segment,  ///< one segment of a sub-block, or the refusal of a start or acknowledge
  block_upload_end,      ///< the end frame; no frame: the client's confirmation of it
  block_download_initiate,
  block_download_segment,  ///< no frame: a segment inside a sub-block; a frame: it was refused
  block_download_ack,      ///< the acknowledge of a sub-block
  block_download_end,
  time_out,  ///< the abort of the server without a request
  other
};

/// What the SDO server answered, and to what.
struct SdoExchange {
  std::array<std::uint8_t, 8> request{};
  SdoStep step = SdoStep::other;
  conform::Multiplexer mux;                   ///< of the request or of the running transfer
  std::optional<conform::AbortCode> aborted;  ///< the conformant answer is this abort
  std::uint8_t channel = 0;                   ///< 0: the default server, 1: 1201h, 2: 1202h
  std::uint8_t sequence = 0;  ///< block transfer: number of the segment sent or of the last one taken

  [[nodiscard]] std::uint16_t index() const { return mux.index.value(); }
  [[nodiscard]] std::uint8_t sub() const { return mux.sub.value(); }
};

/// Requests that begin a transfer.
[[nodiscard]] inline bool begins_transfer(const SdoExchange& e) {
  return e.step == SdoStep::upload_initiate || e.step == SdoStep::download_initiate ||
         e.step == SdoStep::block_upload_initiate || e.step == SdoStep::block_download_initiate;
}

struct Outgoing {
  Frame frame;
  Duration delay{};
  /// Asked when the delay is over: what the frame answers may have ended meanwhile.
  std::function<bool()> still_wanted{};
};

/// What a filter may look at.
struct FilterContext {
  Service service;
  std::uint8_t node_id;
  NmtState state;
  const SdoExchange* sdo = nullptr;  ///< only with Service::sdo
  BusTime now{};                     ///< put in by the outbox
};

using Filter = std::function<void(const FilterContext&, std::vector<Outgoing>&)>;

class Outbox {
 public:
  void attach(conform::can::Participant::Sender sender) { sender_ = std::move(sender); }
  void add_filter(Filter filter) { filters_.push_back(std::move(filter)); }

  void send(const FilterContext& context, std::vector<Outgoing> frames, BusTime now);
  void on_time(BusTime now);
  [[nodiscard]] std::optional<BusTime> next_wakeup() const;
  /// The host says that a frame has left.
  void on_transmitted(BusTime now);
  /// Frames handed to the host that have not left yet. Those of which nothing is heard for long are lost.
  [[nodiscard]] std::size_t waiting(BusTime now) const;
  /// When the frames that wait now will count as lost.
  [[nodiscard]] BusTime waiting_ends(BusTime now) const { return std::max(now, progress_ + patience); }
  /// Forgets delayed frames: after a reset nothing of the past is sent.
  void clear() { delayed_.clear(); }

 private:
  static constexpr Duration patience = std::chrono::milliseconds(100);

  void hand_over(const Frame& frame, BusTime now);

  conform::can::Participant::Sender sender_;
  std::size_t waiting_ = 0;
  BusTime progress_{};  ///< last time a frame was handed over or left
  std::vector<Filter> filters_;
  std::multimap<BusTime, Outgoing> delayed_;
};

}  // namespace refnode
