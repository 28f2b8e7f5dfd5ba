// SPDX-License-Identifier: Apache-2.0
// Where the standard leaves a device a choice: the same device, otherwise, and as conformant as by default.
// The rows of variants/ set these fields and say why it is legal.
#pragma once

#include <cstdint>

#include "base/time.hpp"
#include "dictionary/abort_codes.hpp"

namespace refnode {

using conform::AbortCode;

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
  bool initial_event = false;        ///< TPDO: entering Operational is an event
  bool sends_at_first_sync = false;  ///< TPDO: type n sends at SYNC 1, n + 1, ...
  bool change_is_event = true;       ///< TPDO: of types 00h, FEh and FFh
  bool sent_empty = false;           ///< TPDO: without mapped objects it is sent, with no data
  bool needs_mapping = false;        ///< without mapped objects bit 31 stays set, whatever is written
};

struct Choices {

  bool long_rpdo_reported = false;  ///< EMCY 8220h

  // PDO
  PdoChoices rpdo;
  PdoChoices tpdo;
};

}  // namespace refnode
