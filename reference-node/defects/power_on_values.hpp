// SPDX-License-Identifier: Apache-2.0
// Defects of what a reset brings back: entries that are not stored, or not as they were.
#pragma once

#include <cstdint>
#include <utility>

#include "defects/hooks.hpp"

namespace refnode::defect {

/// Entries for which `left_out` holds are no parameters to 1010h.
[[nodiscard]] inline DictionaryEdit leaves_out(bool (*left_out)(std::uint16_t index, std::uint8_t sub)) {
  return [left_out](ObjectDictionary& od, std::uint8_t) {
    for (auto& [index, object] : od.objects()) {
      for (auto& [sub, entry] : object.entries) {
        if (left_out(index, sub)) entry.storable = false;
      }
    }
  };
}

/// What was stored comes back otherwise with reset node.
[[nodiscard]] inline Change comes_back(void (*otherwise)(std::uint16_t index, const Entry& entry,
                                                         Bytes& value)) {
  return [otherwise](Parts& parts) {
    parts.nmt.on_reset = [&parts, otherwise, former = parts.nmt.on_reset](Reset reset) {
      former(reset);
      if (reset != Reset::node) return;
      for (auto& [index, object] : parts.device.dictionary.objects()) {
        for (auto& [sub, entry] : object.entries) {
          const bool writable = entry.access == Access::rw || entry.access == Access::wo;
          if (writable && !entry.command && entry.value != entry.default_value)
            otherwise(index, entry, entry.value);
        }
      }
    };
  };
}

}  // namespace refnode::defect
