// SPDX-License-Identifier: Apache-2.0
// The server's half: what its frames are reactions to, and what they had to look like.
#include <algorithm>
#include <utility>

#include "canopen/abort_code.hpp"
#include "monitor/sdo_channel.hpp"
#include "monitor/sdo_server_frame.hpp"

namespace conform::monitor {

using namespace server;
SdoAnswer SdoChannel::response(const can::Frame& frame, BusTime time) {
  last_frame_ = time;
  SdoAnswer out;
  out.well_formed = !frame.remote && frame.dlc == 8;
  if (!out.well_formed) {
    lose_track();
    return out;
  }
  if (untrusted_ > 0) {
    answer_without_track(frame);
    out.block = true;
    return out;
  }
  if (sub_block_again(frame)) {
    out.block = true;
    lose_track();
    return out;
  }
  if (answers_abort(frame, out)) {
    // The requests stay open.
  } else if (time_out_crosses(frame, out)) {
    // The request it did not know of stays open.
  } else if (transfer_.kind == Kind::block_upload && count_ == 0 &&
             (transfer_.stage == Stage::segments || transfer_.stage == Stage::complete)) {
    stream_segment(frame, out);
  } else if (count_ == 0) {
    answer_without_request(frame, out);
  } else if (count_ == 1 && pending_[0].overtaken == 0) {
    const auto pending = pending_[0];
    count_ = 0;
    answer_to(pending, frame, out);
    settle_abort(pending, frame);
  } else {
    answer_to_several(frame, out);
  }
  // A segment of a block upload has 80h never: it would be number 0.
  server_abort_ = !out.block && is_abort(frame) && out.to != SdoAnswer::To::unclear;
  return out;
}

/// Exchanges of one initiate and one fitting answer bring trust back; segments in between do no harm. The
/// server works on its requests in order: with this answer the ones before it are settled, unless they look
/// alike.
void SdoChannel::answer_without_track(const can::Frame& frame) {
  if (exchange_ && !answered_) {
    const auto wanted = object_of(*exchange_);
    const unsigned kind = (*exchange_)[0] >> 5U;
    const bool fits = specifier(frame) == (kind == 2 ? 2U : 3U) || frame.data[0] == 0x80;
    if (fits && multiplexer_of(frame) == wanted) {
      if (answers_older_one(frame)) {
        if (unanswered_ > 0) --unanswered_;
        return;
      }
      open_.clear();
      answered_ = true;
      Pending pending;
      pending.data = *exchange_;
      pending.asked = kind == 2 ? Asked::upload : Asked::download;
      SdoAnswer ignored;
      answer_to(pending, frame, ignored);
      const auto others = unanswered_ > 0 ? unanswered_ - 1 : 0;
      unanswered_ = 0;
      if (!fresh_ || untrusted_ == 0) return;
      untrusted_ = 0;
      exchange_.reset();
      answered_ = false;
      for (count_ = 0; count_ < others; ++count_) pending_[count_] = {};
      return;
    }
  } else if (odd_request_) {
    odd_request_ = false;
    if (unanswered_ > 0) --unanswered_;
    return;
  }
  if (unanswered_ > 0) --unanswered_;
  lose_track();
}

/// A server that wrongly answers the client's abort may do so behind the client's next request. By the object
/// it names one answer is told from the other; where it cannot be told, one answer more may come.
bool SdoChannel::answers_abort(const can::Frame& frame, SdoAnswer& out) {
  const auto got = multiplexer_of(frame);
  const auto names = [&](const Pending& each) {
    return !each.has_multiplexer() || object_of(each.data) == got;
  };
  const auto begin = pending_.begin();
  const bool asked = std::any_of(begin, begin + static_cast<std::ptrdiff_t>(count_), names);
  // Seven zero bytes of a sub-block name 0000h:00, as the answer to an unknown command does.
  const bool next_segment = count_ == 0 && transfer_.kind == Kind::block_upload &&
                            transfer_.stage == Stage::segments &&
                            (frame.data[0] & 0x7FU) == transfer_.sent + 1U;
  if (spare_ == got && !asked && !next_segment && specifier(frame) >= 2 && specifier(frame) <= 4) {
    spare_.reset();
    out.to = SdoAnswer::To::unclear;
    // The server may as well have given up what is open.
    if (is_abort(frame) && transfer_.kind != Kind::none) lose_track();
    return true;
  }
  if (!aborted_ || !is_abort(frame) || count_ == 0) return false;
  const auto aborted = *std::exchange(aborted_, std::nullopt);
  // A transfer of this object has been opened since: a server answers in order, and it is that which ends.
  const bool opened_since =
      transfer_.kind != Kind::none && transfer_.kind != Kind::unclear && transfer_.object == got;
  // The same of a request that was on its way when the client gave up.
  const bool asked_before = pending_[0].given_up.has_value();
  const auto& latest = pending_[count_ - 1];
  const bool unknown_command = code_of(frame) == canopen::abort::command_specifier &&
                               latest.has_multiplexer() && has_reserved_bits(latest.data);
  if (asked || aborted != got || opened_since || asked_before || unknown_command) {
    // Whoever was asked last; an abort of an unknown command may name anything.
    spare_ = latest.has_multiplexer() ? object_of(latest.data) : got;
    return false;
  }
  // 0000h:00 is what servers name that do not know the command, whatever its bytes 1 to 3 are.
  if (got == Multiplexer{}) return false;
  const bool both_gave_up = !aborted_idle_ && code_of(frame) == canopen::abort::timed_out;
  out.to = both_gave_up ? SdoAnswer::To::itself : SdoAnswer::To::nothing;
  out.cause = both_gave_up    ? SdoAnswer::Cause::none
              : aborted_idle_ ? SdoAnswer::Cause::idle_abort
                              : SdoAnswer::Cause::client_abort;
  return true;
}

/// The server lost patience while the client's last frame was on its way. It answers that one next: an
/// initiate request as ever, everything else as a frame without a transfer.
bool SdoChannel::time_out_crosses(const can::Frame& frame, SdoAnswer& out) {
  if (!is_abort(frame) || code_of(frame) != canopen::abort::timed_out) return false;
  if (count_ == 0 && confirmed_) {
    // To the server the block upload was not over yet.
    out.to = SdoAnswer::To::itself;
    out.mux = compare(*confirmed_, frame);
    confirmed_.reset();
    expect_refusal();
    return true;
  }
  const bool one = count_ == 1 && pending_[0].overtaken == 0;
  if (count_ == 0 || transfer_.kind == Kind::none || (one && pending_[0].has_multiplexer())) return false;
  out.to = SdoAnswer::To::itself;
  if (one && transfer_.kind != Kind::unclear) out.mux = compare(transfer_.object, frame);
  // Of the segments of a sub-block any number may still be on the way.
  if (!one || pending_[0].asked == Asked::block_download_ack) {
    lose_track();
    return true;
  }
  transfer_ = {};
  transfer_.kind = Kind::none;
  expect_refusal();
  return true;
}

/// The client's last frame has become one without a transfer.
void SdoChannel::expect_refusal() {
  pending_[0] = {};
  count_ = 1;
}

void SdoChannel::answer_without_request(const can::Frame& frame, SdoAnswer& out) {
  if (transfer_.kind == Kind::block_download && transfer_.stage == Stage::segments && !is_abort(frame)) {
    // Before the sub-block is complete a server may acknowledge after its own time-out.
    out.block = true;
    if (frame.data[0] == 0xA2) out.block_size = frame.data[2];
    return lose_track();
  }
  if (is_abort(frame) && transfer_.kind != Kind::none) {
    out.to = SdoAnswer::To::itself;
    if (transfer_.kind != Kind::unclear && code_of(frame) != canopen::abort::command_specifier)
      out.mux = compare(transfer_.object, frame);
    const bool flowing = transfer_.kind == Kind::block_download && transfer_.stage == Stage::segments;
    transfer_ = {};
    transfer_.kind = Kind::none;
    // The segments behind the one it refused may be on the wire before the abort; to the server they are
    // requests without a transfer, and an abort answers each.
    if (flowing) lose_track();
    return;
  }
  // Both sides may have given up at the same time.
  if (client_abort_ && !idle_abort_ && is_abort(frame) && code_of(frame) == canopen::abort::timed_out) return;
  out.to = SdoAnswer::To::nothing;
  using Cause = SdoAnswer::Cause;
  // What answers an abort is an abort.
  out.cause = !is_abort(frame) ? Cause::none
              : idle_abort_    ? Cause::idle_abort
              : client_abort_  ? Cause::client_abort
              : server_abort_  ? Cause::repeated_abort
                               : Cause::none;
  if (is_abort(frame)) aborted_.reset();
}

void SdoChannel::answer_to(const Pending& pending, const can::Frame& frame, SdoAnswer& out) {
  out.to = SdoAnswer::To::request;
  out.asked = pending.asked;
  if (is_abort(frame)) return abort_of_server(pending, frame, out);
  // To start or to acknowledge a block upload that is not open may make a server send segments.
  if (pending.asked == Asked::other && pending.data[0] >> 5U == 5 && may_be_block_segment(frame)) {
    out.to = SdoAnswer::To::unclear;
    out.block = true;
    return lose_track();
  }
  const auto wanted = object_of(pending.data);
  const auto scs = specifier(frame);
  switch (pending.asked) {
    case Asked::upload: return upload_answer(wanted, frame, out);
    case Asked::upload_segment: return upload_segment_answer(pending, frame, out);
    case Asked::download_segment: return download_segment_answer(pending, frame, out);
    case Asked::download: {
      if (scs != 3) break;
      out.mux = compare(wanted, frame);
      transfer_ = {};
      const bool expedited = (pending.data[0] & 0x02U) != 0;
      if (!expedited) {
        transfer_.kind = Kind::download;
        transfer_.object = wanted;
        return;
      }
      transfer_.kind = Kind::none;
      if (out.mux->right) written_ = expedited_value(wanted, pending.data);
      return;
    }
    case Asked::block_upload: {
      // With a protocol switch threshold the server may answer with a normal upload.
      if (scs == 2) return upload_answer(wanted, frame, out);
      out.block = true;
      const auto block_size = pending.data[4];
      if (scs != 6 || (frame.data[0] & 0x01U) != 0 || block_size < 1 || block_size > 127) return lose_track();
      out.mux = compare(wanted, frame);
      transfer_ = {};
      transfer_.kind = Kind::block_upload;
      transfer_.object = wanted;
      transfer_.block_size = block_size;
      transfer_.crc = (pending.data[0] & 0x04U) != 0 && (frame.data[0] & 0x04U) != 0;
      if ((frame.data[0] & 0x02U) != 0) transfer_.announced = long_of(frame);
      return;
    }
    case Asked::block_download: {
      out.block = true;
      if (scs != 5 || (frame.data[0] & 0x03U) != 0) return lose_track();
      out.mux = compare(wanted, frame);
      out.block_size = frame.data[4];
      if (frame.data[4] < 1 || frame.data[4] > 127) return lose_track();
      transfer_ = {};
      transfer_.kind = Kind::block_download;
      transfer_.object = wanted;
      transfer_.stage = Stage::segments;
      transfer_.block_size = frame.data[4];
      return;
    }
    case Asked::block_download_ack: {
      out.block = true;
      if (scs != 5 || (frame.data[0] & 0x03U) != 2) return lose_track();
      const bool all = transfer_.last_sent && frame.data[1] == transfer_.sent;
      // 0 behind the last segment: there is no next sub-block.
      if (!all || frame.data[2] != 0) out.block_size = frame.data[2];
      if (all) {
        transfer_.stage = Stage::end;
        return;
      }
      if (frame.data[2] < 1 || frame.data[2] > 127) return lose_track();
      transfer_.sent = 0;
      transfer_.last_sent = false;
      transfer_.block_size = frame.data[2];
      return;
    }
    case Asked::block_upload_end: return block_end_answer(frame, out);
    case Asked::block_download_end: {
      out.block = true;
      if (scs != 5 || (frame.data[0] & 0x03U) != 1) return lose_track();
      transfer_ = {};
      transfer_.kind = Kind::none;
      return;
    }
    case Asked::other:
    case Asked::nothing: break;
  }
  not_what_was_asked(frame, out);
}

/// That a request is answered by the wrong command is for the scenarios; here it only blurs the state.
void SdoChannel::not_what_was_asked(const can::Frame& frame, SdoAnswer& out) {
  transfer_ = {};
  if (specifier(frame) < 5) return;
  out.block = true;
  lose_track();
}

void SdoChannel::abort_of_server(const Pending& pending, const can::Frame& frame, SdoAnswer& out) {
  using enum Asked;
  std::optional<Multiplexer> wanted;
  switch (pending.asked) {
    case upload:
    case download:
    case block_upload:
    case block_download: wanted = object_of(pending.data); break;
    case upload_segment:
      if (transfer_.kind == Kind::upload) wanted = transfer_.object;
      break;
    case download_segment:
      if (transfer_.kind == Kind::download) wanted = transfer_.object;
      break;
    case block_upload_end: wanted = transfer_.object; break;
    case block_download_ack:
    case block_download_end: wanted = transfer_.object; break;
    case other:
    case nothing: break;
  }
  const auto code = code_of(frame);
  if (wanted && code != canopen::abort::command_specifier) {
    out.mux = compare(*wanted, frame);
  } else if (transfer_.kind != Kind::unclear && (pending.has_multiplexer() || pending.data[0] >> 5U == 7)) {
    // An unknown command specifier belongs to no object: the one in its place, or that of the transfer it
    // ends. A segment without a transfer has none in that place.
    const auto named = object_of(pending.data), got = multiplexer_of(frame);
    const bool open = transfer_.kind != Kind::none;
    const bool right =
        got == named || got == Multiplexer{} || (open && got == transfer_.object) || got == pending.given_up;
    out.mux = SdoAnswer::Mux{open ? transfer_.object : named, got, right, true};
  }
  // An initiate request does not time out: the server gave up the transfer before it. Under any other code,
  // too, it may name the transfer that the request ends, as a refusal or because it ended that by itself.
  bool about_another = false;
  if (pending.has_multiplexer() && out.mux && !out.mux->free && !out.mux->right) {
    const bool open = transfer_.kind != Kind::none && transfer_.object != Multiplexer{};
    about_another = code == canopen::abort::timed_out || (open && out.mux->got == transfer_.object);
    if (about_another) out.mux.reset();
  }
  transfer_ = {};
  transfer_.kind = Kind::none;
  // It may refuse an earlier segment of the sub-block; then the ones behind that get answers, too.
  if (pending.asked == block_download_ack) lose_track();
  // The answer to the request itself may still be to come.
  const bool late = pending.has_multiplexer() && code == canopen::abort::timed_out;
  if (about_another || late) lose_track();
}

/// The client did not wait for the answer before it asked again.
/// A server answers in order: what it said to the client's abort would have come before the answer to a
/// request behind it.
void SdoChannel::settle_abort(const Pending& answered, const can::Frame& frame) {
  if (!is_abort(frame) && !answered.given_up) aborted_.reset();
}

void SdoChannel::answer_to_several(const can::Frame& frame, SdoAnswer& out) {
  out.to = SdoAnswer::To::several;
  const auto begin = pending_.begin();
  const auto end = pending_.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto has = [&](auto predicate) { return std::find_if(begin, end, predicate); };
  const bool block = has([](const Pending& each) {
                       return each.asked >= Asked::block_upload && each.asked <= Asked::block_download_end;
                     }) != end;
  if (block || specifier(frame) >= 5) {
    out.to = SdoAnswer::To::unclear;
    out.block = true;
    return lose_track();
  }
  // A client that does not wait at all: which answer belongs to what is a guess.
  if (count_ > 2) {
    out.to = SdoAnswer::To::unclear;
    return lose_track();
  }
  const auto got = multiplexer_of(frame);
  const auto names = [&](const Pending& each) {
    return each.has_multiplexer() && object_of(each.data) == got;
  };
  const auto scs = specifier(frame);
  const bool initiate = scs == 2 || scs == 3;
  auto found = end;
  if (initiate || is_abort(frame)) {
    found = has([&](const Pending& each) {
      return names(each) && (is_abort(frame) || each.asked == (scs == 2 ? Asked::upload : Asked::download));
    });
    const bool named = found != end || has(names) != end;
    // A frame that is no request, or a segment, may be answered under any name.
    const auto any_name = has([](const Pending& each) { return !each.has_multiplexer(); });
    if (!named && any_name == end &&
        !(is_abort(frame) &&
          (transfer_.kind != Kind::none || code_of(frame) == canopen::abort::command_specifier))) {
      out.mux = SdoAnswer::Mux{object_of(pending_[0].data), got, false};
    } else if (!named) {
      out.to = SdoAnswer::To::unclear;
    }
    if (found == end) found = has(names);
    if (found == end) found = any_name;
  } else {
    const auto asked = scs == 0 ? Asked::upload_segment : Asked::download_segment;
    found = has([asked](const Pending& each) { return each.asked == asked; });
    if (found == end) {
      found = has([](const Pending& each) { return each.asked == Asked::other; });
      out.to = SdoAnswer::To::unclear;
    }
  }
  if (found != end) settle_abort(*found, frame);
  remove(found == end ? 0 : static_cast<std::size_t>(found - begin));
  transfer_ = {};
}

}  // namespace conform::monitor
