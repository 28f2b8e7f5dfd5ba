// SPDX-License-Identifier: Apache-2.0
// How fast SDO transfers are through the harness, on any bus: what was carried, in how many frames, in what
// time, and how long these frames alone would have taken.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/error.hpp"
#include "base/time.hpp"
#include "engine/recorder.hpp"
#include "engine/sdo_channel.hpp"

namespace conform::cli {

enum class TransferKind : std::uint8_t {
  expedited_upload,    ///< 1000h:00, again and again
  expedited_download,  ///< 2007h:00
  segmented_upload,    ///< 2008h:00, as are all that follow
  segmented_download,
  block_upload,  ///< 127 segments in a sub-block, with CRC
  block_download,
};
/// Not to_string, which would hide those of conform from who is in this namespace.
[[nodiscard]] std::string_view transfer_name(TransferKind kind);

struct Throughput {
  std::uint64_t bytes = 0;  ///< of the objects, without protocol
  std::uint64_t transfers = 0;
  std::uint64_t frames = 0;
  Duration elapsed{};  ///< from the start of the first frame to the end of the intermission behind the last
  Duration
      busy{};  ///< what these frames need back to back, stuff bits and intermission included; 0: no bit rate

  [[nodiscard]] double seconds() const { return std::chrono::duration<double>(elapsed).count(); }
  /// Part of the limit that the frames set, 0 to 1.
  [[nodiscard]] double share_of_limit() const {
    return std::chrono::duration<double>(busy).count() / std::chrono::duration<double>(elapsed).count();
  }
};

/// `amount`: transfers when expedited, else bytes of one transfer, at most 1 MiB. An upload reads back what a
/// download has written, which is checked. Error: the reference node did not do what it should, or the
/// environment failed.
[[nodiscard]] Result<Throughput> measure(engine::Recorder& recorder, engine::SdoChannel& channel,
                                         TransferKind kind, std::size_t amount);

/// The same against a reference node on a simulated bus.
[[nodiscard]] Result<Throughput> measure_simulated(TransferKind kind, std::uint32_t bit_rate,
                                                   std::size_t amount);

}  // namespace conform::cli
