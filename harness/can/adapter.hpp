// SPDX-License-Identifier: Apache-2.0
// What the driver of a CAN adapter tells about it (ethtool), for reports: a verdict about times is worth what
// the adapter is worth.
#pragma once

#include <string>

namespace conform::can {

/// Empty or false: the driver does not say.
struct AdapterFacts {
  std::string driver, version, firmware;
  std::string bus;                  ///< where it hangs: "0000:03:00.0", "usb-0000:00:14.0-2"
  bool has_hardware_clock = false;  ///< the adapter could stamp frames itself; the kernel's stamps are used
};

/// Of the interface; nothing where there is none of this name.
[[nodiscard]] AdapterFacts adapter_facts(const std::string& interface_name);

}  // namespace conform::can
