// SPDX-License-Identifier: Apache-2.0
// What a device description says, in the terms of a device: values as wire bytes of a data type, access
// rights.
#pragma once

#include <string_view>

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "canopen/data_type.hpp"
#include "device/dictionary.hpp"
#include "eds/eds.hpp"

namespace conform::device {

struct DescribedValue {
  Bytes bytes;
  bool adds_node_id = false;  ///< $NODEID formula: `bytes` is the constant part
};

/// "0x10", "16", "020", "-5", "0xFFFB" as INTEGER16, "$NODEID+0x180", "1.5", "0x3FC00000" as REAL32, text,
/// "01 A0". Error: no value of that type, with the reason in plain words.
[[nodiscard]] Result<DescribedValue> read_described_value(canopen::DataType type, std::string_view text);

[[nodiscard]] Access access_of(eds::Access access);

}  // namespace conform::device
