// SPDX-License-Identifier: Apache-2.0
#include "sdo/segmented.hpp"

#include <algorithm>

namespace refnode {

namespace {

constexpr unsigned toggle_bit = 0x10;
constexpr unsigned last_bit = 0x01;

// A repeated segment may be ignored or refused.
SdoReply toggle_error(const SdoChoices& choices) {
  if (choices.toggle_errors_ignored) return std::nullopt;
  return refuse(abort_code::toggle_not_alternated);
}

}  // namespace

SdoReply SegmentedUpload::segment(const SdoData& request, const Device& device) {
  const bool toggle = (request[0] & toggle_bit) != 0;
  if (toggle != toggle_ && !device.behaviour.upload_toggle_unchecked) return toggle_error(*choices_);
  const std::size_t left = data_.size() - position_;
  const std::size_t count = std::min<std::size_t>(left, 7);
  const bool last = count == left;
  // 000t nnnc: toggle of the request, n = bytes without data, c = last segment.
  SdoData reply{};
  reply[0] =
      static_cast<std::uint8_t>((toggle ? toggle_bit : 0U) | ((7U - count) << 1U) | (last ? last_bit : 0U));
  std::copy_n(data_.begin() + static_cast<std::ptrdiff_t>(position_), count, reply.begin() + 1);
  position_ += count;
  toggle_ = !toggle;
  if (last) {
    if (device.behaviour.transfer_stays_open_after_last) {
      position_ = 0;
    } else {
      finished_ = true;
    }
  }
  return reply;
}

SdoReply SegmentedDownload::segment(const SdoData& request, Device& device) {
  const bool toggle = (request[0] & toggle_bit) != 0;
  if (toggle != toggle_ && !device.behaviour.download_toggle_unchecked) return toggle_error(*choices_);
  const std::size_t count = 7U - ((request[0] >> 1U) & 0x07U);
  const bool last = (request[0] & last_bit) != 0;
  const std::size_t limit = announced_.value_or(device.dictionary.capacity(mux_));

  data_.insert(data_.end(), request.begin() + 1, request.begin() + 1 + static_cast<std::ptrdiff_t>(count));
  if (device.behaviour.sdo.partial_download_visible) {
    Entry* entry = device.dictionary.entry(mux_.index.value(), mux_.sub.value());
    if (entry != nullptr)
      std::copy_n(data_.begin(), std::min(data_.size(), entry->value.size()), entry->value.begin());
  }
  if (data_.size() > limit && !device.behaviour.segment_overflow_unchecked) {
    return refuse(abort_code::length_too_high);
  }
  if (last) {
    if (const Accepted stored = store(device, limit); !stored) return refuse(stored.error());
    finished_ = true;
  }
  toggle_ = !toggle;
  return SdoData{static_cast<std::uint8_t>(toggle ? 0x30U : 0x20U)};
}

Accepted SegmentedDownload::store(Device& device, std::size_t limit) {
  const Behaviour& behaviour = device.behaviour;
  if (data_.size() < limit && announced_ && !behaviour.segment_shortfall_unchecked) {
    return refuse(abort_code::length_too_low);
  }
  if (behaviour.segment_overflow_unchecked || behaviour.segment_shortfall_unchecked) data_.resize(limit);
  if (behaviour.segmented_download_not_stored) return {};
  const Accepted written = device.dictionary.download(mux_, data_);
  if (!written && written.error() == abort_code::read_only && behaviour.segmented_access_unchecked) {
    if (Entry* entry = device.dictionary.entry(mux_.index.value(), mux_.sub.value())) entry->value = data_;
    return {};
  }
  return written;
}

}  // namespace refnode
