// SPDX-License-Identifier: Apache-2.0
#include "can/capture.hpp"

#include "base/check.hpp"
#include "can/capture_marks.hpp"

namespace conform::can {

void Capture::comment(std::size_t index, std::string text) {
  CONFORM_CHECK(index < frames_.size());
  auto& comment = frames_[index].comment;
  if (!comment.empty()) text.insert(0, comment + std::string(between_comments));
  comment = std::move(text);
}

void Capture::continue_comment(std::size_t index, std::string_view end, std::string_view text) {
  CONFORM_CHECK(index < frames_.size());
  if (frames_[index].comment.ends_with(end)) frames_[index].comment += text;
}

}  // namespace conform::can
