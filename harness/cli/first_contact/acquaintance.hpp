// SPDX-License-Identifier: Apache-2.0
// A first look at a device of which nothing is known: what it has and how it behaves, without leaving a trace
// in it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/strong.hpp"
#include "base/time.hpp"
#include "engine/run_session.hpp"
#include "engine/scan.hpp"
#include "steps/tier.hpp"

namespace conform::cli {

struct Acquaintance {
  NodeId node{1};
  std::vector<engine::ScannedObject> objects;  ///< ascending
  Duration slowest_answer{};                   ///< of its SDO server
  std::optional<Duration> heartbeat_period;    ///< where heartbeats came
  std::string others;                          ///< who else was heard, in words; empty: nobody
  /// Whether a block upload is begun when it is asked for.
  bool block_upload = false;
  // Tried where it was allowed; false or absent: not tried, or nothing can be concluded.
  bool block_download = false;        ///< one was begun when it was asked for
  bool node_guarding = false;         ///< a guard request was answered
  std::optional<bool> lss;            ///< answers when its LSS address is identified (CiA 305)
  std::optional<Duration> boot_time;  ///< the longest from a reset to the boot-up message

  [[nodiscard]] const engine::ScannedObject* find(std::uint16_t index) const;
  /// What the entry holds as a number of at most eight bytes; absent: not there, not read, or longer.
  [[nodiscard]] std::optional<std::uint64_t> number(std::uint16_t index, std::uint8_t sub) const;
};

struct FirstLook {
  std::vector<engine::IndexRange> ranges;  ///< of the dictionary
  /// read_only: uploads alone. From config on it is reset twice, guarded once, asked by LSS, and a block
  /// download is begun and given up; its values are left alone.
  steps::Tier allow = steps::Tier::read_only;
  std::function<void(Index)> progress;  ///< as ScanOptions::progress
};

/// Error: the interface failed, or the device does not answer.
[[nodiscard]] Result<Acquaintance> get_to_know(engine::RunSession& session, const FirstLook& how);

}  // namespace conform::cli
