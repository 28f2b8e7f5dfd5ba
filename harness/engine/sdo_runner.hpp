// SPDX-License-Identifier: Apache-2.0
// Runs passive SDO transfers against time, one or several at once, each on its own pair of CAN-IDs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "canopen/sdo_client.hpp"
#include "engine/recorder.hpp"

namespace conform::engine {

struct SdoRun {
  canopen::SdoClient* client = nullptr;
  Multiplexer object;
  CanId request, response;
  Duration limit{};     ///< how long an answer, or the next segment, may take
  Duration patience{};  ///< how long it may take once more than `limit` has passed: nobody knows all devices
  Duration wait{};      ///< how long to listen when the client has ended it, or fell silent
  bool listens_after = false;        ///< count what still comes when it is over
  std::optional<Multiplexer> stale;  ///< entry whose answer is overdue from an earlier transfer

  // What came of it.
  canopen::TransferResult result;
  std::optional<std::size_t> first_request;  ///< capture index of our first frame
  BusTime last_request{}, asked_at{};        ///< stamp of our last frame, and of the last that is no abort
  std::size_t decisive = 0;                  ///< capture index of the frame that ended it
  Duration slowest{}, latest{};              ///< answers: the slowest, and the latest one
  Duration waited_in_vain{};                 ///< beyond `limit`

  // Of the runner.
  bool stretched = false;               ///< `limit` has passed
  std::optional<std::size_t> overtook;  ///< an answer that came before the echo of what it may answer
  can::Frame posted{};                  ///< the latest
  bool over = false;
  bool replied = false;
  std::size_t in_flight = 0;  ///< frames handed over whose echo has not come
  int heard = 0;              ///< frames of the server that the client took
  BusTime since{};            ///< stamp of the frame from which the time-out counts
  BusTime not_sent_since{};   ///< for frames that do not get out at all
  bool looked_again = false;
  std::uint64_t surplus = 0, answers = 0;  ///< frames of the server after the end, aborts among them
  std::optional<BusTime> quiet_until;
  std::size_t unanswered = 0;          ///< frames on the bus since the server's last one
  std::optional<BusTime> gives_up_at;  ///< what the server still has to say to those is waited for until then
};

/// Error: the environment failed. All runs are over on return.
[[nodiscard]] Result<void> run_transfers(Recorder& recorder, std::span<SdoRun> runs);

}  // namespace conform::engine
