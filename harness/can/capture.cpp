// SPDX-License-Identifier: Apache-2.0
#include "can/capture.hpp"

#include "base/check.hpp"
#include "can/capture_marks.hpp"

namespace conform::can {

void Capture::comment(std::size_t index, std::string_view text) {
  CONFORM_CHECK(index < frames_.size());
  auto& comment = frames_[index].comment;
  if (!comment.empty()) comment.append(between_comments);
  comment.append(text);
}

void Capture::continue_comment(std::size_t index, std::string_view end, std::string_view text) {
  CONFORM_CHECK(index < frames_.size());
  auto& comment = frames_[index].comment;
  if (comment.view().ends_with(end)) comment.append(text);
}

}  // namespace conform::can
