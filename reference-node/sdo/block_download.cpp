// SPDX-License-Identifier: Apache-2.0
#include "sdo/block_download.hpp"

#include <algorithm>
#include <utility>

namespace refnode {

namespace {

constexpr std::size_t segment_size = 7;
constexpr std::uint8_t last_segment_bit = 0x80;

}  // namespace

BlockDownload::BlockDownload(const SdoChoices& choices, const BlockDownloadRules& rules,
                             const BlockDownloadTerms& terms)
    : choices_(&choices), rules_(&rules), terms_(terms), block_size_(terms.block_size) {}

// cnnn nnnn: c = last segment of the transfer, n = sequence number from 1. Only the next number is taken;
// what comes behind a gap, or twice, is left to the acknowledge.
SdoReply BlockDownload::segment(const SdoData& frame, BusTime now) {
  const std::uint8_t number = frame[0] & 0x7FU;
  const bool last = (frame[0] & last_segment_bit) != 0;
  if (number == 0 || number > block_size_) {
    spoiled_ = choices_->invalid_sequence_spoils;
    if (choices_->invalid_sequence_ignored) return std::nullopt;
    return refuse(abort_code::sequence_invalid);
  }
  heard_at_ = now;
  if (skips_to_first_ && number != 1) return std::nullopt;
  skips_to_first_ = false;
  if (choices_->first_segment_awaited && taken_ == 0 && number != 1) return std::nullopt;
  if (choices_->entry_looked_at_late && data_.empty()) {
    if (const Accepted granted = rules_->may_begin(terms_.mux, terms_.announced); !granted)
      return refuse(granted.error());
  }
  if (choices_->unsized_refused_late && !terms_.announced) return refuse(abort_code::length_too_high);
  if (!spoiled_ && rules_->follows(number, taken_)) {
    data_.insert(data_.end(), frame.begin() + 1, frame.end());
    taken_ = number;
    last_taken_ = last;
    // Of the last segment all seven bytes may be unused.
    const std::size_t at_least = data_.size() - (last ? segment_size : 0);
    if (!rules_->fits(at_least, terms_)) return refuse(abort_code::length_too_high);
  }
  const bool gap = number > taken_;
  if (gap && choices_->ack_gap_at_once) {
    const SdoData reply = acknowledge();
    skips_to_first_ = true;
    return reply;
  }
  if (last || number == block_size_) return acknowledge();
  return std::nullopt;
}

std::optional<conform::BusTime> BlockDownload::acknowledge_at() const {
  if (phase_ != Phase::segments || !heard_at_) return std::nullopt;
  return *heard_at_ + choices_->sub_block_time_out;
}

SdoData BlockDownload::acknowledge() {
  const std::uint8_t received = taken_;
  if (choices_->next_block_size != 0) block_size_ = choices_->next_block_size;
  taken_ = 0;
  spoiled_ = false;
  skips_to_first_ = false;
  heard_at_.reset();
  if (last_taken_) phase_ = Phase::end;
  return {0xA2, received, block_size_};
}

// 110n nnx1: n = bytes of the last segment without data; bytes 1-2: CRC, least significant byte first.
SdoReply BlockDownload::end(const SdoData& request) {
  if (phase_ != Phase::end) return refuse(abort_code::command_unknown);
  const std::size_t unused = (request[0] >> 2U) & 0x07U;
  const std::size_t size = data_.size() - std::min(unused, data_.size());
  const auto crc = static_cast<std::uint16_t>(request[1] | (request[2] << 8U));
  if (rules_->crc_checked(terms_.crc) && crc != rules_->crc(data_, size))
    return refuse(abort_code::crc_wrong);
  data_.resize(size);
  const auto value = rules_->value(std::move(data_), terms_);
  if (!value) return refuse(value.error());
  if (const Accepted stored = rules_->store(terms_.mux, *value); !stored) return refuse(stored.error());
  phase_ = Phase::finished;
  return SdoData{0xA1};
}

}  // namespace refnode
