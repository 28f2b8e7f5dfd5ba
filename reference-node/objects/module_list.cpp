// SPDX-License-Identifier: Apache-2.0
#include "objects/module_list.hpp"

namespace refnode {

void add_module_list(Device& device) {
  ObjectDictionary& od = device.dictionary;
  od.add_complex(0x1027, "Module list", ObjectKind::array);
  for (std::size_t i = 0; i < modules.size(); ++i) {
    od.add_sub(0x1027, static_cast<std::uint8_t>(i + 1),
               integer_entry("Module", DataType::unsigned16, Access::ro, modules[i].identifier));
  }
  // The number of modules may change in a modular device: read-only in place of constant.
  Entry& count = *od.entry(0x1027, 0);
  count.name = "Number of connected modules";
  count.access = Access::ro;
}

}  // namespace refnode
