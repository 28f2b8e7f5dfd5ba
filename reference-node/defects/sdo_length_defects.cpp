// SPDX-License-Identifier: Apache-2.0
// Finer defects of SDO: lengths that are wrong for one size only or not told, the last segment of a full
// sub-block, and data that two servers share.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "defects/sdo_block_exchanges.hpp"
#include "defects/sdo_rules.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr std::uint8_t expedited_of(std::size_t size) {
  return static_cast<std::uint8_t>(0x23U | ((4U - size) << 2U));
}

/// An expedited download of `given` bytes to an entry of `size` bytes counts as one of the right length.
Change takes_length(std::size_t size, std::size_t given) {
  return misreads([size, given](Parts& parts, Frame& frame) {
    if (server_asked(parts, frame) == nullptr || frame.data[0] != expedited_of(given)) return;
    if (receiving(parts, frame) != nullptr) return;
    const Entry* entry = parts.device.dictionary.entry(
        static_cast<std::uint16_t>(conform::load_le(std::span(frame.data).subspan(1, 2))), frame.data[3]);
    if (entry != nullptr && fixed_size(entry->type) == size) frame.data[0] = expedited_of(size);
  });
}

/// The size that a segmented upload of a number announces is one byte too high.
Change announces_more_for_numbers() {
  return [](Parts& parts) {
    parts.device.outbox.add_filter([&parts](const FilterContext& context, std::vector<Outgoing>& frames) {
      if (context.sdo == nullptr || !upload_initiated(*context.sdo)) return;
      const Entry* entry = parts.device.dictionary.entry(context.sdo->index(), context.sdo->sub());
      if (entry == nullptr || fixed_size(entry->type) == 0) return;
      for (Outgoing& outgoing : frames) {
        if (is_segmented_upload(outgoing.frame.data)) ++outgoing.frame.data[4];
      }
    });
  };
}

/// When the last segment of a block upload is number 127, the end frame does not tell its unused bytes.
Filter unused_bytes_of_segment_127_not_told() {
  return on_exchange([last = std::uint8_t{0}](const SdoExchange& e, Frames& frames) mutable {
    if (is_upload_segment(e, frames)) last = frames.front().frame.data[0];
    if (!is_upload_end(e, frames) || last != 0xFF) return;
    for (Outgoing& outgoing : frames) outgoing.frame.data[0] &= 0xE3U;
  });
}
/// When the last segment of a block download is number 127, all its bytes are taken for data.
Change unused_bytes_of_segment_127_taken() {
  return [](Parts& parts) {
    const auto last = std::make_shared<std::uint8_t>(0);
    Change(misreads([last](Parts& node, Frame& frame) {
      if (receiving(node, frame) != nullptr) {
        *last = frame.data[0];
      } else if (transfer_of<BlockDownload>(node, frame) != nullptr && (frame.data[0] & 0xE3U) == 0xC1U &&
                 *last == 0xFF) {
        frame.data[0] &= 0xE3U;
      }
    }))(parts);
  };
}

/// All servers send the segments of the upload that was begun last, each from where it is.
Change segments_of_the_latest_upload() {
  struct Shared {
    Bytes data;
    std::map<std::uint8_t, std::size_t> position;  ///< by channel
  };
  return [](Parts& parts) {
    const auto shared = std::make_shared<Shared>();
    parts.device.outbox.add_filter(
        [&parts, shared](const FilterContext& context, std::vector<Outgoing>& frames) {
          if (context.sdo == nullptr || frames.empty()) return;
          const SdoExchange& e = *context.sdo;
          if (upload_initiated(e) && is_segmented_upload(frames.front().frame.data)) {
            if (const Upload data = parts.device.dictionary.upload(e.mux)) shared->data = *data;
            shared->position[e.channel] = 0;
          }
          if (!upload_segment_sent(e)) return;
          std::size_t& position = shared->position[e.channel];
          for (Outgoing& outgoing : frames) {
            for (std::size_t i = 1; i < 8 && position < shared->data.size(); ++i)
              outgoing.frame.data[i] = shared->data[position++];
          }
        });
  };
}

/// The upper limit is not looked at where no size was told.
void unsized_above_the_limit(Parts& parts) {
  const auto sized = std::make_shared<bool>(false);
  SegmentedRules& rules = of_segments(parts);
  rules.granted.replace([sized](const auto& former, Multiplexer mux, std::optional<std::size_t> announced) {
    *sized = announced.has_value();
    return former(mux, announced);
  });
  rules.store.replace([&parts, sized](const auto& former, Multiplexer mux, ByteView data) -> Accepted {
    const Accepted stored = former(mux, data);
    Entry* entry = parts.device.dictionary.entry(mux.index.value(), mux.sub.value());
    if (stored || *sized || entry == nullptr || stored.error() != abort_code::value_too_high) return stored;
    entry->value = Bytes(data.begin(), data.end());
    return {};
  });
}

bool has_fixed_size(Parts& parts, Multiplexer mux) {
  const Entry* entry = parts.device.dictionary.entry(mux.index.value(), mux.sub.value());
  return entry != nullptr && fixed_size(entry->type) != 0;
}
/// Where the entry takes any length more bytes come than were told.
void takes_more_segments_than_told(Parts& parts) {
  const auto most = std::make_shared<std::size_t>(0);
  of_segments(parts).granted.replace(
      [&parts, most](const auto& former, Multiplexer mux, std::optional<std::size_t> announced) {
        *most = has_fixed_size(parts, mux) ? 0 : parts.device.dictionary.capacity(mux);
        return former(mux, announced);
      });
  of_segments(parts).fits.replace([most](const auto& former, std::size_t received, std::size_t told) {
    return received <= *most || former(received, told);
  });
}
void takes_more_by_block_than_told(Parts& parts) {
  const auto as_if_untold = [&parts](const BlockDownloadTerms& terms, std::size_t size) {
    BlockDownloadTerms other = terms;
    if (!has_fixed_size(parts, terms.mux) && size > terms.announced.value_or(size)) other.announced.reset();
    return other;
  };
  BlockDownloadRules& rules = of_block_download(parts);
  rules.fits.replace([as_if_untold](const auto& former, std::size_t size, const BlockDownloadTerms& terms) {
    return former(size, as_if_untold(terms, size));
  });
  rules.value.replace([as_if_untold](const auto& former, Bytes data, const BlockDownloadTerms& terms) {
    const BlockDownloadTerms other = as_if_untold(terms, data.size());
    return former(std::move(data), other);
  });
}

/// A size of 0 counts as none; an entry of more than four bytes for which no bytes come is set to zero.
void fills_up_what_told_no_bytes(Parts& parts) {
  const auto none = std::make_shared<bool>(false);
  of_segments(parts).granted.replace(
      [none](const auto& former, Multiplexer mux, std::optional<std::size_t> announced) {
        *none = announced == std::size_t{0};
        return former(mux, *none ? std::nullopt : announced);
      });
  of_segments(parts).store.replace([&parts, none](const auto& former, Multiplexer mux, ByteView data) {
    const std::size_t size = parts.device.dictionary.capacity(mux);
    const bool filled = *none && data.empty() && size > 4 && has_fixed_size(parts, mux);
    return filled ? former(mux, Bytes(size)) : former(mux, data);
  });
}

/// A segmented download that tells no size counts as an expedited one of the four bytes that are reserved,
/// where the entry takes as many. The segment that follows is refused by name.
void takes_reserved_bytes_for_data(Parts& parts) {
  const auto taken = std::make_shared<std::optional<std::array<std::uint8_t, 3>>>();
  misreads([taken](Parts& node, Frame& frame) {
    if (server_asked(node, frame) == nullptr || receiving(node, frame) != nullptr) return;
    const std::uint8_t command = frame.data[0];
    if (command >> 5U != 0) taken->reset();
    const Entry* entry = node.device.dictionary.entry(
        static_cast<std::uint16_t>(conform::load_le(std::span(frame.data).subspan(1, 2))), frame.data[3]);
    if ((command & 0xF3U) != 0x20 || entry == nullptr) return;
    if (fixed_size(entry->type) != 4 && fixed_size(entry->type) != 0) return;
    *taken = {frame.data[1], frame.data[2], frame.data[3]};
    frame.data[0] = expedited_of(4);
  })(parts);
  parts.device.outbox.add_filter(on_exchange([taken](const SdoExchange& e, Frames& frames) {
    if (!*taken || !download_segment_without_transfer(e)) return;
    for (Outgoing& outgoing : frames) std::ranges::copy(**taken, outgoing.frame.data.begin() + 1);
  }));
}

constexpr std::size_t most_kept = std::size_t{127} * 7;

/// Of downloads that tell no size as much is kept as a sub-block holds.
void cuts_untold_lengths(Parts& parts) {
  const auto untold = std::make_shared<bool>(false);
  of_segments(parts).granted.replace(
      [untold](const auto& former, Multiplexer mux, std::optional<std::size_t> announced) {
        *untold = !announced;
        return former(mux, announced);
      });
  of_segments(parts).store.replace([untold](const auto& former, Multiplexer mux, ByteView data) {
    return former(mux, *untold ? data.first(std::min(data.size(), most_kept)) : data);
  });
}

}  // namespace

DefectTable sdo_length_defects() {
  return {
      {"u32-takes-three-bytes",
       "Three bytes are taken for an entry of 32 bits",
       {"OD-LEN-01"},
       takes_length(4, 3)},
      {"u32-takes-two-bytes",
       "Two bytes are taken for an entry of 32 bits",
       {"OD-LEN-01"},
       takes_length(4, 2)},
      {"u8-takes-two-bytes", "Two bytes are taken for an entry of 8 bits", {"OD-LEN-02"}, takes_length(1, 2)},
      {"u16-takes-three-bytes",
       "Three bytes are taken for an entry of 16 bits",
       {"OD-LEN-02"},
       takes_length(2, 3)},
      {"segmented-size-of-numbers-one-too-high",
       "A segmented upload of five to eight bytes announces one byte more",
       {"SDO-SUP-02"},
       announces_more_for_numbers()},
      {"segmented-download-without-size-above-limit",
       "A segmented download that tells no size takes values above the limit",
       {"SDO-SDN-23"},
       Change(unsized_above_the_limit)},
      {"segmented-download-without-size-cut",
       "Of a segmented download that tells no size 889 bytes are stored",
       {"SDO-SDN-02"},
       Change(cuts_untold_lengths)},
      {"unsized-segmented-taken-for-expedited",
       "A segmented download that tells no size is taken for an expedited one of four bytes",
       {"SDO-SDN-02", "OD-ACC-05"},
       Change(takes_reserved_bytes_for_data)},
      {"segmented-text-longer-than-told",
       "A segmented download brings more bytes than it told where the entry takes any length",
       {"SDO-SDN-09"},
       Change(takes_more_segments_than_told)},
      {"block-text-longer-than-told",
       "A block download brings more bytes than it told where the entry takes any length",
       {"SDO-BDN-15"},
       Change(takes_more_by_block_than_told)},
      {"no-bytes-told-fill-with-zeros",
       "A segmented download that tells a size of 0 and brings nothing sets an entry of eight bytes to zero",
       {"SDO-SDN-14"},
       Change(fills_up_what_told_no_bytes)},
      {"block-upload-segment-127-unused-bytes",
       "The end of a block upload tells no unused bytes when its last segment is number 127",
       {"SDO-BUP-13"},
       unused_bytes_of_segment_127_not_told()},
      {"block-download-segment-127-unused-bytes",
       "The unused bytes of the last segment of a block download are taken for data when it is number 127",
       {"SDO-BDN-06"},
       unused_bytes_of_segment_127_taken()},
      {"segments-of-the-latest-upload",
       "Two SDO servers that upload at the same time both send the data of the later request",
       {"SDO-MUL-04"},
       segments_of_the_latest_upload()},
  };
}

}  // namespace refnode
