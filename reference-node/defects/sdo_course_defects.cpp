// SPDX-License-Identifier: Apache-2.0
// Defects of SDO that show late in the course of a transfer: from its second or third segment on, behind its
// first sub-block, behind something that came again, or when it has ended.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "defects/sdo_block_exchanges.hpp"
#include "defects/sdo_rules.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

using Size = std::optional<std::size_t>;

/// A segmented download of the default server, seen from outside.
struct Download {
  bool open = false;
  Multiplexer mux{};
  Bytes data;
};

void take(Bytes& data, const SdoExchange& e) {
  const auto& request = e.request;
  data.insert(data.end(), request.begin() + 1, request.end() - ((request[0] >> 1U) & 0x07U));
}

/// What has come of a segmented download is stored when it ends by an exchange for which `when` holds.
Change stores_what_has_come(std::function<bool(const Download&, const SdoExchange&)> when) {
  return [when = std::move(when)](Parts& parts) {
    const auto download = std::make_shared<Download>();
    parts.device.outbox.add_filter([&parts, download, when](const FilterContext& context, Frames&) {
      if (context.service == Service::boot_up) *download = {};
      if (context.sdo == nullptr || context.sdo->channel != 0) return;
      const SdoExchange& e = *context.sdo;
      const bool refused = e.step == SdoStep::download_segment && e.aborted.has_value();
      const bool ends = refused || begins_transfer(e) || is_client_abort(e) || e.step == SdoStep::time_out;
      if (download->open && ends && when(*download, e)) {
        if (refused) take(download->data, e);
        [[maybe_unused]] const auto stored = of_segments(parts).store(download->mux, download->data);
      }
      if (ends || last_download_segment(e)) download->open = false;
      if (segmented_download_initiated(e)) *download = {.open = true, .mux = e.mux, .data = {}};
      if (download->open && download_segment_taken(e)) take(download->data, e);
    });
  };
}
template <typename Kind>
Change stores_by_exchange(Kind kind) {
  return stores_what_has_come([kind](const Download& download, const SdoExchange& e) {
    return !download.data.empty() && kind(download, e);
  });
}

/// Where it is set while a frame is looked at the transfer outlives the abort that the server answers with.
std::shared_ptr<bool> spares_the_transfer(Parts& parts) {
  const auto spared = std::make_shared<bool>(false);
  misreads([spared](Parts&, Frame&) { *spared = false; })(parts);
  of_sdo(parts).abort_ends_transfer.replace([spared](const auto& former, SdoSide by, bool block) {
    return !(by == SdoSide::server && *spared) && former(by, block);
  });
  return spared;
}

/// How many bytes of a segmented download have come.
std::shared_ptr<std::size_t> bytes_taken(Parts& parts) {
  const auto taken = std::make_shared<std::size_t>(0);
  SegmentedRules& rules = of_segments(parts);
  rules.granted.replace([taken](const auto& former, Multiplexer mux, Size announced) {
    *taken = 0;
    return former(mux, announced);
  });
  rules.fits.replace([taken](const auto& former, std::size_t received, std::size_t most) {
    *taken = received;
    return former(received, most);
  });
  return taken;
}

/// A segment of a download that is refused by this rule can be followed by others.
Change outlives(Rule<bool(std::size_t, std::size_t)> SegmentedRules::* rule) {
  return [rule](Parts& parts) {
    const auto spared = spares_the_transfer(parts);
    (of_segments(parts).*rule).replace([spared](const auto& former, std::size_t received, std::size_t limit) {
      *spared = !former(received, limit);
      return !*spared;
    });
  };
}
/// The same of the toggle bit, once a segment has been taken.
Change outlives_toggle_abort() {
  return [](Parts& parts) {
    const auto taken = bytes_taken(parts);
    const auto spared = spares_the_transfer(parts);
    of_segments(parts).download_toggle_right.replace(
        [taken, spared](const auto& former, bool toggle, bool due) {
          const bool right = former(toggle, due);
          *spared = !right && *taken > 0;
          return right;
        });
  };
}

constexpr std::size_t two_segments = 14;

/// From the third segment on the toggle bit of a request is not looked at.
void upload_toggle_unchecked_later(Parts& parts) {
  const auto sent = std::make_shared<std::size_t>(0);
  parts.device.outbox.add_filter(on_exchange([sent](const SdoExchange& e, Frames&) {
    if (begins_transfer(e)) *sent = 0;
  }));
  of_segments(parts).goes_on_at.replace([sent](const auto& former, std::size_t position, std::size_t size) {
    *sent = position;
    return former(position, size);
  });
  of_segments(parts).upload_toggle_right.replace([sent](const auto& former, bool toggle, bool due) {
    return *sent >= two_segments || former(toggle, due);
  });
}
void download_toggle_unchecked_later(Parts& parts) {
  const auto taken = bytes_taken(parts);
  of_segments(parts).download_toggle_right.replace([taken](const auto& former, bool toggle, bool due) {
    return *taken >= two_segments || former(toggle, due);
  });
}

/// Where no size was told, what is too long for an entry of fixed length is cut, or what is too short is
/// filled up.
enum class Misfit : std::uint8_t { cut, filled };
bool misfits(Misfit misfit, std::size_t size, std::size_t capacity) {
  return misfit == Misfit::cut ? size > capacity : size < capacity;
}
std::size_t fixed_capacity(const Parts& parts, Multiplexer mux) {
  const Entry* entry = parts.device.dictionary.entry(mux.index.value(), mux.sub.value());
  return entry == nullptr ? 0 : fixed_size(entry->type);
}
void segmented_cut_to_fit(Parts& parts) {
  const auto untold = std::make_shared<bool>(false);
  SegmentedRules& rules = of_segments(parts);
  rules.granted.replace([untold](const auto& former, Multiplexer mux, Size announced) {
    *untold = !announced;
    return former(mux, announced);
  });
  rules.fits.replace([untold](const auto& former, std::size_t received, std::size_t most) {
    return (*untold && most <= 8) || former(received, most);
  });
  rules.store.replace([&parts, untold](const auto& former, Multiplexer mux, ByteView data) {
    const std::size_t capacity = fixed_capacity(parts, mux);
    return former(mux, *untold && capacity != 0 ? data.first(std::min(data.size(), capacity)) : data);
  });
}
Change block_fits_by_force(Misfit misfit) {
  return [misfit](Parts& parts) {
    of_block_download(parts).value.replace(
        [&parts, misfit](const auto& former, Bytes data, const BlockDownloadTerms& terms) {
          const std::size_t capacity = fixed_capacity(parts, terms.mux);
          if (!terms.announced && capacity != 0 && misfits(misfit, data.size(), capacity))
            data.resize(capacity);
          return former(std::move(data), terms);
        });
  };
}

/// A block download whose length is refused by this code is stored all the same.
Change stores_refused_block(AbortCode code) {
  return [code](Parts& parts) {
    of_block_download(parts).value.replace(
        [&parts, code](const auto& former, Bytes data, const BlockDownloadTerms& terms) {
          auto value = former(data, terms);
          if (!value && value.error() == code) {
            [[maybe_unused]] const auto stored = of_block_download(parts).store(terms.mux, data);
          }
          return value;
        });
  };
}

/// The CRC of a block download is not looked at where `marks` says so; it sees frames and answers.
Change crc_unchecked(std::function<void(Parts&, const std::shared_ptr<bool>&)> marks) {
  return [marks = std::move(marks)](Parts& parts) {
    const auto unchecked = std::make_shared<bool>(false);
    marks(parts, unchecked);
    of_block_download(parts).crc_checked.replace(
        [unchecked](const auto& former, bool agreed) { return !*unchecked && former(agreed); });
  };
}
void where_the_last_segment_is_full(Parts& parts, const std::shared_ptr<bool>& unchecked) {
  misreads([unchecked](Parts& node, Frame& frame) {
    const auto* transfer = transfer_of<BlockDownload>(node, frame);
    if (transfer != nullptr && !transfer->in_sub_block()) *unchecked = (frame.data[0] & 0xFDU) == 0xC1;
  })(parts);
}
void where_segments_came_again(Parts& parts, const std::shared_ptr<bool>& unchecked) {
  parts.device.outbox.add_filter(on_exchange([unchecked](const SdoExchange& e, Frames& frames) {
    if (block_download_initiated(e)) *unchecked = false;
    if (e.step != SdoStep::block_download_ack || e.aborted || frames.empty()) return;
    if (frames.front().frame.data[1] < (e.request[0] & 0x7FU)) *unchecked = true;
  }));
}

/// The abort of the client is lost where `when` holds for the transfer and its completed sub-blocks.
template <typename Kind>
Change deaf_to_abort(bool (*when)(const Kind&, std::size_t sub_blocks)) {
  return [when](Parts& parts) {
    const auto sub_blocks = std::make_shared<std::size_t>(0);
    parts.device.outbox.add_filter(on_exchange([sub_blocks](const SdoExchange& e, Frames& frames) {
      if (begins_transfer(e)) *sub_blocks = 0;
      const bool acknowledged = e.step == SdoStep::block_download_ack || is_acknowledge_of_client(e, frames);
      if (acknowledged && !e.aborted) ++*sub_blocks;
    }));
    deaf_to([sub_blocks, when](Parts& node, const Frame& frame) {
      const Kind* transfer = transfer_of<Kind>(node, frame);
      return transfer != nullptr && is_abort_request(node, frame) && when(*transfer, *sub_blocks);
    })(parts);
  };
}

/// The client's confirmation does not close a block upload of which something was sent again.
void not_closed_behind_a_repetition(Parts& parts) {
  const auto again = std::make_shared<bool>(false);
  deaf_to([again](Parts& node, const Frame& frame) {
    const auto* transfer = transfer_of<BlockUpload>(node, frame);
    if (transfer == nullptr) {
      *again = false;
    } else if (frame.data[0] == 0xA2 && frame.data[1] < transfer->sequence()) {
      *again = true;
    }
    return transfer != nullptr && *again && frame.data[0] == 0xA1;
  })(parts);
}
/// An acknowledge of a whole block is taken, however few segments its sub-block had.
void whole_block_acknowledged(Parts& parts) {
  misreads([](Parts& node, Frame& frame) {
    const auto* transfer = transfer_of<BlockUpload>(node, frame);
    if (transfer == nullptr || frame.data[0] != 0xA2) return;
    if (frame.data[1] == transfer->block_size()) frame.data[1] = transfer->sequence();
  })(parts);
}

/// The abort for want of an acknowledge has no multiplexer.
Filter nameless_when_given_up(BlockWatch::Running kind) {
  return on_exchange([kind, watch = BlockWatch{}](const SdoExchange& e, Frames& frames) mutable {
    const bool given_up = e.step == SdoStep::time_out && watch.running == kind;
    watch.see(e, frames);
    if (!given_up) return;
    for (Outgoing& outgoing : frames) std::fill_n(outgoing.frame.data.begin() + 1, 3, std::uint8_t{0});
  });
}
/// An abort with this code has the multiplexer of the last normal transfer.
Filter names_transfer_before(AbortCode code) {
  return on_exchange([code, before = Data{}](const SdoExchange& e, Frames& frames) mutable {
    if (e.step == SdoStep::upload_initiate || e.step == SdoStep::download_initiate) before = e.request;
    if (e.aborted != code || begins_transfer(e)) return;
    for (Outgoing& outgoing : frames) std::copy_n(before.begin() + 1, 3, outgoing.frame.data.begin() + 1);
  });
}

/// Command specifier 7 ends a transfer of this kind without a word.
template <typename Kind>
Change ended_by_unknown_command() {
  return misreads([](Parts& node, Frame& frame) {
    if (transfer_of<Kind>(node, frame) != nullptr && frame.data[0] >> 5U == 7) frame.data[0] = 0x80;
  });
}

DefectTable segmented_rows() {
  return {
      {"segmented-download-stored-by-time-out",
       "What has come of a segmented download is stored when it is given up",
       {"SDO-SDN-18"},
       stores_by_exchange([](const Download&, const SdoExchange& e) { return e.step == SdoStep::time_out; })},
      {"segmented-download-of-two-segments-stored-by-abort",
       "What has come of a segmented download is stored when the client aborts it behind two segments or more",
       {"SDO-SDN-19"},
       stores_by_exchange([](const Download& download, const SdoExchange& e) {
         return is_client_abort(e) && download.data.size() >= two_segments;
       })},
      {"segmented-download-of-short-value-stored-by-abort",
       "Of a segmented download up to four bytes are stored when the client aborts it behind them",
       {"SDO-SDN-19"},
       stores_by_exchange([](const Download& download, const SdoExchange& e) {
         return is_client_abort(e) && download.data.size() <= 4;
       })},
      {"segmented-download-stored-by-new-request",
       "What has come of a segmented download is stored when another transfer replaces it",
       {"SDO-SDN-18"},
       stores_by_exchange([](const Download&, const SdoExchange& e) { return begins_transfer(e); })},
      {"segmented-download-shortfall-stored",
       "A segmented download of fewer bytes than were told is refused and stored all the same",
       {"SDO-SDN-08", "OD-ACC-05"},
       stores_what_has_come(
           [](const Download&, const SdoExchange& e) { return e.aborted == abort_code::length_too_low; })},
      {"segmented-download-surplus-stored",
       "A segmented download of more bytes than were told is refused and stored all the same",
       {"SDO-SDN-09", "OD-ACC-05"},
       stores_what_has_come(
           [](const Download&, const SdoExchange& e) { return e.aborted == abort_code::length_too_high; })},
      {"segmented-download-untold-surplus-cut",
       "A segmented download that tells no size is cut where it is too long for its type",
       {"OD-LEN-02"},
       Change(segmented_cut_to_fit)},
      {"upload-toggle-unchecked-from-third-segment",
       "From the third segment of an upload on the toggle bit of the requests is not checked",
       {"SDO-SUP-06"},
       Change(upload_toggle_unchecked_later)},
      {"download-toggle-unchecked-from-third-segment",
       "From the third segment of a download on the toggle bit is not checked",
       {"SDO-SDN-05"},
       Change(download_toggle_unchecked_later)},
      {"segmented-download-outlives-later-toggle-abort",
       "A segmented download goes on behind the abort of a later segment because of the toggle bit",
       {"SDO-SDN-05"},
       outlives_toggle_abort()},
      {"segmented-download-outlives-surplus",
       "A segmented download that was refused as too long is not over",
       {"SDO-SDN-09"},
       outlives(&SegmentedRules::fits)},
      {"segmented-download-outlives-shortfall",
       "A segmented download that was refused as too short can be completed",
       {"SDO-SDN-08"},
       outlives(&SegmentedRules::complete)},
      {"segmented-upload-ended-by-unknown-command",
       "An unknown command ends a segmented upload without a word",
       {"SDO-ERR-01"},
       ended_by_unknown_command<SegmentedUpload>()},
      {"segmented-download-ended-by-unknown-command",
       "An unknown command ends a segmented download without a word",
       {"SDO-ERR-01"},
       ended_by_unknown_command<SegmentedDownload>()},
      {"block-upload-ended-by-unknown-command",
       "An unknown command ends a block upload without a word",
       {"SDO-ERR-01"},
       ended_by_unknown_command<BlockUpload>()},
  };
}

DefectTable block_rows() {
  using Upload = BlockUpload;
  return {
      {"block-download-shortfall-stored",
       "A block download of fewer bytes than were told is refused and stored all the same",
       {"SDO-BDN-14", "OD-ACC-05"},
       stores_refused_block(abort_code::length_too_low)},
      {"block-download-surplus-stored",
       "A block download of more bytes than were told is refused and stored all the same",
       {"SDO-BDN-15", "OD-ACC-05"},
       stores_refused_block(abort_code::length_too_high)},
      {"block-download-untold-shortfall-filled",
       "A block download that tells no size is filled up where it is too short for its type",
       {"OD-LEN-01"},
       block_fits_by_force(Misfit::filled)},
      {"block-download-untold-surplus-cut",
       "A block download that tells no size is cut where it is too long for its type",
       {"OD-LEN-02"},
       block_fits_by_force(Misfit::cut)},
      {"block-download-crc-of-full-last-segment-unchecked",
       "The CRC of a block download is not checked where the last segment is full",
       {"SDO-BDN-03"},
       crc_unchecked(where_the_last_segment_is_full)},
      {"block-download-crc-behind-a-gap-unchecked",
       "The CRC of a block download is not checked where segments had to come again",
       {"SDO-BDN-03"},
       crc_unchecked(where_segments_came_again)},
      {"block-download-abort-ignored-in-later-sub-block",
       "A client abort behind the first sub-block does not end a block download",
       {"SDO-BDN-19"},
       deaf_to_abort<BlockDownload>([](const BlockDownload& transfer, std::size_t sub_blocks) {
         return transfer.in_sub_block() && sub_blocks > 0;
       })},
      {"block-upload-abort-ignored-in-later-sub-block",
       "A client abort behind the first sub-block does not end a block upload",
       {"SDO-BUP-17"},
       deaf_to_abort<Upload>([](const Upload&, std::size_t sub_blocks) { return sub_blocks > 0; })},
      {"block-upload-abort-ignored-between-segments",
       "A client abort between two segments of a sub-block does not end a block upload",
       {"SDO-BUP-17"},
       deaf_to_abort<Upload>([](const Upload& transfer, std::size_t) {
         return transfer.has_segment() && transfer.sequence() > 0;
       })},
      {"block-upload-not-closed-behind-a-repetition",
       "The client's confirmation does not close a block upload of which segments were sent again",
       {"SDO-BUP-24"},
       Change(not_closed_behind_a_repetition)},
      {"block-upload-acknowledge-of-block-size-taken",
       "An acknowledge of as many segments as the block size is taken, however few there were",
       {"SDO-BUP-12"},
       Change(whole_block_acknowledged)},
      {"block-upload-given-up-without-multiplexer",
       "The abort of a block upload that is left alone carries the multiplexer 0000h:00",
       {"SDO-ERR-04"},
       nameless_when_given_up(BlockWatch::Running::upload)},
      {"block-sequence-abort-names-transfer-before",
       "The abort of a sequence number carries the multiplexer of the transfer before",
       {"SDO-ERR-04"},
       names_transfer_before(abort_code::sequence_invalid)},
      {"block-size-abort-names-transfer-before",
       "The abort of an acknowledge with a wrong block size carries the multiplexer of the transfer before",
       {"SDO-ERR-04"},
       names_transfer_before(abort_code::block_size_invalid)},
  };
}

}  // namespace

DefectTable sdo_course_defects() {
  DefectTable rows = segmented_rows();
  append(rows, block_rows());
  return rows;
}

}  // namespace refnode
