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

// A server that sends empty segments for ever must not hold the caller for ever.
constexpr std::size_t max_empty_segments = 16;

std::string wrong_toggle(bool got, std::size_t segment) {
  return fmt::format("answers segment {} with toggle bit {} instead of {}", segment, got ? 1 : 0,
                     got ? 0 : 1);
}

}  // namespace

SdoUpload::SdoUpload(Multiplexer mux, std::size_t max_bytes, std::optional<std::size_t> enough)
    : mux_(mux), max_bytes_(max_bytes), enough_(enough) {}

std::optional<std::size_t> SdoUpload::settled() const {
  return initiated_ ? std::optional<std::size_t>(result_.counts.segments) : std::nullopt;
}

std::optional<SdoFrame> SdoUpload::next(std::size_t) {
  if (ended_ || asked_) return std::nullopt;
  asked_ = true;
  if (!initiated_) return SdoFrame{.bytes = encode_upload_request(mux_)};
  return SdoFrame{.bytes = encode_upload_segment_request(toggle_),
                  .part = SdoFrame::Part::segment,
                  .number = static_cast<std::size_t>(result_.counts.segments) + 1};
}

bool SdoUpload::on_frame(ByteView data, std::size_t unsent) {
  CONFORM_CHECK(!ended_);
  if (!asked_ || unsent > 0) return false;
  asked_ = false;
  if (data.size() < 8) {
    violation(too_short(data), abort::general);
  } else if (!take_abort(data, mux_)) {
    initiated_ ? on_segment(data) : on_initiate(data);
  }
  return true;
}

void SdoUpload::on_initiate(ByteView bytes) {
  const auto response = decode_upload_response(bytes);
  if (!response) {
    return violation(wrong_command(bytes[0], "an upload response (40h to 4Fh)"), abort::command_specifier);
  }
  // After an expedited response the server has closed the channel: nothing is left to abort.
  if (response->mux != mux_) {
    return violation(wrong_object(response->mux, mux_),
                     response->expedited ? std::nullopt : std::optional(abort::general));
  }
  initiated_ = true;
  if (response->reserved_bit) remark(fmt::format("bit 4 of the command is set ({})", hex(bytes[0], 2)));
  result_.expedited = response->expedited;
  result_.size_indicated = response->size_indicated;
  if (response->unused != 0 && !(response->expedited && response->size_indicated)) {
    remark(fmt::format("bits 2 and 3 of the command are set without e and s ({})", hex(bytes[0], 2)));
  }
  if (response->expedited) {
    const std::size_t size = response->expedited_size();
    if (response->size_indicated) result_.announced_size = static_cast<std::uint32_t>(size);
    if (any_set(bytes.subspan(4 + size))) remark("unused data bytes of the expedited response are not zero");
    if (size > max_bytes_)
      return violation(fmt::format("delivers more than {} bytes", max_bytes_), std::nullopt);
    result_.data.assign(bytes.begin() + 4, bytes.begin() + 4 + static_cast<std::ptrdiff_t>(size));
    return finish(Kind::confirmed);
  }
  if (response->size_indicated) {
    result_.announced_size = response->value;
  } else if (response->value != 0) {
    remark("bytes 4 to 7 of a segmented response without size are not zero");
  }
}

void SdoUpload::on_segment(ByteView bytes) {
  const auto segment = decode_segment(bytes);
  if (!segment) {
    return violation(wrong_command(bytes[0], "an upload segment (00h to 1Fh)"), abort::command_specifier);
  }
  ++result_.counts.segments;
  if (segment->toggle != toggle_)
    return violation(wrong_toggle(segment->toggle, result_.counts.segments), abort::toggle_bit);

  const std::size_t size = segment->size();
  if (any_set(ByteView(segment->data).subspan(size))) remark("unused bytes of a segment are not zero");
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
  if (enough_ && received >= *enough_ && announced.value_or(0) >= least_long_value) {
    result_.reply = abort::general;
    return finish(Kind::gave_up);
  }
  toggle_ = !toggle_;
}

SdoDownload::SdoDownload(Multiplexer mux, Bytes data, Mode mode, std::optional<std::uint32_t> announced)
    : mux_(mux), data_(std::move(data)), mode_(mode), announced_(announced) {
  const bool fits = !data_.empty() && data_.size() <= 4;
  if (mode_ == Mode::automatic) mode_ = fits ? Mode::expedited : Mode::segmented;
  CONFORM_CHECK(fits || mode_ == Mode::segmented || mode_ == Mode::segmented_unsized);
  result_.expedited = mode_ == Mode::expedited || mode_ == Mode::expedited_unsized;
}

std::optional<std::size_t> SdoDownload::settled() const {
  return initiated_ ? std::optional(answered_) : std::nullopt;
}

SdoFrame SdoDownload::initiate() const {
  switch (mode_) {
    case Mode::expedited: return {.bytes = encode_download_expedited(mux_, data_)};
    case Mode::expedited_unsized: return {.bytes = encode_download_expedited(mux_, data_, false)};
    case Mode::segmented_unsized: return {.bytes = encode_download_segmented(mux_, std::nullopt)};
    case Mode::automatic:
    case Mode::segmented: break;
  }
  return {.bytes =
              encode_download_segmented(mux_, announced_.value_or(static_cast<std::uint32_t>(data_.size())))};
}

SdoFrame SdoDownload::segment() {
  const std::size_t size = std::min<std::size_t>(7, data_.size() - sent_);
  const ByteView part = ByteView(data_).subspan(sent_, size);
  sent_ += size;
  ++result_.counts.segments;
  const bool last = sent_ == data_.size();
  return {.bytes = encode_download_segment_request(toggle_, part, last),
          .part = SdoFrame::Part::segment,
          .number = static_cast<std::size_t>(result_.counts.segments),
          .last = last};
}

std::optional<SdoFrame> SdoDownload::next(std::size_t) {
  if (ended_ || asked_) return std::nullopt;
  asked_ = true;
  return initiated_ ? segment() : initiate();
}

bool SdoDownload::on_frame(ByteView data, std::size_t unsent) {
  CONFORM_CHECK(!ended_);
  if (!asked_ || unsent > 0) return false;
  asked_ = false;
  if (data.size() < 8) {
    violation(too_short(data), abort::general);
    return true;
  }
  if (take_abort(data, mux_)) return true;
  if (!initiated_) {
    const std::uint8_t command = data[0];
    const Multiplexer mux = sdo_multiplexer(data);
    if (command >> 5U != 3) {
      violation(wrong_command(command, "the download response (60h)"), abort::command_specifier);
    } else if (mux != mux_) {
      violation(wrong_object(mux, mux_), result_.expedited ? std::nullopt : std::optional(abort::general));
    } else {
      initiated_ = true;
      if ((command & 0x1FU) != 0)
        remark(fmt::format("reserved bits of the command are set ({})", hex(command, 2)));
      if (any_set(data.subspan(4))) remark("reserved bytes 4 to 7 of the download response are not zero");
      if (result_.expedited) finish(Kind::confirmed);
    }
    return true;
  }
  const auto ack = decode_download_segment_response(data);
  if (!ack) {
    violation(wrong_command(data[0], "a download segment response (20h or 30h)"), abort::command_specifier);
  } else if (ack->toggle != toggle_) {
    violation(wrong_toggle(ack->toggle, result_.counts.segments), abort::toggle_bit);
  } else {
    if (ack->reserved_set) remark("reserved bits or bytes of a download segment response are not zero");
    ++answered_;
    if (sent_ == data_.size()) finish(Kind::confirmed);
    toggle_ = !toggle_;
  }
  return true;
}

}  // namespace conform::canopen
