// SPDX-License-Identifier: Apache-2.0
// One runner per interface: two of them would take each other's frames for the device's.
#pragma once

#include <string>

#include "base/error.hpp"
#include "can/descriptor.hpp"

namespace conform::can {

/// Held as long as it lives; the kernel frees it when the process ends, however that happens.
class InterfaceLock {
 public:
  /// Error: there is no such interface, or another runner of this host has it.
  [[nodiscard]] static Result<InterfaceLock> take(const std::string& interface_name);

 private:
  explicit InterfaceLock(Descriptor socket) : socket_(std::move(socket)) {}
  Descriptor socket_;
};

}  // namespace conform::can
