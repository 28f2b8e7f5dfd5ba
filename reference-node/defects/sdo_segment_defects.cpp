// SPDX-License-Identifier: Apache-2.0
// Defects of segmented transfers that show in the frames: sizes, toggle bits, marks, and what ends a
// transfer.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "defects/sdo_exchanges.hpp"
#include "defects/sdo_rules.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

void defect::Transfer::see(const SdoExchange& exchange, const std::vector<Outgoing>& frames) {
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

namespace {

constexpr AbortCode time_out{0x05040000};

/// Runs `change` on the frames of an exchange that met a running transfer of the given direction.
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

void drop(const SdoExchange&, std::vector<Outgoing>& frames) { frames.clear(); }

/// The frames' data in place of what the server answered.
void answer(std::vector<Outgoing>& frames, const Data& data) {
  for (Outgoing& outgoing : frames) outgoing.frame.data = data;
}

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

/// A transfer of this direction that is left alone is not aborted, and the requests that come then are not
/// answered for a while.
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

bool timed_out(const SdoExchange& e) { return e.step == SdoStep::time_out; }

/// What a text held beyond the bytes written stays.
void keep_tail(Entry& entry) {
  if (fixed_size(entry.type) != 0 || entry.access != Access::rw) return;
  Entry* self = &entry;  // entries live in maps: they do not move
  const auto old = std::make_shared<Bytes>();
  entry.check = [self, old](ByteView) -> Accepted {
    *old = self->value;
    return {};
  };
  entry.written = [self, old] {
    const std::size_t size = self->value.size();
    if (old->size() > size) {
      self->value.insert(self->value.end(), old->begin() + static_cast<std::ptrdiff_t>(size), old->end());
    }
  };
}

bool segment_size_is_7(const Data& data) { return (data[0] & 0x0EU) == 0; }
bool empty_last_segment(const SdoExchange& e) {
  return e.step == SdoStep::download_segment && (e.request[0] & 0x0FU) == 0x0F;
}

bool any_toggle(const std::function<bool(bool, bool)>&, bool, bool) { return true; }

/// What has come is filled up with zeros or cut off to what was announced or, if nothing was, to what the
/// entry takes.
Change stores_as_much_as_fits() {
  return [](Parts& parts) {
    const auto most = std::make_shared<std::size_t>(0);
    SegmentedRules& rules = of_segments(parts);
    rules.fits.replace([most](const auto& former, std::size_t received, std::size_t limit) {
      *most = limit;
      return former(received, limit);
    });
    rules.store.replace([most](const auto& former, Multiplexer mux, ByteView data) {
      Bytes value(data.begin(), data.end());
      value.resize(*most);
      return former(mux, value);
    });
  };
}

/// The segments of a download are in the entry as they come.
Change shows_partial_downloads() {
  return [](Parts& parts) {
    ObjectDictionary& od = parts.device.dictionary;
    parts.device.outbox.add_filter(
        [&od, data = Bytes{}](const FilterContext& context, std::vector<Outgoing>&) mutable {
          if (context.sdo == nullptr) return;
          const SdoExchange& exchange = *context.sdo;
          if (segmented_download_initiated(exchange)) data.clear();
          if (exchange.step != SdoStep::download_segment || last_download_segment(exchange)) return;
          if (exchange.aborted == abort_code::command_unknown ||
              exchange.aborted == abort_code::toggle_not_alternated)
            return;
          const auto count = static_cast<std::ptrdiff_t>(7U - ((exchange.request[0] >> 1U) & 0x07U));
          data.insert(data.end(), exchange.request.begin() + 1, exchange.request.begin() + 1 + count);
          if (Entry* entry = od.entry(exchange.index(), exchange.sub()))
            std::copy_n(data.begin(), std::min(data.size(), entry->value.size()), entry->value.begin());
        });
  };
}

/// A download that follows one aborted by the client goes on with the toggle bit that was due there.
void toggles_on_behind_an_abort(Parts& parts) {
  struct Memory {
    bool due = false;   ///< in the transfer that is running
    bool left = false;  ///< by one that was aborted
  };
  const auto memory = std::make_shared<Memory>();
  misreads([memory](Parts& node, Frame& frame) {
    const SdoServer* server = is_base_data_frame(frame) ? node.sdo.server_of(frame) : nullptr;
    if (server == nullptr || frame.size() != 8) return;
    const bool downloading = server->running<SegmentedDownload>() != nullptr;
    if (frame.data[0] >> 5U == 4 && downloading) memory->left = memory->due;
    if (frame.data[0] >> 5U == 1) memory->due = false;
  })(parts);
  of_segments(parts).download_toggle_right.replace([memory](const auto& former, bool toggle, bool due) {
    if (std::exchange(memory->left, false)) return former(toggle, !due);
    memory->due = !toggle;
    return former(toggle, due);
  });
}

/// What has come of a download is stored when NMT stop ends it.
void stores_half_when_stopped(Parts& parts) {
  const auto data = std::make_shared<Bytes>();
  parts.device.outbox.add_filter([data](const FilterContext& context, std::vector<Outgoing>&) {
    if (context.sdo == nullptr || context.sdo->channel != 0) return;
    if (segmented_download_initiated(*context.sdo)) data->clear();
    if (!download_segment_taken(*context.sdo)) return;
    const auto& request = context.sdo->request;
    data->insert(data->end(), request.begin() + 1, request.end() - ((request[0] >> 1U) & 0x07U));
  });
  ahead_of_state_change([data](Parts& node) {
    const SdoServer* server =
        node.sdo.server_of(conform::can::data_frame(conform::CanId(0x600U + node.device.node_id), {}));
    const auto* open = server == nullptr ? nullptr : server->running<SegmentedDownload>();
    if (node.device.state != NmtState::stopped || open == nullptr || data->empty()) return;
    [[maybe_unused]] const auto stored = of_segments(node).store(open->mux(), *data);
  })(parts);
}

DefectTable upload_rows() {
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

DefectTable download_rows() {
  return {
      {"toggle-not-checked-download",
       "The toggle bit of download segments is not checked",
       {"SDO-SDN-04", "SDO-SDN-05"},
       decides(of_segments, &SegmentedRules::download_toggle_right, any_toggle)},
      {"segment-response-toggle-wrong",
       "Download segments are always confirmed with toggle 0",
       {"SDO-SDN-03"},
       patch(download_segment_taken, [](const SdoExchange&, Data& data) { data[0] &= 0xEFU; })},
      {"last-segment-confirmed-as-initiate",
       "The last download segment is confirmed by an initiate response",
       {"SDO-SDN-01", "SDO-SDN-03"},
       respond(last_download_segment, 0x60, 0)},
      {"download-segment-served-without-initiate",
       "A download segment without transfer is confirmed",
       {"SDO-SDN-16", "SDO-SDN-26"},
       respond(download_segment_without_transfer, 0x20, 0)},
      {"segmented-download-not-supported",
       "Segmented downloads are refused although objects of more than four bytes are rw",
       {"SDO-SDN-01", "SDO-SDN-03", "OD-ACC-04"},
       respond(segmented_download_initiated, 0x80, 0x05040001)},
      {"segmented-ack-but-not-stored",
       "Segmented downloads are confirmed and forgotten",
       {"SDO-SDN-01", "SDO-SDN-03", "OD-ACC-04"},
       decides(of_segments, &SegmentedRules::store,
               [](const auto&, Multiplexer, ByteView) { return Accepted{}; })},
      {"segmented-size-mismatch-accepted",
       "Fewer bytes than announced are padded with zeros",
       {"SDO-SDN-08", "OD-LEN-01"},
       together(decides(of_segments, &SegmentedRules::complete,
                        [](const auto&, std::size_t, std::size_t) { return true; }),
                stores_as_much_as_fits())},
      {"segmented-shortfall-taken",
       "Fewer bytes than announced are taken where the type of the entry allows it",
       {"SDO-SDN-08"},
       decides(of_segments, &SegmentedRules::complete,
               [](const auto&, std::size_t, std::size_t) { return true; })},
      {"segmented-surplus-accepted",
       "More bytes than announced are taken and cut off",
       {"SDO-SDN-09", "SDO-SDN-10", "SDO-SDN-27", "OD-LEN-02"},
       together(decides(of_segments, &SegmentedRules::fits,
                        [](const auto&, std::size_t, std::size_t) { return true; }),
                stores_as_much_as_fits())},
      {"abandoned-download-blocks-the-server",
       "A segmented download that is left alone blocks the server",
       {"SDO-SDN-25"},
       stuck_when_abandoned(Transfer::Direction::download)},
      {"partial-download-visible",
       "The segments of an unfinished download can be read already",
       {"SDO-SDN-18"},
       shows_partial_downloads()},
      {"shorter-text-keeps-the-old-tail",
       "Of a text that is replaced by a shorter one the end stays",
       {"SDO-SDN-11", "SDO-SDN-15"},
       everywhere(keep_tail)},
      {"segmented-download-silent",
       "A request for a segmented download gets no answer",
       {"SDO-SDN-01", "SDO-SDN-03", "OD-ACC-04"},
       silent([](const SdoExchange& e) { return e.step == SdoStep::download_initiate && !is_expedited(e); })},
      {"segmented-download-of-small-entries-refused",
       "Segmented downloads of up to four bytes are refused, longer ones are served",
       {"SDO-SDN-01"},
       respond(
           [](const SdoExchange& e) {
             return segmented_download_initiated(e) && is_sized(e) && e.request[4] <= 4 && e.request[5] == 0;
           },
           0x80, 0x05040001)},
      {"segmented-unsized-refused",
       "Segmented downloads that do not tell their size are refused",
       {"SDO-SDN-02"},
       respond([](const SdoExchange& e) { return segmented_download_initiated(e) && !is_sized(e); }, 0x80,
               0x06070010)},
      {"zero-length-download-confirmed",
       "A segmented download of no bytes to an entry of fixed length is confirmed",
       {"SDO-SDN-14"},
       Filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
         if (context.sdo == nullptr || context.sdo->aborted != abort_code::length_too_low) return;
         if (empty_last_segment(*context.sdo)) answer(frames, {0x20});
       })},
      {"zero-length-download-hangs",
       "A segmented download of no bytes gets no answer",
       {"SDO-SDN-15", "SDO-SDN-14"},
       silent(empty_last_segment)},
      {"refused-segment-confirmed-as-well",
       "A last segment that is refused is confirmed first",
       {"SDO-SDN-24", "SDO-GEN-04"},
       Filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
         if (context.sdo == nullptr || frames.empty() || !aborted(*context.sdo)) return;
         if (context.sdo->step != SdoStep::download_segment) return;
         frames.insert(frames.begin(), frames.front());
         frames.front().frame.data = {static_cast<std::uint8_t>(0x20U | (context.sdo->request[0] & 0x10U))};
       })},
      {"confirmed-segment-aborted-as-well",
       "A last segment is confirmed and then aborted",
       {"SDO-SDN-24", "SDO-GEN-04"},
       Filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
         if (context.sdo == nullptr || frames.empty() || !last_download_segment(*context.sdo)) return;
         frames.push_back(frames.back());
         const auto mux = context.sdo->mux;
         Data& data = frames.back().frame.data;
         data = {0x80, static_cast<std::uint8_t>(mux.index.value() & 0xFFU),
                 static_cast<std::uint8_t>(mux.index.value() >> 8U), mux.sub.value()};
         store_code(data, abort_code::general_error);
       })},
      {"upload-segment-served-during-a-download",
       "An upload segment request during a download gets an empty segment",
       {"SDO-SDN-20"},
       during(
           Transfer::Direction::download,
           [](const SdoExchange& e) { return e.step == SdoStep::upload_segment; },
           [](const SdoExchange& e, std::vector<Outgoing>& frames) {
             answer(frames, {static_cast<std::uint8_t>(0x0FU | (e.request[0] & 0x10U))});
           })},
      {"new-download-ignored-during-a-download",
       "A download request during a segmented download gets no answer",
       {"SDO-SDN-17"},
       during(Transfer::Direction::download, download_initiated, drop)},
      {"segmented-download-to-absent-object-confirmed",
       "A segmented download to an absent object is confirmed",
       {"SDO-SDN-22"},
       respond(
           [](const SdoExchange& e) {
             return e.step == SdoStep::download_initiate && !is_expedited(e) &&
                    e.aborted == abort_code::no_object;
           },
           0x60, 0)},
      {"segmented-download-to-absent-sub-index-confirmed",
       "A segmented download to an absent sub-index is confirmed",
       {"SDO-SDN-22"},
       respond(
           [](const SdoExchange& e) {
             return e.step == SdoStep::download_initiate && !is_expedited(e) &&
                    e.aborted == abort_code::no_sub_index;
           },
           0x60, 0)},
      {"segmented-download-toggles-on-behind-abort",
       "A segmented download that follows one aborted by the client begins with the toggle bit that was due there",
       {"SDO-SDN-03"},
       Change(toggles_on_behind_an_abort)},
      {"segmented-download-stored-when-stopped",
       "NMT stop stores what has come of a segmented download",
       {"SDO-SDN-18"},
       Change(stores_half_when_stopped)},
      {"sdo-seg-download-compares-segments",
       "A segmented download with fewer bytes than were told is taken where the number of segments is right",
       {"SDO-SDN-08"},
       decides(of_segments, &SegmentedRules::complete,
               [](const auto& former, std::size_t received, std::size_t announced) {
                 return former((received + 6) / 7 * 7, announced);
               })},
  };
}

}  // namespace

DefectTable sdo_segment_defects() {
  DefectTable rows = upload_rows();
  DefectTable others = download_rows();
  append(rows, std::move(others));
  return rows;
}

}  // namespace refnode
