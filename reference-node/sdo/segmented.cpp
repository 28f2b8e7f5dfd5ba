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

SdoReply SegmentedUpload::segment(const SdoData& request) {
  const bool toggle = (request[0] & toggle_bit) != 0;
  if (!rules_->upload_toggle_right(toggle, toggle_)) return toggle_error(*choices_);
  const std::size_t left = data_.size() - position_;
  const std::size_t count = std::min(left, choices_->upload_segment);
  const bool last = count == left;
  // 000t nnnc: toggle of the request, n = bytes without data, c = last segment.
  SdoData reply{};
  reply[0] =
      static_cast<std::uint8_t>((toggle ? toggle_bit : 0U) | ((7U - count) << 1U) | (last ? last_bit : 0U));
  std::copy_n(data_.begin() + static_cast<std::ptrdiff_t>(position_), count, reply.begin() + 1);
  const auto next = rules_->goes_on_at(position_ + count, data_.size());
  position_ = next.value_or(data_.size());
  finished_ = !next;
  toggle_ = !toggle;
  return reply;
}

SdoReply SegmentedDownload::segment(const SdoData& request, const ObjectDictionary& dictionary) {
  const bool toggle = (request[0] & toggle_bit) != 0;
  if (!rules_->download_toggle_right(toggle, toggle_)) {
    if (choices_->wrong_toggle_ignored_in_downloads) return std::nullopt;
    return toggle_error(*choices_);
  }
  const std::size_t count = 7U - ((request[0] >> 1U) & 0x07U);
  const bool last = (request[0] & last_bit) != 0;
  const std::size_t most = announced_.value_or(dictionary.capacity(mux_));
  if (choices_->entry_looked_at_late && data_.empty()) {
    if (const Accepted granted = rules_->granted(mux_, announced_); !granted) return refuse(granted.error());
  }

  if (choices_->unsized_refused_late && !announced_) return refuse(abort_code::length_too_high);
  data_.insert(data_.end(), request.begin() + 1, request.begin() + 1 + static_cast<std::ptrdiff_t>(count));
  if (!rules_->fits(data_.size(), most)) return refuse(abort_code::length_too_high);
  if (last) {
    if (const Accepted stored = store(); !stored) return refuse(stored.error());
    finished_ = true;
  }
  toggle_ = !toggle;
  return SdoData{static_cast<std::uint8_t>(toggle ? 0x30U : 0x20U)};
}

Accepted SegmentedDownload::store() const {
  if (announced_ && !rules_->complete(data_.size(), *announced_)) return refuse(abort_code::length_too_low);
  return rules_->store(mux_, data_);
}

}  // namespace refnode
