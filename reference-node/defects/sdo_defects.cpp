// SPDX-License-Identifier: Apache-2.0
// Defects of the SDO server: frames, addressing, states, expedited and segmented transfers.
#include <algorithm>
#include <chrono>
#include <iterator>

#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

using Data = std::array<std::uint8_t, 8>;

bool always(const SdoExchange&) { return true; }
bool upload_initiated(const SdoExchange& e) { return e.step == SdoStep::upload_initiate && !e.aborted; }
bool download_initiated(const SdoExchange& e) { return e.step == SdoStep::download_initiate && !e.aborted; }
bool upload_segment_sent(const SdoExchange& e) { return e.step == SdoStep::upload_segment && !e.aborted; }
bool download_segment_taken(const SdoExchange& e) {
  return e.step == SdoStep::download_segment && !e.aborted;
}
bool segmented_download_initiated(const SdoExchange& e) {
  return download_initiated(e) && (e.request[0] & 0x02U) == 0;
}
bool unsized_expedited_download(const SdoExchange& e) {
  return download_initiated(e) && (e.request[0] & 0x03U) == 0x02U;
}
bool last_download_segment(const SdoExchange& e) {
  return download_segment_taken(e) && (e.request[0] & 0x01U) != 0;
}
bool segment_without_transfer(const SdoExchange& e) {
  return e.step == SdoStep::upload_segment && e.aborted == abort_code::command_unknown;
}
bool download_segment_without_transfer(const SdoExchange& e) {
  return e.step == SdoStep::download_segment && e.aborted == abort_code::command_unknown;
}
bool unknown_command(const SdoExchange& e) {
  return e.step == SdoStep::other && e.aborted == abort_code::command_unknown;
}
bool aborted(const SdoExchange& e) { return e.aborted.has_value(); }

// 010x nnes with e = 1: how many bytes carry data.
std::size_t expedited_size(const Data& data) { return 4U - ((data[0] >> 2U) & 0x03U); }
bool is_expedited_upload(const Data& data) { return (data[0] & 0xE2U) == 0x42U; }

DefectTable frame_rows() {
  return {
      {"default-sdo-silent", "The SDO server never answers", {"SDO-GEN-01", "OD-1200-05"}, silent(always)},
      {"sdo-reply-on-wrong-cobid",
       "SDO responses come on 580h without the node-ID",
       {"SDO-GEN-01", "OD-1200-05"},
       reshape(Service::sdo, [](const FilterContext&, Frame& frame) { frame.id = 0x580; })},
      {"sdo-response-dlc-short",
       "Confirmations of a download have four bytes only",
       {"SDO-GEN-02"},
       reshape(Service::sdo,
               [](const FilterContext&, Frame& frame) {
                 if (frame.data[0] == 0x60) frame.dlc = 4;
               })},
      {"mux-not-echoed",
       "Initiate responses carry 0000h:00 instead of the multiplexer",
       {"SDO-GEN-03", "OD-GEN-13"},
       patch([](const SdoExchange& e) { return upload_initiated(e) || download_initiated(e); },
             [](const SdoExchange&, Data& data) { data[1] = data[2] = data[3] = 0; })},
      {"mux-index-byte-swapped",
       "Upload responses carry the index in big-endian order",
       {"SDO-GEN-03", "OD-GEN-13"},
       patch(upload_initiated, [](const SdoExchange&, Data& data) { std::swap(data[1], data[2]); })},
      {"mux-stale-subindex",
       "Upload responses always carry sub-index 00h",
       {"SDO-GEN-03", "OD-GEN-13"},
       patch(upload_initiated, [](const SdoExchange&, Data& data) { data[3] = 0; })},
      {"sdo-double-response", "Every response is sent twice", {"SDO-GEN-04"}, repeat(Service::sdo)},
      {"reserved-bytes-not-zero",
       "Download confirmations repeat bytes 4-7 of the request",
       {"SDO-GEN-05"},
       patch(download_initiated,
             [](const SdoExchange& e, Data& data) {
               std::copy_n(e.request.begin() + 4, 4, data.begin() + 4);
             })},
      {"response-cs-reserved-bit-set",
       "Upload responses have bit 4 of the command byte set",
       {"SDO-GEN-06"},
       patch(upload_initiated, [](const SdoExchange&, Data& data) { data[0] |= 0x10U; })},
      {"n-set-without-size-bit",
       "Expedited uploads tell the number of unused bytes without the size bit",
       {"SDO-GEN-07", "SDO-GEN-06"},
       patch(upload_initiated,
             [](const SdoExchange&, Data& data) {
               if (is_expedited_upload(data)) data[0] &= 0xFEU;
             })},
      {"answers-foreign-node-id",
       "SDO requests to any node-ID are answered",
       {"SDO-GEN-08"},
       behave(&Behaviour::answers_foreign_node_ids)},
      {"answers-sdo-broadcast",
       "SDO requests on 600h are answered",
       {"SDO-GEN-09"},
       behave(&Behaviour::answers_broadcast)},
      {"rtr-treated-as-data-frame",
       "Remote frames are taken for data frames full of zeros",
       {"SYNC-CON-02", "PDO-RX-13", "SDO-GEN-10", "EC-HBC-11"},
       behave(&Behaviour::accepts_remote_frames)},
      {"extended-frame-accepted-as-standard",
       "Frames with a 29-bit identifier are taken for 11-bit ones",
       {"SDO-GEN-11", "NMT-FSA-19", "SYNC-CON-02", "PDO-RX-13"},
       behave(&Behaviour::accepts_extended_frames)},
      {"listens-on-own-tx-id",
       "Requests on the response CAN-ID are served",
       {"SDO-GEN-12"},
       behave(&Behaviour::answers_on_response_id)},
      {"sdo-dead-in-preop",
       "No SDO responses in Pre-operational",
       {"SDO-GEN-13", "OD-RST-07"},
       mute(Service::sdo, NmtState::pre_operational)},
      {"sdo-dead-in-operational",
       "No SDO responses in Operational",
       {"SDO-GEN-14", "NMT-FSA-22"},
       mute(Service::sdo, NmtState::operational)},
      {"sdo-served-in-stopped",
       "SDO requests are served in Stopped",
       {"SDO-GEN-15", "NMT-FSA-23", "SDO-SUP-19"},
       behave(&Behaviour::sdo_served_in_stopped)},
      {"sdo-served-before-bootup",
       "SDO requests are served before the boot-up message",
       {"SDO-GEN-16", "NMT-BOOT-05"},
       behave(&Behaviour::sdo_served_before_boot_up)},
      {"sdo-slow-response",
       "Every SDO response takes 150 ms",
       {"SDO-GEN-18"},
       Filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
         if (context.service != Service::sdo) return;
         for (Outgoing& outgoing : frames) outgoing.delay += std::chrono::milliseconds(150);
       })},
      {"sdo-drops-every-nth-request",
       "Every 100th SDO request stays without response",
       {"SDO-GEN-19", "SDO-GEN-18"},
       Filter([count = 0](const FilterContext& context, std::vector<Outgoing>& frames) mutable {
         if (context.service == Service::sdo && ++count % 100 == 0) frames.clear();
       })},
  };
}

DefectTable transfer_rows() {
  return {
      {"u8-sent-as-u32",
       "Every expedited upload claims four bytes",
       {"SDO-UPL-02", "SDO-UPL-03", "OD-GEN-10", "OD-LEN-04", "OD-1001-01"},
       patch(upload_initiated,
             [](const SdoExchange&, Data& data) {
               if (is_expedited_upload(data)) data[0] = 0x43;
             })},
      {"upload-size-not-indicated",
       "Expedited uploads never tell their size",
       {"OD-LEN-04", "OD-GEN-10"},
       patch(upload_initiated,
             [](const SdoExchange&, Data& data) {
               if (is_expedited_upload(data)) data[0] = 0x42;
             })},
      {"data-big-endian",
       "Expedited uploads send numbers with the most significant byte first",
       {"OD-ACC-04", "SDO-DNL-01", "OD-1000-07", "OD-1018-08", "OD-1017-03"},
       patch(upload_initiated,
             [](const SdoExchange&, Data& data) {
               if (!is_expedited_upload(data)) return;
               std::reverse(data.begin() + 4,
                            data.begin() + 4 + static_cast<std::ptrdiff_t>(expedited_size(data)));
             })},
      {"u64-truncated-to-expedited",
       "Numbers of five to eight bytes are sent expedited, cut to four",
       {"SDO-UPL-05"},
       behave(&Behaviour::long_numbers_truncated)},
      {"stale-data-returned",
       "An upload returns the data of the upload before it",
       {"OD-GEN-13", "SDO-UPL-06"},
       Filter([last = Data{}](const FilterContext& context, std::vector<Outgoing>& frames) mutable {
         if (context.sdo == nullptr || !upload_initiated(*context.sdo)) return;
         for (Outgoing& outgoing : frames) {
           Data& data = outgoing.frame.data;
           if (!is_expedited_upload(data)) continue;
           const Data fresh = data;
           std::copy_n(last.begin() + 4, 4, data.begin() + 4);
           last = fresh;
         }
       })},
      {"expedited-unsized-aborted-but-stored",
       "An expedited download without size is aborted after it was stored",
       {"SDO-DNL-05", "SDO-DNL-06", "SDO-DNL-20"},
       respond(unsized_expedited_download, 0x80, 0x06070010)},
      {"toggle-not-checked-upload",
       "The toggle bit of upload segment requests is not checked",
       {"SDO-SUP-05", "SDO-SUP-06"},
       behave(&Behaviour::upload_toggle_unchecked)},
      {"toggle-not-checked-download",
       "The toggle bit of download segments is not checked",
       {"SDO-SDN-04", "SDO-SDN-05"},
       behave(&Behaviour::download_toggle_unchecked)},
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
      {"segment-response-toggle-wrong",
       "Download segments are always confirmed with toggle 0",
       {"SDO-SDN-03"},
       patch(download_segment_taken, [](const SdoExchange&, Data& data) { data[0] &= 0xEFU; })},
      {"last-segment-confirmed-as-initiate",
       "The last download segment is confirmed by an initiate response",
       {"SDO-SDN-01", "SDO-SDN-03"},
       respond(last_download_segment, 0x60, 0)},
      {"abort-does-not-close-transfer",
       "After a toggle abort the transfer goes on",
       {"SDO-SUP-07"},
       behave(&Behaviour::abort_keeps_transfer)},
      {"segment-served-without-initiate",
       "An upload segment request without transfer gets an empty last segment",
       {"SDO-SUP-08", "SDO-SUP-09"},
       respond(segment_without_transfer, 0x0F, 0)},
      {"download-segment-served-without-initiate",
       "A download segment without transfer is confirmed",
       {"SDO-SDN-16", "SDO-SDN-26"},
       respond(download_segment_without_transfer, 0x20, 0)},
      {"transfer-not-closed-after-last-segment",
       "After the last upload segment the transfer starts again",
       {"SDO-SUP-09"},
       behave(&Behaviour::transfer_stays_open_after_last)},
      {"client-abort-ignored",
       "A client abort does not end the transfer",
       {"SDO-SUP-10", "SDO-SDN-19"},
       behave(&Behaviour::ignores_client_abort)},
      {"client-abort-answered",
       "A client abort is answered with an abort",
       {"SDO-ERR-03", "SDO-SUP-10", "SDO-SDN-19"},
       behave(&Behaviour::answers_client_abort)},
      {"new-initiate-wedges-server",
       "While a segmented transfer is open no new one is served",
       {"SDO-SUP-11", "SDO-SUP-12", "SDO-SDN-17"},
       behave(&Behaviour::initiate_ignored_while_busy)},
      {"transfer-survives-reset-comm",
       "A segmented transfer goes on after reset communication",
       {"SDO-SUP-20"},
       behave(&Behaviour::transfer_survives_reset)},
      {"segmented-download-not-supported",
       "Segmented downloads are refused although objects of more than four bytes are rw",
       {"SDO-SDN-01", "SDO-SDN-03"},
       respond(segmented_download_initiated, 0x80, 0x05040001)},
      {"segmented-ack-but-not-stored",
       "Segmented downloads are confirmed and forgotten",
       {"SDO-SDN-01", "SDO-SDN-03"},
       behave(&Behaviour::segmented_download_not_stored)},
      {"segmented-size-mismatch-accepted",
       "Fewer bytes than announced are padded with zeros",
       {"SDO-SDN-08"},
       behave(&Behaviour::segment_shortfall_unchecked)},
      {"segmented-surplus-accepted",
       "More bytes than announced are taken and cut off",
       {"SDO-SDN-09", "SDO-SDN-10", "SDO-SDN-27"},
       behave(&Behaviour::segment_overflow_unchecked)},
      {"unknown-ccs-silent",
       "An unknown command specifier gets no answer",
       {"SDO-ERR-01", "SDO-ERR-02"},
       silent(unknown_command)},
      {"wrong-abort-unknown-ccs",
       "An unknown command specifier is aborted with 0602 0000h",
       {"SDO-ERR-01", "SDO-ERR-02"},
       Filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
         if (context.sdo == nullptr || !unknown_command(*context.sdo)) return;
         for (Outgoing& outgoing : frames)
           conform::store_le(std::span(outgoing.frame.data).subspan(4), 0x06020000);
       })},
      {"abort-code-big-endian",
       "Abort codes are sent with the most significant byte first",
       {"SDO-UPL-14", "SDO-ERR-05", "OD-GEN-04"},
       patch(aborted, [](const SdoExchange&, Data& data) { std::reverse(data.begin() + 4, data.end()); })},
      {"abort-mux-zero",
       "Aborts carry the multiplexer 0000h:00",
       {"SDO-ERR-04", "SDO-UPL-14", "OD-GEN-04"},
       patch(aborted, [](const SdoExchange&, Data& data) { data[1] = data[2] = data[3] = 0; })},
      {"short-dlc-uses-stale-bytes",
       "A request of fewer than eight bytes is completed from the one before it",
       {"SDO-ERR-07", "SDO-ERR-06"},
       behave(&Behaviour::short_requests_completed)},
  };
}

}  // namespace

DefectTable sdo_defects() {
  DefectTable rows = frame_rows();
  DefectTable transfers = transfer_rows();
  rows.insert(rows.end(), std::make_move_iterator(transfers.begin()),
              std::make_move_iterator(transfers.end()));
  return rows;
}

}  // namespace refnode
