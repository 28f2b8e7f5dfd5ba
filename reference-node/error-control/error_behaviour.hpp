// SPDX-License-Identifier: Apache-2.0
// What a communication error does to the NMT state (1029h, CiA 301, 7.5.2.32).
#pragma once

#include "device/device.hpp"
#include "nmt/nmt_slave.hpp"

namespace refnode {

class ErrorBehaviour {
 public:
  ErrorBehaviour(Device& device, NmtSlave& nmt) : device_(&device), nmt_(&nmt) {}

  /// 1029h
  void add_objects();

  /// A heartbeat that stayed away. Without 1029h the default behaviour applies.
  void on_communication_error();

 private:
  Device* device_;
  NmtSlave* nmt_;
};

}  // namespace refnode
