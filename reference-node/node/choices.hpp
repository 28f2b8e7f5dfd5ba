// SPDX-License-Identifier: Apache-2.0
// Where the standard leaves a device a choice: the same device, otherwise, and as conformant as by default.
// The rows of variants/ set these fields and say why it is legal.
#pragma once

#include <chrono>
#include <cstdint>

#include "dictionary/abort_codes.hpp"
#include "sdo/choices.hpp"

namespace refnode {

using conform::AbortCode;

/// Codes and freedoms of one COB-ID parameter. CiA 301 names no code for most refusals.
struct CobIdChoices {
  AbortCode frame_bit = abort_code::invalid_value;   ///< bit 29 in a device with base frames only
  AbortCode fixed_bit = abort_code::invalid_value;   ///< bit 30: cannot be produced, or reserved
  AbortCode upper_bits = abort_code::invalid_value;  ///< bits 28-11 of a base frame
  AbortCode locked = abort_code::invalid_value;      ///< another CAN-ID while the object exists
  AbortCode restricted = abort_code::invalid_value;  ///< CiA 301, table 40
  bool only_valid_bit = false;                       ///< bit 31 can be changed, the CAN-ID cannot
  bool restricted_always = false;                    ///< refused while the object is not valid, too
  bool locked_by_former_value = false;               ///< switching off and moving in one write is refused
};

/// Codes and freedoms of the parameters of a PDO.
struct PdoChoices {
  AbortCode inhibit_locked = abort_code::invalid_value;
  AbortCode absent_object = abort_code::no_object;
  AbortCode unmappable_object = abort_code::not_mappable;
  AbortCode wrong_length = abort_code::not_mappable;
  AbortCode too_many = abort_code::mapping_too_long;  ///< a count beyond the entries there are
  AbortCode too_long = abort_code::mapping_too_long;  ///< more than 64 bits
  AbortCode out_of_order = abort_code::unsupported_access;
  bool checked_at_count = false;     ///< what is mapped is looked at when sub-index 00h is set
  bool synchronous_types = true;     ///< 00h-F0h
  bool event_types = true;           ///< FEh, FFh
  bool remote_types = true;          ///< TPDO: FCh, FDh
  bool any_remote = true;            ///< TPDO: remote frames at all; without, bit 30 cannot be 0
  bool initial_event = false;        ///< TPDO: entering Operational is an event
  bool sends_at_first_sync = false;  ///< TPDO: type n sends at SYNC 1, n + 1, ...
  bool change_is_event = true;       ///< TPDO: of types 00h, FEh and FFh
  bool sent_empty = false;           ///< TPDO: without mapped objects it is sent, with no data
  bool needs_mapping = false;        ///< without mapped objects bit 31 stays set, whatever is written
};

/// What the boot-up message of a monitored node is to the heartbeat consumer.
enum class BootUpOfProducer : std::uint8_t { heartbeat, new_start, loss };

struct Choices {
  SdoChoices sdo;

  // Object dictionary
  AbortCode value_too_long = abort_code::length_too_high;
  AbortCode value_too_short = abort_code::length_too_low;
  AbortCode value_above_limit = abort_code::value_too_high;
  AbortCode value_below_limit = abort_code::value_too_low;

  // NMT, error control
  int node_start_up_ms = 20;
  int communication_start_up_ms = 5;
  bool self_starting = false;              ///< Operational after boot-up (CiA 302, 1F80h)
  int nmt_latency_ms = 0;                  ///< from start, stop or enter pre-operational to the new state
  bool heartbeat_at_state_change = false;  ///< one more, while 1017h is not 0
  bool heartbeat_at_once = false;          ///< the first right after 1017h was written, and after boot-up
  int heartbeat_jitter_percent = 0;        ///< late and early by turns
  BootUpOfProducer boot_up_of_producer = BootUpOfProducer::heartbeat;
  AbortCode duplicate_consumer = abort_code::parameter_incompatible;
  AbortCode consumer_reserved_bits = abort_code::invalid_value;
  bool consumer_reserved_bits_cleared = false;  ///< taken, and read back as 00h

  // Error register, EMCY, history
  bool register_generic_only = false;         ///< no other bit than 0
  bool error_reset_for_each = false;          ///< EMCY 0000h also while other errors remain
  bool emergency_dropped_in_stopped = false;  ///< not made up for afterwards
  std::uint8_t history_depth = 8;             ///< at most as many as 1003h has fields
  AbortCode nothing_recorded = abort_code::no_data;
  AbortCode history_unused_field = abort_code::no_data;  ///< from sub-index 02h on
  bool long_rpdo_reported = false;                       ///< EMCY 8220h
  bool wrong_sync_reported = true;                       ///< EMCY 8240h
  bool wrong_sync_used = true;

  // 1019h
  AbortCode counter_reserved = abort_code::invalid_value;  ///< the values 1 and 241-255
  AbortCode counter_locked = abort_code::device_state;     ///< a change while 1006h is not 0

  // COB-ID parameters
  CobIdChoices sync_cob_id;
  CobIdChoices time_cob_id;
  CobIdChoices emergency_cob_id;
  CobIdChoices emergency_consumer_cob_id;
  CobIdChoices rpdo_cob_id;
  CobIdChoices tpdo_cob_id;
  CobIdChoices sdo_cob_id;  ///< 1201h, 1202h, 1280h

  // 1023h, 1025h, 1026h
  AbortCode nothing_to_deliver = abort_code::no_data;

  // PDO
  PdoChoices rpdo;
  PdoChoices tpdo;

  // Storage
  AbortCode wrong_signature = abort_code::cannot_store;
  bool storing_needs_pre_operational = false;  ///< 0800 0022h in Operational
  /// Of a device that stores without a command: it waits for the last of several writes, since each wears the
  /// memory.
  conform::Duration rest_before_storing = std::chrono::seconds(4);
};

}  // namespace refnode
