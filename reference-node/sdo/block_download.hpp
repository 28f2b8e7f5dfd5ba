// SPDX-License-Identifier: Apache-2.0
// A block download behind its initiate (CiA 301, 7.2.4.3.10 and 7.2.4.3.11): sub-blocks of segments, one
// acknowledge for each, and the end frame with the CRC.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/time.hpp"
#include "sdo/block_rules.hpp"
#include "sdo/choices.hpp"
#include "sdo/frames.hpp"

namespace refnode {

class BlockDownload {
 public:
  using BusTime = conform::BusTime;

  BlockDownload(const SdoChoices& choices, const BlockDownloadRules& rules, const BlockDownloadTerms& terms);

  /// Every frame but an abort is a segment now, whatever its first byte would mean elsewhere.
  [[nodiscard]] bool in_sub_block() const { return phase_ == Phase::segments; }
  /// A frame inside a sub-block; the reply is the acknowledge, if one is due.
  [[nodiscard]] SdoReply segment(const SdoData& frame, BusTime now);
  /// The end frame (C1h).
  [[nodiscard]] SdoReply end(const SdoData& request);

  /// When an unfinished sub-block has to be acknowledged for want of segments.
  [[nodiscard]] std::optional<BusTime> acknowledge_at() const;
  [[nodiscard]] SdoData acknowledge();

  [[nodiscard]] std::uint8_t block_size() const { return block_size_; }
  /// Number of the segment taken last in this sub-block.
  [[nodiscard]] std::uint8_t sequence() const { return taken_; }
  [[nodiscard]] Multiplexer mux() const { return terms_.mux; }
  [[nodiscard]] bool finished() const { return phase_ == Phase::finished; }

 private:
  enum class Phase : std::uint8_t { segments, end, finished };

  const SdoChoices* choices_;
  const BlockDownloadRules* rules_;
  BlockDownloadTerms terms_;
  std::uint8_t block_size_;          ///< of this sub-block
  Bytes data_;                       ///< whole segments; grows with what comes, whatever was announced
  std::uint8_t taken_ = 0;           ///< segments of this sub-block that came in sequence
  bool last_taken_ = false;          ///< the segment marked as the last one was among them
  bool spoiled_ = false;             ///< a number that cannot be was among them: nothing is acknowledged
  bool skips_to_first_ = false;      ///< acknowledged early: the rest of the old sub-block is still coming
  std::optional<BusTime> heard_at_;  ///< of the last segment, if this sub-block has had any
  Phase phase_ = Phase::segments;
};

}  // namespace refnode
