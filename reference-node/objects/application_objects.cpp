// SPDX-License-Identifier: Apache-2.0
#include "objects/application_objects.hpp"

namespace refnode {

namespace {

constexpr std::uint8_t digital_channels = 8;
constexpr std::uint8_t analog_channels = 2;
constexpr std::uint16_t digital_inputs = 0x6000;
constexpr std::uint16_t digital_outputs = 0x6200;
constexpr std::uint16_t analog_inputs = 0x6401;
constexpr std::uint16_t analog_outputs = 0x6411;
constexpr std::uint16_t wide_analog_inputs = 0x6402;
constexpr std::uint16_t wide_analog_outputs = 0x6412;

void copy(ObjectDictionary& od, std::uint16_t from, std::uint16_t to, std::uint8_t sub) {
  const Entry* output = od.entry(from, sub);
  Entry* input = od.entry(to, sub);
  if (output != nullptr && input != nullptr) input->value = output->value;
}

void add_channels(Device& device, std::uint16_t inputs, std::uint16_t outputs, std::uint8_t count,
                  DataType type, const std::function<void()>& changed) {
  ObjectDictionary* od = &device.dictionary;
  od->add_complex(inputs, "Inputs", ObjectKind::array);
  od->add_complex(outputs, "Outputs", ObjectKind::array);
  for (std::uint8_t sub = 1; sub <= count; ++sub) {
    od->add_sub(inputs, sub, integer_entry("Input", type, Access::ro, 0)).tx_mappable = true;
    Entry& output = od->add_sub(outputs, sub, integer_entry("Output", type, Access::rw, 0));
    output.rx_mappable = true;
    output.written = [od, inputs, outputs, sub, changed] {
      copy(*od, outputs, inputs, sub);
      changed();
    };
  }
}

}  // namespace

void add_application_objects(Device& device, const std::function<void()>& changed) {
  ObjectDictionary& od = device.dictionary;
  add_channels(device, digital_inputs, digital_outputs, digital_channels, DataType::unsigned8, changed);
  add_channels(device, analog_inputs, analog_outputs, analog_channels, DataType::integer16, changed);
  add_channels(device, wide_analog_inputs, wide_analog_outputs, analog_channels, DataType::integer32,
               changed);

  od.add_complex(0x6206, "Error mode of digital outputs", ObjectKind::array);
  od.add_complex(0x6207, "Error value of digital outputs", ObjectKind::array);
  for (std::uint8_t sub = 1; sub <= digital_channels; ++sub) {
    od.add_sub(0x6206, sub, integer_entry("Error mode", DataType::unsigned8, Access::rw, 0xFF));
    od.add_sub(0x6207, sub, integer_entry("Error value", DataType::unsigned8, Access::rw, 0));
  }
}

void report_changes(Device& device, const std::function<void()>& changed) {
  constexpr std::uint16_t first_application_object = 0x2000;
  for (auto& [index, object] : device.dictionary.objects()) {
    if (index < first_application_object) continue;
    for (auto& [sub, entry] : object.entries) {
      const bool writable = entry.rx_mappable || entry.access == Access::rw || entry.access == Access::wo;
      if (entry.tx_mappable && writable) entry.written = changed;
    }
  }
}

void mirror_outputs(ObjectDictionary& od) {
  for (std::uint8_t sub = 1; sub <= digital_channels; ++sub) copy(od, digital_outputs, digital_inputs, sub);
  for (std::uint8_t sub = 1; sub <= analog_channels; ++sub) copy(od, analog_outputs, analog_inputs, sub);
  for (std::uint8_t sub = 1; sub <= analog_channels; ++sub)
    copy(od, wide_analog_outputs, wide_analog_inputs, sub);
}

}  // namespace refnode
