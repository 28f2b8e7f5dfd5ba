// SPDX-License-Identifier: Apache-2.0
#include "emergency/trigger.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

namespace refnode {

namespace {

/// Whether a code belongs to a class of CiA 301, table 26.
bool known_class(std::uint16_t code) {
  constexpr std::uint8_t classes[] = {0x10, 0x20, 0x21, 0x22, 0x23, 0x30, 0x31, 0x32, 0x33, 0x40, 0x41, 0x42,
                                      0x50, 0x60, 0x61, 0x62, 0x63, 0x70, 0x80, 0x81, 0x82, 0x90, 0xF0, 0xFF};
  return std::ranges::find(classes, code >> 8U) != std::end(classes);
}

}  // namespace

void add_error_trigger(Device& device, const Emergency& emergency) {
  ObjectDictionary& od = device.dictionary;
  od.add_complex(0x2F00, "Error trigger", ObjectKind::record);

  Entry& raise = od.add_sub(0x2F00, 1, integer_entry("Raise error", DataType::unsigned16, Access::wo, 0));
  raise.command = true;
  raise.check = [errors = &device.errors](ByteView bytes) -> Accepted {
    const auto code = static_cast<std::uint16_t>(conform::load_le(bytes));
    if (!known_class(code)) return refuse(abort_code::invalid_value);
    errors->raise({code, ErrorSource::application, 0}, 0);
    return {};
  };
  Entry& clear = od.add_sub(0x2F00, 2, integer_entry("Clear error", DataType::unsigned16, Access::wo, 0));
  clear.command = true;
  clear.check = [errors = &device.errors, &emergency](ByteView bytes) -> Accepted {
    const auto code = static_cast<std::uint16_t>(conform::load_le(bytes));
    std::vector<ErrorCause> gone;  // clearing one changes the list
    std::ranges::copy_if(emergency.active(), std::back_inserter(gone), [code](const ErrorCause& cause) {
      return cause.source == ErrorSource::application && (code == 0 || code == cause.code);
    });
    for (const ErrorCause& cause : gone) errors->clear(cause);
    return {};
  };
  Entry& active =
      od.add_sub(0x2F00, 3, integer_entry("Number of active errors", DataType::unsigned8, Access::ro, 0));
  active.read = [&emergency]() -> Upload {
    return Bytes{static_cast<std::uint8_t>(emergency.active().size())};
  };
}

}  // namespace refnode
