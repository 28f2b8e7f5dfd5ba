// SPDX-License-Identifier: Apache-2.0
// Storing (1010h), restoring (1011h) and the power-on values (CiA 301, 7.5.2.13, 7.5.2.14, 7.3.2.2.1).
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "device/device.hpp"
#include "storage/configuration_stamp.hpp"
#include "storage/memory.hpp"

namespace refnode {

struct StoreChoices {
  AbortCode wrong_signature = abort_code::cannot_store;
  bool storing_needs_pre_operational = false;  ///< 0800 0022h in Operational
  /// Of a device that stores without a command: it waits for the last of several writes, since each wears the
  /// memory.
  Duration rest_before_storing = std::chrono::seconds(4);
};

/// The power-on values (7.3.2.2.1).
struct PowerOnRules {
  /// Reset node gives all groups their power-on values, reset communication 1000h-1FFFh.
  Rule<bool(Group, bool whole_node)> reset_loads;
  /// They are the values stored last; while nothing is stored, the defaults.
  Rule<bool(const Images&, Group)> stored_values;
  PowerOnRules();
};

class ParameterStore {
 public:
  ParameterStore(Device& device, std::shared_ptr<Storage> storage);
  ParameterStore(const ParameterStore&) = delete;
  ParameterStore& operator=(const ParameterStore&) = delete;

  StoreChoices choices;
  PowerOnRules rules;
  ConfigurationStamp stamp;
  std::shared_ptr<Storage> memory;  ///< what is kept without power

  /// 1010h and 1011h, and 2F20h that makes them fail.
  void add_objects();
  /// Puts the service behind the entries of 1010h and 1011h.
  void bind();
  /// Gives the parameters their stored or default values: all of them, or with reset communication
  /// 1000h-1FFFh.
  void load_power_on_values(bool whole_node);

  /// What LSS stores: node-ID and bit rate (CiA 305). False: the memory failed.
  [[nodiscard]] bool store_layer_setting(std::uint8_t node_id, std::optional<std::uint8_t> bit_rate);
  [[nodiscard]] std::optional<std::uint8_t> stored_node_id() const;

  void on_time();
  [[nodiscard]] std::optional<BusTime> next_wakeup() const { return store_at_; }

 private:
  /// Takes the present values of these groups into the memory, and 1020h with them where it has to go.
  [[nodiscard]] Accepted store(const std::vector<Group>& groups);
  /// Makes `images` the content of the memory. Fails while the storage fault (2F20h) is armed.
  [[nodiscard]] Accepted keep(Images images);
  [[nodiscard]] Entry* storage_fault() const;
  [[nodiscard]] Accepted save(std::uint8_t sub, ByteView signature);
  [[nodiscard]] Accepted restore(std::uint8_t sub, ByteView signature);
  /// The values to store; what is not stored now keeps the value of `former`.
  [[nodiscard]] Image image_of(Group group, const Image& former) const;
  void load(Group group);
  /// What is stored without a command: of each sub-index of 1010h with bit 1 (7.5.2.13).
  [[nodiscard]] std::vector<Group> stored_autonomously() const;
  /// What is written is stored without a command, when no more is written for a while.
  void store_soon(Multiplexer mux);

  Device* device_;
  std::optional<BusTime> store_at_;  ///< something of them has been written; a reset forgets it
  std::set<Group> restored_;  ///< their defaults wait for the reset: not stored without a command until then
};

}  // namespace refnode
