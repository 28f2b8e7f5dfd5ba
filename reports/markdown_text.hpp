// SPDX-License-Identifier: Apache-2.0
// Text of others in a Markdown document, where it must not become markup.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace conform::reports {

/// Text of others between our marks: nothing in it is a heading, link, mention, HTML or the end of a table
/// cell.
[[nodiscard]] std::string escaped(std::string_view text, std::size_t width = 400);
/// A code span that holds anything: its fence is longer than every run of backticks in it.
[[nodiscard]] std::string code(std::string_view text);
/// A path as the target of a link: whatever could end it is percent-encoded.
[[nodiscard]] std::string link_target(std::string_view path);

}  // namespace conform::reports
