// SPDX-License-Identifier: Apache-2.0
// Defects of SDO, of the dictionary and of storing that show at one place only: with one kind of transfer, on
// one channel, in one state, the second time.
#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "defects/sdo_block_exchanges.hpp"
#include "defects/sdo_rules.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

using Write = std::function<Accepted(Multiplexer, ByteView)>;
using ReadAt = std::function<Upload(Multiplexer)>;

/// `write(parts, former, mux, bytes)` in place of a write to the dictionary.
Change writing(Accepted (*write)(Parts&, const Write& former, Multiplexer, ByteView)) {
  return [write](Parts& parts) {
    parts.device.dictionary.download.replace(
        [&parts, write](const auto& former, Multiplexer at, ByteView bytes) {
          return write(parts, former, at, bytes);
        });
  };
}
/// `read(parts, former, mux)` in place of a read.
Change uploading(Upload (*read)(Parts&, const ReadAt& former, Multiplexer)) {
  return [read](Parts& parts) {
    parts.device.dictionary.upload.replace(
        [&parts, read](const auto& former, Multiplexer at) { return read(parts, former, at); });
  };
}

Entry* entry_at(Parts& parts, Multiplexer at) {
  return parts.device.dictionary.entry(at.index.value(), at.sub.value());
}
bool out_of_limits(const Accepted& done) {
  return !done && (done.error() == abort_code::value_too_high || done.error() == abort_code::value_too_low);
}

/// The request that came last, on whatever channel.
std::shared_ptr<Frame> latest_request(Parts& parts) {
  auto latest = std::make_shared<Frame>();
  misreads([latest](Parts& node, Frame& frame) {
    if (server_asked(node, frame) != nullptr) *latest = frame;
  })(parts);
  return latest;
}
bool is_unsized_expedited(const Frame& request) { return (request.data[0] & 0xE3U) == 0x22U; }
const SdoServer* default_server(const Parts& parts) {
  return parts.sdo.server_of(conform::can::data_frame(conform::CanId(0x600U + parts.device.node_id), {}));
}

/// A client abort right behind the initiate of such a transfer does not come through.
template <typename Kind>
Change loses_aborts_before_the_first_segment() {
  return deaf_to([further = 0](Parts& node, const Frame& frame) mutable {
    if (channel_of(node, frame) != 0 || frame.size() != 8) return false;
    const auto* transfer = transfer_of<Kind>(node, frame);
    if (transfer == nullptr) further = 0;
    const bool lost = transfer != nullptr && further == 0 && frame.data[0] == 0x80;
    if (transfer != nullptr && !lost) ++further;
    return lost;
  });
}
void loses_the_abort_behind_the_end(Parts& parts) {
  const auto ended = std::make_shared<bool>(false);
  parts.device.outbox.add_filter(
      on_exchange([ended](const SdoExchange& e, Frames& frames) { *ended = is_upload_end(e, frames); }));
  deaf_to([ended](Parts& node, const Frame& frame) {
    return *ended && frame.data[0] == 0x80 && transfer_of<BlockUpload>(node, frame) != nullptr;
  })(parts);
}

/// In the last segment of a download toggle bit 0 is taken for 1.
void repeats_the_last_segment(Parts& parts) {
  of_segments(parts).download_toggle_right.replace(
      [latest = latest_request(parts)](const auto& former, bool toggle, bool due) {
        return former(toggle, due) || (due && (latest->data[0] & 1U) != 0);
      });
}
void drops_what_an_empty_segment_follows(Parts& parts) {
  of_segments(parts).store.replace(
      [latest = latest_request(parts)](const auto& former, Multiplexer at, ByteView data) {
        const bool empty = (latest->data[0] & 0x0EU) == 0x0EU;
        return former(at, data.first(empty && data.size() > 7 ? data.size() - 7 : data.size()));
      });
}

void keeps_the_block_size_of_what_is_repeated(Parts& node, Frame& frame) {
  const auto* transfer = transfer_of<BlockUpload>(node, frame);
  const bool repeats = transfer != nullptr && frame.data[0] == 0xA2 && frame.data[1] < transfer->sequence();
  if (repeats && valid_block_size(frame.data[2])) frame.data[2] = transfer->block_size();
}

bool refuses_read_only(const SdoExchange& e) {
  return e.step == SdoStep::download_initiate && e.aborted == abort_code::read_only;
}
void confirm(const SdoExchange&, Data& data) { data = {0x60, data[1], data[2], data[3], 0, 0, 0, 0}; }

bool on_additional(const Parts& parts, const Frame& frame) {
  return channel_of(parts, frame).value_or(0) != 0;
}
bool is_of_class_06(const Frame& frame) { return frame.data[0] == 0x80 && frame.data[7] == 0x06; }

/// Where `when` holds for the latest request a value is not held against the limits.
Change looks_at_no_limits(bool (*when)(const Parts&, const Frame& request)) {
  return [when](Parts& parts) {
    parts.device.dictionary.download.replace(
        [&parts, when, latest = latest_request(parts)](const auto& former, Multiplexer at,
                                                       ByteView bytes) -> Accepted {
          const Accepted done = former(at, bytes);
          if (!out_of_limits(done) || !when(parts, *latest)) return done;
          entry_at(parts, at)->value.assign(bytes.begin(), bytes.end());
          return {};
        });
  };
}
Accepted compares_as_signed(Parts& parts, const Write& former, Multiplexer at, ByteView bytes) {
  const Accepted done = former(at, bytes);
  Entry* entry = entry_at(parts, at);
  if (!out_of_limits(done) || entry->type != DataType::unsigned32 || (bytes.back() & 0x80U) == 0) return done;
  entry->value.assign(bytes.begin(), bytes.end());
  return {};
}
Accepted fills_up_in_operational(Parts& parts, const Write& former, Multiplexer at, ByteView bytes) {
  const Entry* entry = entry_at(parts, at);
  Bytes all(bytes.begin(), bytes.end());
  if (entry != nullptr && !entry->command && parts.device.state == NmtState::operational)
    all.resize(std::max(all.size(), fixed_size(entry->type)));
  return former(at, all);
}
Accepted takes_half_of_64_bits(Parts& parts, const Write& former, Multiplexer at, ByteView bytes) {
  const Entry* entry = entry_at(parts, at);
  const bool half = entry != nullptr && fixed_size(entry->type) == 8 && bytes.size() == 4;
  if (!half) return former(at, bytes);
  Bytes all(bytes.begin(), bytes.end());
  all.insert(all.end(), entry->value.begin() + 4, entry->value.end());
  return former(at, all);
}

Upload reads_write_only_in_operational(Parts& parts, const ReadAt& former, Multiplexer at) {
  const Entry* entry = entry_at(parts, at);
  const bool open =
      parts.device.state == NmtState::operational && entry != nullptr && entry->access == Access::wo;
  return open ? Upload(entry->value) : former(at);
}
Upload reads_gaps_as_zero(Parts& parts, const ReadAt& former, Multiplexer at) {
  const std::uint16_t index = at.index.value();
  const bool gap = index >= 0x2000 && entry_at(parts, at) == nullptr &&
                   at.sub.value() < parts.device.dictionary.number(index, 0) &&
                   parts.device.dictionary.entry(index, 1) != nullptr;
  return gap ? Upload(Bytes{0, 0}) : former(at);
}

/// The abort of a request that is refused while a transfer is open names what that is about.
void names_the_open_transfer(Parts& parts) {
  const auto open = std::make_shared<std::optional<Multiplexer>>();
  misreads([open](Parts& node, Frame& frame) {
    if (const SdoServer* server = server_asked(node, frame)) *open = server->running_mux();
  })(parts);
  parts.device.outbox.add_filter(on_exchange([open](const SdoExchange& e, Frames& frames) {
    if (!begins_transfer(e) || !e.aborted || !*open) return;
    for (Outgoing& outgoing : frames) {
      conform::store_le(std::span(outgoing.frame.data).subspan(1, 2), (**open).index.value());
      outgoing.frame.data[3] = (**open).sub.value();
    }
  }));
}
void knows_no_segmented_download_in_operational(Parts& node, Frame& frame) {
  if (server_asked(node, frame) == nullptr || node.device.state != NmtState::operational) return;
  if ((frame.data[0] & 0xE2U) == 0x20U) frame.data[0] = 0xE0;
}
void refuses_otherwise_in_operational(const FilterContext& context, Frames& frames) {
  if (context.sdo == nullptr || context.state != NmtState::operational) return;
  if (context.sdo->aborted == abort_code::no_object)
    for (Outgoing& outgoing : frames) store_code(outgoing.frame.data, abort_code::device_state);
}
template <typename Kind>
Change ends_with(NmtState state) {
  return [state](Parts& parts) {
    of_sdo(parts).transfers_end_in.replace([&parts, state](const auto& former, NmtState entered,
                                                           std::uint8_t channel) {
      const bool such = entered == state && channel == 0 && default_server(parts)->running<Kind>() != nullptr;
      return such || former(entered, channel);
    });
  };
}

// Additional channels.
void ends_the_default_transfer_with_its_aborts(Parts& parts) {
  parts.device.outbox.add_filter(on_exchange([&parts](const SdoExchange& e, Frames&) {
    if (e.channel != 0 && e.aborted) parts.sdo.drop();
  }));
}
/// One buffer for the segments of all downloads.
void shares_a_buffer(Parts& parts) {
  struct Buffer {
    Bytes data;
    std::set<std::uint8_t> open;
    bool shared = false;
  };
  const auto buffer = std::make_shared<Buffer>();
  misreads([buffer](Parts& node, Frame& frame) {
    const auto channel = server_asked(node, frame) == nullptr ? std::nullopt : channel_of(node, frame);
    if (!channel) return;
    if ((frame.data[0] & 0xE2U) == 0x20U) {
      buffer->open.insert(*channel);
      buffer->data.clear();
      buffer->shared = buffer->open.size() > 1;
    } else if (frame.data[0] >> 5U == 0 && buffer->open.contains(*channel)) {
      buffer->data.insert(buffer->data.end(), frame.data.begin() + 1,
                          frame.data.end() - ((frame.data[0] >> 1U) & 7U));
    } else {
      buffer->open.erase(*channel);
    }
  })(parts);
  parts.device.outbox.add_filter(on_exchange([buffer](const SdoExchange& e, Frames&) {
    if (e.step == SdoStep::download_segment && (e.aborted || is_last_segment(e)))
      buffer->open.erase(e.channel);
  }));
  of_segments(parts).store.replace([buffer](const auto& former, Multiplexer at, ByteView data) {
    if (!buffer->shared) return former(at, data);
    Bytes all = buffer->data;
    all.resize(data.size());
    return former(at, all);
  });
}

// Storing.
constexpr Group groups[] = {Group::communication, Group::application};

constexpr std::uint32_t save_signature = 0x65766173;

/// `change(parts, before, images)` changes what the command has left in the memory.
Change leaves(std::uint16_t index,
              void (*change)(Parts&, std::uint8_t sub, const Images& before, Images& images)) {
  return checking_all(index, [change](Parts& parts, const Check& former, std::uint8_t sub, ByteView bytes) {
    const Images before = parts.store.memory->images();
    const Accepted done = former(bytes);
    if (!done) return done;
    Images images = parts.store.memory->images();
    change(parts, sub, before, images);
    [[maybe_unused]] const auto kept = parts.store.memory->replace(std::move(images));
    return done;
  });
}
/// The second "save" since the boot-up message is confirmed, and nothing done.
void saves_once(Parts& parts) {
  const auto saved = since_boot_up<std::set<std::uint8_t>>(parts);
  checking_all(0x1010, [saved](Parts&, const Check& former, std::uint8_t sub, ByteView bytes) {
    if (saved->contains(sub) && conform::load_le(bytes) == save_signature) return Accepted{};
    const Accepted done = former(bytes);
    if (done) saved->insert(sub);
    return done;
  })(parts);
}
void keeps_later_elements(Parts& parts, std::uint8_t, const Images& before, Images& images) {
  for (const auto& [group, image] : before) {
    const bool erased = !images.contains(group);
    for (const auto& [at, value] : image) {
      const auto object = parts.device.dictionary.objects().find(at.index.value());
      if (!erased || object == parts.device.dictionary.objects().end()) continue;
      const bool element = object->second.kind == ObjectKind::array && at.index.value() < 0x1020;
      if (element && at.sub.value() > 1) images[group][at] = value;
    }
  }
}
void erases_manufacturer(Parts&, std::uint8_t sub, const Images&, Images& images) {
  if (sub == 2) images.erase(Group::manufacturer);
}
void erases_communication(Parts&, std::uint8_t sub, const Images&, Images& images) {
  if (sub == 3) images.erase(Group::communication);
}
/// Only what has been written since the boot-up message is stored, in place of all that was.
void stores_what_was_written(Parts& parts) {
  const auto written = since_boot_up<std::set<Multiplexer>>(parts);
  parts.device.dictionary.on_download = [written,
                                         former = parts.device.dictionary.on_download](Multiplexer at) {
    written->insert(at);
    if (former) former(at);
  };
  checking_all(0x1010, [written](Parts& node, const Check& former, std::uint8_t sub, ByteView bytes) {
    const Accepted done = former(bytes);
    if (!done) return done;
    Images images = node.store.memory->images();
    for (const Group group : groups) {
      const bool stored = sub == 1 || (sub == 2) == (group == Group::communication);
      if (stored)
        std::erase_if(images[group], [&](const auto& value) { return !written->contains(value.first); });
    }
    [[maybe_unused]] const auto kept = node.store.memory->replace(std::move(images));
    return done;
  })(parts);
}
void forgets_the_sync_period(Parts& parts) {
  parts.nmt.on_reset = [&parts, former = parts.nmt.on_reset](Reset kind) {
    former(kind);
    if (kind != Reset::communication) return;
    for (const std::uint16_t index : {std::uint16_t{0x1006}, std::uint16_t{0x1007}}) {
      if (Entry* entry = parts.device.dictionary.entry(index, 0)) entry->value = entry->default_value;
    }
  };
}

}  // namespace

DefectTable sdo_rare_defects() {
  return {
      {"client-abort-of-class-06-ignored",
       "A client abort with a code of the class 06 does not end a segmented transfer",
       {"SDO-SUP-10", "SDO-SDN-19"},
       deaf_to([](Parts& node, const Frame& frame) {
         const SdoServer* server = is_of_class_06(frame) ? server_asked(node, frame) : nullptr;
         return server != nullptr && (server->running<SegmentedUpload>() != nullptr ||
                                      server->running<SegmentedDownload>() != nullptr);
       })},
      {"segmented-upload-abort-ignored-before-first-segment",
       "A client abort right behind the initiate does not end a segmented upload",
       {"SDO-SUP-10"},
       loses_aborts_before_the_first_segment<SegmentedUpload>()},
      {"segmented-download-abort-ignored-before-first-segment",
       "A client abort right behind the initiate does not end a segmented download",
       {"SDO-SDN-19"},
       loses_aborts_before_the_first_segment<SegmentedDownload>()},
      {"block-download-abort-ignored-before-first-segment",
       "A client abort right behind the initiate does not end a block download",
       {"SDO-BDN-19"},
       loses_aborts_before_the_first_segment<BlockDownload>()},
      {"block-upload-abort-ignored-behind-end",
       "A client abort in place of the confirmation does not end a block upload",
       {"SDO-BUP-17"},
       Change(loses_the_abort_behind_the_end)},
      {"download-toggle-unchecked-in-last-segment",
       "The toggle bit of the last segment of a download is not checked where it has to be 1",
       {"SDO-SDN-05"},
       Change(repeats_the_last_segment)},
      {"empty-last-segment-drops-the-one-before",
       "Of a download whose last segment holds no data the segment before is lost",
       {"SDO-SDN-11"},
       Change(drops_what_an_empty_segment_follows)},
      {"segmented-download-lost-with-nmt-start",
       "A segmented download that was begun in Pre-operational is lost with the change to Operational",
       {"SDO-SUP-21"},
       ends_with<SegmentedDownload>(NmtState::operational)},
      {"block-download-lost-with-nmt-start",
       "A block download that was begun in Pre-operational is lost with the change to Operational",
       {"SDO-SUP-21"},
       ends_with<BlockDownload>(NmtState::operational)},
      {"block-upload-of-nothing-with-full-segment",
       "The end of a block upload of an empty entry tells that its segment is full",
       {"SDO-BUP-02", "SDO-BUP-22"},
       Filter(on_exchange([](const SdoExchange& e, Frames& frames) {
         if (is_upload_end(e, frames) && frames.front().frame.data[0] == 0xDD)
           frames.front().frame.data[0] = 0xC1;
       }))},
      {"block-upload-repeats-with-former-block-size",
       "The block size of an acknowledge is not used where segments are sent again",
       {"SDO-BUP-26", "SDO-BUP-08"},
       misreads(keeps_the_block_size_of_what_is_repeated)},
      {"additional-sdo-block-download-crc-unchecked",
       "Additional SDO servers do not check the CRC of block downloads",
       {"SDO-BDN-03"},
       [](Parts& parts) {
         of_block_download(parts).crc_checked.replace(
             [&parts, latest = latest_request(parts)](const auto& former, bool agreed) {
               return former(agreed) && !on_additional(parts, *latest);
             });
       }},
      {"expedited-unsized-to-read-only-confirmed",
       "An expedited download without size to a read-only entry is confirmed without effect",
       {"OD-ACC-01"},
       patch([](const SdoExchange& e) { return refuses_read_only(e) && (e.request[0] & 0x23U) == 0x22U; },
             confirm)},
      {"expedited-unsized-past-the-limits",
       "An expedited download without size is not held against the limits",
       {"OD-RNG-01"},
       looks_at_no_limits([](const Parts&, const Frame& request) { return is_unsized_expedited(request); })},
      {"expedited-sized-fills-half-of-64-bits",
       "An expedited download of four bytes changes the lower half of an entry of 64 bits",
       {"SDO-DNL-19"},
       writing(takes_half_of_64_bits)},
      {"write-only-readable-in-operational",
       "Write-only entries can be read in Operational",
       {"OD-ACC-07", "OD-ACC-03"},
       uploading(reads_write_only_in_operational)},
      {"missing-object-in-operational-wrong-abort",
       "Absent objects are aborted with 0800 0022h in Operational",
       {"OD-GEN-04", "OD-GEN-05"},
       Filter(refuses_otherwise_in_operational)},
      {"gap-in-record-reads-zero",
       "Gaps among the sub-indices of a record are read as 0",
       {"OD-GEN-07"},
       uploading(reads_gaps_as_zero)},
      {"refused-request-names-the-open-transfer",
       "The abort of a request within a transfer names the object of the transfer",
       {"SDO-ERR-04"},
       Change(names_the_open_transfer)},
      {"additional-sdo-read-only-confirmed",
       "Additional SDO servers confirm writing to read-only entries",
       {"OD-ACC-01"},
       patch([](const SdoExchange& e) { return refuses_read_only(e) && e.channel != 0; }, confirm)},
      {"additional-sdo-client-abort-ignored",
       "On additional channels a client abort does not end the transfer",
       {"SDO-SUP-10", "SDO-SDN-19"},
       deaf_to([](Parts& node, const Frame& frame) {
         return frame.data[0] == 0x80 && server_asked(node, frame) != nullptr && channel_of(node, frame) != 0;
       })},
      {"additional-sdo-refusal-ends-default-transfer",
       "A request that is refused on an additional channel ends the transfer of the default one",
       {"SDO-MUL-04"},
       Change(ends_the_default_transfer_with_its_aborts)},
      {"sdo-channels-share-the-download-buffer",
       "Segmented downloads that run at the same time on two channels are stored as one",
       {"SDO-MUL-04"},
       Change(shares_a_buffer)},
      {"1010-second-save-forgotten",
       "A second \"save\" to the same sub-index is confirmed and forgotten, until a reset",
       {"OD-1010-10"},
       Change(saves_once)},
      {"1010-sub3-erases-communication",
       "Storing the application parameters erases the communication parameters that were stored",
       {"OD-1010-12", "OD-RST-04"},
       leaves(0x1010, erases_communication)},
      {"1010-only-what-was-written",
       "Of what was stored only values that have been written since the boot-up message are stored again",
       {"OD-1010-10", "OD-RST-04"},
       Change(stores_what_was_written)},
      {"1011-later-elements-stay",
       "\"load\" restores the first element of arrays of the communication parameters only",
       {"OD-1011-10"},
       leaves(0x1011, keeps_later_elements)},
      {"reset-communication-forgets-the-stored-sync-period",
       "Reset communication gives 1006h and 1007h their defaults, whatever is stored",
       {"STO-1010-05", "OD-RST-04"},
       Change(forgets_the_sync_period)},
      {"block-transfer-abort-of-class-06-ignored",
       "A client abort with a code of the class 06 does not end a block transfer",
       {"SDO-BUP-17", "SDO-BDN-19"},
       deaf_to([](Parts& node, const Frame& frame) {
         const SdoServer* server = is_of_class_06(frame) ? server_asked(node, frame) : nullptr;
         return server != nullptr &&
                (server->running<BlockUpload>() != nullptr || server->running<BlockDownload>() != nullptr);
       })},
      {"segmented-download-lost-with-return-to-pre-operational",
       "A segmented download that was begun in Operational is lost with the change to Pre-operational",
       {"SDO-SUP-21"},
       ends_with<SegmentedDownload>(NmtState::pre_operational)},
      {"block-upload-lost-with-return-to-pre-operational",
       "A block upload that was begun in Operational is lost with the change to Pre-operational",
       {"SDO-SUP-21"},
       ends_with<BlockUpload>(NmtState::pre_operational)},
      {"segmented-download-unknown-in-operational",
       "Requests for a segmented download are unknown commands in Operational",
       {"SDO-GEN-14"},
       misreads(knows_no_segmented_download_in_operational)},
      {"limits-unchecked-in-operational",
       "Values are not held against the limits in Operational",
       {"OD-RNG-01", "OD-RNG-02"},
       looks_at_no_limits(
           [](const Parts& parts, const Frame&) { return parts.device.state == NmtState::operational; })},
      {"additional-sdo-limits-unchecked",
       "Additional SDO servers do not hold values against the limits",
       {"OD-RNG-01"},
       looks_at_no_limits(on_additional)},
      {"high-limit-compared-as-signed",
       "A value of 32 bits with bit 31 set is below every upper limit",
       {"OD-RNG-01"},
       writing(compares_as_signed)},
      {"short-write-filled-up-in-operational",
       "A value with too few bytes is filled up with zeros in Operational",
       {"OD-LEN-01"},
       writing(fills_up_in_operational)},
      {"expedited-unsized-to-absent-object-wrong-abort",
       "An expedited download without size to an absent object is aborted with 0609 0011h",
       {"OD-GEN-05"},
       patch(
           [](const SdoExchange& e) {
             return (e.request[0] & 0xE3U) == 0x22U && e.aborted == abort_code::no_object;
           },
           [](const SdoExchange&, Data& data) { store_code(data, abort_code::no_sub_index); })},
      {"1010-sub2-erases-manufacturer",
       "Storing the communication parameters erases the parameters of the manufacturer that were stored",
       {"OD-RST-04", "OD-1010-11"},
       leaves(0x1010, erases_manufacturer)},
  };
}

}  // namespace refnode
