// SPDX-License-Identifier: Apache-2.0
// Defects of the SDO server as a channel: frames, addressing, states, load, aborts and unknown commands.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>
#include <utility>

#include "defects/hooks.hpp"
#include "defects/sdo_exchanges.hpp"
#include "defects/sdo_rules.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

Filter deaf_after_boot_up(Duration time) {
  // Not after power-on, or the run ends before it has begun.
  return [time, ready = BusTime{}, boot_ups = 0](const FilterContext& context,
                                                 std::vector<Outgoing>& frames) mutable {
    if (context.service == Service::boot_up && ++boot_ups > 1) ready = context.now + time;
    if (context.service == Service::sdo && context.now < ready) frames.clear();
  };
}

/// Requests on other CAN-IDs are taken for such to the default server, too.
Change serves_requests_on(bool (*also)(std::uint32_t id, std::uint8_t node_id)) {
  return misreads([also](Parts& parts, Frame& frame) {
    const std::uint8_t node_id = parts.device.node_id;
    if (is_base_data_frame(frame) && also(frame.id, node_id)) frame.id = 0x600U + node_id;
  });
}

/// The abort of what `request` asked for.
Data abort_of(const Data& request, AbortCode code) {
  Data abort{0x80, request[1], request[2], request[3]};
  store_code(abort, code);
  return abort;
}

Change refuses_in_stopped() {
  return Reading([](Parts& parts, std::vector<Frame>& frames) {
    if (parts.device.state != NmtState::stopped) return;
    for (const Frame& frame : frames) {
      const auto channel = channel_of(parts, frame);
      if (!channel || frame.size() != 8) continue;
      parts.device.send(Service::sdo,
                        conform::can::data_frame(conform::CanId(response_id(parts, *channel)),
                                                 abort_of(frame.data, abort_code::device_state)));
    }
  });
}

/// The last request of Stopped comes again as soon as SDO works, before the next frame.
Change serves_after_stopped() {
  return Reading([held = std::optional<Frame>{}](Parts& parts, std::vector<Frame>& frames) mutable {
    if (held && parts.device.works_now(Service::sdo)) frames.insert(frames.begin(), *std::exchange(held, {}));
    if (parts.device.state != NmtState::stopped) return;
    for (const Frame& frame : frames) {
      if (channel_of(parts, frame)) held = frame;
    }
  });
}

Change completes_short_requests() {
  return misreads([last = Data{}](Parts& parts, Frame& frame) mutable {
    if (!is_base_data_frame(frame) || frame.id != 0x600U + parts.device.node_id) return;
    std::copy_n(frame.data.begin(), frame.size(), last.begin());
    frame.data = last;
    frame.dlc = 8;
  });
}

Change answers_client_aborts() {
  return [](Parts& parts) {
    parts.device.outbox.add_filter([&parts](const FilterContext& context, std::vector<Outgoing>& frames) {
      constexpr unsigned client_abort = 4;
      if (context.sdo == nullptr || !frames.empty()) return;
      const SdoExchange& exchange = *context.sdo;
      if (exchange.step != SdoStep::other || exchange.request[0] >> 5U != client_abort) return;
      frames.push_back({conform::can::data_frame(conform::CanId(response_id(parts, exchange.channel)),
                                                 abort_of(exchange.request, abort_code::general_error)),
                        parts.sdo.choices.turnaround});
    });
  };
}

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
       serves_requests_on([](std::uint32_t id, std::uint8_t) { return id >= 0x601 && id <= 0x67F; })},
      {"answers-sdo-broadcast",
       "SDO requests on 600h are answered",
       {"SDO-GEN-09"},
       serves_requests_on([](std::uint32_t id, std::uint8_t) { return id == 0x600; })},
      {"rtr-treated-as-data-frame",
       "Remote frames are taken for data frames full of zeros",
       {"SYNC-CON-02", "PDO-RX-13", "SDO-GEN-10", "EC-HBC-11"},
       misreads([](Parts&, Frame& frame) { frame.remote = false; })},
      {"extended-frame-accepted-as-standard",
       "Frames with a 29-bit identifier are taken for 11-bit ones",
       {"SDO-GEN-11", "NMT-FSA-19", "SYNC-CON-02", "PDO-RX-13", "LSS-GEN-03"},
       misreads([](Parts&, Frame& frame) { frame.extended = false; })},
      {"listens-on-own-tx-id",
       "Requests on the response CAN-ID are served",
       {"SDO-GEN-12"},
       serves_requests_on([](std::uint32_t id, std::uint8_t node_id) { return id == 0x580U + node_id; })},
      {"sdo-dead-in-preop",
       "No SDO responses in Pre-operational",
       {"SDO-GEN-13", "OD-RST-07", "SDO-GEN-01"},
       mute(Service::sdo, NmtState::pre_operational)},
      {"sdo-dead-in-operational",
       "No SDO responses in Operational",
       {"SDO-GEN-14", "NMT-FSA-22"},
       mute(Service::sdo, NmtState::operational)},
      {"sdo-served-in-stopped",
       "SDO requests are served in Stopped",
       {"SDO-GEN-15", "NMT-FSA-23", "SDO-SUP-19"},
       works_also(Service::sdo, NmtState::stopped)},
      {"sdo-refused-in-stopped",
       "SDO requests in Stopped are aborted with 0800 0022h instead of staying unanswered",
       {"SDO-GEN-15", "NMT-FSA-23"},
       refuses_in_stopped()},
      {"sdo-served-after-stopped",
       "The last SDO request that came in Stopped is answered as soon as the node leaves it",
       {"SDO-GEN-15"},
       serves_after_stopped()},
      {"sdo-served-before-bootup",
       "SDO requests are served before the boot-up message",
       {"SDO-GEN-16", "NMT-BOOT-05"},
       works_also(Service::sdo, NmtState::initialising)},
      {"sdo-slow-response",
       "Every SDO response takes 150 ms",
       {"SDO-GEN-18"},
       Filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
         if (context.service != Service::sdo) return;
         for (Outgoing& outgoing : frames) outgoing.delay += std::chrono::milliseconds(150);
       })},
      {"sdo-drops-every-nth-request",
       "Every 100th SDO request stays without response",
       {"SDO-GEN-19", "SDO-GEN-18", "SDO-GEN-01"},
       Filter([count = 0](const FilterContext& context, std::vector<Outgoing>& frames) mutable {
         if (context.service == Service::sdo && ++count % 100 == 0) frames.clear();
       })},
      {"sdo-response-id-cut-to-8-bits",
       "Only the lower 8 bits of the CAN-ID of responses are used",
       {"SDO-GEN-01"},
       reshape(Service::sdo, [](const FilterContext&, Frame& frame) { frame.id &= 0xFFU; })},
      {"sdo-response-extended",
       "Responses have a 29-bit identifier",
       {"SDO-GEN-01", "SDO-GEN-02", "CAN-TRF-03"},
       reshape(Service::sdo, [](const FilterContext&, Frame& frame) { frame.extended = true; })},
      {"sdo-not-ready-after-boot-up",
       "After a reset SDO requests are answered from 200 ms after the boot-up message on",
       {"SDO-GEN-17", "OD-RST-07"},
       deaf_after_boot_up(std::chrono::milliseconds(200))},
      {"sdo-not-ready-long-after-boot-up",
       "After a reset SDO requests are answered from 1.5 s after the boot-up message on",
       {"SDO-GEN-17", "OD-RST-07"},
       deaf_after_boot_up(std::chrono::milliseconds(1500))},
      {"sdo-second-request-gets-data-of-the-first",
       "A request that comes while a response is being prepared is answered with the data of that response",
       {"SDO-GEN-20"},
       Filter([busy_until = BusTime{}, last = Data{}](const FilterContext& context,
                                                      std::vector<Outgoing>& frames) mutable {
         if (context.service != Service::sdo || frames.empty()) return;
         Data& data = frames.front().frame.data;
         if (context.now < busy_until) std::copy(last.begin() + 4, last.end(), data.begin() + 4);
         last = data;
         // The longer, the surer is the second request to come in between.
         frames.front().delay += std::chrono::milliseconds(3);
         busy_until = context.now + std::chrono::milliseconds(3);
       })},
      {"sdo-late-response",
       "Every 150th response comes after 1.2 s",
       {"SDO-GEN-19", "SDO-GEN-18"},
       Filter([count = 0](const FilterContext& context, std::vector<Outgoing>& frames) mutable {
         if (context.service != Service::sdo || ++count % 150 != 0) return;
         for (Outgoing& outgoing : frames) outgoing.delay += std::chrono::milliseconds(1200);
       })},
  };
}

DefectTable command_rows() {
  return {
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
       completes_short_requests()},
      {"client-abort-ignored",
       "A client abort does not end the transfer",
       {"SDO-SUP-10", "SDO-SDN-19", "SDO-BUP-17", "SDO-BUP-18", "SDO-BDN-19", "SDO-BDN-20"},
       goes_on_after_abort(SdoSide::client)},
      {"client-abort-answered",
       "A client abort is answered with an abort",
       {"SDO-ERR-03", "SDO-SUP-10", "SDO-SDN-19"},
       answers_client_aborts()},
      {"unknown-ccs-served",
       "Command specifier 7 is answered like an upload request",
       {"SDO-ERR-01", "SDO-ERR-02"},
       respond(unknown_command, 0x43, 0)},
      {"unknown-ccs-echoed",
       "A request with an unknown command specifier comes back as it was",
       {"SDO-ERR-01", "SDO-ERR-02"},
       patch(unknown_command, [](const SdoExchange& e, Data& data) { data = e.request; })},
      {"abort-request-with-reserved-bits-hangs",
       "A client abort with reserved bits set stops the server for good",
       {"SDO-ERR-09"},
       Filter([stopped = false](const FilterContext& context, std::vector<Outgoing>& frames) mutable {
         if (context.service == Service::boot_up) stopped = false;
         if (context.sdo == nullptr) return;
         const std::uint8_t command = context.sdo->request[0];
         const auto step = context.sdo->step;
         const bool segment = step == SdoStep::block_download_segment || step == SdoStep::block_download_ack;
         if (command > 0x80 && command < 0xA0 && !segment) stopped = true;
         if (stopped) frames.clear();
       })},
      {"abort-mux-stale",
       "Aborts carry the multiplexer of the request before",
       {"SDO-ERR-04", "SDO-UPL-14", "OD-GEN-04"},
       Filter([last = Data{}](const FilterContext& context, std::vector<Outgoing>& frames) mutable {
         if (context.sdo == nullptr) return;
         if (context.sdo->aborted) {
           for (Outgoing& outgoing : frames)
             std::copy_n(last.begin() + 1, 3, outgoing.frame.data.begin() + 1);
         }
         last = context.sdo->request;
       })},
      {"unknown-command-abort-names-another-object",
       "The abort of an unknown command names the object four behind that of the request",
       {"SDO-ERR-04"},
       patch([](const SdoExchange& e) { return aborted(e) && (e.request[0] & 0xE0U) == 0xE0U; },
             [](const SdoExchange& e, Data& data) {
               data[1] = static_cast<std::uint8_t>(e.request[1] + 4);
               data[2] = e.request[2];
               data[3] = e.request[3];
             })},
      {"segment-abort-mux-zero",
       "Aborts of a running transfer carry the multiplexer 0000h:00",
       {"SDO-ERR-04", "SDO-SUP-05", "SDO-SDN-04"},
       patch(
           [](const SdoExchange& e) {
             return aborted(e) && (e.step == SdoStep::upload_segment || e.step == SdoStep::download_segment);
           },
           [](const SdoExchange&, Data& data) { data[1] = data[2] = data[3] = 0; })},
      {"abort-repeated",
       "Every abort is sent twice",
       {"SDO-ERR-10", "SDO-GEN-04"},
       Filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
         if (context.sdo == nullptr || !aborted(*context.sdo) || frames.empty()) return;
         frames.push_back(frames.back());
       })},
      {"abort-repeated-later",
       "Every abort is sent again after 100 ms",
       {"SDO-ERR-10", "SDO-GEN-04"},
       Filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
         if (context.sdo == nullptr || !aborted(*context.sdo) || frames.empty()) return;
         frames.push_back(frames.back());
         frames.back().delay += std::chrono::milliseconds(100);
       })},
      {"abort-code-always-general",
       "Every abort says 0800 0000h, whatever the reason",
       {"OD-GEN-04", "OD-GEN-07", "OD-ACC-01", "OD-LEN-01", "OD-RNG-01"},
       patch(aborted, [](const SdoExchange&, Data& data) { store_code(data, abort_code::general_error); })},
  };
}

}  // namespace

DefectTable sdo_defects() {
  DefectTable rows = frame_rows();
  DefectTable others = command_rows();
  append(rows, std::move(others));
  return rows;
}

}  // namespace refnode
