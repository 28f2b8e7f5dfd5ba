// SPDX-License-Identifier: Apache-2.0
// What no frame tells, as comments of frames: which case and step a frame belongs to, and what happened
// between two frames. A capture can be judged and replayed like the run by them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace conform::can {

/// The harness switched the power of the device off and on; the start that follows was not its own.
inline constexpr std::string_view power_was_switched =
    "the power of the device was switched before this frame";

/// From here on the run looks after the device as a whole; nothing belongs to a case any more.
inline constexpr std::string_view cases_are_over = "the cases are over";

/// What separates the marks of one frame, see Capture::comment().
inline constexpr std::string_view between_comments = "; ";

/// The part of a case that begins with a frame.
enum class CasePart : std::uint8_t {
  preparation,   ///< the baseline that the case begins in
  begin,         ///< the first frame of the case
  step,          ///< the first own frame of a step; where it sends nothing, the first that came
  cleanup,       ///< the same of a step that only tidies up
  end,           ///< the last frame of the case
  putting_back,  ///< what the case changed is put back
};

struct CaseMark {
  std::string name;  ///< of the case
  CasePart part = CasePart::begin;
  std::size_t number = 0;  ///< of the step, from 1 in the order in which they were carried out; 0: not a step
  std::string words{};     ///< of the step; may be empty
};

/// "case cia301/sdo/upload/basic[1000h:00] step 2: upload 1000h:00"
[[nodiscard]] std::string to_comment(const CaseMark& mark);
/// One mark; nullopt: the text is none.
[[nodiscard]] std::optional<CaseMark> parse_case_mark(std::string_view text);
/// Every mark in the comment of a frame, in their order.
[[nodiscard]] std::vector<CaseMark> case_marks(std::string_view comment);

}  // namespace conform::can
