// SPDX-License-Identifier: Apache-2.0
// Every switch that makes the node misbehave. The default of each is the conformant behaviour; each is
// consulted in one or two places and set by rows of defects/.
#pragma once

#include <cstdint>


namespace refnode {

/// How the rules of the parameters of a PDO are broken.
struct PdoFaults {
  bool reserved_type_accepted = false;
  bool inhibit_lock_missing = false;
  int inhibit_unit_us = 100;
  int event_timer_factor = 1;
  bool absent_object_mapped = false;
  bool unmappable_object_mapped = false;
  bool mapping_length_unchecked = false;
  bool mapping_count_unchecked = false;
  bool overlong_mapping_accepted = false;
  bool mapping_writable_while_enabled = false;
  bool mapping_writable_while_valid = false;
};

struct Behaviour {


  // PDO
  PdoFaults rpdo;
  PdoFaults tpdo;
  bool rpdo_processed_in_pre_operational = false;
  bool short_rpdo_processed = false;
  bool short_rpdo_not_reported = false;
  bool long_rpdo_dropped = false;
  bool sync_rpdo_applied_at_once = false;
  bool rpdo_data_ignored = false;
  bool rpdo_data_big_endian = false;
  bool tpdo_sent_in_pre_operational = false;
  bool tpdo_data_big_endian = false;
  bool event_timer_in_synchronous_types = false;
  bool remote_type_sends_at_sync = false;
  bool acyclic_type_sends_every_sync = false;
  bool sync_ratio_off_by_one = false;
  bool tpdo_change_ignored = false;           ///< a change of what is mapped is no event
  bool tpdo_timer_ignores_valid_bit = false;  ///< sent by the event timer while not valid
};

}  // namespace refnode
