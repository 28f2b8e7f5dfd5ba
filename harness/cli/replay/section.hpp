// SPDX-License-Identifier: Apache-2.0
// Which frames of a capture belong to a case, by the comments that the run left in it.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "can/capture.hpp"

namespace conform::cli {

/// Frames [first, end) of a capture.
struct Section {
  std::size_t first = 0;
  std::size_t end = 0;
  std::string name;  ///< "case cia301/sdo/upload/basic[1000h:00]", "frames 120 to 180"
  /// What the capture does not hold of the case, or may not: "it does not tell where the case ends: ...".
  std::vector<std::string> missing{};
};

/// The names of the cases of which the capture tells where they begin, in their order, each once.
[[nodiscard]] std::vector<std::string> cases_in(std::span<const can::CapturedFrame> frames);

/// What the harness did for the case: its preparation, its steps, and what was put back behind it. Where the
/// case was tried more than once, the last time. Of one that is there in part, or may be, `missing` tells
/// what is not. Error: the capture does not tell of the case (`where` names the file).
[[nodiscard]] Result<Section> section_of_case(std::span<const can::CapturedFrame> frames,
                                              std::string_view name, const std::string& where);

/// "120-180": numbers as Wireshark counts, from 1, both included. Error: no range, or not within the capture.
[[nodiscard]] Result<Section> section_of_numbers(std::span<const can::CapturedFrame> frames,
                                                 std::string_view range, const std::string& where);

}  // namespace conform::cli
