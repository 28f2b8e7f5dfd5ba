// SPDX-License-Identifier: Apache-2.0
// Text for roff: nothing in it is taken for a request or an escape.
#pragma once

#include <string>
#include <string_view>

namespace conform::usage {

/// Text that is read; of UTF-8, what is not ASCII as \[uXXXX].
[[nodiscard]] std::string roff_text(std::string_view text);
/// Text that is typed: dashes and quotes as the keyboard has them.
[[nodiscard]] std::string roff_literal(std::string_view text);

[[nodiscard]] inline std::string roff_bold(std::string_view text) {
  return "\\fB" + roff_literal(text) + "\\fR";
}
[[nodiscard]] inline std::string roff_italic(std::string_view text) {
  return "\\fI" + roff_literal(text) + "\\fR";
}

}  // namespace conform::usage
