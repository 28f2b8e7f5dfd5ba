// SPDX-License-Identifier: Apache-2.0
// The times that a trace shows, whatever anybody judges of them: how long answers took, how regular
// heartbeats came. Only what the trace is sure of is measured.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "can/capture.hpp"
#include "monitor/follower.hpp"
#include "monitor/watch.hpp"
#include "result/run_result.hpp"

namespace conform::monitor {

class Stopwatch {
 public:
  /// So many samples of a series are kept at the most; of more, evenly drawn ones.
  static constexpr std::size_t most_samples = 512;

  /// In the state before the frame, as the monitors see it.
  void on_frame(const Observation& seen, const Follower& follower);
  /// Frames were lost, or the power was switched: no interval goes over that.
  void on_loss();
  /// By kind, then by what they are of.
  [[nodiscard]] std::vector<result::Measurement> take() const;

 private:
  struct Series {
    result::Measurement told;
    Duration sum{};
    std::size_t stride = 1;  ///< every so manieth is kept
  };
  struct Limits {
    std::optional<Duration> nominal{}, least{}, most{};
  };

  void add(const std::string& kind, const std::string& of, const Limits& limits, BusTime at, Duration value);
  void answer(const Observation& seen);
  void heartbeat(const Observation& seen, const Follower& follower);
  void produced(const Observation& seen, const Follower& follower);
  void command(const Observation& seen, const Follower& follower);
  void forget_intervals();

  std::map<std::pair<std::string, std::string>, Series> series_;
  std::optional<BusTime> asked_;              ///< the one open request to the default server
  std::optional<Multiplexer> object_;         ///< of the transfer
  std::optional<BusTime> heartbeat_;          ///< the last one
  std::map<Entries::Key, BusTime> produced_;  ///< the last frame with a CAN-ID
  std::optional<std::pair<BusTime, std::string>> reset_;
};

/// All times of a trace, with the places where frames are missing or the power was switched.
[[nodiscard]] std::vector<result::Measurement> measure(std::span<const can::CapturedFrame> frames,
                                                       const Facts& facts, std::span<const Loss> losses);

/// What the bus carried, in at most `slices` stretches of one length. `bit_rate` in bit/s, 0: not known.
[[nodiscard]] std::vector<result::BusLoad> load_of(std::span<const can::CapturedFrame> frames,
                                                   std::uint32_t bit_rate, std::size_t slices = 240);

}  // namespace conform::monitor
