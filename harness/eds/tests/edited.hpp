// SPDX-License-Identifier: Apache-2.0
// Edits of the text of an EDS or DCF, as the tables of the tests write them (lint_matrix.txt says how).
#pragma once

#include <string>
#include <string_view>

namespace conform::eds {

/// `text` with the edits, joined by " && ", applied in their order. "=" changes nothing. Throws
/// std::runtime_error where an edit finds nothing to change.
[[nodiscard]] std::string edited(std::string text, std::string_view edits);

}  // namespace conform::eds
