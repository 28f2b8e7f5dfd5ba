// SPDX-License-Identifier: Apache-2.0
// SDO abort codes by name, with their meaning in a few words (CiA 301, 7.2.4.3.17, table 22).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/strong.hpp"

namespace conform::canopen {

namespace abort {
inline constexpr AbortCode toggle_bit{0x0503'0000};
inline constexpr AbortCode timed_out{0x0504'0000};
inline constexpr AbortCode command_specifier{0x0504'0001};
inline constexpr AbortCode block_size{0x0504'0002};
inline constexpr AbortCode sequence_number{0x0504'0003};
inline constexpr AbortCode crc{0x0504'0004};
inline constexpr AbortCode out_of_memory{0x0504'0005};
inline constexpr AbortCode unsupported_access{0x0601'0000};
inline constexpr AbortCode write_only{0x0601'0001};  ///< attempt to read a write-only entry
inline constexpr AbortCode read_only{0x0601'0002};   ///< attempt to write a read-only entry
inline constexpr AbortCode no_object{0x0602'0000};
inline constexpr AbortCode not_mappable{0x0604'0041};
inline constexpr AbortCode pdo_length{0x0604'0042};
inline constexpr AbortCode parameter_incompatible{0x0604'0043};
inline constexpr AbortCode internal_incompatible{0x0604'0047};
inline constexpr AbortCode hardware{0x0606'0000};
inline constexpr AbortCode length_mismatch{0x0607'0010};
inline constexpr AbortCode length_too_high{0x0607'0012};
inline constexpr AbortCode length_too_low{0x0607'0013};
inline constexpr AbortCode no_sub_index{0x0609'0011};
inline constexpr AbortCode invalid_value{0x0609'0030};
inline constexpr AbortCode value_too_high{0x0609'0031};
inline constexpr AbortCode value_too_low{0x0609'0032};
inline constexpr AbortCode max_below_min{0x0609'0036};
inline constexpr AbortCode no_sdo_connection{0x060A'0023};
inline constexpr AbortCode general{0x0800'0000};
inline constexpr AbortCode cannot_store{0x0800'0020};
inline constexpr AbortCode local_control{0x0800'0021};
inline constexpr AbortCode device_state{0x0800'0022};
inline constexpr AbortCode no_dictionary{0x0800'0023};
inline constexpr AbortCode no_data{0x0800'0024};
}  // namespace abort

struct AbortName {
  AbortCode code;
  std::string_view meaning;
};

/// Every code of table 22 in ascending order; all others are reserved.
[[nodiscard]] std::span<const AbortName> abort_codes();
/// The meaning in a few words; empty for reserved codes.
[[nodiscard]] std::string_view meaning(AbortCode code);
/// "0609 0030h (invalid value)"; "1234 5678h (reserved code)".
[[nodiscard]] std::string describe(AbortCode code);

}  // namespace conform::canopen
