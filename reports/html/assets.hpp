// SPDX-License-Identifier: Apache-2.0
// report.css and report.js as the build has embedded them (embed.cmake). Nothing else on a page is obeyed:
// its policy names the hashes of these two.
#pragma once

#include <string_view>

namespace conform::reports::html {

extern const std::string_view style_text;
extern const std::string_view style_hash;  ///< SHA-256 in base64, without "sha256-"
extern const std::string_view script_text;
extern const std::string_view script_hash;

}  // namespace conform::reports::html
