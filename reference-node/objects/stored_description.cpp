// SPDX-License-Identifier: Apache-2.0
#include "objects/stored_description.hpp"

#include <string>

namespace refnode {

namespace {

constexpr std::uint64_t plain_text = 0x00;  // 01h-7Fh are reserved, 80h-FFh the manufacturer's

}  // namespace

void add_stored_description(Device& device,
                            std::string (*text)(const ObjectDictionary&, std::uint8_t node_id)) {
  ObjectDictionary& od = device.dictionary;
  od.add_variable(0x1021, bytes_entry("Store EDS", DataType::domain, Access::ro, {})).read =
      [&device, text]() -> Upload {
    const std::string made = text(device.dictionary, device.node_id);
    return Bytes(made.begin(), made.end());
  };
  od.add_variable(0x1022, integer_entry("Store format", DataType::unsigned16, Access::ro, plain_text));
}

}  // namespace refnode
