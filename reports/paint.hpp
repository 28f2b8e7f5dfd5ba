// SPDX-License-Identifier: Apache-2.0
// Colours of the terminal writers. What a colour says is always said in words as well.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "reports/console.hpp"

namespace conform::reports {

enum class Ink : std::uint8_t { plain, strong, dim, good, doubtful, bad, unsure, hint };

/// `text` between the escape sequences of `ink`, or as it is.
[[nodiscard]] inline std::string paint(std::string_view text, Ink ink, const Style& style) {
  if (!style.colour || ink == Ink::plain || text.empty()) return std::string(text);
  std::string_view code;
  switch (ink) {
    case Ink::plain: break;
    case Ink::strong: code = "1"; break;
    case Ink::dim: code = "2"; break;
    case Ink::good: code = "32"; break;
    case Ink::doubtful: code = "33"; break;
    case Ink::bad: code = "1;31"; break;
    case Ink::unsure: code = "35"; break;
    case Ink::hint: code = "36"; break;
  }
  return "\x1B[" + std::string(code) + "m" + std::string(text) + "\x1B[0m";
}

[[nodiscard]] inline Ink ink_of(result::Verdict verdict) {
  switch (verdict) {
    case result::Verdict::not_applicable: return Ink::dim;
    case result::Verdict::pass: return Ink::good;
    case result::Verdict::waived:
    case result::Verdict::warn: return Ink::doubtful;
    case result::Verdict::inconclusive: return Ink::unsure;
    case result::Verdict::error: return Ink::unsure;
    case result::Verdict::fail: return Ink::bad;
  }
  return Ink::plain;
}

}  // namespace conform::reports
