// SPDX-License-Identifier: Apache-2.0
// Defects of the SDO block download: sub-blocks, acknowledges, lengths, CRC, and what ends it.
#include <iterator>

#include "defects/sdo_block_exchanges.hpp"

namespace refnode {

using namespace defect;

namespace {

using Block = SdoBlockFaults;

template <typename Value>
BehaviourSwitch block(Value Block::* member, Value value) {
  return [member, value](Behaviour& behaviour) { behaviour.block.*member = value; };
}
BehaviourSwitch block(bool Block::* flag) { return block(flag, true); }

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

DefectTable frame_rows() {
  return {
      {"block-download-not-stored",
       "Block downloads are confirmed and forgotten",
       {"SDO-BDN-01", "SDO-BDN-02", "SDO-BDN-06"},
       block(&Block::not_stored)},
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
       block(&Block::buffer, std::size_t{889})},
      {"block-download-buffer-of-1024-bytes",
       "What a block download brings behind 1024 bytes is lost, and the rest is stored",
       {"SDO-BDN-06"},
       block(&Block::buffer, std::size_t{1024})},
      {"block-download-loses-segments-at-full-rate",
       "Of a sub-block at full rate the segments behind the 100th are lost",
       {"SDO-BDN-06"},
       block(&Block::receives_at_most, std::size_t{100})},
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
       block(&Block::gap_unnoticed)},
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
       block(&Block::duplicate_appended)},
      {"block-download-number-0-accepted",
       "A segment with the number 0 is stored",
       {"SDO-BDN-10"},
       block(&Block::number_0_accepted)},
      {"block-download-number-above-size-accepted",
       "A segment with a number above the block size is stored",
       {"SDO-BDN-11"},
       BehaviourSwitch([](Behaviour& behaviour) {
         behaviour.block.offered_size = 16;
         behaviour.block.number_above_size_accepted = true;
       })},
  };
}

DefectTable end_rows() {
  return {
      {"block-download-length-unchecked",
       "The length of a block download is not checked: it is cut or filled up",
       {"SDO-BDN-12", "SDO-BDN-13"},
       block(&Block::length_unchecked)},
      {"block-download-shortfall-filled",
       "A block download of fewer bytes than announced is filled up with zeros",
       {"SDO-BDN-14"},
       block(&Block::shortfall_filled)},
      {"block-download-surplus-cut",
       "A block download of more bytes than announced is cut off",
       {"SDO-BDN-15"},
       block(&Block::surplus_cut)},
      {"block-download-padding-stored",
       "The unused bytes of the last segment are stored",
       {"SDO-BDN-17", "SDO-BDN-01"},
       block(&Block::unused_ignored)},
      {"block-download-unused-bytes-misread",
       "The number of unused bytes is read from the wrong bits of the end request",
       {"SDO-BDN-17", "SDO-BDN-01"},
       block(&Block::unused_misread)},
      {"block-download-range-unchecked",
       "The value of a block download is not checked against the range",
       {"SDO-BDN-24"},
       block(&Block::range_unchecked)},
      {"block-download-crc-other-polynomial",
       "A block download expects a CRC with the polynomial 8005h",
       {"SDO-BDN-02"},
       block(&Block::crc_polynomial, std::uint16_t{0x8005})},
      {"block-download-crc-starts-with-ffff",
       "A block download expects a CRC that starts with FFFFh",
       {"SDO-BDN-02"},
       block(&Block::crc_start, std::uint16_t{0xFFFF})},
      {"block-download-crc-byte-swapped",
       "A block download expects the CRC with the most significant byte first",
       {"SDO-BDN-02"},
       block(&Block::crc_byte_swapped)},
      {"block-download-crc-with-padding",
       "A block download expects a CRC over the unused bytes as well",
       {"SDO-BDN-02"},
       block(&Block::crc_with_padding)},
      {"block-download-crc-unchecked",
       "The CRC of a block download is not checked",
       {"SDO-BDN-03"},
       block(&Block::crc_unchecked)},
      {"block-download-crc-checked-unasked",
       "The CRC of a block download is checked although it was not agreed",
       {"SDO-BDN-04", "SDO-BDN-01"},
       block(&Block::crc_always_checked)},
      {"block-download-stored-despite-wrong-crc",
       "A block download with a wrong CRC is refused and stored all the same",
       {"SDO-BDN-03", "OD-ACC-05"},
       block(&Block::stored_despite_wrong_crc)},
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
      {"block-download-serves-upload-segments",
       "An upload segment request in place of the end of a block download gets a segment",
       {"SDO-BDN-21"},
       on_exchange([watch = BlockWatch{}](const SdoExchange& e, Frames& frames) mutable {
         const bool wrong =
             watch.running == BlockWatch::Running::download && e.step == SdoStep::upload_segment;
         if (wrong && !frames.empty()) frames.front().frame.data = {0x00};
         watch.see(e, frames);
       })},
  };
}

}  // namespace

DefectTable sdo_block_download_defects() {
  DefectTable rows;
  for (auto part : {frame_rows(), loss_rows(), end_rows()}) {
    rows.insert(rows.end(), std::make_move_iterator(part.begin()), std::make_move_iterator(part.end()));
  }
  return rows;
}

}  // namespace refnode
