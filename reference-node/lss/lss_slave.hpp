// SPDX-License-Identifier: Apache-2.0
// LSS slave (CiA 305): node-ID and bit rate are set by a master that knows nothing of the device but its LSS
// address, the four numbers of 1018h. Requests come on CAN-ID 7E5h, answers go out on 7E4h; both have eight
// bytes, the first of them the command specifier.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "device/device.hpp"
#include "lss/address_checks.hpp"

namespace refnode {

/// What a slave may do otherwise: services it does without, and what older versions of CiA 305 had.
struct LssChoices {
  bool supported = true;
  bool store = true;                    ///< 17h; else it is refused with error code 1
  bool bit_timing = true;               ///< 13h and 15h; else they are not answered
  bool identify_remote_slave = true;    ///< 46h to 4Bh
  bool identify_non_configured = true;  ///< 4Ch
  bool fastscan = true;                 ///< 51h
  bool node_id_fixed = false;           ///< by switches: 11h is refused with error code FFh
  bool bit_rate_fixed = false;          ///< by switches: 13h is refused with error code FFh
  bool few_bit_rates = false;           ///< 125 kbit/s and more; others of the table have error code FFh
  bool can_be_unconfigured = true;      ///< 11h takes FFh
  /// A new node-ID is active as soon as the configuration state is left, not with the next reset
  /// communication.
  bool node_id_at_once = false;
  bool state_survives_reset = false;  ///< the LSS state machine knows nothing of NMT
  bool address_in_any_order = false;  ///< the four parts of a switch state selective are collected
};

struct LssRules {
  Rule<bool(const Frame&)> is_request;       ///< eight bytes on CAN-ID 7E5h
  Rule<bool(std::uint8_t)> node_id_allowed;  ///< 1 to 127, and FFh where a node-ID can be missing
  /// Table 0 has the rates 1000, 800, 500, 250, 125, (reserved), 50, 20 and 10 kbit/s, by index.
  Rule<bool(std::uint8_t table, std::uint8_t index)> bit_rate_allowed;
  Rule<std::uint32_t(std::uint8_t part)> address;  ///< the slave's own: 1018h:01 to 04
  Rule<bool(const Frame& answered)> configured;    ///< takes no part in fastscan, nor answers 4Ch
  Rule<std::uint8_t(std::uint8_t active, std::uint8_t pending)> after_reset_communication;
};

class LssSlave {
 public:
  static constexpr std::uint8_t no_node_id = 0xFF;

  explicit LssSlave(Device& device);
  LssSlave(const LssSlave&) = delete;
  LssSlave& operator=(const LssSlave&) = delete;

  LssChoices choices;
  LssRules rules;
  LssAddressRules address_rules;

  /// What is kept without power; the memory belongs to somebody else.
  std::function<std::optional<std::uint8_t>()> stored_node_id;
  std::function<bool(std::uint8_t node_id, std::optional<std::uint8_t> bit_rate)> keep;
  /// The device has got a node-ID that it begins to work with now.
  std::function<void()> on_node_id;

  /// A data frame; true when it was for LSS.
  bool on_frame(const Frame& frame);
  /// The node-ID that is in force from this reset on. `whole_node`: as after power-on.
  [[nodiscard]] std::uint8_t on_reset(bool whole_node);

 private:
  enum class State : std::uint8_t { waiting, configuration };
  using Request = std::array<std::uint8_t, 8>;

  void obey(const Frame& frame);
  void switch_global(std::uint8_t mode);
  void switch_selective(const Request& request);
  void configure(const Request& request);
  void configure_node_id(std::uint8_t node_id);
  void configure_bit_timing(std::uint8_t table, std::uint8_t index);
  void store();
  void identify(const Request& request);
  void scan(const Request& request);
  void enter(State state);
  void answer(std::uint8_t specifier, std::uint8_t error = 0, std::uint8_t detail = 0);
  void answer_number(std::uint8_t specifier, std::uint32_t number);

  Device* device_;
  State state_ = State::waiting;
  std::uint8_t delivered_;  ///< node-ID as long as none is stored
  std::uint8_t pending_;
  std::optional<std::uint8_t> bit_rate_;
  SelectiveAddress selective_;
  IdentityRange range_;
  Fastscan fastscan_;
};

}  // namespace refnode
