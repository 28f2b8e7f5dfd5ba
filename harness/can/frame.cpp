// SPDX-License-Identifier: Apache-2.0
#include "can/frame.hpp"

#include "base/check.hpp"

namespace conform::can {

Frame data_frame(CanId id, ByteView bytes) {
  CONFORM_CHECK(bytes.size() <= 8);
  Frame frame;
  frame.id = id.value();
  frame.dlc = static_cast<std::uint8_t>(bytes.size());
  std::ranges::copy(bytes, frame.data.begin());
  return frame;
}

Frame remote_frame(CanId id, std::uint8_t dlc) {
  Frame frame;
  frame.id = id.value();
  frame.remote = true;
  frame.dlc = dlc;
  return frame;
}

}  // namespace conform::can
