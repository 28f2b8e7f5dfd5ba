// SPDX-License-Identifier: Apache-2.0
// The known ways to break the node, one row per fault. A row says what is wrong, which requirements that
// violates, and how it is done: by an edit of the dictionary or of the hooks of an entry, by a filter on what
// comes in or goes out, or by another decision in place of a rule of a service.
#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "parts/parts.hpp"

namespace refnode {

/// Changes the finished dictionary; the node-ID is given because some defaults hold it.
using DictionaryEdit = std::function<void(ObjectDictionary&, std::uint8_t node_id)>;
/// Changes the frames that one received frame has led to, before a service sees them.
using Reading = std::function<void(Parts&, std::vector<Frame>&)>;

/// How a finished node is changed before it starts. What it is made of is copied for every node, so a filter
/// may have a memory.
class Change {
 public:
  /// Of a function of the parts, an edit of the dictionary, a filter on the way out or a reading on the way
  /// in, as a row of a table holds them.
  template <typename F>
  Change(F how) {  // NOLINT(google-explicit-constructor)
    if constexpr (std::invocable<F&, Parts&>) {
      change_ = std::move(how);
    } else if constexpr (std::invocable<F&, ObjectDictionary&, std::uint8_t>) {
      change_ = [how = std::move(how)](Parts& parts) { how(parts.device.dictionary, parts.device.node_id); };
    } else if constexpr (std::invocable<F&, const FilterContext&, std::vector<Outgoing>&>) {
      change_ = [how = std::move(how)](Parts& parts) { parts.device.outbox.add_filter(how); };
    } else {
      change_ = [how = std::move(how)](Parts& parts) {
        parts.device.inbox.add_filter(
            [&parts, how](std::vector<Frame>& frames) mutable { how(parts, frames); });
      };
    }
  }

  void operator()(Parts& parts) const { change_(parts); }

 private:
  std::function<void(Parts&)> change_;
};

struct Defect {
  std::string_view id;
  std::string_view summary;
  std::vector<std::string_view> violates;  ///< requirement ids, the one that it proves best first
  Change how;
  /// Features of the device profile that go with it: the fault is one of a device without them.
  std::vector<std::string_view> lacks = {};
};

/// All rows, in the order of the tables; ids are unique and never reused.
[[nodiscard]] std::span<const Defect> defects();
/// nullptr when there is no such defect.
[[nodiscard]] const Defect* find_defect(std::string_view id);

using DefectTable = std::vector<Defect>;

// The tables, one per file; the first word of a file is the room whose faults it holds.
[[nodiscard]] DefectTable sdo_defects();
[[nodiscard]] DefectTable sdo_expedited_defects();
[[nodiscard]] DefectTable sdo_segment_defects();
[[nodiscard]] DefectTable sdo_segment_download_defects();
[[nodiscard]] DefectTable sdo_request_defects();
[[nodiscard]] DefectTable sdo_block_upload_defects();
[[nodiscard]] DefectTable sdo_block_download_defects();
[[nodiscard]] DefectTable sdo_channel_defects();
[[nodiscard]] DefectTable sdo_length_defects();
[[nodiscard]] DefectTable sdo_turn_defects();
[[nodiscard]] DefectTable sdo_leftover_defects();
[[nodiscard]] DefectTable sdo_end_defects();
[[nodiscard]] DefectTable sdo_course_defects();
[[nodiscard]] DefectTable dictionary_abort_defects();
[[nodiscard]] DefectTable dictionary_defects();
[[nodiscard]] DefectTable dictionary_value_defects();
[[nodiscard]] DefectTable dictionary_leftover_defects();
[[nodiscard]] DefectTable emergency_history_defects();
[[nodiscard]] DefectTable emergency_defects();
[[nodiscard]] DefectTable emergency_course_defects();
[[nodiscard]] DefectTable emergency_waiting_defects();
[[nodiscard]] DefectTable nmt_defects();
[[nodiscard]] DefectTable nmt_course_defects();
[[nodiscard]] DefectTable error_control_heartbeat_defects();
[[nodiscard]] DefectTable error_control_monitoring_defects();
[[nodiscard]] DefectTable error_control_course_defects();
[[nodiscard]] DefectTable error_control_state_defects();
[[nodiscard]] DefectTable cob_id_defects();
[[nodiscard]] DefectTable cob_id_course_defects();
[[nodiscard]] DefectTable storage_defects();
[[nodiscard]] DefectTable storage_course_defects();
[[nodiscard]] DefectTable storage_memory_defects();
[[nodiscard]] DefectTable pdo_receive_defects();
[[nodiscard]] DefectTable pdo_transmit_defects();
[[nodiscard]] DefectTable pdo_receive_traffic_defects();
[[nodiscard]] DefectTable pdo_event_defects();
[[nodiscard]] DefectTable pdo_sync_defects();
[[nodiscard]] DefectTable pdo_mapping_defects();
[[nodiscard]] DefectTable pdo_parameter_defects();
[[nodiscard]] DefectTable pdo_course_defects();
[[nodiscard]] DefectTable pdo_receive_course_defects();
[[nodiscard]] DefectTable pdo_receive_waiting_defects();
[[nodiscard]] DefectTable pdo_transmit_course_defects();
[[nodiscard]] DefectTable pdo_reset_defects();
[[nodiscard]] DefectTable dictionary_structure_defects();
[[nodiscard]] DefectTable error_control_behaviour_defects();
[[nodiscard]] DefectTable emergency_consumer_defects();
[[nodiscard]] DefectTable error_control_guarding_defects();
[[nodiscard]] DefectTable time_defects();
[[nodiscard]] DefectTable sync_defects();
[[nodiscard]] DefectTable sync_consumer_defects();
[[nodiscard]] DefectTable sync_producer_defects();
[[nodiscard]] DefectTable storage_stamp_defects();
[[nodiscard]] DefectTable objects_description_defects();
[[nodiscard]] DefectTable objects_operating_system_defects();
[[nodiscard]] DefectTable lss_defects();
[[nodiscard]] DefectTable lss_sequence_defects();
[[nodiscard]] DefectTable lss_frame_defects();
[[nodiscard]] DefectTable pdo_traffic_defects();
[[nodiscard]] DefectTable device_traffic_defects();
[[nodiscard]] DefectTable device_load_defects();
[[nodiscard]] DefectTable sdo_rare_defects();
[[nodiscard]] DefectTable pdo_rare_defects();
[[nodiscard]] DefectTable nmt_rare_defects();
[[nodiscard]] DefectTable emergency_rare_defects();
[[nodiscard]] DefectTable clock_rare_defects();
[[nodiscard]] DefectTable dictionary_rare_defects();

}  // namespace refnode
