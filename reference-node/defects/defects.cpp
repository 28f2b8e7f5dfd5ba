// SPDX-License-Identifier: Apache-2.0
// The list of all defects: the tables of this folder, one after the other.
#include <algorithm>
#include <iterator>

#include "defects/defect.hpp"

namespace refnode {

namespace {

DefectTable join(std::initializer_list<DefectTable (*)()> tables) {
  DefectTable all;
  for (const auto table : tables) {
    DefectTable rows = table();
    all.insert(all.end(), std::make_move_iterator(rows.begin()), std::make_move_iterator(rows.end()));
  }
  return all;
}

}  // namespace

std::span<const Defect> defects() {
  static const DefectTable all = join({sdo_defects,
                                       sdo_expedited_defects,
                                       sdo_segment_defects,
                                       sdo_request_defects,
                                       sdo_block_upload_defects,
                                       sdo_block_download_defects,
                                       sdo_channel_defects,
                                       abort_defects,
                                       dictionary_defects,
                                       history_defects,
                                       emergency_defects,
                                       nmt_defects,
                                       heartbeat_defects,
                                       cob_id_defects,
                                       storage_defects,
                                       receive_pdo_defects,
                                       transmit_pdo_defects,
                                       structure_defects,
                                       error_behaviour_defects,
                                       emergency_consumer_defects,
                                       guarding_defects,
                                       optional_object_defects,
                                       operating_system_defects});
  return all;
}

const Defect* find_defect(std::string_view id) {
  const auto all = defects();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Defect& row) { return row.id == id; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace refnode
