// SPDX-License-Identifier: Apache-2.0
// Whether an XDD is built as CiA 311 (version 1.1, annex A) wants it: elements, their order and number,
// attributes, the form of values, namespaces.
#pragma once

#include <pugixml.hpp>

#include "eds/position.hpp"
#include "eds/xml_text.hpp"

namespace conform::eds {

/// Remarks what is not; `root` is the ISO15745ProfileContainer, of a depth that a recursion can follow.
/// Version 1.0 of the schema was never public enough to be described here: of files that name it, or none,
/// only the values are looked at. Lists of LEDs, functions and data types are not looked into.
void check_xdd_structure(const pugi::xml_node& root, const XmlText& text, Remarks& remarks);

}  // namespace conform::eds
