// SPDX-License-Identifier: Apache-2.0
// The short way through a file in which nothing is wrong.
#pragma once

#include <optional>

#include "yaml/diagnostic.hpp"
#include "yaml/node.hpp"
#include "yaml/source.hpp"

namespace conform::yaml {

/// The tree of a text that has passed check_text(), read by libyaml in an eighth of the time that yaml-cpp
/// takes. Nothing when there is anything to say of the text, be it a warning: yaml-cpp knows better what is
/// wrong and where, and the words for it are made from what it says. What lands in `scratch` until then is
/// not to be shown.
[[nodiscard]] std::optional<Node> read_quickly(const Source& source, Diagnostics& scratch);

}  // namespace conform::yaml
