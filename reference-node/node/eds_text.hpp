// SPDX-License-Identifier: Apache-2.0
// The device description (EDS, CiA 306-1) of a node, made from its dictionary so that both agree.
#pragma once

#include <cstdint>
#include <string>

#include "dictionary/object_dictionary.hpp"

namespace refnode {

/// Of the conformant node. Independent of the node-ID: defaults that hold it are written as $NODEID+0x80.
[[nodiscard]] std::string eds_text();
/// Of a node with this dictionary.
[[nodiscard]] std::string eds_text(const ObjectDictionary& dictionary, std::uint8_t node_id);

}  // namespace refnode
