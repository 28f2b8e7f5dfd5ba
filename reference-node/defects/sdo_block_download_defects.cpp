// SPDX-License-Identifier: Apache-2.0
// Defects of the SDO block download: sub-blocks, acknowledges, lengths, CRC, and what ends it.
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "defects/sdo_block_exchanges.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

using Rules = BlockDownloadRules;
using Terms = BlockDownloadTerms;

bool acknowledged(const SdoExchange& e) { return e.step == SdoStep::block_download_ack && !e.aborted; }
bool unsized_block_download(const SdoExchange& e) {
  return block_download_initiated(e) && (e.request[0] & 0x02U) == 0;
}
bool block_download_refused(const SdoExchange& e) {
  return e.step == SdoStep::block_download_initiate && e.aborted &&
         (*e.aborted == abort_code::read_only || *e.aborted == abort_code::no_object ||
          *e.aborted == abort_code::no_sub_index);
}
bool end_without_transfer(const SdoExchange& e) {
  return e.step == SdoStep::block_download_end && e.aborted == abort_code::command_unknown;
}
/// A segment to which the conformant server says nothing yet.
bool is_silent_segment(const SdoExchange& e, const Frames& frames) {
  return e.step == SdoStep::block_download_segment && !e.aborted && frames.empty();
}

/// Numbers of the segments of a sub-block: which one is due.
struct SegmentWatch {
  unsigned due = 1;
  bool gap = false;

  void see(const SdoExchange& e) {
    if (block_download_initiated(e)) *this = {};
    const bool segment = e.step == SdoStep::block_download_segment || e.step == SdoStep::block_download_ack;
    if (!segment || e.aborted) return;
    const unsigned number = e.request[0] & 0x7FU;
    if (number == due) ++due;
    gap = number > due;
  }
};

/// Something is done to the data before their length is looked at.
template <typename Do>
Change shapes_data(Do shape) {
  return decides(of_block_download, &Rules::value, [shape](const auto& former, Bytes data, Terms terms) {
    shape(data, terms);
    return former(std::move(data), terms);
  });
}
/// Bytes behind the end are dropped.
Change drops_surplus() {
  return together(
      decides(of_block_download, &Rules::fits, [](const auto&, std::size_t, const Terms&) { return true; }),
      shapes_data(
          [](Bytes& data, const Terms& terms) { data.resize(std::min(data.size(), terms.limit())); }));
}
Change buffer_of(std::size_t bytes) {
  return shapes_data([bytes](Bytes& data, Terms& terms) {
    if (data.size() <= bytes) return;
    data.resize(bytes);
    terms.announced.reset();
  });
}
/// A download may have any length: its end is cut off or filled up.
Change any_length() {
  return [](Parts& parts) {
    Rules& rules = of_block_download(parts);
    rules.may_begin.replace([](const auto& former, Multiplexer mux, std::optional<std::size_t>) {
      return former(mux, std::nullopt);
    });
    rules.value.replace([&parts](const auto& former, Bytes data, Terms terms) {
      if (!parts.device.dictionary.may_download(terms.mux, data.size())) {
        data.resize(terms.capacity);
        terms.announced.reset();
      }
      return former(std::move(data), terms);
    });
    drops_surplus()(parts);
  };
}

/// The segment marked as the last one ends the sub-blocks, whatever was lost before it: what then comes again
/// is no segment any more.
void ends_with_last_mark(Parts& parts) {
  const auto ended = std::make_shared<bool>(false);
  of_block_download(parts).fits.replace([ended](const auto& former, std::size_t size, const Terms& terms) {
    return !*ended && former(size, terms);
  });
  parts.device.outbox.add_filter([ended](const FilterContext& context, Frames& frames) {
    if (context.sdo == nullptr) return;
    const SdoExchange& e = *context.sdo;
    if (*ended && e.step == SdoStep::block_download_segment && e.aborted == abort_code::length_too_high)
      for (Outgoing& outgoing : frames) store_code(outgoing.frame.data, abort_code::command_unknown);
    const bool marked = (e.request[0] & 0x80U) != 0;
    *ended =
        acknowledged(e) && marked && !frames.empty() && frames.front().frame.data[1] < (e.request[0] & 0x7FU);
  });
}

/// A segment whose number `when` holds for is taken for the next one.
Change takes_for_next(bool (*when)(unsigned number, const BlockDownload&)) {
  return misreads([when](Parts& parts, Frame& frame) {
    const BlockDownload* transfer = receiving(parts, frame);
    if (transfer == nullptr || !when(frame.data[0] & 0x7FU, *transfer)) return;
    frame.data[0] = static_cast<std::uint8_t>((frame.data[0] & 0x80U) | (transfer->sequence() + 1U));
  });
}
/// What is missing before a segment is made up with zeros.
void fill_gaps(Parts& parts, std::vector<Frame>& frames) {
  std::vector<Frame> all;
  for (const Frame& segment : frames) {
    const BlockDownload* transfer = receiving(parts, segment);
    const unsigned number = segment.data[0] & 0x7FU;
    const bool behind = transfer != nullptr && number <= transfer->block_size();
    for (unsigned gone = behind ? transfer->sequence() + 1U : number; gone < number; ++gone) {
      all.push_back(segment);
      all.back().data = {static_cast<std::uint8_t>(gone)};
    }
    all.push_back(segment);
  }
  frames = std::move(all);
}

/// The command of the end request is changed before the server sees it. n is in bits 4-2, where a segmented
/// download has it in bits 3-1.
Change misreads_end(unsigned (*command)(unsigned)) {
  return misreads([command](Parts& parts, Frame& frame) {
    const auto* transfer = transfer_of<BlockDownload>(parts, frame);
    if (transfer == nullptr || transfer->in_sub_block() || (frame.data[0] & 0xE1U) != 0xC1) return;
    frame.data[0] = static_cast<std::uint8_t>(command(frame.data[0]));
  });
}

Change expects_crc(std::uint16_t (*other)(ByteView data)) {
  return decides(of_block_download, &Rules::crc, [other](const auto&, ByteView segments, std::size_t size) {
    return other(segments.first(size));
  });
}
Change checks_crc(bool (*when)(bool agreed)) {
  return decides(of_block_download, &Rules::crc_checked,
                 [when](const auto&, bool agreed) { return when(agreed); });
}
/// The CRC is looked at while the whole download fits into one sub-block.
void checks_crc_of_one_sub_block(Parts& parts) {
  const auto received = std::make_shared<std::size_t>(0);
  Rules& rules = of_block_download(parts);
  rules.fits.replace([received](const auto& former, std::size_t size, const Terms& terms) {
    *received = size;
    return former(size, terms);
  });
  rules.crc_checked.replace([received](const auto& former, bool agreed) {
    constexpr std::size_t largest_sub_block = 127 * std::size_t{7};
    return former(agreed) && *received < largest_sub_block;
  });
}
/// The entry has the value by the time its CRC turns out to be wrong.
Change stores_before_crc_check() {
  return [](Parts& parts) {
    const auto value = std::make_shared<Bytes>();
    of_block_download(parts).crc.replace([value](const auto& former, ByteView segments, std::size_t size) {
      value->assign(segments.begin(), segments.begin() + static_cast<std::ptrdiff_t>(size));
      return former(segments, size);
    });
    parts.device.outbox.add_filter([&parts, value](const FilterContext& context, std::vector<Outgoing>&) {
      if (context.sdo == nullptr || context.sdo->aborted != abort_code::crc_wrong) return;
      [[maybe_unused]] const auto stored = parts.device.dictionary.download(context.sdo->mux, *value);
    });
  };
}
/// What the entry refuses is put into it all the same.
Change stores_whatever_comes() {
  return [](Parts& parts) {
    of_block_download(parts).store.replace([&parts](const auto& former, Multiplexer mux, ByteView value) {
      Accepted stored = former(mux, value);
      Entry* entry = parts.device.dictionary.entry(mux.index.value(), mux.sub.value());
      if (stored || entry == nullptr) return stored;
      entry->value.assign(value.begin(), value.end());
      return Accepted{};
    });
  };
}

/// Of a later sub-block that lost a segment nothing is kept, what was acknowledged included.
void forgets_later_sub_blocks_with_a_gap(Parts& parts) {
  struct Memory {
    std::size_t size = 0;  ///< of what is kept and of what is to be forgotten
    bool later = false;
    std::vector<std::pair<std::size_t, std::size_t>> forgotten;  ///< first and end
  };
  const auto memory = std::make_shared<Memory>();
  parts.device.outbox.add_filter(on_exchange([memory](const SdoExchange& e, const Frames& frames) {
    if (block_download_initiated(e)) *memory = {};
    if (!acknowledged(e) || frames.empty()) return;
    const Data& answer = frames.front().frame.data;
    const std::size_t end = memory->size + answer[1] * std::size_t{7};
    const bool last = (e.request[0] & 0x80U) != 0 && (e.request[0] & 0x7FU) == answer[1];
    if (memory->later && !last && answer[1] < answer[2]) memory->forgotten.emplace_back(memory->size, end);
    memory->size = end;
    memory->later = true;
  }));
  of_block_download(parts).value.replace([memory](const auto& former, Bytes data, const Terms& terms) {
    Bytes kept;
    for (std::size_t i = 0; i < data.size(); ++i) {
      const bool gone = std::ranges::any_of(
          memory->forgotten, [i](const auto& range) { return i >= range.first && i < range.second; });
      if (!gone) kept.push_back(data[i]);
    }
    return former(std::move(kept), terms);
  });
}

/// A download that follows one aborted within a sub-block waits for the segment that was due there.
void goes_on_counting_behind_an_abort(Parts& parts) {
  const auto left = std::make_shared<std::uint8_t>(std::uint8_t{0});
  misreads([left](Parts& node, Frame& frame) {
    const auto* transfer = transfer_of<BlockDownload>(node, frame);
    if (transfer != nullptr && is_abort_request(node, frame)) *left = transfer->sequence();
  })(parts);
  of_block_download(parts).follows.replace(
      [left](const auto& former, std::uint8_t number, std::uint8_t last) {
        const bool follows = former(number, last == 0 ? *left : last);
        if (follows) *left = 0;
        return follows;
      });
}

DefectTable frame_rows() {
  return {
      {"block-download-not-stored",
       "Block downloads are confirmed and forgotten",
       {"SDO-BDN-01", "SDO-BDN-02", "SDO-BDN-06"},
       decides(of_block_download, &Rules::store,
               [](const auto&, Multiplexer, ByteView) { return Accepted{}; })},
      {"block-download-end-confirmed-as-download",
       "The end of a block download is confirmed by a download response",
       {"SDO-BDN-01", "SDO-BDN-02"},
       patch([](const SdoExchange& e) { return e.step == SdoStep::block_download_end && !e.aborted; },
             [](const SdoExchange&, Data& data) { data[0] = 0x60; })},
      {"block-download-offers-size-0",
       "The response to a block download request offers a block size of 0",
       {"SDO-BDN-05", "SDO-BDN-01"},
       patch(block_download_initiated, [](const SdoExchange&, Data& data) { data[4] = 0; })},
      {"block-download-acknowledges-with-size-128",
       "Acknowledges of a block download ask for a block size of 128",
       {"SDO-BDN-05"},
       patch(acknowledged, [](const SdoExchange&, Data& data) { data[2] = 128; })},
      {"block-download-unsized-refused",
       "A block download without size is refused",
       {"SDO-BDN-16"},
       on_exchange([refused = false](const SdoExchange& e, Frames& frames) mutable {
         if (begins_transfer(e)) refused = unsized_block_download(e);
         if (refused && is_client_abort(e)) refused = false;
         if (refused) answer_with_abort(frames, e, 0x05040001);
       })},
      {"block-download-unsized-silent",
       "A block download without size gets no answer",
       {"SDO-BDN-16"},
       silent(unsized_block_download)},
      {"block-download-later-sub-blocks-lost",
       "Of a block download only the first sub-block is kept",
       {"SDO-BDN-06"},
       buffer_of(889)},
      {"block-download-buffer-of-1024-bytes",
       "What a block download brings behind 1024 bytes is lost, and the rest is stored",
       {"SDO-BDN-06"},
       buffer_of(1024)},
      {"block-download-loses-segments-at-full-rate",
       "Of a sub-block at full rate the segments behind the 100th are lost",
       {"SDO-BDN-06"},
       deaf_to([](Parts& parts, const Frame& frame) {
         return receiving(parts, frame) != nullptr && (frame.data[0] & 0x7FU) > 100;
       })},
      {"block-download-answers-every-segment",
       "Every segment of a block download is acknowledged",
       {"SDO-BDN-18"},
       Filter([](const FilterContext& context, Frames& frames) {
         if (context.sdo == nullptr || !is_silent_segment(*context.sdo, frames)) return;
         frames.push_back(response(context, {0xA2, context.sdo->sequence, 127}));
       })},
      {"block-download-reserved-bits-silent",
       "A block download request with reserved bits set gets no answer",
       {"SDO-BDN-27"},
       silent([](const SdoExchange& e) {
         return e.step == SdoStep::block_download_initiate && (e.request[0] & 0x18U) != 0;
       })},
      {"block-download-end-bytes-silent",
       "The end of a block download with reserved bytes set gets no answer",
       {"SDO-BDN-27"},
       silent([](const SdoExchange& e) {
         return e.step == SdoStep::block_download_end && (e.request[3] != 0 || e.request[7] != 0);
       })},
  };
}

DefectTable loss_rows() {
  return {
      {"block-download-gap-unnoticed",
       "A lost segment of a block download is not noticed, and the data are stored with a hole",
       {"SDO-BDN-07", "SDO-BDN-08"},
       Reading(fill_gaps)},
      {"block-download-acknowledges-last-number-at-a-gap",
       "After a lost segment the number of the last one is acknowledged",
       {"SDO-BDN-07", "SDO-BDN-08"},
       patch(acknowledged, [](const SdoExchange& e, Data& data) { data[1] = e.request[0] & 0x7FU; })},
      {"block-download-deaf-after-a-gap",
       "After a lost segment a block download is never answered again",
       {"SDO-BDN-07", "SDO-BDN-08"},
       on_exchange([watch = SegmentWatch{}, deaf = false](const SdoExchange& e, Frames& frames) mutable {
         if (is_client_abort(e)) deaf = false;
         watch.see(e);
         deaf = deaf || watch.gap;
         if (begins_transfer(e)) deaf = false;
         if (deaf) frames.clear();
       })},
      {"block-download-ends-with-the-last-mark",
       "A block download that lost a segment of its last sub-block aborts the segments that come again",
       {"SDO-BDN-07"},
       ends_with_last_mark},
      {"block-download-acknowledges-every-segment-behind-a-gap",
       "Every segment behind a lost one is acknowledged",
       {"SDO-BDN-07"},
       Filter([watch = SegmentWatch{}](const FilterContext& context, Frames& frames) mutable {
         if (context.sdo == nullptr) return;
         watch.see(*context.sdo);
         if (acknowledged(*context.sdo)) watch = {};
         if (watch.gap && is_silent_segment(*context.sdo, frames))
           frames.push_back(response(context, {0xA2, static_cast<std::uint8_t>(watch.due - 1), 127}));
       })},
      {"block-download-duplicate-appended",
       "A segment that comes twice is stored twice",
       {"SDO-BDN-09", "SDO-BDN-15"},
       together(drops_surplus(), decides(of_block_download, &Rules::follows,
                                         [](const auto& former, std::uint8_t number, std::uint8_t last) {
                                           return number == last || former(number, last);
                                         }))},
      {"block-download-number-0-accepted",
       "A segment with the number 0 is stored",
       {"SDO-BDN-10"},
       takes_for_next([](unsigned number, const BlockDownload&) { return number == 0; })},
      {"block-download-number-above-size-accepted",
       "A segment with a number above the block size is stored",
       {"SDO-BDN-11"},
       together([](Parts& parts) { parts.sdo.choices.block_size = 16; },
                takes_for_next([](unsigned number, const BlockDownload& transfer) {
                  return number > transfer.block_size();
                }))},
      {"block-download-later-sub-block-lost-with-gap",
       "Behind the first sub-block a lost segment makes forget what came before it in its sub-block",
       {"SDO-BDN-07"},
       Change(forgets_later_sub_blocks_with_a_gap)},
      {"block-download-counts-on-behind-abort",
       "A block download that follows one aborted within a sub-block does not begin with segment 1",
       {"SDO-BDN-17", "SDO-BDN-26"},
       Change(goes_on_counting_behind_an_abort)},
  };
}

DefectTable end_rows() {
  return {
      {"block-download-length-unchecked",
       "The length of a block download is not checked: it is cut or filled up",
       {"SDO-BDN-12", "SDO-BDN-13"},
       any_length()},
      {"block-download-shortfall-filled",
       "A block download of fewer bytes than announced is filled up with zeros",
       {"SDO-BDN-14"},
       shapes_data([](Bytes& data, const Terms& terms) {
         data.resize(std::max(data.size(), terms.announced.value_or(0)));
       })},
      {"block-download-shortfall-taken",
       "A block download of fewer bytes than announced is taken where the type of the entry allows it",
       {"SDO-BDN-14"},
       shapes_data([](Bytes&, Terms& terms) { terms.announced.reset(); })},
      {"block-download-surplus-cut",
       "A block download of more bytes than announced is cut off",
       {"SDO-BDN-15"},
       drops_surplus()},
      {"block-download-padding-stored",
       "The unused bytes of the last segment are stored",
       {"SDO-BDN-17", "SDO-BDN-01"},
       misreads_end([](unsigned command) { return command & 0xE3U; })},
      {"block-download-unused-bytes-misread",
       "The number of unused bytes is read from the wrong bits of the end request",
       {"SDO-BDN-17", "SDO-BDN-01"},
       misreads_end([](unsigned command) { return (command & 0xE3U) | ((command & 0x0EU) << 1U); })},
      {"block-download-range-unchecked",
       "The value of a block download is not checked against the range",
       {"SDO-BDN-24"},
       stores_whatever_comes()},
      {"block-download-crc-other-polynomial",
       "A block download expects a CRC with the polynomial 8005h",
       {"SDO-BDN-02"},
       expects_crc([](ByteView data) { return crc16(data, 0x8005, 0); })},
      {"block-download-crc-starts-with-ffff",
       "A block download expects a CRC that starts with FFFFh",
       {"SDO-BDN-02"},
       expects_crc([](ByteView data) { return crc16(data, ccitt, 0xFFFF); })},
      {"block-download-crc-byte-swapped",
       "A block download expects the CRC with the most significant byte first",
       {"SDO-BDN-02"},
       decides(of_block_download, &Rules::crc,
               [](const auto& former, ByteView segments, std::size_t size) {
                 return std::byteswap(former(segments, size));
               })},
      {"block-download-crc-with-padding",
       "A block download expects a CRC over the unused bytes as well",
       {"SDO-BDN-02"},
       decides(of_block_download, &Rules::crc,
               [](const auto& former, ByteView segments, std::size_t) {
                 return former(segments, segments.size());
               })},
      {"block-download-crc-unchecked",
       "The CRC of a block download is not checked",
       {"SDO-BDN-03"},
       checks_crc([](bool) { return false; })},
      {"block-download-crc-checked-unasked",
       "The CRC of a block download is checked although it was not agreed",
       {"SDO-BDN-04", "SDO-BDN-01"},
       checks_crc([](bool) { return true; })},
      {"block-download-stored-despite-wrong-crc",
       "A block download with a wrong CRC is refused and stored all the same",
       {"SDO-BDN-03", "OD-ACC-05"},
       stores_before_crc_check()},
      {"block-download-access-unchecked",
       "Block downloads to entries that are absent or constant are accepted",
       {"SDO-BDN-23"},
       on_exchange([open = false](const SdoExchange& e, Frames& frames) mutable {
         if (begins_transfer(e)) open = block_download_refused(e);
         if (is_client_abort(e)) open = false;
         if (!open || frames.empty()) return;
         Data& data = frames.front().frame.data;
         if (e.step == SdoStep::block_download_initiate) {
           data = {0xA0, e.request[1], e.request[2], e.request[3], 127};
         } else if (e.step == SdoStep::block_download_end) {
           data = {0xA1};
         } else {
           data = {0xA2, static_cast<std::uint8_t>(e.request[0] & 0x7FU), 127};
         }
       })},
      {"block-download-end-served-without-transfer",
       "The end of a block download is confirmed while none is running",
       {"SDO-BDN-22"},
       patch(end_without_transfer, [](const SdoExchange&, Data& data) { data = {0xA1}; })},
      {"block-download-abort-taken-as-segment",
       "A client abort in a sub-block is taken for a segment and acknowledged",
       {"SDO-BDN-19", "SDO-GEN-04"},
       Filter([watch = BlockWatch{}](const FilterContext& context, Frames& frames) mutable {
         if (context.sdo == nullptr) return;
         const bool receiving = watch.running == BlockWatch::Running::download;
         if (receiving && is_client_abort(*context.sdo)) frames.push_back(response(context, {0xA2, 0, 127}));
         watch.see(*context.sdo, frames);
       })},
      {"block-download-ended-by-any-command",
       "Whatever has bit 0 set ends a block download as its end does",
       {"SDO-BDN-21"},
       misreads([](Parts& parts, Frame& frame) {
         const auto* transfer = transfer_of<BlockDownload>(parts, frame);
         if (transfer == nullptr || transfer->in_sub_block() || (frame.data[0] & 1U) == 0) return;
         if ((frame.data[0] & 0xE3U) == 0xC1) return;
         constexpr unsigned unused = 5;  // of a segment with two bytes
         frame.data[0] = static_cast<std::uint8_t>(0xC1U | (unused << 2U));
       })},
      {"block-download-serves-upload-segments",
       "An upload segment request in place of the end of a block download gets a segment",
       {"SDO-BDN-21"},
       on_exchange([watch = BlockWatch{}](const SdoExchange& e, Frames& frames) mutable {
         const bool wrong =
             watch.running == BlockWatch::Running::download && e.step == SdoStep::upload_segment;
         if (wrong && !frames.empty()) frames.front().frame.data = {0x00};
         watch.see(e, frames);
       })},
      {"sdo-bdn-crc-checked-in-one-sub-block",
       "The CRC of a block download of more than one sub-block is not checked",
       {"SDO-BDN-03"},
       Change(checks_crc_of_one_sub_block)},
      {"sdo-bdn-compares-segments",
       "A block download with fewer bytes than were told is taken where the number of segments is right",
       {"SDO-BDN-14"},
       decides(of_block_download, &Rules::value,
               [](const auto& former, Bytes data, const Terms& terms) -> std::expected<Bytes, AbortCode> {
                 BlockDownloadTerms untold = terms;
                 if ((data.size() + 6) / 7 * 7 >= terms.announced.value_or(0)) untold.announced.reset();
                 return former(std::move(data), untold);
               })},
  };
}

}  // namespace

DefectTable sdo_block_download_defects() {
  DefectTable rows;
  for (auto part : {frame_rows(), loss_rows(), end_rows()}) {
    append(rows, std::move(part));
  }
  return rows;
}

}  // namespace refnode
