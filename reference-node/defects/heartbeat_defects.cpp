// SPDX-License-Identifier: Apache-2.0
// Defects of the heartbeat producer (1017h) and consumer (1016h).
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

DefectTable heartbeat_defects() {
  using B = Behaviour;
  return {
      {"1017-period-wrong", "The heartbeat comes at half the rate of 1017h", {"OD-1017-05", "EC-HBP-01"}, behave(&B::heartbeat_period_factor, 2)},
      {"1017-period-in-10ms-units", "1017h counts in units of 10 ms", {"EC-HBP-01", "OD-1017-05", "EC-HBP-02", "OD-1017-07"}, behave(&B::heartbeat_period_factor, 10)},
      {"1017-change-needs-reset", "A change of 1017h takes effect with the next reset only",
       {"OD-1017-05", "OD-1017-07", "EC-HBP-02", "EC-HBP-03"}, behave(&B::heartbeat_starts_only_after_reset)},
      {"1017-zero-does-not-stop", "Writing 0 to 1017h does not stop the heartbeat", {"OD-1017-06", "EC-HBP-04"}, behave(&B::heartbeat_zero_does_not_stop)},
      {"1017-stored-value-not-started", "A stored heartbeat time is not used after boot-up", {"OD-1017-08", "EC-HBP-05"}, behave(&B::heartbeat_not_started_at_boot)},
      {"heartbeat-on-state-change-when-off", "State changes send a heartbeat although 1017h is 0", {"EC-HBP-04"}, behave(&B::heartbeat_on_state_change_when_off)},
      {"heartbeat-stops-in-stopped", "There is no heartbeat in Stopped", {"NMT-SVC-04", "EC-HBP-06"}, behave(&B::heartbeat_stops_in_stopped)},
      {"heartbeat-state-stale", "The heartbeat always shows Pre-operational", {"EC-HBP-06", "NMT-SVC-04", "NMT-FSA-01", "NMT-FSA-02"}, behave(&B::heartbeat_state_stale)},
      {"heartbeat-with-toggle-bit", "Bit 7 of the heartbeat toggles", {"EC-HBP-07", "OD-1017-05"}, behave(&B::heartbeat_with_toggle_bit)},
      {"heartbeat-dlc-wrong", "Heartbeats have two bytes", {"EC-HBP-08", "OD-1017-05"},
       reshape(Service::heartbeat, [](const FilterContext&, Frame& frame) { frame.dlc = 2; })},
      {"heartbeat-wrong-cobid", "Heartbeats are sent on 700h without the node-ID", {"EC-HBP-08", "EC-HBP-01", "OD-1017-05"},
       reshape(Service::heartbeat, [](const FilterContext&, Frame& frame) { frame.id = 0x700; })},
      {"1016-duplicate-accepted", "Two entries of 1016h for the same node are accepted", {"OD-1016-06", "EC-HBC-05"}, behave(&B::consumer_accepts_duplicate)},
      {"1016-duplicate-wrong-abort", "A duplicate node in 1016h is aborted with 0609 0030h instead of 0604 0043h",
       {"OD-1016-06", "EC-HBC-05"}, wrong_abort(abort_code::parameter_incompatible, abort_code::invalid_value, {0x1016, 0x1016})},
      {"1016-zero-time-duplicate-refused", "A second entry of 1016h with time 0 is refused as a duplicate", {"OD-1016-07"}, behave(&B::consumer_zero_time_is_duplicate)},
      {"1016-own-entry-counts-as-duplicate", "Rewriting an entry of 1016h is refused as a duplicate of itself", {"OD-1016-08"}, behave(&B::consumer_own_entry_is_duplicate)},
      {"1016-reserved-bits-writable", "Bits 31-24 of 1016h can be set", {"OD-1016-12"}, behave(&B::consumer_accepts_reserved_bits)},
      {"1016-monitors-before-first-heartbeat", "Monitoring starts with the configuration", {"OD-1016-10", "EC-HBC-02"}, behave(&B::consumer_starts_without_heartbeat)},
      {"1016-timeout-not-detected", "A missing heartbeat is not noticed", {"OD-1016-11", "EC-HBC-03"}, behave(&B::consumer_loss_not_detected)},
      {"1016-unit-wrong", "1016h counts in units of 10 ms", {"OD-1016-11", "EC-HBC-03"}, behave(&B::consumer_time_factor, 10)},
      {"hbc-timeout-wrong-code", "A missing heartbeat is reported as generic error 1000h", {"EC-HBC-03"}, behave(&B::consumer_wrong_code)},
      {"hbc-timer-not-restarted", "The consumer time runs from the first heartbeat, whatever follows", {"EC-HBC-04", "OD-1016-11"}, behave(&B::consumer_timer_not_restarted)},
      {"hbc-error-never-resolved", "Returning heartbeats do not end the error", {"EC-HBC-07", "OD-1001-06", "EMCY-SEQ-02"}, behave(&B::consumer_error_never_resolved)},
      {"hbc-node-id-not-checked", "Heartbeats of any node feed the monitoring", {"EC-HBC-09"}, behave(&B::consumer_node_id_unchecked)},
      {"error-behavior-default-wrong", "A heartbeat loss does not end Operational", {"EC-HBC-08"}, behave(&B::consumer_loss_keeps_operational)},
  };
}

}  // namespace refnode
