// SPDX-License-Identifier: Apache-2.0
#include "objects/stored_description.hpp"

#include <string>

#include "objects/eds_text.hpp"

namespace refnode {

namespace {

constexpr std::uint64_t plain_text = 0x00;  // 01h-7Fh are reserved, 80h-FFh the manufacturer's

// Made once, at the first upload: the text is that of the conformant node and so the same for all nodes.
const Bytes& description() {
  static const Bytes bytes = [] {
    const std::string text = eds_text();
    return Bytes(text.begin(), text.end());
  }();
  return bytes;
}

}  // namespace

void add_stored_description(Device& device) {
  ObjectDictionary& od = device.dictionary;
  od.add_variable(0x1021, bytes_entry("Store EDS", DataType::domain, Access::ro, {})).read = []() -> Upload {
    return description();
  };
  od.add_variable(0x1022, integer_entry("Store format", DataType::unsigned16, Access::ro, plain_text));
}

}  // namespace refnode
