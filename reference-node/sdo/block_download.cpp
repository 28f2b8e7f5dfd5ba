// SPDX-License-Identifier: Apache-2.0
#include "sdo/block_download.hpp"

#include <algorithm>

#include "sdo/crc.hpp"

namespace refnode {

namespace {

constexpr std::size_t segment_size = 7;
constexpr std::uint8_t last_segment_bit = 0x80;

}  // namespace

BlockDownload::BlockDownload(const SdoChoices& choices, Multiplexer mux, std::optional<std::size_t> announced,
                             std::uint8_t block_size, bool crc)
    : choices_(&choices), mux_(mux), announced_(announced), block_size_(block_size), crc_agreed_(crc) {}

std::size_t BlockDownload::limit(const Device& device) const {
  return announced_.value_or(device.dictionary.capacity(mux_));
}

// cnnn nnnn: c = last segment of the transfer, n = sequence number from 1. Only the next number is taken;
// what comes behind a gap, or twice, is left to the acknowledge.
SdoReply BlockDownload::segment(const SdoData& frame, const Device& device) {
  const SdoBlockFaults& fault = device.behaviour.block;
  std::uint8_t number = frame[0] & 0x7FU;
  if (number > fault.receives_at_most) return std::nullopt;
  const bool any_number =
      (number == 0 && fault.number_0_accepted) || (number > block_size_ && fault.number_above_size_accepted);
  if (any_number) number = static_cast<std::uint8_t>(taken_ + 1);
  const bool last = (frame[0] & last_segment_bit) != 0;
  if (number == 0 || number > block_size_) {
    spoiled_ = choices_->invalid_sequence_spoils;
    if (choices_->invalid_sequence_ignored) return std::nullopt;
    return refuse(abort_code::sequence_invalid);
  }
  heard_at_ = device.now;
  if (skips_to_first_ && number != 1) return std::nullopt;
  skips_to_first_ = false;
  if (fault.gap_unnoticed && number > taken_ + 1) {
    data_.resize(data_.size() + (number - taken_ - 1U) * segment_size);
    taken_ = static_cast<std::uint8_t>(number - 1);
  }
  if (fault.duplicate_appended && number == taken_) --taken_;
  const bool expected = !spoiled_ && number == taken_ + 1;
  if (expected) {
    data_.insert(data_.end(), frame.begin() + 1, frame.end());
    taken_ = number;
    last_taken_ = last;
    // Of the last segment all seven bytes may be unused.
    const bool too_long = data_.size() - (last ? segment_size : 0) > limit(device);
    if (too_long && !fault.drops_surplus()) return refuse(abort_code::length_too_high);
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

std::optional<BusTime> BlockDownload::acknowledge_at() const {
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
  // The last segment may hold padding: how much tells the end frame only.
  if (crc_agreed_ && data_.size() > segment_size) add_to_crc(data_.size() - segment_size);
  if (last_taken_) phase_ = Phase::end;
  return {0xA2, received, block_size_};
}

void BlockDownload::add_to_crc(std::size_t end) {
  crc_ = sdo_crc(ByteView(data_).subspan(crc_end_, end - crc_end_), crc_);
  crc_end_ = end;
}

/// What defects make of data that are too long or too short.
void BlockDownload::distort_length(const Device& device) {
  const SdoBlockFaults& fault = device.behaviour.block;
  if (fault.drops_surplus() && data_.size() > limit(device)) data_.resize(limit(device));
  if (fault.shortfall_filled && announced_ && data_.size() < *announced_) data_.resize(*announced_);
  if (fault.buffer != 0 && data_.size() > fault.buffer) {
    data_.resize(fault.buffer);
    announced_.reset();
  }
  if (fault.length_unchecked && !device.dictionary.may_download(mux_, data_.size())) {
    data_.resize(device.dictionary.capacity(mux_));
    announced_.reset();
  }
}

// 110n nnx1: n = bytes of the last segment without data; bytes 1-2: CRC, least significant byte first.
SdoReply BlockDownload::end(const SdoData& request, Device& device) {
  if (phase_ != Phase::end) return refuse(abort_code::command_unknown);
  const SdoBlockFaults& fault = device.behaviour.block;
  const Bytes padded = data_;
  data_.resize(data_.size() - std::min<std::size_t>(fault.unused(request[0]), data_.size()));
  if (crc_agreed_ || fault.crc_always_checked) {
    if (crc_agreed_) add_to_crc(data_.size());
    const auto given = static_cast<std::uint16_t>(request[1] | (request[2] << 8));
    const bool wrong = given != fault.crc(crc_, data_, padded);
    if (wrong && fault.stored_despite_wrong_crc) {
      [[maybe_unused]] const auto stored = device.dictionary.download(mux_, data_);
    }
    if (wrong && !fault.crc_unchecked) return refuse(abort_code::crc_wrong);
  }
  distort_length(device);
  if (announced_ && data_.size() < *announced_) return refuse(abort_code::length_too_low);
  if (data_.size() > limit(device)) return refuse(abort_code::length_too_high);
  if (!fault.not_stored) {
    const Accepted written = device.dictionary.download(mux_, data_);
    Entry* entry = device.dictionary.entry(mux_.index.value(), mux_.sub.value());
    if (!written && (!fault.range_unchecked || entry == nullptr)) return refuse(written.error());
    if (!written) entry->value = data_;
  }
  phase_ = Phase::finished;
  return SdoData{0xA1};
}

}  // namespace refnode
