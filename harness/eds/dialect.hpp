// SPDX-License-Identifier: Apache-2.0
// What EDS and DCF (CiA 306) and XDD and XDC (CiA 311) can say, and how they say the same in other words.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "eds/eds.hpp"

namespace conform::eds {

/// How the text behind a key is meant.
enum class Meaning : std::uint8_t {
  number,  ///< no data type
  flag,    ///< 0 or 1; nothing is 0
  count,   ///< a number; nothing is 0
  text,
  word,   ///< a word in whatever case
  date,   ///< file_date.hpp
  time,   ///< file_date.hpp
  value,  ///< of the data type of its entry
  access,
  mapping,
};

/// Of a key of CiA 306, spelled as in the tables of eds.hpp.
[[nodiscard]] Meaning meaning_of(std::string_view key);

/// CiA 311 has no attribute or element for this key.
[[nodiscard]] bool only_in_ini(std::string_view key);

/// Bit rates (kbit/s) that have a key in [DeviceInfo].
[[nodiscard]] bool is_ini_bit_rate(std::uint64_t rate);
/// Bit rates (kbit/s) that have a value of supportedBaudRate.
[[nodiscard]] bool is_xml_bit_rate(std::uint64_t rate);

/// Into which PDOs an entry may be mapped.
struct Directions {
  bool rpdo = false;
  bool tpdo = false;
  [[nodiscard]] bool any() const { return rpdo || tpdo; }
  friend constexpr bool operator==(const Directions&, const Directions&) = default;
};

/// Access and mapping in one vocabulary: `rw` that CiA 311 maps in one direction is what CiA 306 calls `rwr`
/// or `rww`, and what CiA 306 maps goes where its access leaves a way.
struct Reach {
  std::optional<Access> access;  ///< nullopt: not said, or in no known word
  Directions mapped;
  friend constexpr bool operator==(const Reach&, const Reach&) = default;
};
[[nodiscard]] Reach reach(const Entry& entry);
/// What PDOMapping=1 means by CiA 306 with this access.
[[nodiscard]] Directions directions_of(std::optional<Access> access);

/// ObjectType, PDOMapping, ObjFlags and of a DOMAIN DataType and AccessType: what an entry means that is not
/// there. Empty: nothing.
[[nodiscard]] std::string_view implied_meaning(std::string_view key, const Entry& entry);

}  // namespace conform::eds
