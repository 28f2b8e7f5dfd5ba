// SPDX-License-Identifier: Apache-2.0
// Defects of the order of requests: what comes for a transfer that another one has replaced, and frames of a
// block upload that are not due.
#include "defects/sdo_block_exchanges.hpp"

namespace refnode {

using namespace defect;

namespace {

/// A transfer of this kind stays open beside the one that has replaced it, if that is over with its answer.
Change outlives_expedited_requests(bool block_transfer) {
  return decides(of_sdo, &SdoRules::makes_way, [block_transfer](const auto& former, bool block) {
    return block != block_transfer && former(block);
  });
}

/// A frame of a running block upload that was refused because it was not due. Without a running upload the
/// answer has no multiplexer.
bool not_due(const SdoExchange& e) { return e.aborted == abort_code::command_unknown && e.index() != 0; }
bool start_not_due(const SdoExchange& e) {
  return e.step == SdoStep::block_upload_segment && e.request[0] == 0xA3 && not_due(e);
}
bool acknowledge_not_due(const SdoExchange& e) {
  return e.step == SdoStep::block_upload_segment && e.request[0] == 0xA2 && not_due(e);
}
bool confirmation_not_due(const SdoExchange& e) { return e.step == SdoStep::block_upload_end && not_due(e); }

}  // namespace

DefectTable sdo_turn_defects() {
  return {
      {"segmented-transfer-outlives-expedited-one",
       "A segmented transfer that an expedited one has replaced goes on with its next segment",
       {"SDO-SUP-11", "SDO-SDN-17"},
       outlives_expedited_requests(false)},
      {"block-upload-outlives-expedited-one",
       "A block upload that an expedited upload has replaced goes on with the next acknowledge",
       {"SDO-BUP-21"},
       outlives_expedited_requests(true)},
      {"block-upload-ended-by-second-start",
       "A start that is not due ends a block upload without a word",
       {"SDO-BUP-20"},
       silent(start_not_due)},
      {"block-upload-ended-by-early-acknowledge",
       "An acknowledge that is not due ends a block upload without a word",
       {"SDO-BUP-20"},
       silent(acknowledge_not_due)},
      {"block-upload-ended-by-early-confirmation",
       "A confirmation that is not due ends a block upload without a word",
       {"SDO-BUP-20"},
       silent(confirmation_not_due)},
  };
}

}  // namespace refnode
