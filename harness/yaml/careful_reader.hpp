// SPDX-License-Identifier: Apache-2.0
// The long way, with words for what is wrong in a file.
#pragma once

#include <optional>

#include "yaml/diagnostic.hpp"
#include "yaml/node.hpp"
#include "yaml/source.hpp"

namespace conform::yaml {

/// The tree of a text that has passed check_text(), read by yaml-cpp: as load(). yaml-cpp and its exceptions
/// do not leave this file.
[[nodiscard]] std::optional<Node> read_carefully(const Source& source, Diagnostics& diagnostics);

}  // namespace conform::yaml
