// SPDX-License-Identifier: Apache-2.0
// Defects of the SDO block upload: frames, sequence numbers, CRC, acknowledges, and what ends it.
#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "defects/sdo_block_exchanges.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

bool block_initiate(const SdoExchange& e) {
  return e.step == SdoStep::block_upload_initiate || e.step == SdoStep::block_download_initiate;
}
bool block_upload_refused(const SdoExchange& e) {
  return e.step == SdoStep::block_upload_initiate && e.aborted &&
         *e.aborted != abort_code::block_size_invalid;
}
bool sub_command_without_transfer(const SdoExchange& e) {
  return (e.step == SdoStep::block_upload_segment || e.step == SdoStep::block_upload_end) &&
         e.aborted == abort_code::command_unknown;
}

/// Changes each segment; the sequence number is data[0] without bit 7.
template <typename Change>
Filter each_segment(Change change) {
  return on_exchange([change](const SdoExchange& e, Frames& frames) mutable {
    if (!is_upload_segment(e, frames)) return;
    for (Outgoing& outgoing : frames) change(e, outgoing.frame.data);
  });
}
/// Changes the end frame.
template <typename Change>
Filter end_frame(Change change) {
  return on_exchange([change](const SdoExchange& e, Frames& frames) mutable {
    if (!is_upload_end(e, frames)) return;
    for (Outgoing& outgoing : frames) change(e, outgoing.frame.data);
  });
}

/// What comes again behind an acknowledge of 0 is the sub-block before.
Filter sends_the_sub_block_before() {
  using SubBlock = std::map<std::uint8_t, Data>;  // by sequence number
  return on_exchange(
      [now = SubBlock{}, before = SubBlock{}, again = false](const SdoExchange& e, Frames& frames) mutable {
        if (block_upload_initiated(e)) {
          now.clear();
          before.clear();
          again = false;
        } else if (is_upload_segment(e, frames)) {
          Data& segment = frames.front().frame.data;
          if (const auto former = before.find(e.sequence); again && former != before.end()) {
            std::copy(former->second.begin() + 1, former->second.end(), segment.begin() + 1);
          } else {
            now[e.sequence] = segment;
          }
        } else if (is_acknowledge_of_client(e, frames)) {
          again = e.request[1] == 0;
          if (again) return;
          before = std::exchange(now, {});
        }
      });
}

/// The CRC of the end frame, where one was agreed, by another rule. `rule` gets the upload and the number of
/// bytes without padding.
template <typename Rule>
Filter other_crc(Rule rule) {
  return on_exchange([rule, watch = UploadWatch{}](const SdoExchange& e, Frames& frames) mutable {
    watch.see(e, frames);
    if (!is_upload_end(e, frames) || !watch.crc_agreed) return;
    Data& data = frames.front().frame.data;
    const std::size_t unused = (data[0] >> 2U) & 0x07U;
    const std::uint16_t crc = rule(watch, watch.data.size() - unused);
    data[1] = static_cast<std::uint8_t>(crc & 0xFFU);
    data[2] = static_cast<std::uint8_t>(crc >> 8U);
  });
}

std::span<const std::uint8_t> net(const UploadWatch& upload, std::size_t size) {
  return std::span(upload.data).first(size);
}

/// The request of a block upload is changed before the server sees it; byte 4: block size.
Change misreads_request(void (*change)(Data&)) {
  return misreads([change](Parts& parts, Frame& frame) {
    const bool request = server_asked(parts, frame) != nullptr && receiving(parts, frame) == nullptr;
    if (request && (frame.data[0] & 0xE3U) == 0xA0) change(frame.data);
  });
}
/// The acknowledge of a sub-block is; byte 1: the last segment that came, byte 2: block size from here on.
Change misreads_acknowledge(void (*change)(Data&, const BlockUpload&)) {
  return misreads([change](Parts& parts, Frame& frame) {
    const auto* transfer = transfer_of<BlockUpload>(parts, frame);
    if (transfer != nullptr && (frame.data[0] & 0xE3U) == 0xA2) change(frame.data, *transfer);
  });
}
Change may_switch(bool (*when)(std::size_t size, std::uint8_t threshold)) {
  return decides(
      of_block_upload, &BlockUploadRules::may_switch,
      [when](const auto&, std::size_t size, std::uint8_t threshold) { return when(size, threshold); });
}

/// The client's start is there as soon as the upload is offered.
Change starts_at_once() {
  return [](Parts& parts) {
    parts.device.outbox.add_filter([&parts](const FilterContext& context, Frames&) {
      if (context.sdo == nullptr || !block_upload_initiated(*context.sdo)) return;
      const auto server = static_cast<std::uint16_t>(0x1200 + context.sdo->channel);
      const std::uint64_t id = parts.device.dictionary.number(server, 1, 0x600U + context.node_id) & 0x7FFU;
      const conform::CanId request(static_cast<std::uint32_t>(id));
      parts.device.inbox.put(conform::can::data_frame(request, {0xA3, 0, 0, 0, 0, 0, 0, 0}), context.now);
    });
  };
}

/// Uploads that run at the same time on two channels have one register for the CRC.
Filter shares_crc() {
  struct Memory {
    std::set<std::uint8_t> running, spoiled;
  };
  return on_exchange([memory = Memory{}](const SdoExchange& e, Frames& frames) mutable {
    const bool ends = e.aborted || is_client_abort(e) || e.step == SdoStep::time_out || begins_transfer(e);
    if (ends) memory.running.erase(e.channel);
    if (block_upload_initiated(e) && (e.request[0] & 0x04U) != 0) {
      memory.running.insert(e.channel);
      memory.spoiled.erase(e.channel);
      if (memory.running.size() > 1) memory.spoiled = memory.running;
    }
    if (!is_upload_end(e, frames)) return;
    memory.running.erase(e.channel);
    if (memory.spoiled.erase(e.channel) != 0) frames.front().frame.data[1] ^= 0x5AU;
  });
}

DefectTable frame_rows() {
  return {
      {"block-unsupported-silent",
       "Requests for a block transfer get no answer",
       {"SDO-BUP-01", "SDO-BDN-01"},
       silent(block_initiate)},
      {"block-upload-refused-although-claimed",
       "Block uploads are refused as unknown, although the device claims them",
       {"SDO-BUP-01"},
       respond(block_upload_initiated, 0x80, 0x05040001)},
      {"block-upload-without-end",
       "The end frame of a block upload does not come",
       {"SDO-BUP-01", "SDO-BUP-24"},
       on_exchange([](const SdoExchange& e, Frames& frames) {
         if (is_upload_end(e, frames)) frames.clear();
       })},
      {"block-upload-size-one-too-high",
       "A block upload announces one byte more than it delivers",
       {"SDO-BUP-04"},
       patch(block_upload_initiated, [](const SdoExchange&, Data& data) { ++data[4]; })},
      {"block-upload-size-without-flag",
       "A block upload fills the size field and says that it holds none",
       {"SDO-BUP-04"},
       patch(block_upload_initiated, [](const SdoExchange&, Data& data) { data[0] &= 0xFDU; })},
      {"block-upload-size-cut-to-16-bits",
       "A block upload announces the lower half of its size",
       {"SDO-BUP-04"},
       patch(block_upload_initiated, [](const SdoExchange&, Data& data) { data[6] = data[7] = 0; })},
      {"block-upload-numbers-from-0",
       "The segments of a block upload are numbered from 0",
       {"SDO-BUP-05", "SDO-BUP-01"},
       each_segment([](const SdoExchange&, Data& data) { --data[0]; })},
      {"block-upload-numbers-go-on",
       "The numbers of the segments go on from one sub-block to the next",
       {"SDO-BUP-06", "SDO-BUP-05", "SDO-BUP-08", "SDO-BUP-13"},
       on_exchange([count = 0U](const SdoExchange& e, Frames& frames) mutable {
         if (block_upload_initiated(e)) count = 0;
         if (!is_upload_segment(e, frames)) return;
         Data& data = frames.front().frame.data;
         data[0] = static_cast<std::uint8_t>((data[0] & 0x80U) | (++count & 0x7FU));
       })},
      {"block-upload-repeats-with-old-numbers",
       "Segments that are sent again keep the numbers they had",
       {"SDO-BUP-13", "SDO-BUP-05"},
       on_exchange([kept = 0U](const SdoExchange& e, Frames& frames) mutable {
         if (block_upload_initiated(e)) kept = 0;
         if (is_acknowledge_of_client(e, frames)) kept = e.request[1];
         if (is_upload_segment(e, frames) && kept != 0 && kept < 3) {
           Data& data = frames.front().frame.data;
           data[0] = static_cast<std::uint8_t>(data[0] + kept);
         }
       })},
      {"block-upload-last-segment-not-marked",
       "The last segment of a block upload is not marked",
       {"SDO-BUP-05", "SDO-BUP-01"},
       each_segment([](const SdoExchange&, Data& data) { data[0] &= 0x7FU; })},
      {"block-upload-every-segment-marked",
       "Every segment of a block upload is marked as the last one",
       {"SDO-BUP-05", "SDO-BUP-06", "SDO-BUP-26"},
       each_segment([](const SdoExchange&, Data& data) { data[0] |= 0x80U; })},
      {"block-upload-last-segment-twice",
       "The last segment of a block upload is sent twice",
       {"SDO-BUP-05", "SDO-BUP-01", "SDO-BUP-26"},
       on_exchange([](const SdoExchange& e, Frames& frames) {
         if (is_upload_segment(e, frames) && (frames.front().frame.data[0] & 0x80U) != 0)
           frames.push_back(Outgoing(frames.front()));
       })},
      {"block-upload-buffer-of-64-segments",
       "Of a sub-block the segments behind the 64th are not sent",
       {"SDO-BUP-07"},
       on_exchange([](const SdoExchange& e, Frames& frames) {
         if (is_upload_segment(e, frames) && e.sequence > 64) frames.clear();
       })},
      {"block-upload-segments-shifted",
       "The segments of a block upload begin one byte late",
       {"SDO-BUP-01", "SDO-BUP-05"},
       each_segment([](const SdoExchange&, Data& data) {
         std::rotate(data.begin() + 1, data.begin() + 2, data.end());
       })},
      {"block-upload-unused-bytes-not-told",
       "The end frame of a block upload always tells that the last segment is full",
       {"SDO-BUP-22", "SDO-BUP-01"},
       end_frame([](const SdoExchange&, Data& data) { data[0] &= 0xE3U; })},
      {"block-upload-full-last-segment-claims-nothing",
       "The end frame of a block upload whose last segment is full tells that it holds nothing",
       {"SDO-BUP-22", "SDO-BUP-01"},
       end_frame([](const SdoExchange&, Data& data) {
         if ((data[0] & 0x1CU) == 0) data[0] |= 0x1CU;
       })},
      {"block-upload-confirmation-answered",
       "The client's confirmation of a block upload is answered",
       {"SDO-BUP-24", "SDO-GEN-04"},
       Filter([](const FilterContext& context, Frames& frames) {
         if (context.sdo != nullptr && is_end_confirmation(*context.sdo, frames))
           frames.push_back(response(context, {0xA1}));
       })},
      {"block-upload-confirmed-times-out",
       "A block upload that the client has confirmed is aborted after the server's time-out",
       {"SDO-GEN-04", "SDO-BUP-24"},
       Filter([](const FilterContext& context, Frames& frames) {
         if (context.sdo == nullptr || !is_end_confirmation(*context.sdo, frames)) return;
         frames.push_back(response(context, {0x80, 0, 0, 0, 0x00, 0x00, 0x04, 0x05}));
         frames.back().delay = std::chrono::seconds(1);
       })},
      {"block-upload-never-closed",
       "After a block upload no transfer is served until the client aborts",
       {"SDO-BUP-24"},
       on_exchange([open = false](const SdoExchange& e, Frames& frames) mutable {
         if (is_client_abort(e)) open = false;
         if (open) frames.clear();
         if (is_end_confirmation(e, frames) && e.request[0] == 0xA1) open = true;
       })},
      {"block-upload-wedged-by-full-sub-block",
       "A block upload is aborted when its last segment is the last one of a sub-block",
       {"SDO-BUP-06", "SDO-BUP-13"},
       on_exchange([size = 0U](const SdoExchange& e, Frames& frames) mutable {
         if (block_upload_initiated(e)) size = e.request[4];
         if (is_upload_end(e, frames) && e.request[1] == size) answer_with_abort(frames, e, 0x05040001);
         if (is_acknowledge_of_client(e, frames)) size = e.request[2];
       })},
  };
}

DefectTable crc_rows() {
  return {
      {"block-upload-crc-other-polynomial",
       "The CRC of a block upload uses the polynomial 8005h",
       {"SDO-BUP-02"},
       other_crc(
           [](const UploadWatch& upload, std::size_t size) { return crc16(net(upload, size), 0x8005, 0); })},
      {"block-upload-crc-starts-with-ffff",
       "The CRC of a block upload starts with FFFFh",
       {"SDO-BUP-02"},
       other_crc([](const UploadWatch& upload, std::size_t size) {
         return crc16(net(upload, size), ccitt, 0xFFFF);
       })},
      {"block-upload-crc-byte-swapped",
       "The CRC of a block upload is sent with the most significant byte first",
       {"SDO-BUP-02"},
       other_crc([](const UploadWatch& upload, std::size_t size) {
         const std::uint16_t crc = crc16(net(upload, size), ccitt, 0);
         return static_cast<std::uint16_t>((crc << 8U) | (crc >> 8U));
       })},
      {"block-upload-crc-with-padding",
       "The CRC of a block upload covers the unused bytes of the last segment",
       {"SDO-BUP-02"},
       other_crc([](const UploadWatch& upload, std::size_t) { return crc16(upload.data, ccitt, 0); })},
      {"block-upload-crc-agreed-but-zero",
       "A block upload agrees to a CRC and sends 0",
       {"SDO-BUP-02"},
       other_crc([](const UploadWatch&, std::size_t) { return std::uint16_t{0}; })},
      {"block-upload-crc-counts-repeated-segments",
       "The CRC of a block upload counts segments that were sent again twice",
       {"SDO-BUP-13", "SDO-BUP-14", "SDO-BUP-02"},
       other_crc([](const UploadWatch& upload, std::size_t size) {
         const std::size_t padding = upload.data.size() - size;
         return crc16(std::span(upload.sent).first(upload.sent.size() - padding), ccitt, 0);
       })},
      {"block-upload-crc-unasked",
       "The end frame of a block upload holds a CRC that was not agreed",
       {"SDO-BUP-03"},
       on_exchange([watch = UploadWatch{}](const SdoExchange& e, Frames& frames) mutable {
         watch.see(e, frames);
         if (!is_upload_end(e, frames) || watch.crc_agreed) return;
         frames.front().frame.data[1] = 0x34;
         frames.front().frame.data[2] = 0x12;
       })},
      {"block-upload-crc-shared-by-channels",
       "Block uploads that run at the same time on two channels spoil each other's CRC",
       {"SDO-BUP-02"},
       shares_crc()},
  };
}

DefectTable refusal_rows() {
  return {
      {"block-upload-size-0-accepted",
       "A block upload with a block size of 0 is served",
       {"SDO-BUP-09"},
       misreads_request([](Data& data) {
         if (data[4] == 0) data[4] = 127;
       })},
      {"block-upload-size-above-127-accepted",
       "A block upload with a block size above 127 is served",
       {"SDO-BUP-10"},
       misreads_request([](Data& data) { data[4] = std::min<std::uint8_t>(data[4], 127); })},
      {"wrong-abort-block-size",
       "A block size that is not allowed is aborted with 0609 0030h",
       {"SDO-BUP-09", "SDO-BUP-10", "SDO-BUP-11"},
       wrong_abort(abort_code::block_size_invalid, abort_code::invalid_value)},
      {"wrong-abort-sequence-number",
       "A sequence number that is not allowed is aborted as an invalid block size",
       {"SDO-BUP-12", "SDO-BDN-10"},
       wrong_abort(abort_code::sequence_invalid, abort_code::block_size_invalid)},
      {"block-upload-size-ignored",
       "A block upload sends 127 segments whatever the client asks for",
       {"SDO-BUP-06", "SDO-BUP-26"},
       together(misreads_request([](Data& data) { data[4] = 127; }),
                misreads_acknowledge([](Data& data, const BlockUpload&) {
                  if (valid_block_size(data[2])) data[2] = 127;
                }))},
      {"block-upload-next-size-ignored",
       "The block size of an acknowledge is not used",
       {"SDO-BUP-08", "SDO-BUP-26"},
       misreads_acknowledge([](Data& data, const BlockUpload& upload) {
         if (valid_block_size(data[2])) data[2] = upload.block_size();
       })},
      {"block-upload-next-size-unchecked",
       "A block size that is not allowed is accepted in an acknowledge",
       {"SDO-BUP-11"},
       misreads_acknowledge([](Data& data, const BlockUpload&) {
         if (!valid_block_size(data[2])) data[2] = 127;
       })},
      {"block-upload-acknowledge-unchecked",
       "An acknowledge of a segment that was never sent is taken",
       {"SDO-BUP-12"},
       misreads_acknowledge(
           [](Data& data, const BlockUpload& upload) { data[1] = std::min(data[1], upload.sequence()); })},
      {"block-upload-nothing-repeated",
       "Segments that were not acknowledged are not sent again",
       {"SDO-BUP-13", "SDO-BUP-14"},
       misreads_acknowledge([](Data& data, const BlockUpload& upload) { data[1] = upload.sequence(); })},
      {"block-upload-repeats-one-too-late",
       "After a lost segment the one behind it is sent first",
       {"SDO-BUP-13", "SDO-BUP-14"},
       misreads_acknowledge([](Data& data, const BlockUpload& upload) {
         if (data[1] < upload.sequence()) ++data[1];
       })},
      {"block-upload-starts-at-once",
       "A block upload does not wait for its start",
       {"SDO-BUP-19", "SDO-GEN-04", "SDO-BUP-01"},
       starts_at_once()},
      {"block-upload-switches-without-threshold",
       "A block upload with a threshold of 0 is answered by a normal upload",
       {"SDO-BUP-16", "SDO-BUP-01"},
       may_switch(
           [](std::size_t size, std::uint8_t threshold) { return size <= threshold || threshold == 0; })},
      {"block-upload-threshold-inverted",
       "A block upload is answered by a normal upload when the size is above the threshold",
       {"SDO-BUP-16"},
       may_switch(
           [](std::size_t size, std::uint8_t threshold) { return threshold != 0 && size > threshold; })},
      {"block-upload-switch-announced-as-block",
       "The switch to a normal upload is announced by a block upload response",
       {"SDO-BUP-15"},
       on_exchange([](const SdoExchange& e, Frames& frames) {
         const bool switched = e.step == SdoStep::upload_initiate && (e.request[0] >> 5U) == 5 && !e.aborted;
         if (switched && !frames.empty()) frames.front().frame.data[0] = 0xC2;
       })},
      {"block-upload-access-unchecked",
       "Block uploads of entries that cannot be read are accepted",
       {"SDO-BUP-23"},
       respond(block_upload_refused, 0xC2, 4)},
      {"block-sub-commands-served-without-transfer",
       "Sub-commands of a block upload get an empty last segment while none is running",
       {"SDO-BUP-21"},
       patch(sub_command_without_transfer, [](const SdoExchange&, Data& data) { data = {0x81}; })},
      {"block-upload-starts-again-after-its-end",
       "A start after the end of a block upload gets its last segment once more",
       {"SDO-BUP-21"},
       on_exchange([last = Data{}, ended = false](const SdoExchange& e, Frames& frames) mutable {
         if (is_upload_segment(e, frames)) last = frames.front().frame.data;
         if (begins_transfer(e) || is_client_abort(e)) ended = false;
         if (is_end_confirmation(e, frames)) ended = true;
         if (ended && sub_command_without_transfer(e) && !frames.empty()) frames.front().frame.data = last;
       })},
      {"block-upload-serves-upload-segments",
       "An upload segment request in a block upload gets a segment",
       {"SDO-BUP-20"},
       on_exchange([watch = BlockWatch{}](const SdoExchange& e, Frames& frames) mutable {
         const bool wrong = watch.running == BlockWatch::Running::upload && e.step == SdoStep::upload_segment;
         if (wrong && !frames.empty()) frames.front().frame.data = {0x00};
         watch.see(e, frames);
       })},
      {"block-upload-reserved-bits-silent",
       "A block upload request with reserved bits set gets no answer",
       {"SDO-BUP-28"},
       silent([](const SdoExchange& e) {
         return e.step == SdoStep::block_upload_initiate && (e.request[0] & 0x18U) != 0;
       })},
      {"block-upload-reserved-bytes-silent",
       "A block upload request with reserved bytes set gets no answer",
       {"SDO-BUP-28"},
       silent([](const SdoExchange& e) {
         return e.step == SdoStep::block_upload_initiate && (e.request[6] != 0 || e.request[7] != 0);
       })},
  };
}

DefectTable end_rows() {
  return {
      {"block-client-abort-ignored",
       "A client abort does not end a block transfer",
       {"SDO-BUP-17", "SDO-BUP-18", "SDO-BDN-19", "SDO-BDN-20"},
       decides(of_sdo, &SdoRules::abort_ends_transfer,
               [](const auto& former, SdoSide by, bool block) {
                 return !(block && by == SdoSide::client) && former(by, block);
               })},
      {"block-upload-abort-waits-for-the-sub-block",
       "A client abort ends a block upload at the end of the sub-block only",
       {"SDO-BUP-17"},
       deaf_to([](Parts& parts, const Frame& frame) {
         const auto* transfer = transfer_of<BlockUpload>(parts, frame);
         return transfer != nullptr && transfer->has_segment() && is_abort_request(parts, frame);
       })},
      {"block-upload-goes-on-in-stopped",
       "A running sub-block goes on in Stopped",
       {"SDO-BUP-27", "SDO-SUP-19"},
       keeps_transfers_in(NmtState::stopped)},
      {"block-new-request-refused",
       "While a block upload is open every new request is aborted",
       {"SDO-BUP-29"},
       on_exchange([watch = BlockWatch{}](const SdoExchange& e, Frames& frames) mutable {
         if (watch.running == BlockWatch::Running::upload && begins_transfer(e)) {
           answer_with_abort(frames, e, 0x05040001);
         } else {
           watch.see(e, frames);
         }
       })},
      {"block-abandoned-transfer-wedges-server",
       "After the time-out of a block transfer no other is served until the client aborts",
       {"SDO-BUP-25", "SDO-BDN-25"},
       on_exchange([watch = BlockWatch{}, wedged = false](const SdoExchange& e, Frames& frames) mutable {
         const bool in_block = watch.running != BlockWatch::Running::nothing;
         if (e.step == SdoStep::time_out && in_block) wedged = true;
         if (is_client_abort(e)) wedged = false;
         if (wedged) frames.clear();
         watch.see(e, frames);
       })},
      {"block-upload-repeats-for-ever",
       "A block upload that is not acknowledged sends its last segment again and again",
       {"SDO-BUP-25", "SDO-BUP-26", "SDO-GEN-04"},
       on_exchange([](const SdoExchange& e, Frames& frames) {
         if (!is_upload_segment(e, frames)) return;
         const Outgoing segment = frames.front();
         for (int i = 1; i <= 40; ++i) {
           Outgoing again = segment;
           again.delay = std::chrono::milliseconds(500) * i;
           frames.push_back(again);
         }
       })},
      {"block-upload-dies-of-repetitions",
       "A server that is asked for the same sub-block more than 16 times answers nothing until a reset",
       {"SDO-BUP-14"},
       Filter([asked = 0](const FilterContext& context, Frames& frames) mutable {
         if (context.service == Service::boot_up) asked = 0;
         if (context.sdo == nullptr) return;
         if (is_acknowledge_of_client(*context.sdo, frames) && asked <= 16)
           asked = context.sdo->request[1] == 0 ? asked + 1 : 0;
         if (asked > 16) frames.clear();
       })},
      {"block-upload-returns-old-data",
       "A second block upload of an entry returns what the first one found",
       {"SDO-BDN-26"},
       on_exchange([known = std::map<Multiplexer, std::vector<Data>>{}, at = std::size_t{0}, replays = false](
                       const SdoExchange& e, Frames& frames) mutable {
         if (block_upload_initiated(e)) {
           at = 0;
           replays = known.contains(e.mux);
         }
         const bool part =
             block_upload_initiated(e) || is_upload_segment(e, frames) || is_upload_end(e, frames);
         if (!part || frames.empty()) return;
         auto& old = known[e.mux];
         if (!replays) old.push_back(frames.front().frame.data);
         if (replays && at < old.size()) frames.front().frame.data = old[at];
         ++at;
       })},
      {"sdo-bup-acknowledge-of-0-goes-back-too-far",
       "An acknowledge of 0 in a later sub-block makes the server send the data of the sub-block before",
       {"SDO-BUP-14"},
       sends_the_sub_block_before()},
  };
}

}  // namespace

DefectTable sdo_block_upload_defects() {
  DefectTable rows;
  for (auto part : {frame_rows(), crc_rows(), refusal_rows(), end_rows()}) {
    append(rows, std::move(part));
  }
  return rows;
}

}  // namespace refnode
