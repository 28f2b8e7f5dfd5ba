// SPDX-License-Identifier: Apache-2.0
// Defects of expedited transfers: length, order and completeness of up to four bytes.
#include <algorithm>
#include <memory>
#include <utility>

#include "defects/hooks.hpp"
#include "defects/sdo_exchanges.hpp"
#include "defects/sdo_rules.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

bool reserved_request_bytes_used(const SdoExchange& e) {
  return upload_initiated(e) &&
         std::any_of(e.request.begin() + 4, e.request.end(), [](std::uint8_t byte) { return byte != 0; });
}
// Reserved bits: 4-0 of an upload initiate, 4 of a download initiate, 3-0 of an upload segment request.
bool reserved_bits_used(const SdoExchange& e) {
  switch (e.step) {
    case SdoStep::upload_initiate: return (e.request[0] & 0x1FU) != 0;
    case SdoStep::download_initiate: return (e.request[0] & 0x10U) != 0;
    case SdoStep::upload_segment: return (e.request[0] & 0x0FU) != 0;
    default: return false;
  }
}

/// Changes the manufacturer's writable entries of `size` bytes; communication objects keep working.
DictionaryEdit scratch_entries(std::size_t size, void (*change)(Entry&)) {
  return [size, change](ObjectDictionary& od, std::uint8_t) {
    for (auto& [index, object] : od.objects()) {
      for (auto& [sub, entry] : object.entries) {
        if (index >= 0x2000 && index < 0x2F00 && entry.access == Access::rw && fixed_size(entry.type) == size)
          change(entry);
      }
    }
  };
}
DictionaryEdit downloads_forgotten(std::size_t size) {
  return scratch_entries(size, [](Entry& entry) { entry.command = true; });
}
/// Whatever is written, the bytes from the third on are zero.
void lose_upper_bytes(Entry& entry) {
  Entry* self = &entry;  // entries live in maps: they do not move
  entry.written = [self] { std::fill(self->value.begin() + 2, self->value.end(), std::uint8_t{0}); };
}

/// A constant that counts how often it was read.
DictionaryEdit counting_constant(std::uint16_t index, std::uint8_t sub) {
  return [index, sub](ObjectDictionary& od, std::uint8_t) {
    Entry* entry = od.entry(index, sub);
    if (entry == nullptr || entry->value.empty()) return;
    entry->read = [entry]() -> Upload {
      ++entry->value[0];
      return entry->value;
    };
  };
}

/// What an upload request, not one for a block upload, gets of five to eight bytes.
Change cuts_long_numbers() {
  return [](Parts& parts) {
    const auto asked = std::make_shared<bool>(false);
    Change(Reading([asked](Parts&, std::vector<Frame>& frames) {
      for (const Frame& frame : frames) *asked = frame.data[0] >> 5U == 2;
    }))(parts);
    parts.device.dictionary.upload.replace([asked](const auto& former, Multiplexer mux) {
      Upload data = former(mux);
      if (std::exchange(*asked, false) && data && data->size() <= 8)
        data->resize(std::min<std::size_t>(data->size(), 4));
      return data;
    });
  };
}

using Flag = std::shared_ptr<bool>;
/// Set while the latest request is an expedited download without size.
Flag unsized_download_seen(Parts& parts) {
  const auto seen = std::make_shared<bool>(false);
  misreads([seen](Parts& node, Frame& frame) {
    *seen = channel_of(node, frame).has_value() && frame.size() == 8 && (frame.data[0] & 0xE3U) == 0x22;
  })(parts);
  return seen;
}

/// An expedited download without size counts as one of the entry's length, where `concerned` holds: what four
/// bytes leave over keeps what it held before.
Change takes_the_length_of(bool (*concerned)(const Entry&)) {
  return [concerned](Parts& parts) {
    const Flag unsized = unsized_download_seen(parts);
    parts.device.dictionary.download.replace(
        [&parts, unsized, concerned](const auto& former, Multiplexer mux, ByteView data) {
          const Entry* entry = parts.device.dictionary.entry(mux.index.value(), mux.sub.value());
          if (!std::exchange(*unsized, false) || entry == nullptr || !concerned(*entry) ||
              entry->value.size() <= data.size())
            return former(mux, data);
          Bytes all = entry->value;
          std::copy(data.begin(), data.end(), all.begin());
          return former(mux, all);
        });
  };
}

/// Of a DOMAIN nothing is written by an expedited download without size.
Change forgets_unsized_domains() {
  return [](Parts& parts) {
    const Flag unsized = unsized_download_seen(parts);
    parts.device.dictionary.download.replace(
        [&parts, unsized](const auto& former, Multiplexer mux, ByteView data) -> Accepted {
          const Entry* entry = parts.device.dictionary.entry(mux.index.value(), mux.sub.value());
          if (std::exchange(*unsized, false) && entry != nullptr && entry->type == DataType::domain)
            return {};
          return former(mux, data);
        });
  };
}

DefectTable upload_rows() {
  return {
      {"u8-sent-as-u32",
       "Every expedited upload claims four bytes",
       {"SDO-UPL-02", "SDO-UPL-03", "OD-GEN-10", "OD-LEN-04", "OD-1001-01", "SDO-UPL-04"},
       patch(upload_initiated,
             [](const SdoExchange&, Data& data) {
               if (is_expedited_upload(data)) data[0] = 0x43;
             })},
      {"upload-size-not-indicated",
       "Expedited uploads never tell their size",
       {"OD-LEN-04", "OD-GEN-10", "SDO-SUP-23"},
       patch(upload_initiated,
             [](const SdoExchange&, Data& data) {
               if (is_expedited_upload(data)) data[0] = 0x42;
             })},
      {"data-big-endian",
       "Expedited uploads send numbers with the most significant byte first",
       {"OD-ACC-04", "SDO-DNL-01", "OD-1000-07", "OD-1018-08", "OD-1017-03"},
       patch(upload_initiated,
             [](const SdoExchange&, Data& data) {
               if (!is_expedited_upload(data)) return;
               std::reverse(data.begin() + 4,
                            data.begin() + 4 + static_cast<std::ptrdiff_t>(expedited_size(data)));
             })},
      {"u64-truncated-to-expedited",
       "Numbers of five to eight bytes are sent expedited, cut to four",
       {"SDO-UPL-05"},
       cuts_long_numbers()},
      {"stale-data-returned",
       "An upload returns the data of the upload before it",
       {"OD-GEN-13", "SDO-UPL-06"},
       Filter([last = Data{}](const FilterContext& context, std::vector<Outgoing>& frames) mutable {
         if (context.sdo == nullptr || !upload_initiated(*context.sdo)) return;
         for (Outgoing& outgoing : frames) {
           Data& data = outgoing.frame.data;
           if (!is_expedited_upload(data)) continue;
           const Data fresh = data;
           std::copy_n(last.begin() + 4, 4, data.begin() + 4);
           last = fresh;
         }
       })},
      {"expedited-size-one-too-low",
       "Expedited uploads of two to four bytes claim one byte less",
       {"SDO-UPL-01", "SDO-UPL-03", "SDO-UPL-04"},
       patch(upload_initiated,
             [](const SdoExchange&, Data& data) {
               if (is_expedited_upload(data) && expedited_size(data) > 1) data[0] += 0x04U;
             })},
      {"expedited-size-one-too-high",
       "Expedited uploads of one to three bytes claim one byte more",
       {"SDO-UPL-02", "SDO-UPL-03", "SDO-UPL-04"},
       patch(upload_initiated,
             [](const SdoExchange&, Data& data) {
               if (is_expedited_upload(data) && expedited_size(data) < 4)
                 data[0] = static_cast<std::uint8_t>(data[0] - 4U);
             })},
      {"u16-sent-as-u32",
       "Entries of 16 bits are sent as 32 bits",
       {"SDO-UPL-03", "OD-LEN-04"},
       patch(upload_initiated,
             [](const SdoExchange&, Data& data) {
               if (data[0] == 0x4B) data[0] = 0x43;
             })},
      {"u24-sent-as-u32",
       "Entries of 24 bits are sent as 32 bits",
       {"SDO-UPL-04", "OD-LEN-04"},
       patch(upload_initiated,
             [](const SdoExchange&, Data& data) {
               if (data[0] == 0x47) data[0] = 0x43;
             })},
      {"empty-entry-command-byte-53h",
       "An empty entry is sent expedited with the impossible command byte 53h",
       {"SDO-SUP-16", "SDO-GEN-06"},
       patch(upload_initiated,
             [](const SdoExchange&, Data& data) {
               if (is_segmented_upload(data) && data[4] == 0 && data[5] == 0) data[0] = 0x53;
             })},
      {"empty-entry-silent",
       "Reading an empty entry gets no answer",
       {"OD-GEN-17", "SDO-SUP-16"},
       Filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
         if (context.sdo == nullptr || !upload_initiated(*context.sdo) || frames.empty()) return;
         const Data& data = frames.front().frame.data;
         if (is_segmented_upload(data) && data[4] == 0 && data[5] == 0) frames.clear();
       })},
      {"small-entry-by-segments-with-wrong-n",
       "Entries of up to four bytes come by segments that claim seven bytes",
       {"SDO-SUP-15", "SDO-UPL-01", "SDO-UPL-02", "SDO-UPL-03", "SDO-SUP-02", "SDO-SUP-04"},
       Filter([held = Data{}](const FilterContext& context, std::vector<Outgoing>& frames) mutable {
         if (context.sdo == nullptr || frames.empty()) return;
         Data& data = frames.front().frame.data;
         if (upload_initiated(*context.sdo)) {
           held = {};
           if (!is_expedited_upload(data)) return;
           held = data;
           data = {0x41, data[1], data[2], data[3], static_cast<std::uint8_t>(expedited_size(data))};
         } else if (held[0] != 0 && segment_without_transfer(*context.sdo)) {
           data = {0x01, held[4], held[5], held[6], held[7]};
           held = {};
         }
       })},
      {"upload-request-bytes-interpreted",
       "Reserved bytes of an upload request come back as data",
       {"SDO-UPL-12"},
       patch(reserved_request_bytes_used,
             [](const SdoExchange& e, Data& data) {
               if (is_expedited_upload(data)) std::copy_n(e.request.begin() + 4, 4, data.begin() + 4);
             })},
      {"upload-request-bytes-not-zero-silent",
       "An upload request with reserved bytes that are not zero gets no answer",
       {"SDO-UPL-12"},
       silent(reserved_request_bytes_used)},
      {"reserved-request-bits-silent",
       "Requests with a reserved bit of the command byte set get no answer",
       {"SDO-UPL-13", "SDO-DNL-18", "SDO-SUP-14"},
       silent(reserved_bits_used)},
      {"upload-request-bits-taken-for-a-download",
       "An upload request with reserved bits set is answered like a download",
       {"SDO-UPL-13"},
       respond([](const SdoExchange& e) { return upload_initiated(e) && reserved_bits_used(e); }, 0x60, 0)},
      {"constant-counts-reads",
       "The constant 2001h:04 is another one at each upload",
       {"SDO-UPL-15", "OD-ACC-06", "EDS-VSD-06"},
       counting_constant(0x2001, 4)},
  };
}

DefectTable download_rows() {
  return {
      {"expedited-unsized-aborted-but-stored",
       "An expedited download without size is aborted after it was stored",
       {"SDO-DNL-05", "SDO-DNL-06", "SDO-DNL-20"},
       respond(unsized_expedited_download, 0x80, 0x06070010)},
      {"expedited-unsized-takes-the-length-of-the-entry",
       "An expedited download without size is taken for one of the entry's length, and four of five to eight bytes change",
       {"SDO-DNL-19"},
       takes_the_length_of([](const Entry& entry) { return fixed_size(entry.type) > 4; })},
      {"expedited-unsized-text-keeps-its-length",
       "An expedited download without size changes the first four characters of a text, and the others stay",
       {"SDO-DNL-05"},
       takes_the_length_of(
           [](const Entry& entry) { return fixed_size(entry.type) == 0 && entry.type != DataType::domain; })},
      {"expedited-unsized-download-to-a-domain-forgotten",
       "An expedited download without size to a DOMAIN is confirmed and forgotten",
       {"SDO-DNL-05"},
       forgets_unsized_domains()},
      {"8-bit-download-not-stored",
       "Downloads of one byte to manufacturer-specific entries are confirmed and forgotten",
       {"SDO-DNL-02", "OD-ACC-04"},
       downloads_forgotten(1)},
      {"16-bit-download-not-stored",
       "Downloads of two bytes to manufacturer-specific entries are confirmed and forgotten",
       {"SDO-DNL-01", "OD-ACC-04"},
       downloads_forgotten(2)},
      {"24-bit-download-not-stored",
       "Downloads of three bytes are confirmed and forgotten",
       {"SDO-DNL-04", "OD-ACC-04"},
       downloads_forgotten(3)},
      {"32-bit-download-not-stored",
       "Downloads of four bytes to manufacturer-specific entries are confirmed and forgotten",
       {"SDO-DNL-03", "SDO-DNL-05", "OD-ACC-04"},
       downloads_forgotten(4)},
      {"32-bit-download-loses-upper-half",
       "Of four bytes written only the lower two are kept",
       {"SDO-DNL-03", "SDO-DNL-05", "OD-ACC-04"},
       scratch_entries(4, lose_upper_bytes)},
      {"24-bit-download-loses-upper-byte",
       "Of three bytes written only the lower two are kept",
       {"SDO-DNL-04", "OD-ACC-04"},
       scratch_entries(3, lose_upper_bytes)},
      {"download-request-bit-taken-for-a-segment",
       "A download request with the reserved bit set is answered like a segment",
       {"SDO-DNL-18"},
       respond([](const SdoExchange& e) { return download_initiated(e) && reserved_bits_used(e); }, 0x30, 0)},
  };
}

}  // namespace

DefectTable sdo_expedited_defects() {
  DefectTable rows = upload_rows();
  DefectTable others = download_rows();
  append(rows, std::move(others));
  return rows;
}

}  // namespace refnode
