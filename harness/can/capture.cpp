// SPDX-License-Identifier: Apache-2.0
#include "can/capture.hpp"

#include "base/check.hpp"

namespace conform::can {

void Capture::comment(std::size_t index, std::string text) {
  CONFORM_CHECK(index < frames_.size());
  auto& comment = frames_[index].comment;
  comment = comment.empty() ? std::move(text) : comment + "; " + text;
}

}  // namespace conform::can
