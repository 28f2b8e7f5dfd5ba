// SPDX-License-Identifier: Apache-2.0
// Defects of the order of requests: what comes for a transfer that another one has replaced, frames of a
// block transfer that are not due, and aborts that end nothing.
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

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

constexpr unsigned download_request = 1, upload_request = 2;  ///< bits 7 to 5 of an initiate

/// A transfer of this kind stays open beside one that such a request begins, if that is over with its answer.
template <typename Kind>
Change outlives(unsigned specifier) {
  return [specifier](Parts& parts) {
    const auto met = std::make_shared<bool>(false);
    misreads([met, specifier](Parts& node, Frame& frame) {
      *met = transfer_of<Kind>(node, frame) != nullptr && frame.data[0] >> 5U == specifier;
    })(parts);
    of_sdo(parts).makes_way.replace([met](const auto& former, bool block) { return !*met && former(block); });
  };
}

/// The server knows one entry, that of the latest request: what a download still brings goes there.
template <typename Kind, typename Rules>
Change goes_to_what_was_read(Rules& (*part)(Parts&)) {
  return [part](Parts& parts) {
    outlives<Kind>(upload_request)(parts);
    const auto read = std::make_shared<std::optional<Multiplexer>>();
    misreads([read](Parts& node, Frame& frame) {
      if (server_asked(node, frame) == nullptr) return;
      if (transfer_of<Kind>(node, frame) == nullptr) return read->reset();
      if (receiving(node, frame) != nullptr || frame.data[0] >> 5U != upload_request) return;
      const auto index = conform::load_le(std::span(frame.data).subspan(1, 2));
      *read = mux(static_cast<std::uint16_t>(index), frame.data[3]);
    })(parts);
    part(parts).store.replace([read](const auto& former, Multiplexer own, ByteView data) {
      return former(read->value_or(own), data);
    });
  };
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

/// Where a block upload of the default server stands.
enum class Stage : std::uint8_t { none, offered, segments, ended };
std::shared_ptr<Stage> watch_block_upload(Parts& parts) {
  const auto stage = std::make_shared<Stage>(Stage::none);
  parts.device.outbox.add_filter(on_exchange([stage](const SdoExchange& e, Frames& frames) {
    if (e.channel != 0) return;
    if (e.aborted || is_client_abort(e) || begins_transfer(e) || is_end_confirmation(e, frames))
      *stage = Stage::none;
    if (block_upload_initiated(e)) *stage = Stage::offered;
    if (is_upload_segment(e, frames)) *stage = Stage::segments;
    if (is_upload_end(e, frames)) *stage = Stage::ended;
  }));
  return stage;
}

/// The server looks for acknowledges only: whatever else comes sends the sub-block.
void takes_anything_for_a_start(Parts& parts) {
  misreads([stage = watch_block_upload(parts)](Parts& node, Frame& frame) {
    if (channel_of(node, frame) != 0) return;
    const auto* transfer = transfer_of<BlockUpload>(node, frame);
    const bool due = (frame.data[0] & 0x03U) == 2 || frame.data[0] == 0x80;
    if (transfer == nullptr || due) return;
    if (*stage == Stage::offered) frame.data = {0xA3};
    if (*stage == Stage::segments) frame.data = {0xA2, 0, transfer->block_size()};
  })(parts);
}
/// Behind the end frame it waits for one frame more, and does not look at it.
void takes_anything_for_the_confirmation(Parts& parts) {
  misreads([stage = watch_block_upload(parts)](Parts& node, Frame& frame) {
    if (channel_of(node, frame) != 0) return;
    const bool running = transfer_of<BlockUpload>(node, frame) != nullptr && frame.data[0] != 0x80;
    if (running && *stage == Stage::ended) frame.data = {0xA1};
  })(parts);
}

/// What is sent again begins with 1; the server waits for the number behind the one that it acknowledged.
void counts_on_behind_a_gap(Parts& parts) {
  struct Memory {
    std::uint8_t gap_behind = 0, base = 0, number = 0;
  };
  parts.sdo.rules.block_download.follows.replace(
      [memory = std::make_shared<Memory>()](const auto& former, std::uint8_t number, std::uint8_t last) {
        Memory& m = *memory;
        if (number <= std::exchange(m.number, number)) m.base = std::exchange(m.gap_behind, std::uint8_t{0});
        if (last == 0 && m.base != 0) return number == m.base + 1;
        if (!former(number, last) && number > last) m.gap_behind = last;
        return former(number, last);
      });
}

/// The sub-block behind a gap has only as many segments as were missing in that with the gap: it is
/// acknowledged before its end. A segment that seems to end it makes the server do so.
void cuts_the_sub_block_behind_a_gap(Parts& parts) {
  const auto cut = std::make_shared<unsigned>(0);
  Change(Reading([cut](Parts& node, std::vector<Frame>& frames) {
    if (frames.empty()) return;
    const Frame segment = frames.back();
    const BlockDownload* transfer = receiving(node, segment);
    if (transfer == nullptr) return;
    const unsigned number = segment.data[0] & 0x7FU;
    const unsigned size = transfer->block_size();
    if (number == size && transfer->sequence() + 1U < number) *cut = size - transfer->sequence();
    if (*cut == 0 || number != *cut || transfer->sequence() + 1U != number || number == size) return;
    *cut = 0;
    frames.push_back(segment);
    frames.back().data[0] = static_cast<std::uint8_t>(size);
  }))(parts);
}

/// When a sub-block was acknowledged because nothing more came, the first segment of the next is not taken.
void loses_a_segment_behind_a_pause(Parts& parts) {
  const auto paused = std::make_shared<bool>(false);
  parts.device.outbox.add_filter(on_exchange([paused](const SdoExchange& e, Frames&) {
    if (block_download_initiated(e)) *paused = false;
    if (e.step == SdoStep::block_download_ack && e.request[0] == 0) *paused = true;
  }));
  of_block_download(parts).follows.replace(
      [paused](const auto& former, std::uint8_t number, std::uint8_t last) {
        return !(number == 1 && std::exchange(*paused, false)) && former(number, last);
      });
}

/// A client abort is answered where nothing was open that it could end.
void answers_aborts_when_idle(Parts& parts) {
  const auto open = std::make_shared<bool>(false);
  misreads([open](Parts& node, Frame& frame) {
    const SdoServer* server = server_asked(node, frame);
    if (server != nullptr) *open = server->busy();
  })(parts);
  parts.device.outbox.add_filter([open](const FilterContext& context, Frames& frames) {
    if (context.sdo == nullptr || context.sdo->channel != 0 || *open) return;
    if (is_client_abort(*context.sdo))
      frames.push_back(response(context, {0x80, 0, 0, 0, 0x01, 0x00, 0x04, 0x05}));
  });
}

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
      {"upload-outlives-expedited-download",
       "A segmented upload that an expedited download has replaced goes on with its next segment",
       {"SDO-SUP-11"},
       outlives<SegmentedUpload>(download_request)},
      {"download-outlives-expedited-upload",
       "A segmented download that an expedited upload has replaced goes on with its next segment",
       {"SDO-SDN-17"},
       outlives<SegmentedDownload>(upload_request)},
      {"download-goes-to-the-entry-that-was-read",
       "A segmented download within which another entry was read is stored in that one",
       {"SDO-SDN-17"},
       goes_to_what_was_read<SegmentedDownload>(of_segments)},
      {"block-download-goes-to-the-entry-that-was-read",
       "A block download before whose end another entry was read is stored in that one",
       {"SDO-BDN-21"},
       goes_to_what_was_read<BlockDownload>(of_block_download)},
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
      {"block-upload-takes-anything-for-a-start",
       "In a block upload every request but its acknowledges sends the sub-block",
       {"SDO-BUP-29", "SDO-BUP-20"},
       Change(takes_anything_for_a_start)},
      {"block-upload-takes-anything-for-its-confirmation",
       "Behind the end frame of a block upload the next request is lost, whatever it is",
       {"SDO-BUP-29"},
       Change(takes_anything_for_the_confirmation)},
      {"block-download-counts-on-behind-a-gap",
       "Behind a gap a block download waits for the next number, where what is sent again begins with 1",
       {"SDO-BDN-07"},
       Change(counts_on_behind_a_gap)},
      {"block-download-sub-block-cut-behind-a-gap",
       "A sub-block behind one with a gap is acknowledged before its end",
       {"SDO-BDN-07"},
       Change(cuts_the_sub_block_behind_a_gap)},
      {"block-download-segment-lost-behind-a-pause",
       "Behind a sub-block that was acknowledged because nothing more came the next segment is not taken",
       {"SDO-BDN-07"},
       Change(loses_a_segment_behind_a_pause)},
      {"client-abort-answered-when-idle",
       "A client abort is answered with an abort when no transfer is open",
       {"SDO-ERR-03"},
       Change(answers_aborts_when_idle)},
  };
}

}  // namespace refnode
