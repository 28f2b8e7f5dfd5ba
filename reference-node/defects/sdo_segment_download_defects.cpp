// SPDX-License-Identifier: Apache-2.0
// Defects of segmented downloads: sizes, toggle bits, what is stored, and what ends a transfer.
#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

#include "defects/sdo_exchanges.hpp"
#include "defects/sdo_rules.hpp"
#include "defects/sdo_transfers.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

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

bool empty_last_segment(const SdoExchange& e) {
  return e.step == SdoStep::download_segment && (e.request[0] & 0x0FU) == 0x0F;
}

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

}  // namespace

DefectTable sdo_segment_download_defects() {
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
      {"unwritable-segment-confirmed-as-well",
       "A segmented download to what cannot be written is begun, and its last segment confirmed and aborted",
       {"SDO-SDN-24", "SDO-GEN-04"},
       together([](Parts& parts) { parts.sdo.choices.entry_looked_at_late = true; },
                Filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
                  if (context.sdo == nullptr || frames.empty() || !aborted(*context.sdo)) return;
                  if (context.sdo->step != SdoStep::download_segment) return;
                  const auto code = context.sdo->aborted;
                  if (code != abort_code::read_only && code != abort_code::no_object) return;
                  frames.insert(frames.begin(), frames.front());
                  frames.front().frame.data = {0x20};
                }))},
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

}  // namespace refnode
