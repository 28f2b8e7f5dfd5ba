// SPDX-License-Identifier: Apache-2.0
// The file that a description is written to.
#pragma once

#include <optional>
#include <string>

#include "eds/eds.hpp"

namespace conform::cli {

/// By the word ("xdd"), else by the extension of the path, in whatever case; nullopt when neither is a
/// format.
[[nodiscard]] std::optional<eds::Format> target_format(const std::string& word, const std::string& path);

/// What the description says its file is called: `out` without its folders; for standard output ("-") that of
/// `in` with the extension of the format.
[[nodiscard]] std::string file_name_for(const std::string& out, const std::string& in, eds::Format format);

}  // namespace conform::cli
