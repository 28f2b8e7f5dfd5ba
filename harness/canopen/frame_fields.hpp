// SPDX-License-Identifier: Apache-2.0
// The fields of a frame by their names, for who compares two frames and wants to hear what differs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "can/frame.hpp"

namespace conform::canopen {

struct FrameField {
  std::string name;   ///< "abort code"
  std::string value;  ///< "0609 0030h (invalid value)"
  friend bool operator==(const FrameField&, const FrameField&) = default;
};

/// All bytes of the frame, each in one field, in their order. `meaning` is what Decoder says of the frame: of
/// a segment of a block transfer only the frames before it tell that it is one. What has no fields that are
/// known here is told byte by byte.
[[nodiscard]] std::vector<FrameField> fields_of(const can::Frame& frame, std::string_view meaning);

struct FieldDifference {
  std::string name, before, after;  ///< a value is empty where the frame has no such field
  friend bool operator==(const FieldDifference&, const FieldDifference&) = default;
};
/// By the names of the fields, in their order; those of `before` first. Empty: all are the same.
[[nodiscard]] std::vector<FieldDifference> differences(const std::vector<FrameField>& before,
                                                       const std::vector<FrameField>& after);

}  // namespace conform::canopen
