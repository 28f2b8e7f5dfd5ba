// SPDX-License-Identifier: Apache-2.0
// The way out: every frame the node sends passes here, at once or delayed. Filters may change, repeat, delay
// or drop it; that is how a whole class of defects is made without a word in the conformant code.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "base/strong.hpp"
#include "base/time.hpp"
#include "can/frame.hpp"
#include "can/participant.hpp"

namespace refnode {

using conform::BusTime;
using conform::Duration;
using conform::can::Frame;

enum class Service : std::uint8_t { boot_up, heartbeat, emergency, sdo, tpdo };

enum class NmtState : std::uint8_t {
  initialising = 0x00,
  stopped = 0x04,
  operational = 0x05,
  pre_operational = 0x7F
};

enum class SdoStep : std::uint8_t {
  upload_initiate,
  upload_segment,
  download_initiate,
  download_segment,
  other
};

/// What the SDO server answered, and to what.
struct SdoExchange {
  std::array<std::uint8_t, 8> request{};
  SdoStep step = SdoStep::other;
  conform::Multiplexer mux;                   ///< of the request or of the running transfer
  std::optional<conform::AbortCode> aborted;  ///< the conformant answer is this abort

  [[nodiscard]] std::uint16_t index() const { return mux.index.value(); }
  [[nodiscard]] std::uint8_t sub() const { return mux.sub.value(); }
};

struct Outgoing {
  Frame frame;
  Duration delay{};
};

/// What a filter may look at.
struct FilterContext {
  Service service;
  std::uint8_t node_id;
  NmtState state;
  const SdoExchange* sdo = nullptr;  ///< only with Service::sdo
};

using Filter = std::function<void(const FilterContext&, std::vector<Outgoing>&)>;

class Outbox {
 public:
  void attach(conform::can::Participant::Sender sender) { sender_ = std::move(sender); }
  void add_filter(Filter filter) { filters_.push_back(std::move(filter)); }

  void send(const FilterContext& context, std::vector<Outgoing> frames, BusTime now);
  void on_time(BusTime now);
  [[nodiscard]] std::optional<BusTime> next_wakeup() const;
  /// Forgets delayed frames: after a reset nothing of the past is sent.
  void clear() { delayed_.clear(); }

 private:
  conform::can::Participant::Sender sender_;
  std::vector<Filter> filters_;
  std::multimap<BusTime, Frame> delayed_;
};

}  // namespace refnode
