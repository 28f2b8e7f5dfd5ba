// SPDX-License-Identifier: Apache-2.0
// The list of all defects: the tables of this folder, one after the other.
#include <algorithm>

#include "defects/tools.hpp"

namespace refnode {

namespace {

DefectTable join(std::initializer_list<DefectTable (*)()> tables) {
  DefectTable all;
  for (const auto table : tables) defect::append(all, table());
  return all;
}

}  // namespace

std::span<const Defect> defects() {
  static const DefectTable all = join({sdo_defects,
                                       sdo_expedited_defects,
                                       sdo_segment_defects,
                                       sdo_segment_download_defects,
                                       sdo_request_defects,
                                       sdo_block_upload_defects,
                                       sdo_block_download_defects,
                                       sdo_channel_defects,
                                       sdo_length_defects,
                                       sdo_turn_defects,
                                       sdo_leftover_defects,
                                       sdo_end_defects,
                                       sdo_course_defects,
                                       dictionary_abort_defects,
                                       dictionary_defects,
                                       dictionary_value_defects,
                                       dictionary_leftover_defects,
                                       emergency_history_defects,
                                       emergency_defects,
                                       emergency_course_defects,
                                       emergency_waiting_defects,
                                       nmt_defects,
                                       nmt_course_defects,
                                       error_control_heartbeat_defects,
                                       error_control_monitoring_defects,
                                       error_control_course_defects,
                                       error_control_state_defects,
                                       cob_id_defects,
                                       cob_id_course_defects,
                                       storage_defects,
                                       storage_course_defects,
                                       storage_memory_defects,
                                       pdo_receive_defects,
                                       pdo_transmit_defects,
                                       pdo_receive_traffic_defects,
                                       pdo_event_defects,
                                       pdo_sync_defects,
                                       pdo_mapping_defects,
                                       pdo_parameter_defects,
                                       dictionary_structure_defects,
                                       error_control_behaviour_defects,
                                       emergency_consumer_defects,
                                       error_control_guarding_defects,
                                       time_defects,
                                       sync_defects,
                                       sync_consumer_defects,
                                       sync_producer_defects,
                                       storage_stamp_defects,
                                       objects_description_defects,
                                       objects_operating_system_defects,
                                       lss_defects,
                                       lss_sequence_defects,
                                       lss_frame_defects,
                                       pdo_traffic_defects,
                                       pdo_course_defects,
                                       pdo_receive_course_defects,
                                       pdo_receive_waiting_defects,
                                       pdo_transmit_course_defects,
                                       pdo_reset_defects,
                                       device_traffic_defects,
                                       device_load_defects,
                                       sdo_rare_defects,
                                       pdo_rare_defects,
                                       nmt_rare_defects,
                                       emergency_rare_defects,
                                       clock_rare_defects,
                                       dictionary_rare_defects});
  return all;
}

const Defect* find_defect(std::string_view id) {
  const auto all = defects();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Defect& row) { return row.id == id; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace refnode
