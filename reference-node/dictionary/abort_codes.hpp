// SPDX-License-Identifier: Apache-2.0
// SDO abort codes this device uses (CiA 301, 7.2.4.3.17). Written down here a second time on purpose: the
// device shares no protocol constant with the harness that judges it.
#pragma once

#include "base/strong.hpp"

namespace refnode::abort_code {

using conform::AbortCode;

inline constexpr AbortCode toggle_not_alternated{0x05030000};
inline constexpr AbortCode time_out{0x05040000};
inline constexpr AbortCode command_unknown{0x05040001};
inline constexpr AbortCode block_size_invalid{0x05040002};
inline constexpr AbortCode sequence_invalid{0x05040003};
inline constexpr AbortCode crc_wrong{0x05040004};
inline constexpr AbortCode unsupported_access{0x06010000};
inline constexpr AbortCode write_only{0x06010001};
inline constexpr AbortCode read_only{0x06010002};
inline constexpr AbortCode no_object{0x06020000};
inline constexpr AbortCode not_mappable{0x06040041};
inline constexpr AbortCode mapping_too_long{0x06040042};
inline constexpr AbortCode parameter_incompatible{0x06040043};
inline constexpr AbortCode hardware_error{0x06060000};
inline constexpr AbortCode length_mismatch{0x06070010};
inline constexpr AbortCode length_too_high{0x06070012};
inline constexpr AbortCode length_too_low{0x06070013};
inline constexpr AbortCode no_sub_index{0x06090011};
inline constexpr AbortCode invalid_value{0x06090030};
inline constexpr AbortCode value_too_high{0x06090031};
inline constexpr AbortCode value_too_low{0x06090032};
inline constexpr AbortCode general_error{0x08000000};
inline constexpr AbortCode cannot_store{0x08000020};
inline constexpr AbortCode device_state{0x08000022};
inline constexpr AbortCode no_data{0x08000024};

}  // namespace refnode::abort_code
