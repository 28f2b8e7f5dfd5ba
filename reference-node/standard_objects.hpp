// SPDX-License-Identifier: Apache-2.0
// The communication objects 1000h-1200h with their defaults and rules.
#pragma once

#include "device.hpp"
#include "emergency.hpp"
#include "heartbeat.hpp"

namespace refnode {

void add_identity_objects(Device& device);
void add_error_objects(Device& device, Emergency& emergency);
void add_error_control_objects(Device& device, HeartbeatProducer& producer, HeartbeatConsumer& consumer);

}  // namespace refnode
