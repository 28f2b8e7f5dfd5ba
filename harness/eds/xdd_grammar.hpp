// SPDX-License-Identifier: Apache-2.0
// The structure of an XDD as data, in our own words.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace conform::eds {

struct XddChild {
  std::vector<std::string_view> names;  ///< one of these
  bool required = true;
  bool repeated = false;
};

/// The form of a value, as XML Schema names it.
enum class XddForm : std::uint8_t {
  text,
  boolean,   ///< true, false, 1, 0
  byte,      ///< decimal, to 255
  word,      ///< decimal, to 65535
  number,    ///< decimal
  hex,       ///< pairs of hexadecimal digits
  date,      ///< 2030-12-31
  time,      ///< 23:59:59
  bit_rate,  ///< 250 Kbps
  dummy,     ///< Dummy0005=1
  access,    ///< not rwr and rww; other words are for another rule
};
/// "decimal, 0 to 255", for messages.
[[nodiscard]] std::string_view to_string(XddForm form);

struct XddAttribute {
  std::string_view name;
  bool required = false;
  XddForm form = XddForm::text;
};

struct XddElement {
  std::string_view name;
  bool global = false;  ///< declared by itself: in the namespace of the schema; all others are in none
  bool closed = true;   ///< `children` is all of it
  std::vector<XddChild> children;
  std::vector<XddAttribute> attributes;
};

/// nullptr: nothing is known of it. A ProfileBody has two forms, the name of that for the network is
/// "ProfileBody/network".
[[nodiscard]] const XddElement* find_xdd_element(std::string_view name);

}  // namespace conform::eds
