// SPDX-License-Identifier: Apache-2.0
// A block upload (CiA 301, 7.2.4.3.12 to 7.2.4.3.15): offered, started by the client, then sub-blocks of up
// to 127 segments, each acknowledged, and the end frame with the CRC.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "device/device.hpp"
#include "sdo/frames.hpp"

namespace refnode {

class BlockUpload {
 public:
  /// `block_size` 1 to 127; `crc` when both sides can.
  BlockUpload(Multiplexer mux, Bytes data, std::uint8_t block_size, bool crc);

  /// A3h, A2h and A1h.
  [[nodiscard]] SdoReply start();
  [[nodiscard]] SdoReply acknowledge(const SdoData& request);
  [[nodiscard]] SdoReply confirm_end();

  /// There is a segment to send before an acknowledge is due.
  [[nodiscard]] bool has_segment() const;
  [[nodiscard]] SdoData next_segment();
  [[nodiscard]] std::uint8_t block_size() const { return block_size_; }
  /// Number of the segment sent last in this sub-block, 0 before the first.
  [[nodiscard]] std::uint8_t sequence() const { return sent_; }

  [[nodiscard]] Multiplexer mux() const { return mux_; }
  [[nodiscard]] bool finished() const { return phase_ == Phase::finished; }

 private:
  enum class Phase : std::uint8_t { offered, segments, ended, finished };

  [[nodiscard]] SdoData end_frame() const;

  Multiplexer mux_;
  Bytes data_;
  std::size_t total_;             ///< segments; an empty object has one without data
  std::size_t acknowledged_ = 0;  ///< segments the client has for good
  std::uint8_t sent_ = 0;         ///< segments of this sub-block
  std::uint8_t block_size_;
  bool crc_agreed_;
  std::uint16_t crc_ = 0;  ///< of the acknowledged segments: what is sent again counts once
  Phase phase_ = Phase::offered;
};

}  // namespace refnode
