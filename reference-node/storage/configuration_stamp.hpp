// SPDX-License-Identifier: Apache-2.0
// Date and time of the configuration (1020h, CiA 301, 7.5.2.23). They stand for what is stored: another
// configuration without a new stamp sets them to 0, in the memory too.
#pragma once

#include "device/device.hpp"
#include "storage/memory.hpp"

namespace refnode {

struct StampRules {
  /// Whether what is in the memory means the same configuration as what was there: every entry has the same
  /// value after a reset, 1020h itself left aside.
  Rule<bool(const Images& former, const Images& images)> same_configuration;
  explicit StampRules(const ObjectDictionary& dictionary);
};

class ConfigurationStamp {
 public:
  explicit ConfigurationStamp(Device& device) : rules(device.dictionary), device_(&device) {}

  StampRules rules;

  /// 1020h
  void add_objects();
  void bind();

  void on_reset() { renewed_ = false; }
  /// Storing turns `former` into `images`: takes the stamp out of them when it no longer fits. True when the
  /// entries have to be cleared as well, once the memory has taken the images.
  [[nodiscard]] bool before_storing(const Images& former, Images& images, bool stamp_is_stored) const;
  /// The same for the defaults: what is left in the memory has another application configuration.
  void before_restoring(const Images& former, Images& images) const;
  void after_storing(bool clear, bool stamp_is_stored);

 private:
  Device* device_;
  bool renewed_ = false;  ///< written since it was stored
};

}  // namespace refnode
