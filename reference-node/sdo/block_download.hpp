// SPDX-License-Identifier: Apache-2.0
// A block download behind its initiate (CiA 301, 7.2.4.3.10 and 7.2.4.3.11): sub-blocks of segments, one
// acknowledge for each, and the end frame with the CRC.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "device/device.hpp"
#include "sdo/choices.hpp"
#include "sdo/frames.hpp"

namespace refnode {

class BlockDownload {
 public:
  BlockDownload(const SdoChoices& choices, Multiplexer mux, std::optional<std::size_t> announced,
                std::uint8_t block_size, bool crc);

  /// Every frame but an abort is a segment now, whatever its first byte would mean elsewhere.
  [[nodiscard]] bool in_sub_block() const { return phase_ == Phase::segments; }
  /// A frame inside a sub-block; the reply is the acknowledge, if one is due.
  [[nodiscard]] SdoReply segment(const SdoData& frame, const Device& device);
  /// The end frame (C1h).
  [[nodiscard]] SdoReply end(const SdoData& request, Device& device);

  /// When an unfinished sub-block has to be acknowledged for want of segments.
  [[nodiscard]] std::optional<BusTime> acknowledge_at() const;
  [[nodiscard]] SdoData acknowledge();

  /// Number of the segment taken last in this sub-block.
  [[nodiscard]] std::uint8_t sequence() const { return taken_; }
  [[nodiscard]] Multiplexer mux() const { return mux_; }
  [[nodiscard]] bool finished() const { return phase_ == Phase::finished; }

 private:
  enum class Phase : std::uint8_t { segments, end, finished };

  [[nodiscard]] std::size_t limit(const Device& device) const;
  void add_to_crc(std::size_t end);
  void distort_length(const Device& device);

  const SdoChoices* choices_;
  Multiplexer mux_;
  std::optional<std::size_t> announced_;
  std::uint8_t block_size_;
  bool crc_agreed_;
  Bytes data_;                       ///< whole segments; grows with what comes, whatever was announced
  std::uint8_t taken_ = 0;           ///< segments of this sub-block that came in sequence
  bool last_taken_ = false;          ///< the segment marked as the last one was among them
  bool spoiled_ = false;             ///< a number that cannot be was among them: nothing is acknowledged
  bool skips_to_first_ = false;      ///< acknowledged early: the rest of the old sub-block is still coming
  std::optional<BusTime> heard_at_;  ///< of the last segment, if this sub-block has had any
  std::uint16_t crc_ = 0;
  std::size_t crc_end_ = 0;  ///< bytes that are in crc_
  Phase phase_ = Phase::segments;
};

}  // namespace refnode
