// SPDX-License-Identifier: Apache-2.0
// The process image (6000h-9FFFh): inputs that repeat the outputs, so that a bus alone can change what a TPDO
// sends.
#pragma once

#include <functional>

#include "device/device.hpp"

namespace refnode {

/// `changed` is called after an output, and with it an input, has a new value.
void add_application_objects(Device& device, const std::function<void()>& changed);
/// In a dictionary that was described: calls `changed` after anything that a TPDO may hold has been written.
void report_changes(Device& device, const std::function<void()>& changed);
/// Copies all outputs to the inputs, after power-on values have been loaded.
void mirror_outputs(ObjectDictionary& dictionary);

}  // namespace refnode
