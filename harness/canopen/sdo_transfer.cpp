// SPDX-License-Identifier: Apache-2.0
#include "canopen/sdo_transfer.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/check.hpp"
#include "base/text.hpp"
#include "canopen/abort_code.hpp"

namespace conform::canopen {
namespace {

using Kind = TransferResult::Kind;

// A server that sends empty segments for ever must not hold the caller for ever.
constexpr std::size_t max_empty_segments = 16;
constexpr std::size_t max_remarks = 16;

void remark(TransferResult& result, std::string text) {
  if (result.remarks.size() >= max_remarks) return;
  if (std::ranges::find(result.remarks, text) == result.remarks.end())
    result.remarks.push_back(std::move(text));
}

bool any_set(ByteView bytes) {
  return std::ranges::any_of(bytes, [](std::uint8_t byte) { return byte != 0; });
}

std::string too_short(ByteView bytes) {
  return fmt::format("answers with a frame of {} data byte{} instead of 8", bytes.size(),
                     bytes.size() == 1 ? "" : "s");
}

std::string wrong_command(std::uint8_t command, std::string_view due) {
  return fmt::format("answers with command {} where {} is due", hex(command, 2), due);
}

std::string wrong_object(Multiplexer got, Multiplexer wanted) {
  return fmt::format("answers {} instead of {}", to_string(got), to_string(wanted));
}

std::string wrong_toggle(bool got, std::size_t segment) {
  return fmt::format("answers segment {} with toggle bit {} instead of {}", segment, got ? 1 : 0,
                     got ? 0 : 1);
}

/// What an abort does to the transfer; nullopt when `bytes` (eight of them) are no abort.
std::optional<TransferResult> aborted(ByteView bytes, Multiplexer mux, TransferResult& so_far) {
  const auto found = decode_abort(bytes);
  if (!found) return std::nullopt;
  if (found->reserved_bits)
    remark(so_far, fmt::format("reserved bits of the abort command are set ({})", hex(bytes[0], 2)));
  TransferResult result = std::move(so_far);
  result.kind = Kind::aborted;
  result.code = found->code;
  if (found->mux != mux) {
    result.kind = Kind::violation;
    result.detail = fmt::format("aborts {} instead of {} ({})", to_string(found->mux), to_string(mux),
                                describe(found->code));
  }
  return result;
}

}  // namespace

SdoUpload::SdoUpload(Multiplexer mux, std::size_t max_bytes) : mux_(mux), max_bytes_(max_bytes) {}

SdoBytes SdoUpload::first_request() const { return encode_upload_request(mux_); }

TransferResult SdoUpload::finish(Kind kind) {
  phase_ = Phase::done;
  result_.kind = kind;
  return std::move(result_);
}

TransferResult SdoUpload::violation(std::string detail, std::optional<AbortCode> reply) {
  result_.detail = std::move(detail);
  result_.reply = reply;
  return finish(Kind::violation);
}

TransferStep SdoUpload::on_response(ByteView frame_data) {
  CONFORM_CHECK(phase_ != Phase::done);
  if (frame_data.size() < 8) return violation(too_short(frame_data), abort::general);
  if (auto result = aborted(frame_data, mux_, result_)) {
    phase_ = Phase::done;
    return *std::move(result);
  }
  return phase_ == Phase::initiate ? on_initiate(frame_data) : on_segment(frame_data);
}

TransferStep SdoUpload::on_initiate(ByteView bytes) {
  const auto response = decode_upload_response(bytes);
  if (!response) {
    return violation(wrong_command(bytes[0], "an upload response (40h to 4Fh)"), abort::command_specifier);
  }
  // After an expedited response the server has closed the channel: nothing is left to abort.
  if (response->mux != mux_) {
    return violation(wrong_object(response->mux, mux_),
                     response->expedited ? std::nullopt : std::optional(abort::general));
  }
  if (response->reserved_bit)
    remark(result_, fmt::format("bit 4 of the command is set ({})", hex(bytes[0], 2)));
  result_.expedited = response->expedited;
  result_.size_indicated = response->size_indicated;
  if (response->unused != 0 && !(response->expedited && response->size_indicated)) {
    remark(result_,
           fmt::format("bits 2 and 3 of the command are set without e and s ({})", hex(bytes[0], 2)));
  }
  if (response->expedited) {
    const std::size_t size = response->expedited_size();
    if (response->size_indicated) result_.announced_size = static_cast<std::uint32_t>(size);
    if (any_set(bytes.subspan(4 + size)))
      remark(result_, "unused data bytes of the expedited response are not zero");
    if (size > max_bytes_)
      return violation(fmt::format("delivers more than {} bytes", max_bytes_), std::nullopt);
    result_.data.assign(bytes.begin() + 4, bytes.begin() + 4 + static_cast<std::ptrdiff_t>(size));
    return finish(Kind::confirmed);
  }
  if (response->size_indicated) {
    result_.announced_size = response->value;
  } else if (response->value != 0) {
    remark(result_, "bytes 4 to 7 of a segmented response without size are not zero");
  }
  phase_ = Phase::segment;
  return encode_upload_segment_request(toggle_);
}

TransferStep SdoUpload::on_segment(ByteView bytes) {
  const auto segment = decode_segment(bytes);
  if (!segment) {
    return violation(wrong_command(bytes[0], "an upload segment (00h to 1Fh)"), abort::command_specifier);
  }
  ++segments_;
  if (segment->toggle != toggle_)
    return violation(wrong_toggle(segment->toggle, segments_), abort::toggle_bit);

  const std::size_t size = segment->size();
  if (any_set(ByteView(segment->data).subspan(size)))
    remark(result_, "unused bytes of a segment are not zero");
  // Grows with what has arrived; the announced size reserves nothing.
  if (result_.data.size() + size > max_bytes_) {
    return violation(fmt::format("delivers more than {} bytes", max_bytes_),
                     segment->last ? std::nullopt : std::optional(abort::out_of_memory));
  }
  result_.data.insert(result_.data.end(), segment->data.begin(),
                      segment->data.begin() + static_cast<std::ptrdiff_t>(size));

  const std::size_t received = result_.data.size();
  const auto announced = result_.announced_size;
  if (announced && received > *announced) {
    return violation(fmt::format("delivers {} bytes or more, {} were announced", received, *announced),
                     segment->last ? std::nullopt : std::optional(abort::length_mismatch));
  }
  if (segment->last) {
    if (announced && received < *announced) {
      return violation(fmt::format("delivers {} bytes, {} were announced", received, *announced),
                       std::nullopt);
    }
    return finish(Kind::confirmed);
  }
  empty_ = size == 0 ? empty_ + 1 : 0;
  if (empty_ >= max_empty_segments) {
    return violation(fmt::format("delivers {} segments without data one after the other", empty_),
                     abort::general);
  }
  toggle_ = !toggle_;
  return encode_upload_segment_request(toggle_);
}

SdoDownload::SdoDownload(Multiplexer mux, Bytes data, Mode mode)
    : mux_(mux), data_(std::move(data)), mode_(mode) {
  const bool fits = !data_.empty() && data_.size() <= 4;
  if (mode_ == Mode::automatic) mode_ = fits ? Mode::expedited : Mode::segmented;
  CONFORM_CHECK(fits || mode_ == Mode::segmented || mode_ == Mode::segmented_unsized);
  result_.expedited = mode_ == Mode::expedited || mode_ == Mode::expedited_unsized;
}

SdoBytes SdoDownload::first_request() const {
  switch (mode_) {
    case Mode::expedited: return encode_download_expedited(mux_, data_);
    case Mode::expedited_unsized: return encode_download_expedited(mux_, data_, false);
    case Mode::segmented_unsized: return encode_download_segmented(mux_, std::nullopt);
    case Mode::automatic:
    case Mode::segmented: break;
  }
  return encode_download_segmented(mux_, static_cast<std::uint32_t>(data_.size()));
}

TransferResult SdoDownload::finish(Kind kind) {
  phase_ = Phase::done;
  result_.kind = kind;
  return std::move(result_);
}

TransferResult SdoDownload::violation(std::string detail, std::optional<AbortCode> reply) {
  result_.detail = std::move(detail);
  result_.reply = reply;
  return finish(Kind::violation);
}

SdoBytes SdoDownload::next_segment() {
  const std::size_t size = std::min<std::size_t>(7, data_.size() - sent_);
  const ByteView part = ByteView(data_).subspan(sent_, size);
  sent_ += size;
  ++segments_;
  return encode_download_segment_request(toggle_, part, sent_ == data_.size());
}

TransferStep SdoDownload::on_response(ByteView frame_data) {
  CONFORM_CHECK(phase_ != Phase::done);
  if (frame_data.size() < 8) return violation(too_short(frame_data), abort::general);
  if (auto result = aborted(frame_data, mux_, result_)) {
    phase_ = Phase::done;
    return *std::move(result);
  }
  if (phase_ == Phase::initiate) {
    const std::uint8_t command = frame_data[0];
    if (command >> 5U != 3) {
      return violation(wrong_command(command, "the download response (60h)"), abort::command_specifier);
    }
    const Multiplexer mux = sdo_multiplexer(frame_data);
    if (mux != mux_) {
      return violation(wrong_object(mux, mux_),
                       result_.expedited ? std::nullopt : std::optional(abort::general));
    }
    if ((command & 0x1FU) != 0)
      remark(result_, fmt::format("reserved bits of the command are set ({})", hex(command, 2)));
    if (any_set(frame_data.subspan(4)))
      remark(result_, "reserved bytes 4 to 7 of the download response are not zero");
    if (result_.expedited) return finish(Kind::confirmed);
    phase_ = Phase::segment;
    return next_segment();
  }
  const auto ack = decode_download_segment_response(frame_data);
  if (!ack) {
    return violation(wrong_command(frame_data[0], "a download segment response (20h or 30h)"),
                     abort::command_specifier);
  }
  if (ack->toggle != toggle_) return violation(wrong_toggle(ack->toggle, segments_), abort::toggle_bit);
  if (ack->reserved_set)
    remark(result_, "reserved bits or bytes of a download segment response are not zero");
  if (sent_ == data_.size()) return finish(Kind::confirmed);
  toggle_ = !toggle_;
  return next_segment();
}

}  // namespace conform::canopen
