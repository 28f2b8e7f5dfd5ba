// SPDX-License-Identifier: Apache-2.0
#include "canopen/sdo_block_download.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/check.hpp"
#include "base/text.hpp"
#include "canopen/abort_code.hpp"

namespace conform::canopen {
namespace {

// A server that never takes a segment must not be sent the same sub-block for ever. Every other
// acknowledge is progress, so that the transfer ends by itself.
constexpr std::size_t most_stalled = 4;

std::string wrong_block_size(std::uint8_t blksize) {
  return fmt::format("asks for {} segments per block, 1 to 127 are allowed", blksize);
}

bool legal(std::uint8_t blksize) { return blksize >= 1 && blksize <= most_block_segments; }

}  // namespace

SdoBlockDownload::SdoBlockDownload(Multiplexer mux, Bytes data, Options options)
    : mux_(mux), data_(std::move(data)), options_(options), total_(segments_of(data_.size())) {
  result_.counts.block = true;
}

std::size_t SdoBlockDownload::segments_of(std::size_t bytes) {
  return std::max<std::size_t>(1, (bytes + segment_bytes - 1) / segment_bytes);
}

std::optional<std::size_t> SdoBlockDownload::settled() const {
  switch (phase_) {
    case Phase::initiate: return std::nullopt;
    case Phase::end: return total_;
    case Phase::segments: break;
  }
  if (draining_) return base_;
  // The last one of a sub-block is behind us when it has been acknowledged.
  return base_ + in_block_ - (in_block_ == block_ ? 1 : 0);
}

std::optional<SdoFrame> SdoBlockDownload::next(std::size_t unsent) {
  if (ended_ || asked_) return std::nullopt;
  if (phase_ == Phase::segments) {
    if (draining_ && unsent > 0) return std::nullopt;
    draining_ = false;
    return in_block_ == block_ ? std::nullopt : std::optional(segment());
  }
  asked_ = true;
  if (phase_ == Phase::initiate) {
    std::optional<std::uint32_t> size;
    if (options_.size_told) size = options_.announced.value_or(static_cast<std::uint32_t>(data_.size()));
    return SdoFrame{.bytes = encode_block_download(mux_, size, options_.crc)};
  }
  const auto unused = static_cast<std::uint8_t>(total_ * segment_bytes - data_.size());
  const auto crc = result_.counts.crc_agreed == true ? block_crc(data_) : std::uint16_t{0};
  return SdoFrame{.bytes = encode_block_download_end(unused, crc), .part = SdoFrame::Part::end};
}

SdoFrame SdoBlockDownload::segment() {
  ++in_block_;
  const auto number = base_ + in_block_;
  if (number <= highest_) {
    ++result_.counts.retransmitted;
  } else {
    highest_ = number;
    result_.counts.segments = number;
  }
  const auto from = std::min((number - 1) * segment_bytes, data_.size());
  const auto part = ByteView(data_).subspan(from, std::min(segment_bytes, data_.size() - from));
  const bool last = number == total_;
  return {.bytes = encode_block_segment(static_cast<std::uint8_t>(in_block_), part, last),
          .part = SdoFrame::Part::segment,
          .number = number,
          .last = last};
}

void SdoBlockDownload::begin_sub_block(std::uint8_t blksize) {
  ++result_.counts.sub_blocks;
  in_block_ = 0;
  block_ = std::min<std::size_t>(blksize, total_ - base_);
}

bool SdoBlockDownload::on_frame(ByteView data, std::size_t unsent) {
  CONFORM_CHECK(!ended_);
  const bool aborts = data.size() >= 8 && data[0] >> 5U == 4;
  if (phase_ == Phase::initiate && (!asked_ || unsent > 0)) return false;
  if (data.size() < 8) {
    violation(too_short(data), abort::general);
    return true;
  }
  if (aborts) return take_abort(data, mux_, phase_ == Phase::initiate);
  if (phase_ == Phase::segments) {
    const auto on_the_bus = in_block_ - std::min(in_block_, unsent);
    if (on_the_bus == 0 || draining_) {
      // Nothing of this sub-block can be meant.
      if (!decode_block_acknowledge(data)) {
        violation(wrong_command(data[0], "nothing but an acknowledge (A2h)"), abort::command_specifier);
        return true;
      }
      ++result_.counts.acks;
      return false;
    }
    on_acknowledge(data, on_the_bus);
    return true;
  }
  if (phase_ == Phase::end) {
    if (unsent > 0 || !asked_) {
      if (decode_block_acknowledge(data)) ++result_.counts.acks;
      return false;
    }
    on_end(data);
    return true;
  }
  on_initiate(data);
  return true;
}

void SdoBlockDownload::on_initiate(ByteView bytes) {
  const auto response = decode_block_download_response(bytes);
  if (!response) {
    return violation(wrong_command(bytes[0], "a block download response (A0h or A4h)"),
                     abort::command_specifier);
  }
  if (response->mux != mux_) return violation(wrong_object(response->mux, mux_), abort::general);
  if (response->reserved_set) remark("reserved bits or bytes of the block download response are not zero");
  result_.counts.blksize = response->blksize;
  result_.counts.crc_agreed = options_.crc && response->crc;
  if (!legal(response->blksize)) return violation(wrong_block_size(response->blksize), abort::block_size);
  asked_ = false;
  phase_ = Phase::segments;
  begin_sub_block(response->blksize);
}

void SdoBlockDownload::on_acknowledge(ByteView bytes, std::size_t on_the_bus) {
  const auto ack = decode_block_acknowledge(bytes);
  if (!ack) {
    return violation(wrong_command(bytes[0], "an acknowledge of the sub-block (A2h)"),
                     abort::command_specifier);
  }
  ++result_.counts.acks;
  if (!result_.counts.first_ackseq) result_.counts.first_ackseq = ack->ackseq;
  if (ack->reserved_set) remark("reserved bits or bytes of an acknowledge are not zero");
  if (ack->ackseq > on_the_bus) {
    return violation(fmt::format("acknowledges segment {} of a sub-block of which {} {} sent", ack->ackseq,
                                 on_the_bus, on_the_bus == 1 ? "was" : "were"),
                     abort::sequence_number);
  }
  base_ += ack->ackseq;
  if (base_ == total_) {
    // There is no next sub-block that the block size could be of.
    phase_ = Phase::end;
    return;
  }
  if (!legal(ack->blksize)) return violation(wrong_block_size(ack->blksize), abort::block_size);
  stalled_ = ack->ackseq == 0 ? stalled_ + 1 : 0;
  if (stalled_ >= most_stalled) {
    return violation(fmt::format("takes no segment in {} sub-blocks one after the other", stalled_),
                     abort::general);
  }
  draining_ = on_the_bus < in_block_;
  begin_sub_block(ack->blksize);
}

void SdoBlockDownload::on_end(ByteView bytes) {
  const auto reserved_set = decode_block_download_end(bytes);
  if (!reserved_set) {
    return violation(wrong_command(bytes[0], "the end of the block download (A1h)"),
                     abort::command_specifier);
  }
  if (*reserved_set) remark("reserved bits or bytes of the end of the block download are not zero");
  finish(Kind::confirmed);
}

}  // namespace conform::canopen
