// SPDX-License-Identifier: Apache-2.0
#include "sdo/block_upload.hpp"

#include <algorithm>

#include "sdo/block_rules.hpp"
#include "sdo/crc.hpp"

namespace refnode {

namespace {

constexpr std::size_t segment_size = 7;
constexpr unsigned last_segment_bit = 0x80;

}  // namespace

BlockUpload::BlockUpload(Multiplexer mux, Bytes data, std::uint8_t block_size, bool crc)
    : mux_(mux),
      data_(std::move(data)),
      total_(std::max<std::size_t>(1, (data_.size() + segment_size - 1) / segment_size)),
      block_size_(block_size),
      crc_agreed_(crc) {}

SdoReply BlockUpload::start() {
  if (phase_ != Phase::offered) return refuse(abort_code::command_unknown);
  phase_ = Phase::segments;
  return std::nullopt;
}

bool BlockUpload::has_segment() const {
  return phase_ == Phase::segments && sent_ < block_size_ && acknowledged_ + sent_ < total_;
}

SdoData BlockUpload::next_segment() {
  const std::size_t number = acknowledged_ + sent_;
  const std::size_t position = number * segment_size;
  const std::size_t count = std::min(segment_size, data_.size() - position);
  ++sent_;
  SdoData frame{static_cast<std::uint8_t>(sent_ | (number + 1 == total_ ? last_segment_bit : 0U))};
  std::copy_n(data_.begin() + static_cast<std::ptrdiff_t>(position), count, frame.begin() + 1);
  return frame;
}

// Byte 1: last segment the client received in sequence, byte 2: block size from here on. A client that sees a
// gap may acknowledge before the sub-block has ended: what it has not acknowledged is sent again anyway.
SdoReply BlockUpload::acknowledge(const SdoData& request) {
  if (phase_ != Phase::segments) return refuse(abort_code::command_unknown);
  const std::uint8_t received = request[1];
  const std::uint8_t block_size = request[2];
  if (received > sent_) return refuse(abort_code::sequence_invalid);
  if (!valid_block_size(block_size)) return refuse(abort_code::block_size_invalid);

  const std::size_t from = std::min(acknowledged_ * segment_size, data_.size());
  acknowledged_ += received;
  const std::size_t to = std::min(acknowledged_ * segment_size, data_.size());
  if (crc_agreed_) crc_ = sdo_crc(ByteView(data_).subspan(from, to - from), crc_);
  sent_ = 0;
  block_size_ = block_size;
  if (acknowledged_ < total_) return std::nullopt;
  phase_ = Phase::ended;
  return end_frame();
}

// 110n nn01: n = bytes of the last segment without data.
SdoData BlockUpload::end_frame() const {
  const std::size_t unused = total_ * segment_size - data_.size();
  return {static_cast<std::uint8_t>(0xC1U | (unused << 2U)), static_cast<std::uint8_t>(crc_ & 0xFFU),
          static_cast<std::uint8_t>(crc_ >> 8U)};
}

SdoReply BlockUpload::confirm_end() {
  if (phase_ != Phase::ended) return refuse(abort_code::command_unknown);
  phase_ = Phase::finished;
  return std::nullopt;
}

}  // namespace refnode
