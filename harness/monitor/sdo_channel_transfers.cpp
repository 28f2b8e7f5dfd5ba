// SPDX-License-Identifier: Apache-2.0
// The server's half inside a transfer: segments, and what is known when the last one has come.
#include <algorithm>
#include <span>
#include <utility>

#include "canopen/abort_code.hpp"
#include "canopen/sdo_block.hpp"
#include "monitor/sdo_channel.hpp"
#include "monitor/sdo_server_frame.hpp"

namespace conform::monitor {

using namespace server;

/// A segment of a sub-block that the client has acknowledged, or given up, in the meantime; also one that can
/// be taken for an abort, the last one of up to 31.
bool SdoChannel::sub_block_again(const can::Frame& frame) {
  const auto number = static_cast<std::size_t>(frame.data[0] & 0x7FU);
  const auto segments = std::exchange(crossed_, std::uint8_t{0});
  if (number >= 1 && number <= segments &&
      std::ranges::equal(std::span(frame.data).subspan(1, 7), block_[number - 1])) {
    return true;
  }
  return transfer_.kind == Kind::block_upload && count_ > 0 && is_abort(frame) && frame.data[0] != 0x80;
}

void SdoChannel::stream_segment(const can::Frame& frame, SdoAnswer& out) {
  if (frame.data[0] == 0x80) {
    out.to = SdoAnswer::To::itself;
    if (code_of(frame) != canopen::abort::command_specifier) out.mux = compare(transfer_.object, frame);
    // Before its first segment the server waits for the frame of the client that asks for it.
    const bool crossed = transfer_.stage == Stage::segments && transfer_.sent == 0 &&
                         code_of(frame) == canopen::abort::timed_out;
    transfer_ = {};
    transfer_.kind = Kind::none;
    if (crossed) expect_refusal();
    return;
  }
  out.to = SdoAnswer::To::stream;
  out.block = true;
  const auto number = static_cast<std::uint8_t>(frame.data[0] & 0x7FU);
  const bool last = (frame.data[0] & 0x80U) != 0;
  const auto bytes = std::span(frame.data).subspan(1, 7);
  if (transfer_.stage == Stage::complete) {
    // A server that waits in vain for the acknowledge may send the sub-block again.
    if (number == 1 && std::ranges::equal(bytes, block_[0])) {
      out.to = SdoAnswer::To::unclear;
    } else {
      out.segment = SdoAnswer::Segment{0, number, transfer_.block_size, true};
    }
    return lose_track();
  }
  const auto wanted = static_cast<std::uint8_t>(transfer_.sent + 1);
  out.segment = SdoAnswer::Segment{wanted, number, transfer_.block_size, false};
  if (number != wanted) return lose_track();
  std::ranges::copy(bytes, block_[transfer_.sent].begin());
  transfer_.sent = number;
  transfer_.last_sent = last;
  const auto delivered = (transfer_.segments + transfer_.sent) * 7;
  if (!last && transfer_.announced && delivered > *transfer_.announced) {
    out.size = SdoAnswer::Size{*transfer_.announced, delivered};
    transfer_.announced.reset();
  }
  if (!last && number != transfer_.block_size) return;
  transfer_.stage = Stage::complete;
  complete_ = number;
}

/// 0100 nn e s: expedited, or the beginning of a segmented transfer.
void SdoChannel::upload_answer(Multiplexer wanted, const can::Frame& frame, SdoAnswer& out) {
  if (specifier(frame) != 2) return not_what_was_asked(frame, out);
  out.mux = compare(wanted, frame);
  transfer_ = {};
  transfer_.kind = Kind::none;
  if ((frame.data[0] & 0x02U) != 0) {
    if (out.mux->right) read_ = expedited_value(wanted, frame.data);
    return;
  }
  transfer_.kind = Kind::upload;
  transfer_.object = wanted;
  if ((frame.data[0] & 0x01U) != 0) transfer_.announced = long_of(frame);
}

/// 000 t nnn c, seven bytes.
void SdoChannel::upload_segment_answer(const Pending& pending, const can::Frame& frame, SdoAnswer& out) {
  if (specifier(frame) != 0) return not_what_was_asked(frame, out);
  const bool toggle = (pending.data[0] & 0x10U) != 0;
  out.toggle = SdoAnswer::Toggle{toggle, (frame.data[0] & 0x10U) != 0};
  if (transfer_.kind != Kind::upload) return;
  // A repeated request may be answered with the same segment again: from there on the bytes are not counted.
  if (toggle != transfer_.toggle) transfer_.in_order = false;
  transfer_.toggle = !toggle;
  transfer_.delivered += 7U - ((frame.data[0] >> 1U) & 7U);
  const bool last = (frame.data[0] & 0x01U) != 0;
  if (transfer_.in_order && transfer_.announced && (last || transfer_.delivered > *transfer_.announced)) {
    out.size = SdoAnswer::Size{*transfer_.announced, transfer_.delivered};
    if (!last) transfer_.announced.reset();
  }
  if (!last) return;
  transfer_ = {};
  transfer_.kind = Kind::none;
}

/// 001 t, reserved.
void SdoChannel::download_segment_answer(const Pending& pending, const can::Frame& frame, SdoAnswer& out) {
  if (specifier(frame) != 1) return not_what_was_asked(frame, out);
  out.toggle = SdoAnswer::Toggle{(pending.data[0] & 0x10U) != 0, (frame.data[0] & 0x10U) != 0};
  if (transfer_.kind != Kind::download || (pending.data[0] & 0x01U) == 0) return;
  transfer_ = {};
  transfer_.kind = Kind::none;
}

/// 110 nnn 01, CRC in bytes 1-2.
void SdoChannel::block_end_answer(const can::Frame& frame, SdoAnswer& out) {
  out.block = true;
  if (specifier(frame) != 6 || (frame.data[0] & 0x03U) != 1) return lose_track();
  SdoAnswer::End end;
  end.agreed = transfer_.crc;
  end.got = static_cast<std::uint16_t>(load_le(ByteView(frame.data).subspan(1, 2)));
  end.unused = static_cast<std::uint8_t>((frame.data[0] >> 2U) & 7U);
  if (transfer_.held) {
    end.wanted = canopen::block_crc(transfer_.crc_value, ByteView(transfer_.tail).first(7U - end.unused));
    const auto delivered = transfer_.segments * 7 - end.unused;
    if (transfer_.announced && *transfer_.announced > 0) {
      const auto size = *transfer_.announced;
      // As many segments as the size needs, but another n: the end frame is wrong and not the size.
      if ((std::uint64_t{size} + 6) / 7 == transfer_.segments) {
        end.unused_wanted = static_cast<std::uint8_t>((7U - size % 7U) % 7U);
        out.size = SdoAnswer::Size{size, size};
      } else {
        out.size = SdoAnswer::Size{size, delivered};
      }
    }
  }
  out.end = end;
}

}  // namespace conform::monitor
