// SPDX-License-Identifier: Apache-2.0
#include "objects/standard_objects.hpp"

namespace refnode {

void add_identity_objects(Device& device) {
  ObjectDictionary& od = device.dictionary;
  // CiA 401, digital and analog inputs and outputs; the profile makes the pre-defined connection set apply.
  od.add_variable(0x1000, integer_entry("Device type", DataType::unsigned32, Access::ro, 0x000F0191));
  od.add_variable(0x1002, integer_entry("Manufacturer status register", DataType::unsigned32, Access::ro, 0));
  od.add_variable(0x1008, text_entry("Manufacturer device name", Access::constant, "canopen-refnode"));
  od.add_variable(0x1009,
                  text_entry("Manufacturer hardware version", Access::constant, "none (software device)"));
  od.add_variable(0x100A, text_entry("Manufacturer software version", Access::constant, "1.00"));
  od.add_complex(0x1018, "Identity object", ObjectKind::record);
  od.add_sub(0x1018, 1, integer_entry("Vendor-ID", DataType::unsigned32, Access::ro, 0x00005AFE));
  od.add_sub(0x1018, 2, integer_entry("Product code", DataType::unsigned32, Access::ro, 0x00000301));
  od.add_sub(0x1018, 3, integer_entry("Revision number", DataType::unsigned32, Access::ro, 0x00010000));
  od.add_sub(0x1018, 4, integer_entry("Serial number", DataType::unsigned32, Access::ro, 0x00000001));
  od.add_complex(0x1200, "SDO server parameter", ObjectKind::record);
  od.add_sub(0x1200, 1, cob_id_entry("COB-ID client -> server", Access::ro, 0x600, device.node_id));
  od.add_sub(0x1200, 2, cob_id_entry("COB-ID server -> client", Access::ro, 0x580, device.node_id));
}

}  // namespace refnode
