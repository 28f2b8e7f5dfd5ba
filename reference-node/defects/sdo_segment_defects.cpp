// SPDX-License-Identifier: Apache-2.0
// Defects of segmented uploads that show in the frames: sizes, toggle bits, marks, and what ends a transfer;
// and of what both directions have in common.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "defects/sdo_exchanges.hpp"
#include "defects/sdo_rules.hpp"
#include "defects/sdo_transfers.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr AbortCode time_out{0x05040000};

bool in_a_segment(const SdoExchange& e) {
  return e.step == SdoStep::upload_segment || e.step == SdoStep::download_segment;
}

/// A transfer that was begun in `from` is lost in another NMT state.
Filter lost_outside(NmtState from) {
  return [transfer = Transfer{}, from, began = NmtState::initialising](
             const FilterContext& context, std::vector<Outgoing>& frames) mutable {
    if (context.service == Service::boot_up) transfer = {};
    if (context.sdo == nullptr) return;
    const bool lost = transfer.running != Transfer::Direction::none && in_a_segment(*context.sdo) &&
                      began == from && context.state != from;
    transfer.see(*context.sdo, frames);
    if (upload_initiated(*context.sdo) || download_initiated(*context.sdo)) began = context.state;
    if (!lost) return;
    Data abort{0x80};
    store_code(abort, abort_code::command_unknown);
    answer(frames, abort);
  };
}

/// A segment request is aborted when more than `limit` has passed since the frame before, or, `in_total`,
/// since the first frame of the transfer.
Filter impatient(Duration limit, bool in_total, AbortCode code) {
  return [limit, in_total, code, since = BusTime{}](const FilterContext& context,
                                                    std::vector<Outgoing>& frames) mutable {
    if (context.sdo == nullptr) return;
    const bool late = in_a_segment(*context.sdo) && context.now - since > limit;
    if (!in_total || !in_a_segment(*context.sdo)) since = context.now;
    if (!late) return;
    const auto mux = context.sdo->mux;
    Data abort{0x80, static_cast<std::uint8_t>(mux.index.value() & 0xFFU),
               static_cast<std::uint8_t>(mux.index.value() >> 8U), mux.sub.value()};
    store_code(abort, code);
    answer(frames, abort);
  };
}

bool segment_size_is_7(const Data& data) { return (data[0] & 0x0EU) == 0; }
bool timed_out(const SdoExchange& e) { return e.step == SdoStep::time_out; }

}  // namespace

DefectTable sdo_segment_defects() {
  return {
      {"toggle-not-checked-upload",
       "The toggle bit of upload segment requests is not checked",
       {"SDO-SUP-05", "SDO-SUP-06"},
       decides(of_segments, &SegmentedRules::upload_toggle_right, any_toggle)},
      {"wrong-abort-toggle",
       "A toggle error is aborted with 0609 0030h instead of 0503 0000h",
       {"SDO-SUP-05", "SDO-SUP-06", "SDO-SDN-04", "SDO-SDN-05"},
       wrong_abort(abort_code::toggle_not_alternated, abort_code::invalid_value)},
      {"toggle-not-alternating",
       "Upload segments always carry toggle 0",
       {"SDO-SUP-03", "SDO-SUP-01"},
       patch(upload_segment_sent, [](const SdoExchange&, Data& data) { data[0] &= 0xEFU; })},
      {"toggle-starts-with-1",
       "Upload segments carry the inverted toggle bit",
       {"SDO-SUP-03", "SDO-SUP-01"},
       patch(upload_segment_sent, [](const SdoExchange&, Data& data) { data[0] ^= 0x10U; })},
      {"segment-last-flag-missing",
       "The last upload segment is not marked",
       {"SDO-SUP-01", "SDO-SUP-04"},
       patch(upload_segment_sent, [](const SdoExchange&, Data& data) { data[0] &= 0xFEU; })},
      {"last-segment-n-wrong",
       "The last upload segment claims seven bytes whatever it holds",
       {"SDO-SUP-04", "SDO-SUP-01", "SDO-SUP-02"},
       patch(upload_segment_sent, [](const SdoExchange&, Data& data) { data[0] &= 0xF1U; })},
      {"size-indicated-wrong",
       "The size told by a segmented upload is one too high",
       {"SDO-SUP-02", "OD-1008-01"},
       patch(upload_initiated,
             [](const SdoExchange&, Data& data) {
               if (data[0] == 0x41) ++data[4];
             })},
      {"segment-data-shifted",
       "Upload segments start one byte late",
       {"SDO-SUP-01"},
       patch(upload_segment_sent,
             [](const SdoExchange&, Data& data) {
               std::rotate(data.begin() + 1, data.begin() + 2, data.end());
             })},
      {"abort-does-not-close-transfer",
       "After a toggle abort the transfer goes on",
       {"SDO-SUP-07"},
       goes_on_after_abort(SdoSide::server)},
      {"segment-served-without-initiate",
       "An upload segment request without transfer gets an empty last segment",
       {"SDO-SUP-08", "SDO-SUP-09"},
       respond(segment_without_transfer, 0x0F, 0)},
      {"transfer-not-closed-after-last-segment",
       "After the last upload segment the transfer starts again",
       {"SDO-SUP-09"},
       decides(of_segments, &SegmentedRules::goes_on_at,
               [](const auto& former, std::size_t sent, std::size_t size) {
                 return std::optional(former(sent, size).value_or(0));
               })},
      {"new-initiate-wedges-server",
       "While a segmented transfer is open no new one is served",
       {"SDO-SUP-11", "SDO-SUP-12", "SDO-SDN-17"},
       begins_nothing_while_busy()},
      {"transfer-survives-reset-comm",
       "A segmented transfer goes on after reset communication",
       {"SDO-SUP-20"},
       keeps_transfers_in(NmtState::initialising)},
      {"full-last-segment-claims-nothing",
       "A last upload segment of seven bytes says that it holds none",
       {"SDO-SUP-04", "SDO-SUP-02", "SDO-SUP-01"},
       patch(upload_segment_sent,
             [](const SdoExchange&, Data& data) {
               if ((data[0] & 0x01U) != 0 && segment_size_is_7(data)) data[0] |= 0x0EU;
             })},
      {"told-size-cut-to-8-bits",
       "The size told by a segmented upload has only its lowest byte",
       {"SDO-SUP-02"},
       patch(upload_initiated,
             [](const SdoExchange&, Data& data) {
               if (is_segmented_upload(data)) data[5] = data[6] = data[7] = 0;
             })},
      {"told-size-big-endian",
       "The size told by a segmented upload has its most significant byte first",
       {"SDO-SUP-02"},
       patch(upload_initiated,
             [](const SdoExchange&, Data& data) {
               if (is_segmented_upload(data)) std::reverse(data.begin() + 4, data.end());
             })},
      {"size-told-without-size-bit",
       "Segmented uploads tell the size in bytes that are reserved without the size bit",
       {"SDO-GEN-05"},
       patch(upload_initiated,
             [](const SdoExchange&, Data& data) {
               if (is_segmented_upload(data)) data[0] = 0x40;
             })},
      {"size-bit-of-odd-sizes-only",
       "Segmented uploads tell an even size in bytes that are reserved without the size bit",
       {"SDO-GEN-05"},
       patch(upload_initiated,
             [](const SdoExchange&, Data& data) {
               if (is_segmented_upload(data) && (data[4] & 1U) == 0) data[0] = 0x40;
             })},
      {"long-entries-silent",
       "Uploads of entries of more than four bytes get no answer",
       {"SDO-SUP-01", "SDO-UPL-05"},
       Filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
         if (context.sdo == nullptr || !upload_initiated(*context.sdo)) return;
         std::erase_if(frames, [](const Outgoing& sent) { return is_segmented_upload(sent.frame.data); });
       })},
      {"new-initiate-returns-old-object",
       "An upload request during a segmented upload is answered for the old object",
       {"SDO-SUP-11", "SDO-GEN-03"},
       Filter([transfer = Transfer{}, first = Data{}](const FilterContext& context,
                                                      std::vector<Outgoing>& frames) mutable {
         if (context.sdo == nullptr) return;
         const bool busy = transfer.running == Transfer::Direction::upload;
         transfer.see(*context.sdo, frames);
         if (!upload_initiated(*context.sdo) || frames.empty()) return;
         if (busy) {
           answer(frames, first);
         } else {
           first = frames.front().frame.data;
         }
       })},
      {"new-initiate-returns-old-data",
       "An upload request during a segmented upload is answered with four bytes of the old object",
       {"SDO-SUP-11"},
       Filter([transfer = Transfer{}](const FilterContext& context, std::vector<Outgoing>& frames) mutable {
         if (context.sdo == nullptr) return;
         const bool busy = transfer.running == Transfer::Direction::upload;
         transfer.see(*context.sdo, frames);
         if (!busy || !upload_initiated(*context.sdo) || frames.empty()) return;
         auto& data = frames.front().frame.data;
         if (data[0] == 0x43) std::fill(data.begin() + 4, data.begin() + 8, std::uint8_t{0x41});
       })},
      {"download-ignored-during-an-upload",
       "A download request during a segmented upload gets no answer",
       {"SDO-SUP-12"},
       during(Transfer::Direction::upload, download_initiated, drop)},
      {"download-segment-taken-during-an-upload",
       "A download segment during an upload is confirmed",
       {"SDO-SUP-13"},
       during(
           Transfer::Direction::upload,
           [](const SdoExchange& e) { return e.step == SdoStep::download_segment; },
           [](const SdoExchange& e, std::vector<Outgoing>& frames) {
             answer(frames, {static_cast<std::uint8_t>(0x20U | (e.request[0] & 0x10U))});
           })},
      {"block-upload-differs-from-segmented",
       "A block upload gives other bytes than a segmented one",
       {"SDO-SUP-23", "SDO-BUP-01"},
       patch([](const SdoExchange& e) { return e.step == SdoStep::block_upload_segment && !e.aborted; },
             [](const SdoExchange&, Data& data) { data[1] ^= 0x01U; })},
      {"empty-upload-without-end",
       "The segment of an empty entry is not marked as the last",
       {"SDO-SUP-16", "SDO-SUP-04"},
       patch(upload_segment_sent,
             [](const SdoExchange&, Data& data) {
               if ((data[0] & 0x0FU) == 0x0F) data[0] &= 0xFEU;
             })},
      {"transfer-lost-in-operational",
       "A segmented transfer that was begun in Pre-operational is lost with the change to Operational",
       {"SDO-SUP-21"},
       lost_outside(NmtState::pre_operational)},
      {"transfer-lost-in-pre-operational",
       "A segmented transfer that was begun in Operational is lost with the change to Pre-operational",
       {"SDO-SUP-21"},
       lost_outside(NmtState::operational)},
      {"server-time-out-too-short",
       "A pause of more than 100 ms between two segments ends the transfer",
       {"SDO-SUP-17"},
       impatient(std::chrono::milliseconds(100), false, time_out)},
      {"server-time-out-of-the-whole-transfer",
       "A transfer that takes more than 500 ms in all is ended",
       {"SDO-SUP-17"},
       impatient(std::chrono::milliseconds(500), true, time_out)},
      {"server-time-out-general-error",
       "A pause of more than 100 ms between two segments ends the transfer with 0800 0000h",
       {"SDO-SUP-17"},
       impatient(std::chrono::milliseconds(100), false, abort_code::general_error)},
      {"abandoned-upload-blocks-the-server",
       "A segmented upload that is left alone blocks the server",
       {"SDO-SUP-18"},
       stuck_when_abandoned(Transfer::Direction::upload)},
      {"time-out-wrong-abort",
       "A transfer that is left alone is aborted with 0800 0000h instead of 0504 0000h",
       {"SDO-SUP-18", "SDO-SDN-25"},
       patch(timed_out, [](const SdoExchange&, Data& data) { store_code(data, abort_code::general_error); })},
      {"time-out-abort-without-multiplexer",
       "The abort of a transfer that is left alone carries the multiplexer 0000h:00",
       {"SDO-SUP-18", "SDO-SDN-25", "SDO-ERR-04"},
       patch(timed_out, [](const SdoExchange&, Data& data) { data[1] = data[2] = data[3] = 0; })},
      {"time-out-abort-repeated",
       "A transfer that is left alone is aborted again and again",
       {"SDO-SUP-18", "SDO-SDN-25", "SDO-ERR-10"},
       Filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
         if (context.sdo == nullptr || !timed_out(*context.sdo) || frames.empty()) return;
         frames.push_back(frames.back());
         frames.back().delay += std::chrono::milliseconds(500);
       })},
      {"transfer-blocks-after-stopped",
       "A transfer that was interrupted by Stopped lets no new one begin afterwards",
       {"SDO-SUP-19", "SDO-SUP-11", "SDO-SUP-12", "SDO-SDN-17", "SDO-BUP-29"},
       together(keeps_transfers_in(NmtState::stopped), begins_nothing_while_busy())},
      {"segment-request-bytes-in-the-data",
       "Reserved bytes of a segment request are mixed into the data",
       {"SDO-SUP-14"},
       patch(upload_segment_sent,
             [](const SdoExchange& e, Data& data) {
               for (std::size_t i = 1; i < data.size(); ++i) data[i] |= e.request[i];
             })},
      {"segment-request-bits-in-the-response",
       "Reserved bits of a segment request come back in the response",
       {"SDO-SUP-14"},
       patch(upload_segment_sent,
             [](const SdoExchange& e, Data& data) {
               data[0] |= static_cast<std::uint8_t>(e.request[0] & 0x0FU);
             })},
  };
}

}  // namespace refnode
