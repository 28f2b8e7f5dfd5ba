// SPDX-License-Identifier: Apache-2.0
// The client's half: what its frames ask for, and where they leave the protocol.
#include "monitor/sdo_channel.hpp"

#include <algorithm>
#include <utility>

#include "canopen/sdo_block.hpp"
#include "monitor/sdo_server_frame.hpp"

namespace conform::monitor {
namespace {

constexpr std::uint8_t abort_command = 0x80;

/// Bits 7-5 of the command: ccs.
unsigned specifier(const can::Frame& frame) { return frame.data[0] >> 5U; }

Asked asked_by(const can::Frame& frame) {
  switch (specifier(frame)) {
    case 0: return Asked::download_segment;
    case 1: return Asked::download;
    case 2: return Asked::upload;
    case 3: return Asked::upload_segment;
    case 5: return (frame.data[0] & 0x03U) == 0 ? Asked::block_upload : Asked::other;
    case 6: return (frame.data[0] & 0x01U) == 0 ? Asked::block_download : Asked::other;
    default: return Asked::other;
  }
}

}  // namespace

Multiplexer multiplexer_of(const can::Frame& frame) {
  return {Index(static_cast<std::uint16_t>(load_le(ByteView(frame.data).subspan(1, 2)))),
          SubIndex(frame.data[3])};
}

void SdoChannel::lose_track(int exchanges) {
  if (untrusted_ == 0) {
    unanswered_ = count_;
    for (std::size_t i = 0; i < count_; ++i) note_open(pending_[i].data);
  }
  untrusted_ = std::max(untrusted_, exchanges);
  fresh_ = false;
  exchange_.reset();
  answered_ = false;
  odd_request_ = false;
  count_ = 0;
  complete_ = crossed_ = 0;
  aborted_.reset();
  spare_.reset();
  transfer_ = {};
}

void SdoChannel::note_open(const Data& initiate) {
  if (open_.size() == most_pending) open_.erase(open_.begin());
  open_.push_back(initiate);
}

/// True once for each earlier request that had no answer and looks like the last one: a client that does not
/// wait may ask for the same again and again.
bool SdoChannel::answers_older_one(const can::Frame& frame) {
  if (open_.empty()) return false;
  const auto same = [&](const Data& each) {
    return each[0] >> 5U == open_.back()[0] >> 5U &&
           std::equal(each.begin() + 1, each.begin() + 4, frame.data.begin() + 1);
  };
  const auto older = std::find_if(open_.begin(), open_.end() - 1, same);
  if (older == open_.end() - 1) return false;
  open_.erase(open_.begin(), older + 1);
  return true;
}

void SdoChannel::lose_frames() {
  lose_track();
  unanswered_ = most_unanswered + 1;
}

void SdoChannel::transfer_unclear() {
  // The server of a block upload may go on sending, and the client's next frames may be segments.
  if (transfer_.kind == Kind::block_upload || transfer_.kind == Kind::block_download) return lose_track();
  if (transfer_.kind != Kind::none) transfer_.kind = Kind::unclear;
}

std::optional<SdoChannel::Value> SdoChannel::take_written() { return std::exchange(written_, std::nullopt); }

std::optional<SdoChannel::Value> SdoChannel::take_read() { return std::exchange(read_, std::nullopt); }

void SdoChannel::push(const can::Frame& frame, Asked asked) {
  if (count_ == most_pending) return lose_track();
  auto& pending = pending_[count_++];
  pending.data = frame.data;
  pending.asked = asked;
  pending.overtaken = 0;
  pending.given_up.reset();
}

void SdoChannel::remove(std::size_t position) {
  for (std::size_t i = 0; i < position; ++i) ++pending_[i].overtaken;
  std::copy(pending_.begin() + static_cast<std::ptrdiff_t>(position) + 1,
            pending_.begin() + static_cast<std::ptrdiff_t>(count_),
            pending_.begin() + static_cast<std::ptrdiff_t>(position));
  --count_;
  // A server works on its requests in order: what two later ones have overtaken was ignored.
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    if (pending_[i].overtaken < 2) pending_[kept++] = pending_[i];
  }
  count_ = kept;
}

void SdoChannel::request(const can::Frame& frame, BusTime time) {
  const bool plain = !frame.remote && frame.dlc == 8;
  const bool after_silence = last_frame_ && time >= *last_frame_ + silence_to_trust;
  last_frame_ = time;
  idle_abort_ = client_abort_ = server_abort_ = false;
  if (after_silence) {
    aborted_.reset();
    spare_.reset();
  }
  confirmed_.reset();
  // By its bytes a sub-block that comes again is hardly told from the next one, where the data repeat: it is
  // looked for only where the client was slow enough for a server to lose patience.
  crossed_ = after_silence ? complete_ : std::uint8_t{0};
  complete_ = 0;
  if (untrusted_ > 0 && !request_without_track(frame, plain, after_silence)) return;
  const bool block_segments = transfer_.kind == Kind::block_download && transfer_.stage == Stage::segments;
  const bool streaming = transfer_.kind == Kind::block_upload && transfer_.stage == Stage::segments;
  if (plain && block_segments && frame.data[0] != abort_command) return client_segment(frame);
  if (plain && specifier(frame) == 4) return client_abort(frame);
  if (block_segments || (streaming && count_ == 0)) return lose_track();
  // The server may send the sub-block again before it sees that the client wants something else.
  const bool complete = transfer_.kind == Kind::block_upload && transfer_.stage == Stage::complete;
  if (complete && (frame.data[0] & 0xE3U) != 0xA2) return lose_track();
  if (!plain) {
    // What a server makes of it is its own affair.
    push(frame, Asked::other);
    if (transfer_.kind == Kind::block_upload || transfer_.kind == Kind::block_download) return lose_track();
    transfer_.kind = Kind::unclear;
    return;
  }
  if (specifier(frame) == 5 && (frame.data[0] & 0x03U) != 0) return block_upload_request(frame);
  if (specifier(frame) == 6 && (frame.data[0] & 0x01U) != 0) return block_download_end(frame);
  push(frame, asked_by(frame));
}

/// True when trust has come back with this frame.
bool SdoChannel::request_without_track(const can::Frame& frame, bool plain, bool after_silence) {
  if (exchange_ && answered_) --untrusted_;
  const bool waiting = (exchange_ && !answered_) || odd_request_;
  exchange_.reset();
  answered_ = false;
  odd_request_ = false;
  if (untrusted_ == 0) {
    count_ = 0;
    open_.clear();
    return true;
  }
  // One more answer may be outstanding.
  if (waiting && untrusted_ < exchanges_to_trust) untrusted_ = std::max(untrusted_ + 1, 2);
  const bool few = unanswered_ <= most_unanswered;
  fresh_ = false;
  const auto asked = plain ? asked_by(frame) : Asked::other;
  if (!plain || specifier(frame) != 4) ++unanswered_;
  if (asked == Asked::download || asked == Asked::upload) {
    exchange_ = frame.data;
    fresh_ = after_silence && few;
    if (fresh_) open_.clear();
    note_open(frame.data);
  } else {
    odd_request_ = true;
    transfer_ = {};
    transfer_.kind = Kind::unclear;
  }
  return false;
}

void SdoChannel::client_abort(const can::Frame& frame) {
  const bool flowing = (transfer_.kind == Kind::block_upload && transfer_.stage == Stage::segments) ||
                       (transfer_.kind == Kind::block_download && transfer_.stage == Stage::segments);
  client_abort_ = true;
  idle_abort_ = transfer_.kind == Kind::none && count_ == 0;
  aborted_ = multiplexer_of(frame);
  aborted_idle_ = idle_abort_;
  for (std::size_t i = 0; i < count_; ++i) {
    // Of several aborts one names the object of the request itself, which goes without saying.
    auto& pending = pending_[i];
    if (!pending.given_up || !pending.has_multiplexer() || aborted_ != server::object_of(pending.data))
      pending.given_up = aborted_;
  }
  transfer_ = {};
  transfer_.kind = Kind::none;
  // Segments or an acknowledge may be in the server's queue already.
  if (flowing) lose_track();
}

/// Segment of a block download: c in bit 7, sequence number in bits 6-0.
void SdoChannel::client_segment(const can::Frame& frame) {
  const auto number = static_cast<std::uint8_t>(frame.data[0] & 0x7FU);
  if (count_ > 0 || number != transfer_.sent + 1 || number > transfer_.block_size) return lose_track();
  transfer_.sent = number;
  transfer_.last_sent = (frame.data[0] & 0x80U) != 0;
  if (transfer_.last_sent || number == transfer_.block_size) push(frame, Asked::block_download_ack);
}

void SdoChannel::block_upload_request(const can::Frame& frame) {
  if (transfer_.kind != Kind::block_upload) {
    if (transfer_.kind == Kind::unclear || count_ > 0) return lose_track();
    return push(frame, Asked::other);
  }
  const auto command = frame.data[0] & 0x03U;
  if (count_ > 0) return lose_track();
  if (command == 3 && transfer_.stage == Stage::initiated) {
    transfer_.stage = Stage::segments;
    transfer_.sent = 0;
    return;
  }
  if (command == 2 && transfer_.stage == Stage::complete) return acknowledge(frame);
  if (command == 1 && transfer_.stage == Stage::end) {
    confirmed_ = transfer_.object;
    transfer_ = {};
    transfer_.kind = Kind::none;
    return;
  }
  push(frame, Asked::other);
}

/// A2, ackseq, blksize of the next sub-block.
void SdoChannel::acknowledge(const can::Frame& frame) {
  const auto good = frame.data[1];
  const auto next = frame.data[2];
  if (good > transfer_.sent || next < 1 || next > 127) {
    push(frame, Asked::other);
    return;
  }
  for (std::size_t i = 0; i < good; ++i) {
    if (transfer_.held) transfer_.crc_value = canopen::block_crc(transfer_.crc_value, transfer_.tail);
    transfer_.tail = block_[i];
    transfer_.held = true;
    ++transfer_.segments;
  }
  const bool all = transfer_.last_sent && good == transfer_.sent;
  transfer_.sent = 0;
  transfer_.last_sent = false;
  transfer_.block_size = next;
  if (all) {
    transfer_.stage = Stage::end;
    return push(frame, Asked::block_upload_end);
  }
  transfer_.stage = Stage::segments;
}

void SdoChannel::block_download_end(const can::Frame& frame) {
  if (transfer_.kind == Kind::unclear) return lose_track();
  const bool due = transfer_.kind == Kind::block_download && transfer_.stage == Stage::end && count_ == 0;
  push(frame, due ? Asked::block_download_end : Asked::other);
}

}  // namespace conform::monitor
