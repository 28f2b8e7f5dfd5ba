// SPDX-License-Identifier: Apache-2.0
// Defects of what one SDO transfer leaves to the next: toggle bit, position, data, sequence number, size,
// CRC. And of what holds for one kind of transfer only: sizes that are cut, values that are not looked at or
// not put into effect.
#include <cstddef>
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

/// How a transfer was left before it had ended.
enum class Way : std::uint8_t { aborted, replaced, refused, stopped, timed_out };

/// A transfer of the default server, seen from outside.
struct Left {
  std::size_t steps = 0;  ///< segments (block upload: sub-blocks) it has come to
  Bytes data;             ///< of a download
  bool behind = false;    ///< it was left in the way that counts, and no other one has begun to work since
};

const SdoServer* default_server(const Parts& parts) {
  return parts.sdo.server_of(conform::can::data_frame(conform::CanId(0x600U + parts.device.node_id), {}));
}

bool initiates(std::uint8_t command) {
  const unsigned specifier = command >> 5U;
  return specifier == 1 || specifier == 2 || (specifier == 5 && (command & 0x03U) == 0) ||
         (specifier == 6 && (command & 0x01U) == 0);
}

/// A request that takes the transfer one step on.
bool is_step(const SegmentedUpload&, const Frame& frame) { return frame.data[0] >> 5U == 3; }
bool is_step(const SegmentedDownload&, const Frame& frame) { return frame.data[0] >> 5U == 0; }
bool is_step(const BlockUpload&, const Frame& frame) { return frame.data[0] == 0xA2 && frame.data[1] != 0; }
bool is_step(const BlockDownload& transfer, const Frame& frame) {
  return transfer.in_sub_block() && frame.data[0] != 0x80;
}

/// Looks at transfers of this kind; `use` makes something of those that were left.
template <typename Kind, typename Use>
Change left_by(Way way, Use use) {
  return [way, use](Parts& parts) {
    const auto left = std::make_shared<Left>();
    const auto open = std::make_shared<bool>(false);
    const auto leave = [way, left](Way present) {
      if (present == way && left->steps > 0) left->behind = true;
    };
    misreads([left, open, leave](Parts& node, Frame& frame) {
      const SdoServer* server = default_server(node);
      const Kind* transfer = server == nullptr ? nullptr : server->running<Kind>();
      *open = transfer != nullptr;
      if (!*open) {
        if (!left->behind) *left = {};
        return;
      }
      if (left->behind) return;  // of the new one only that there is one
      if (frame.id == 0x000 && is_base_data_frame(frame) && frame.data[0] == 0x02) return leave(Way::stopped);
      if (channel_of(node, frame) != 0) return;
      const std::uint8_t command = frame.data[0];
      if (is_step(*transfer, frame)) {
        ++left->steps;
        left->data.insert(left->data.end(), frame.data.begin() + 1, frame.data.end());
      } else if (command == 0x80) {
        leave(Way::aborted);
      } else if (initiates(command)) {
        leave(Way::replaced);
      }
    })(parts);
    parts.device.outbox.add_filter(on_exchange([left, open, leave](const SdoExchange& e, Frames&) {
      if (e.channel != 0 || !e.aborted || !*open || begins_transfer(e)) return;
      if (e.step == SdoStep::time_out) return leave(Way::timed_out);
      if (left->steps > 0) --left->steps;  // what was refused
      leave(Way::refused);
    }));
    use(parts, left);
  };
}

using Kept = std::shared_ptr<Left>;

/// Where a transfer was left behind an odd number of segments, the next one begins with toggle bit 1.
Change toggle_left(SegmentedRules::Toggle SegmentedRules::* rule, Way way) {
  const auto use = [rule](Parts& parts, const Kept& left) {
    (of_segments(parts).*rule).replace([left](const auto& former, bool toggle, bool due) {
      const Left was = std::exchange(*left, left->behind ? Left{} : *left);
      return former(toggle, (was.behind && was.steps % 2 == 1) ? !due : due);
    });
  };
  return rule == &SegmentedRules::upload_toggle_right ? left_by<SegmentedUpload>(way, use)
                                                      : left_by<SegmentedDownload>(way, use);
}

/// An upload goes on from where the one before it was left.
Change position_left(Way way) {
  return left_by<SegmentedUpload>(way, [](Parts& parts, const Kept& left) {
    of_segments(parts).goes_on_at.replace([left](const auto& former, std::size_t sent, std::size_t size) {
      if (!left->behind) return former(sent, size);
      const std::size_t further = left->steps * 7;
      *left = {};
      return former(sent + further < size ? sent + further : sent, size);
    });
  });
}

/// What a download had brought stands before the data of the next one.
Change data_left(Way way) {
  return left_by<SegmentedDownload>(way, [](Parts& parts, const Kept& left) {
    of_segments(parts).store.replace([left](const auto& former, Multiplexer mux, ByteView data) {
      if (!left->behind) return former(mux, data);
      Bytes all(left->data.begin(), left->data.begin() + static_cast<std::ptrdiff_t>(7 * left->steps));
      all.insert(all.end(), data.begin(), data.end());
      *left = {};
      return former(mux, all);
    });
  });
}

/// The first sub-block goes on with the numbers of the one before it: none of its segments is taken.
Change number_left(Way way) {
  return left_by<BlockDownload>(way, [](Parts& parts, const Kept& left) {
    parts.sdo.rules.block_download.follows.replace(
        [left, skips = std::make_shared<bool>(false)](const auto& former, std::uint8_t number,
                                                      std::uint8_t last) {
          if (number == 1) *skips = std::exchange(*left, left->behind ? Left{} : *left).behind;
          return !*skips && former(number, last);
        });
  });
}

/// The CRC of a block upload goes on from that of the one before it.
Change crc_left(Way way) {
  return left_by<BlockUpload>(way, [](Parts& parts, const Kept& left) {
    parts.device.outbox.add_filter(on_exchange([left](const SdoExchange& e, Frames& frames) {
      if (!is_upload_end(e, frames) || !left->behind) return;
      *left = {};
      for (Outgoing& outgoing : frames) outgoing.frame.data[1] ^= 0x5AU;
    }));
  });
}

using Size = std::optional<std::size_t>;

/// A download that tells no size has the one that was told last.
void segmented_size_left(Parts& parts) {
  const auto told = std::make_shared<Size>();
  const auto untold = std::make_shared<bool>(false);
  of_segments(parts).granted.replace([told, untold](const auto& former, Multiplexer mux, Size announced) {
    *untold = !announced;
    if (announced) *told = announced;
    return former(mux, announced);
  });
  of_segments(parts).fits.replace([told, untold](const auto& former, std::size_t received, std::size_t most) {
    return former(received, *untold ? told->value_or(most) : most);
  });
}
void refuses_eight_untold_bytes(Parts& parts) {
  const auto untold = std::make_shared<bool>(false);
  of_segments(parts).granted.replace([untold](const auto& former, Multiplexer mux, Size announced) {
    *untold = !announced;
    return former(mux, announced);
  });
  of_segments(parts).fits.replace([untold](const auto& former, std::size_t received, std::size_t most) {
    return former(received, most) && !(*untold && received == 8 && most == 8);
  });
}
void block_size_left(Parts& parts) {
  const auto told = std::make_shared<Size>();
  auto& rules = parts.sdo.rules.block_download;
  rules.may_begin.replace([told](const auto& former, Multiplexer mux, Size announced) {
    if (announced) *told = announced;
    return former(mux, announced);
  });
  rules.value.replace([told](const auto& former, Bytes data, const BlockDownloadTerms& terms) {
    BlockDownloadTerms other = terms;
    if (!other.announced) other.announced = *told;
    return former(std::move(data), other);
  });
}
/// The length of the latest expedited or segmented upload.
std::shared_ptr<Size> uploaded_size(Parts& parts) {
  const auto size = std::make_shared<Size>();
  parts.device.outbox.add_filter(on_exchange([size](const SdoExchange& e, Frames& frames) {
    if (!upload_initiated(e) || frames.empty()) return;
    const Data& data = frames.front().frame.data;
    *size = is_expedited_upload(data) ? expedited_size(data) : conform::load_le(std::span(data).subspan(4));
  }));
  return size;
}
/// Until another size is told, that of an upload counts for downloads that tell none.
void segmented_size_left_by_upload(Parts& parts) {
  const auto told = uploaded_size(parts);
  const auto untold = std::make_shared<bool>(false);
  of_segments(parts).granted.replace([told, untold](const auto& former, Multiplexer mux, Size announced) {
    *untold = !announced;
    if (announced) told->reset();
    return former(mux, announced);
  });
  of_segments(parts).store.replace(
      [told, untold](const auto& former, Multiplexer mux, ByteView data) -> Accepted {
        if (*untold && *told && data.size() > **told) return refuse(abort_code::length_too_high);
        if (*untold && *told && data.size() < **told) return refuse(abort_code::length_too_low);
        return former(mux, data);
      });
}
void block_size_left_by_upload(Parts& parts) {
  const auto told = uploaded_size(parts);
  auto& rules = parts.sdo.rules.block_download;
  rules.may_begin.replace([told](const auto& former, Multiplexer mux, Size announced) {
    if (announced) told->reset();
    return former(mux, announced);
  });
  rules.value.replace([told](const auto& former, Bytes data, const BlockDownloadTerms& terms) {
    BlockDownloadTerms other = terms;
    if (!other.announced) other.announced = *told;
    return former(std::move(data), other);
  });
}
void crc_agreement_left(Parts& parts) {
  parts.sdo.rules.block_download.crc_checked.replace(
      [before = std::make_shared<bool>(false)](const auto& former, bool agreed) {
        *before = *before || agreed;
        return former(*before);
      });
}

/// Of the size that a download tells this many bits are kept.
void segmented_size_cut(Parts& parts, unsigned bits) {
  const std::size_t mask = (std::size_t{1} << bits) - 1;
  SegmentedRules& rules = of_segments(parts);
  rules.granted.replace([mask](const auto& former, Multiplexer mux, Size announced) {
    return former(mux, announced ? Size(*announced & mask) : announced);
  });
  rules.complete.replace([mask](const auto& former, std::size_t received, std::size_t announced) {
    return former(received, announced & mask);
  });
}
void block_size_cut(Parts& parts, unsigned bits) {
  const std::size_t mask = (std::size_t{1} << bits) - 1;
  auto& rules = parts.sdo.rules.block_download;
  rules.may_begin.replace([mask](const auto& former, Multiplexer mux, Size announced) {
    return former(mux, announced ? Size(*announced & mask) : announced);
  });
  rules.value.replace([mask](const auto& former, Bytes data, const BlockDownloadTerms& terms) {
    BlockDownloadTerms other = terms;
    if (other.announced) other.announced = *other.announced & mask;
    return former(std::move(data), other);
  });
}

/// While `store` runs, one hook of the entry is not there.
template <typename Hook, typename Store>
Accepted without(Parts& parts, Multiplexer mux, Hook Entry::* hook, Store store) {
  Entry* entry = parts.device.dictionary.entry(mux.index.value(), mux.sub.value());
  if (entry == nullptr || entry->command) return store();
  const Hook kept = std::exchange(entry->*hook, Hook{});
  const Accepted done = store();
  entry->*hook = kept;
  return done;
}
using Concerned = bool (*)(Multiplexer mux);

bool any_entry(Multiplexer) { return true; }
bool is_sync(Multiplexer mux) { return mux.index.value() == 0x1005; }
bool is_time(Multiplexer mux) { return mux.index.value() == 0x1012; }
bool is_emergency(Multiplexer mux) { return mux.index.value() == 0x1014; }
bool is_cob_id_of_pdo(Multiplexer mux) {
  const unsigned index = mux.index.value();
  return mux.sub.value() == 1 && ((index >= 0x1400 && index < 0x1600) || (index >= 0x1800 && index < 0x1A00));
}
bool is_mapping(Multiplexer mux) {
  const unsigned index = mux.index.value();
  return (index >= 0x1600 && index < 0x1800) || (index >= 0x1A00 && index < 0x1C00);
}

template <typename Hook>
Change segments_without(Hook Entry::* hook, Concerned concerned = any_entry) {
  return [hook, concerned](Parts& parts) {
    of_segments(parts).store.replace(
        [&parts, hook, concerned](const auto& former, Multiplexer mux, ByteView data) {
          if (!concerned(mux)) return former(mux, data);
          return without(parts, mux, hook, [&] { return former(mux, data); });
        });
  };
}
template <typename Hook>
Change blocks_without(Hook Entry::* hook, Concerned concerned = any_entry) {
  return [hook, concerned](Parts& parts) {
    parts.sdo.rules.block_download.store.replace(
        [&parts, hook, concerned](const auto& former, Multiplexer mux, ByteView data) {
          if (!concerned(mux)) return former(mux, data);
          return without(parts, mux, hook, [&] { return former(mux, data); });
        });
  };
}

bool is_type_of_pdo(Multiplexer mux) {
  const unsigned index = mux.index.value();
  return mux.sub.value() == 2 && ((index >= 0x1400 && index < 0x1600) || (index >= 0x1800 && index < 0x1A00));
}

/// What is to be looked at before a value is taken is looked at with the initiate already, where the size
/// that is told stands in the place of the value; the value itself is not.
using Look = Accepted (*)(const Entry& entry, ByteView bytes);

Accepted at_limits(const Entry& entry, ByteView bytes) {
  const auto number = static_cast<std::int64_t>(conform::load_le(bytes));
  const bool within = number >= entry.low.value_or(number) && number <= entry.high.value_or(number);
  return within ? Accepted{} : refuse(abort_code::invalid_value);
}
Accepted at_rules(const Entry& entry, ByteView bytes) {
  return entry.check && !entry.command ? entry.check(bytes) : Accepted{};
}

Accepted look_at_size(Parts& parts, Multiplexer mux, Size told, Look look) {
  const Entry* entry = parts.device.dictionary.entry(mux.index.value(), mux.sub.value());
  if (entry == nullptr || fixed_size(entry->type) == 0) return {};
  Bytes bytes(fixed_size(entry->type));
  conform::store_le(bytes, told.value_or(0));
  return look(*entry, bytes);
}
template <typename Granted>
void looks_at_size(Parts& parts, Granted& granted, Look look, Concerned concerned) {
  granted.replace([&parts, look, concerned](const auto& former, Multiplexer mux, Size told) {
    const Accepted may = former(mux, told);
    return may && concerned(mux) ? look_at_size(parts, mux, told, look) : may;
  });
}
void segmented_looks_at_size(Parts& parts, Look look, Concerned concerned) {
  looks_at_size(parts, of_segments(parts).granted, look, concerned);
}
void block_looks_at_size(Parts& parts, Look look, Concerned concerned) {
  looks_at_size(parts, parts.sdo.rules.block_download.may_begin, look, concerned);
}

DefectTable left_rows() {
  const auto upload_toggle = &SegmentedRules::upload_toggle_right;
  const auto download_toggle = &SegmentedRules::download_toggle_right;
  return {
      {"upload-toggle-left-by-new-request",
       "An upload that has replaced another one behind an odd number of segments begins with toggle bit 1",
       {"SDO-SUP-03"},
       toggle_left(upload_toggle, Way::replaced)},
      {"upload-toggle-left-by-stop",
       "An upload begins with toggle bit 1 where the device was stopped behind an odd number of segments",
       {"SDO-SUP-03"},
       toggle_left(upload_toggle, Way::stopped)},
      {"upload-toggle-left-by-time-out",
       "An upload begins with toggle bit 1 where the one before was given up behind an odd number of segments",
       {"SDO-SUP-03"},
       toggle_left(upload_toggle, Way::timed_out)},
      {"upload-position-left-by-refusal",
       "An upload goes on where the one before it was refused",
       {"SDO-SUP-03"},
       position_left(Way::refused)},
      {"upload-position-left-by-stop",
       "An upload goes on where the one before it was when the device was stopped",
       {"SDO-SUP-03"},
       position_left(Way::stopped)},
      {"download-toggle-left-by-new-request",
       "A download that has replaced another one behind an odd number of segments begins with toggle bit 1",
       {"SDO-SDN-03"},
       toggle_left(download_toggle, Way::replaced)},
      {"download-toggle-left-by-refusal",
       "A download begins with toggle bit 1 where the one before was refused behind an odd number of segments",
       {"SDO-SDN-03"},
       toggle_left(download_toggle, Way::refused)},
      {"download-toggle-left-by-stop",
       "A download begins with toggle bit 1 where the device was stopped behind an odd number of segments",
       {"SDO-SDN-03"},
       toggle_left(download_toggle, Way::stopped)},
      {"download-toggle-left-by-time-out",
       "A download begins with toggle bit 1 where the one before was given up behind an odd number of segments",
       {"SDO-SDN-03", "SDO-SDN-01"},
       toggle_left(download_toggle, Way::timed_out)},
      {"download-data-left-by-abort",
       "What an aborted download had brought stands before the data of the next one",
       {"SDO-SDN-03"},
       data_left(Way::aborted)},
      {"download-data-left-by-new-request",
       "What a replaced download had brought stands before the data of the one that has replaced it",
       {"SDO-SDN-03"},
       data_left(Way::replaced)},
      {"download-data-left-by-stop",
       "What a download had brought when the device was stopped stands before the data of the next one",
       {"SDO-SDN-03"},
       data_left(Way::stopped)},
      {"block-download-number-left-by-new-request",
       "A block download that has replaced another one waits for the number behind the last one of that",
       {"SDO-BDN-06"},
       number_left(Way::replaced)},
      {"block-download-number-left-by-refusal",
       "A block download waits for the number behind the last one of a download that was refused at its end",
       {"SDO-BDN-06"},
       number_left(Way::refused)},
      {"block-download-number-left-by-stop",
       "A block download waits for the number behind the last one before the device was stopped",
       {"SDO-BDN-06"},
       number_left(Way::stopped)},
      {"block-upload-crc-left-by-abort",
       "The CRC of a block upload goes on from that of an aborted one",
       {"SDO-BUP-02"},
       crc_left(Way::aborted)},
      {"block-upload-crc-left-by-new-request",
       "The CRC of a block upload goes on from that of the one it has replaced",
       {"SDO-BUP-02"},
       crc_left(Way::replaced)},
      {"block-upload-crc-left-by-refusal",
       "The CRC of a block upload goes on from that of one that was refused",
       {"SDO-BUP-02"},
       crc_left(Way::refused)},
      {"block-upload-crc-left-by-stop",
       "The CRC of a block upload goes on from that of one during which the device was stopped",
       {"SDO-BUP-02"},
       crc_left(Way::stopped)},
      {"download-size-left-to-next",
       "A segmented download that tells no size cannot be longer than the one before it that told one",
       {"SDO-SDN-02"},
       Change(segmented_size_left)},
      {"block-download-size-left-to-next",
       "A block download that tells no size has to be as long as the one before it that told one",
       {"SDO-BDN-16"},
       Change(block_size_left)},
      {"download-size-left-by-upload",
       "A segmented download that tells no size has to be as long as the upload before it",
       {"SDO-SDN-02"},
       Change(segmented_size_left_by_upload)},
      {"block-download-size-left-by-upload",
       "A block download that tells no size has to be as long as the upload before it",
       {"SDO-BDN-16"},
       Change(block_size_left_by_upload)},
      {"block-download-crc-left-to-next",
       "After a block download with CRC one without is refused because of its CRC",
       {"SDO-BDN-04"},
       Change(crc_agreement_left)},
  };
}

}  // namespace

DefectTable sdo_leftover_defects() {
  DefectTable rows = left_rows();
  DefectTable other = {
      {"segmented-download-size-16-bits",
       "Of the size that a segmented download tells 16 bits count",
       {"SDO-SDN-06"},
       [](Parts& parts) { segmented_size_cut(parts, 16); }},
      {"segmented-download-size-24-bits",
       "Of the size that a segmented download tells 24 bits count",
       {"SDO-SDN-06"},
       [](Parts& parts) { segmented_size_cut(parts, 24); }},
      {"segmented-download-size-bit-31-unanswered",
       "A segmented download that tells a size with bit 31 set gets no answer",
       {"SDO-SDN-06"},
       silent([](const SdoExchange& e) {
         return e.step == SdoStep::download_initiate && !is_expedited(e) && is_sized(e) &&
                (e.request[7] & 0x80U) != 0;
       })},
      {"block-download-size-16-bits",
       "Of the size that a block download tells 16 bits count",
       {"SDO-BDN-12"},
       [](Parts& parts) { block_size_cut(parts, 16); }},
      {"block-download-size-24-bits",
       "Of the size that a block download tells 24 bits count",
       {"SDO-BDN-12"},
       [](Parts& parts) { block_size_cut(parts, 24); }},
      {"block-download-size-bit-31-unanswered",
       "A block download that tells a size with bit 31 set gets no answer",
       {"SDO-BDN-12"},
       silent([](const SdoExchange& e) {
         // Bit 1 of the command: bytes 4 to 7 hold the size.
         return e.step == SdoStep::block_download_initiate && (e.request[0] & 0x02U) != 0 &&
                (e.request[7] & 0x80U) != 0;
       })},
      {"segmented-download-of-8-bytes-needs-size",
       "A segmented download that tells no size cannot have eight bytes",
       {"SDO-SDN-02"},
       Change(refuses_eight_untold_bytes)},
      {"block-download-lower-number-taken",
       "A segment with a lower number than the last one is taken, and counting goes on from there",
       {"SDO-BDN-07"},
       [](Parts& parts) {
         parts.sdo.rules.block_download.follows.replace(
             [](const auto& former, std::uint8_t number, std::uint8_t last) {
               return former(number, last) || number < last;
             });
       }},
      {"segmented-write-without-effect",
       "What a segmented download writes is stored and not put into effect",
       {"EC-HBP-02"},
       segments_without(&Entry::written)},
      {"block-write-without-effect",
       "What a block download writes is stored and not put into effect",
       {"EC-HBP-02"},
       blocks_without(&Entry::written)},
      {"segmented-write-not-looked-at",
       "What a segmented download brings is looked at for its length and limits only",
       {"OD-1016-06"},
       segments_without(&Entry::check)},
      {"block-write-not-looked-at",
       "What a block download brings is looked at for its length and limits only",
       {"OD-1016-06"},
       blocks_without(&Entry::check)},
      {"1005-by-segments-not-looked-at",
       "A segmented download brings any value for the CAN-ID of SYNC",
       {"CAN-RID-01", "OD-CID-03"},
       segments_without(&Entry::check, is_sync)},
      {"1005-by-blocks-not-looked-at",
       "A block download brings any value for the CAN-ID of SYNC",
       {"CAN-RID-01", "OD-CID-03"},
       blocks_without(&Entry::check, is_sync)},
      {"1012-by-segments-not-looked-at",
       "A segmented download brings any value for the CAN-ID of TIME",
       {"CAN-RID-02", "OD-CID-03"},
       segments_without(&Entry::check, is_time)},
      {"1012-by-blocks-not-looked-at",
       "A block download brings any value for the CAN-ID of TIME",
       {"CAN-RID-02", "OD-CID-03"},
       blocks_without(&Entry::check, is_time)},
      {"1014-by-segments-not-looked-at",
       "A segmented download brings any value for the CAN-ID of EMCY",
       {"CAN-RID-03", "OD-CID-03", "OD-1014-06"},
       segments_without(&Entry::check, is_emergency)},
      {"1014-by-blocks-not-looked-at",
       "A block download brings any value for the CAN-ID of EMCY",
       {"CAN-RID-03", "OD-CID-03", "OD-1014-06"},
       blocks_without(&Entry::check, is_emergency)},
      {"pdo-cob-id-by-segments-not-looked-at",
       "A segmented download brings any value for the COB-ID of a PDO",
       {"CAN-RID-04", "CAN-RID-05", "OD-CID-03", "OD-1400-10", "OD-1800-10"},
       segments_without(&Entry::check, is_cob_id_of_pdo)},
      {"pdo-cob-id-by-blocks-not-looked-at",
       "A block download brings any value for the COB-ID of a PDO",
       {"CAN-RID-04", "CAN-RID-05", "OD-CID-03", "OD-1400-10", "OD-1800-10"},
       blocks_without(&Entry::check, is_cob_id_of_pdo)},
      {"pdo-mapping-by-segments-not-looked-at",
       "A segmented download brings any value for the mapping of a PDO",
       {"OD-1600-06", "OD-1A00-06"},
       segments_without(&Entry::check, is_mapping)},
      {"pdo-mapping-by-blocks-not-looked-at",
       "A block download brings any value for the mapping of a PDO",
       {"OD-1600-06", "OD-1A00-06"},
       blocks_without(&Entry::check, is_mapping)},
      {"pdo-type-by-segments-not-looked-at",
       "A segmented download brings any value for the transmission type of a PDO",
       {"OD-1400-16", "OD-1800-16"},
       segments_without(&Entry::check, is_type_of_pdo)},
      {"pdo-type-by-blocks-not-looked-at",
       "A block download brings any value for the transmission type of a PDO",
       {"OD-1400-16", "OD-1800-16"},
       blocks_without(&Entry::check, is_type_of_pdo)},
      {"segmented-limits-held-against-size",
       "A segmented download is held against the limits of the entry by the size it tells, not by its value",
       {"SDO-SDN-23"},
       together(segments_without(&Entry::low), segments_without(&Entry::high),
                [](Parts& parts) { segmented_looks_at_size(parts, at_limits, any_entry); })},
      {"block-limits-held-against-size",
       "A block download is held against the limits of the entry by the size it tells, not by its value",
       {"SDO-BDN-24"},
       together(blocks_without(&Entry::low), blocks_without(&Entry::high),
                [](Parts& parts) { block_looks_at_size(parts, at_limits, any_entry); })},
      {"pdo-cob-id-by-segments-held-against-size",
       "What a segmented download tells as its size is taken for the COB-ID of a PDO, which is then refused",
       {"SDO-SDN-23"},
       [](Parts& parts) { segmented_looks_at_size(parts, at_rules, is_cob_id_of_pdo); }},
      {"pdo-cob-id-by-blocks-held-against-size",
       "What a block download tells as its size is taken for the COB-ID of a PDO, which is then refused",
       {"SDO-BDN-24"},
       [](Parts& parts) { block_looks_at_size(parts, at_rules, is_cob_id_of_pdo); }},
  };
  append(rows, std::move(other));
  return rows;
}

}  // namespace refnode
