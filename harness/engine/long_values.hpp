// SPDX-License-Identifier: Apache-2.0
// What long entries held when they were last read or written. A device description of 40 kB takes seconds to
// read: before a write that the device most likely refuses it is not read again only to be put back.
#pragma once

#include <map>

#include "base/bytes.hpp"
#include "base/strong.hpp"
#include "canopen/sdo_client.hpp"

namespace conform::engine {

class LongValues {
 public:
  /// From this size on a value is worth remembering, in bytes.
  static constexpr std::size_t least = canopen::least_long_value;

  /// The device has told or confirmed `value`.
  void note(Multiplexer object, const Bytes& value) {
    if (value.size() >= least && value.size() <= most) {
      values_.insert_or_assign(object, value);
    } else {
      values_.erase(object);
    }
  }
  /// Something may have changed it that nobody followed.
  void forget(Multiplexer object) { values_.erase(object); }
  /// The device is given another program.
  void forget() { values_.clear(); }
  /// The device starts or restores: what can be written may have another value.
  template <typename Writable>
  void forget_if(Writable writable) {
    std::erase_if(values_, [&](const auto& each) { return writable(each.first); });
  }
  /// nullptr: not known.
  [[nodiscard]] const Bytes* find(Multiplexer object) const {
    const auto found = values_.find(object);
    return found == values_.end() ? nullptr : &found->second;
  }

 private:
  static constexpr std::size_t most = 1U << 20U;
  std::map<Multiplexer, Bytes> values_;
};

}  // namespace conform::engine
