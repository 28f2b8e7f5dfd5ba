// SPDX-License-Identifier: Apache-2.0
#include "defects/sdo_transfers.hpp"

#include <chrono>

namespace refnode::defect {

void Transfer::see(const SdoExchange& exchange, const std::vector<Outgoing>& frames) {
  constexpr unsigned client_abort = 4;
  const bool ended =
      aborted(exchange) || exchange.request[0] >> 5U == client_abort || last_download_segment(exchange);
  if (ended) running = Direction::none;
  if (ended || frames.empty()) return;
  const Data& sent = frames.front().frame.data;
  if (upload_initiated(exchange)) {
    running = is_segmented_upload(sent) ? Direction::upload : Direction::none;
  } else if (download_initiated(exchange)) {
    running = is_expedited(exchange) ? Direction::none : Direction::download;
  } else if (upload_segment_sent(exchange) && (sent[0] & 0x01U) != 0) {
    running = Direction::none;
  }
}

Filter during(Transfer::Direction direction, Condition when,
              void (*change)(const SdoExchange&, std::vector<Outgoing>&)) {
  return [transfer = Transfer{}, direction, when, change](const FilterContext& context,
                                                          std::vector<Outgoing>& frames) mutable {
    if (context.service == Service::boot_up) transfer = {};
    if (context.sdo == nullptr) return;
    const bool meets = transfer.running == direction && when(*context.sdo);
    transfer.see(*context.sdo, frames);
    if (meets) change(*context.sdo, frames);
  };
}

Filter stuck_when_abandoned(Transfer::Direction direction) {
  return [transfer = Transfer{}, direction, abandoned = false, stuck_until = BusTime{}](
             const FilterContext& context, std::vector<Outgoing>& frames) mutable {
    if (context.service == Service::boot_up) transfer = {};
    if (context.sdo == nullptr) return;
    if (context.sdo->step == SdoStep::time_out) {
      abandoned = transfer.running == direction;
      if (abandoned) frames.clear();
    } else if (abandoned) {
      abandoned = false;
      stuck_until = context.now + std::chrono::milliseconds(1500);
    }
    transfer.see(*context.sdo, frames);
    if (context.now < stuck_until) frames.clear();
  };
}

}  // namespace refnode::defect
