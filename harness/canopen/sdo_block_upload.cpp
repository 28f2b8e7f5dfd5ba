// SPDX-License-Identifier: Apache-2.0
#include "canopen/sdo_block_upload.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/check.hpp"
#include "base/text.hpp"
#include "canopen/abort_code.hpp"

namespace conform::canopen {
namespace {

using Fault = SdoFault::Kind;
using Part = SdoFrame::Part;

// A server that stops again and again within a sub-block is silent in the end.
constexpr std::uint64_t most_timeouts = 3;

}  // namespace

SdoBlockUpload::SdoBlockUpload(Multiplexer mux, Options options, std::shared_ptr<SdoFaultPlan> plan)
    : mux_(mux), options_(options), plan_(std::move(plan)), next_blksize_(options.blksize) {
  result_.counts.block = true;
}

std::optional<std::size_t> SdoBlockUpload::settled() const {
  if (switched_) return switched_->settled();
  if (phase_ == Phase::initiate) return std::nullopt;
  return base_ + good_;
}

std::optional<SdoFrame> SdoBlockUpload::next(std::size_t unsent) {
  if (ended_) return std::nullopt;
  if (switched_) return switched_->next(unsent);
  switch (phase_) {
    case Phase::initiate:
      if (std::exchange(asked_, true)) return std::nullopt;
      return SdoFrame{.bytes = encode_block_upload(mux_, options_.blksize, options_.pst, options_.crc)};
    case Phase::start:
      begin_sub_block();
      return SdoFrame{.bytes = encode_block_upload_start(), .part = Part::start};
    case Phase::acknowledge: return acknowledge();
    case Phase::confirm:
      finish(Kind::confirmed);
      return SdoFrame{.bytes = encode_block_upload_end(), .part = Part::end};
    case Phase::segments:
    case Phase::end: break;
  }
  return std::nullopt;
}

void SdoBlockUpload::begin_sub_block() {
  phase_ = Phase::segments;
  ++result_.counts.sub_blocks;
  good_ = number_ = 0;
  gap_ = false;
}

SdoFrame SdoBlockUpload::acknowledge() {
  const auto block = static_cast<std::size_t>(result_.counts.sub_blocks);
  auto ackseq = good_;
  if (plan_) {
    if (const auto* fault = plan_->take(Fault::acknowledge, Part::acknowledge, block))
      ackseq = static_cast<std::uint8_t>(fault->other);
    // The last acknowledge still asks for a size, which nobody uses: no place for another one.
    if (const auto* fault = last_ ? nullptr : plan_->take(Fault::blksize, Part::acknowledge, block + 1))
      next_blksize_ = static_cast<std::uint8_t>(fault->other);
  }
  const auto kept = std::min(ackseq, good_);
  if (kept < good_) last_ = false;
  base_ += kept;
  result_.counts.segments = base_;
  const SdoFrame out{
      .bytes = encode_block_acknowledge(ackseq, next_blksize_), .part = Part::acknowledge, .number = block};
  if (last_) {
    good_ = 0;
    phase_ = Phase::end;
  } else {
    begin_sub_block();
  }
  return out;
}

bool SdoBlockUpload::on_frame(ByteView data, std::size_t unsent) {
  CONFORM_CHECK(!ended_);
  if (switched_) {
    const bool taken = switched_->on_frame(data, unsent);
    adopt_switched();
    return taken;
  }
  if (phase_ == Phase::initiate && (!asked_ || unsent > 0)) return false;
  if (data.size() < 8) {
    violation(too_short(data), abort::general);
    return true;
  }
  // Within a sub-block 81h to 9Fh are last segments; 80h alone is an abort, as no segment has the number 0.
  if (phase_ == Phase::segments ? data[0] == 0x80 : data[0] >> 5U == 4)
    return take_abort(data, mux_, phase_ == Phase::initiate);
  if (phase_ != Phase::initiate &&
      (unsent > 0 || phase_ == Phase::start || phase_ == Phase::acknowledge || phase_ == Phase::confirm)) {
    if (stopped_) return false;
    on_early(data);
    return true;
  }
  switch (phase_) {
    case Phase::initiate: on_initiate(data); break;
    case Phase::segments: on_segment(data); break;
    default: on_end(data); break;
  }
  return true;
}

/// Between two sub-blocks, and before the start, it is the client's turn.
void SdoBlockUpload::on_early(ByteView bytes) {
  if (phase_ == Phase::confirm ||
      (phase_ == Phase::segments && base_ == 0 && result_.counts.sub_blocks <= 1) || phase_ == Phase::start) {
    const auto before = phase_ == Phase::confirm ? "its end is confirmed" : "the start of the block upload";
    return violation(fmt::format("sends a frame ({}) before {}", hex(bytes[0], 2), before),
                     abort::command_specifier);
  }
  violation(fmt::format("sends another frame ({}) before its sub-block is acknowledged", hex(bytes[0], 2)),
            abort::sequence_number);
}

void SdoBlockUpload::on_initiate(ByteView bytes) {
  if (options_.pst != 0 && bytes[0] >> 5U == 2) {
    switched_ = std::make_unique<SdoUpload>(mux_, options_.max_bytes);
    switched_->take_over();
    switched_->on_frame(bytes, 0);
    return adopt_switched();
  }
  const auto response = decode_block_upload_response(bytes);
  if (!response) {
    return violation(wrong_command(bytes[0], "a block upload response (C0h, C2h, C4h or C6h)"),
                     abort::command_specifier);
  }
  if (response->mux != mux_) return violation(wrong_object(response->mux, mux_), abort::general);
  if (response->reserved_bits)
    remark(fmt::format("reserved bits of the block upload response are set ({})", hex(bytes[0], 2)));
  result_.size_indicated = response->size_indicated;
  if (response->size_indicated) {
    result_.announced_size = response->size;
  } else if (response->size != 0) {
    remark("bytes 4 to 7 of a block upload response without size are not zero");
  }
  result_.counts.crc_agreed = options_.crc && response->crc;
  phase_ = Phase::start;
}

void SdoBlockUpload::adopt_switched() {
  result_.counts.switched = true;
  result_.counts.segments = switched_->result().counts.segments;
  if (!switched_->ended()) return;
  const auto counts = result_.counts;
  result_ = switched_->take();
  result_.counts = counts;
  ended_ = true;
  if (result_.kind == Kind::confirmed && result_.data.size() > options_.pst) {
    violation(fmt::format("switches to the normal upload for {} bytes, above the threshold of {}",
                          result_.data.size(), options_.pst),
              std::nullopt);
  }
}

void SdoBlockUpload::on_segment(ByteView bytes) {
  const auto number = static_cast<std::uint8_t>(bytes[0] & 0x7FU);
  const bool last = (bytes[0] & 0x80U) != 0;
  const auto due = static_cast<std::uint8_t>(number_ + 1);
  const auto position = base_ + due;
  if (number != due) {
    ++result_.counts.wrong_numbers;
    return violation(
        fmt::format("answers segment {} with sequence number {} instead of {}", position, number, due),
        abort::sequence_number);
  }
  number_ = number;
  stopped_ = false;
  if (position <= seen_) {
    ++result_.counts.retransmitted;
  } else {
    seen_ = position;
  }
  if (plan_ && !gap_ && plan_->take(Fault::lose, Part::segment, position) != nullptr) gap_ = true;
  if (!gap_) {
    if (!keep(bytes.subspan(1, segment_bytes), position, last)) return;
    good_ = number;
    last_ = last;
    result_.counts.segments = base_ + good_;
  }
  // A blksize that is illegal on purpose ends nothing before the highest number does.
  const bool legal = next_blksize_ >= 1 && next_blksize_ <= most_block_segments;
  if (last || number == (legal ? next_blksize_ : most_block_segments)) phase_ = Phase::acknowledge;
}

/// False: the transfer has ended.
bool SdoBlockUpload::keep(ByteView data, std::size_t position, bool last) {
  auto& raw = result_.data;
  const auto from = (position - 1) * segment_bytes;
  if (result_.announced_size && from > 0 && from >= *result_.announced_size) {
    violation(fmt::format("sends segment {}, {} bytes were announced", position, *result_.announced_size),
              abort::length_mismatch);
    return false;
  }
  if (from < raw.size()) {
    // What fills up the last segment is no data, and may be anything.
    if (!last && !std::ranges::equal(data, ByteView(raw).subspan(from, segment_bytes))) {
      violation(fmt::format("sends other bytes when segment {} is sent once more", position), abort::general);
      return false;
    }
    std::ranges::copy(data, raw.begin() + static_cast<std::ptrdiff_t>(from));
    return true;
  }
  // Grows with what has arrived; the announced size reserves nothing.
  if (raw.size() > options_.max_bytes) {
    violation(fmt::format("delivers more than {} bytes", options_.max_bytes), abort::out_of_memory);
    return false;
  }
  raw.insert(raw.end(), data.begin(), data.end());
  return true;
}

void SdoBlockUpload::on_end(ByteView bytes) {
  const auto end = decode_block_upload_end(bytes);
  if (!end) {
    return violation(wrong_command(bytes[0], "the end of the block upload (C1h to DDh)"),
                     abort::command_specifier);
  }
  auto& counts = result_.counts;
  auto& data = result_.data;
  counts.unused = end->unused;
  counts.crc = end->crc;
  if (end->reserved_set) remark("reserved bits or bytes of the end of the block upload are not zero");
  data.resize(base_ * segment_bytes - end->unused);
  if (result_.announced_size && data.size() != *result_.announced_size) {
    return violation(
        fmt::format("delivers {} bytes, {} were announced", data.size(), *result_.announced_size),
        abort::length_mismatch);
  }
  if (counts.crc_agreed == true) {
    const auto due = block_crc(data);
    counts.crc_ok = due == end->crc;
    if (due != end->crc) {
      return violation(fmt::format("ends with the CRC {} instead of {}", hex(end->crc, 4), hex(due, 4)),
                       abort::crc);
    }
  } else if (end->crc != 0) {
    remark(fmt::format("the CRC field is {} though no CRC was agreed", hex(end->crc, 4)));
  }
  phase_ = Phase::confirm;
}

void SdoBlockUpload::on_silence() {
  if (switched_) {
    switched_->on_silence();
    return adopt_switched();
  }
  // The server believes that it has sent the sub-block, or waits for an acknowledge: tell it what has come.
  if (phase_ == Phase::segments && number_ > 0 && result_.counts.timeouts < most_timeouts) {
    ++result_.counts.timeouts;
    stopped_ = true;
    phase_ = Phase::acknowledge;
    return;
  }
  give_up_waiting();
}

}  // namespace conform::canopen
