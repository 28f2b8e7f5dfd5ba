// SPDX-License-Identifier: Apache-2.0
// The known ways to break the node, one row per fault. A row says what is wrong, which requirements that
// violates, and how it is done: an edit of the dictionary, a filter on outgoing frames, or a switch of
// Behaviour.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "device/outbox.hpp"
#include "dictionary/object_dictionary.hpp"
#include "node/behaviour.hpp"

namespace refnode {

/// Changes the finished dictionary before the node starts; the node-ID is given because some defaults hold
/// it.
using DictionaryEdit = std::function<void(ObjectDictionary&, std::uint8_t node_id)>;
using BehaviourSwitch = std::function<void(Behaviour&)>;

struct Defect {
  std::string_view id;
  std::string_view summary;
  std::vector<std::string_view> violates;  ///< requirement ids, the one that it proves best first
  std::variant<DictionaryEdit, Filter, BehaviourSwitch> how;
};

/// All rows, in the order of the tables; ids are unique and never reused.
[[nodiscard]] std::span<const Defect> defects();
/// nullptr when there is no such defect.
[[nodiscard]] const Defect* find_defect(std::string_view id);

using DefectTable = std::vector<Defect>;

// The tables, one per file.
[[nodiscard]] DefectTable sdo_defects();
[[nodiscard]] DefectTable sdo_expedited_defects();
[[nodiscard]] DefectTable sdo_segment_defects();
[[nodiscard]] DefectTable sdo_request_defects();
[[nodiscard]] DefectTable sdo_block_upload_defects();
[[nodiscard]] DefectTable sdo_block_download_defects();
[[nodiscard]] DefectTable sdo_channel_defects();
[[nodiscard]] DefectTable abort_defects();
[[nodiscard]] DefectTable dictionary_defects();
[[nodiscard]] DefectTable history_defects();
[[nodiscard]] DefectTable emergency_defects();
[[nodiscard]] DefectTable nmt_defects();
[[nodiscard]] DefectTable heartbeat_defects();
[[nodiscard]] DefectTable cob_id_defects();
[[nodiscard]] DefectTable storage_defects();
[[nodiscard]] DefectTable pdo_defects();
[[nodiscard]] DefectTable structure_defects();
[[nodiscard]] DefectTable object_defects();
[[nodiscard]] DefectTable optional_object_defects();
[[nodiscard]] DefectTable operating_system_defects();

}  // namespace refnode
