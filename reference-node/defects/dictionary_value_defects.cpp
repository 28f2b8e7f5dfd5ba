// SPDX-License-Identifier: Apache-2.0
// Defects of what is written and read where they show with some values, sub-indices or kinds of transfer
// only: the end of a string, a sub-index of an object that is absent, a const entry.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "defects/sdo_block_exchanges.hpp"
#include "defects/sdo_rules.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

bool absent_above_00(const SdoExchange& e) { return e.aborted == abort_code::no_object && e.sub() != 0; }

void say_no_sub_index(const SdoExchange&, defect::Data& data) { store_code(data, abort_code::no_sub_index); }

/// In place of "no such object" where the sub-index is not 00h.
Accepted looked_up_by_sub_index(const Accepted& granted, Multiplexer mux) {
  const bool other = !granted && granted.error() == abort_code::no_object && mux.sub.value() != 0;
  return other ? refuse(abort_code::no_sub_index) : granted;
}
void looks_up_sub_index_first(Parts& parts) {
  ObjectDictionary& od = parts.device.dictionary;
  od.may_download.replace([](const auto& former, Multiplexer mux, std::optional<std::size_t> size) {
    return looked_up_by_sub_index(former(mux, size), mux);
  });
  od.download.replace([](const auto& former, Multiplexer mux, ByteView bytes) {
    return looked_up_by_sub_index(former(mux, bytes), mux);
  });
}

/// Block downloads do not ask whether an entry is const.
void const_taken_by_block(Parts& parts) {
  const auto is_const = [&od = parts.device.dictionary](Multiplexer mux) {
    const Entry* entry = od.entry(mux.index.value(), mux.sub.value());
    return entry != nullptr && entry->access == Access::constant;
  };
  auto& rules = of_block_download(parts);
  rules.may_begin.replace([is_const](const auto& former, Multiplexer mux, std::optional<std::size_t> size) {
    return is_const(mux) ? Accepted{} : former(mux, size);
  });
  rules.store.replace([is_const](const auto& former, Multiplexer mux, ByteView value) {
    return is_const(mux) ? Accepted{} : former(mux, value);
  });
}

/// Of a text that a block download replaces by a shorter one the end stays.
void tail_left_by_block(Parts& parts) {
  of_block_download(parts).store.replace(
      [&od = parts.device.dictionary](const auto& former, Multiplexer mux, ByteView value) {
        Entry* entry = od.entry(mux.index.value(), mux.sub.value());
        if (entry == nullptr || entry->type != DataType::visible_string) return former(mux, value);
        const Bytes before = entry->value;
        const Accepted done = former(mux, value);
        if (done && before.size() > value.size()) {
          const auto tail = before.begin() + static_cast<std::ptrdiff_t>(value.size());
          entry->value.insert(entry->value.end(), tail, before.end());
        }
        return done;
      });
}

/// The application gives one byte of its values of 32 bits; the others are those of the expedited upload
/// before.
void fills_one_byte(Parts& parts) {
  constexpr std::uint16_t first_of_application = 0x2000;
  parts.device.outbox.add_filter([&parts, buffer = std::array<std::uint8_t, 4>{}](
                                     const FilterContext& context, std::vector<Outgoing>& frames) mutable {
    if (context.sdo == nullptr || !upload_initiated(*context.sdo)) return;
    const Multiplexer mux = context.sdo->mux;
    const Entry* entry = parts.device.dictionary.entry(mux.index.value(), mux.sub.value());
    for (Outgoing& outgoing : frames) {
      defect::Data& data = outgoing.frame.data;
      if (!is_expedited_upload(data) || entry == nullptr) continue;
      const bool filled = fixed_size(entry->type) != 4 || entry->access != Access::ro ||
                          mux.index.value() < first_of_application;
      std::copy_n(data.begin() + 4, filled ? expedited_size(data) : 1, buffer.begin());
      if (!filled) std::ranges::copy(buffer, data.begin() + 4);
    }
  });
}

/// `change` makes something else of what has been written to the rw entries of a type.
Change changes_written(DataType type, std::function<void(Entry&)> change) {
  return [type, change = std::move(change)](Parts& parts) {
    for (auto& [index, object] : parts.device.dictionary.objects()) {
      for (auto& [sub, each] : object.entries) {
        if (each.type != type || each.access != Access::rw || each.command) continue;
        each.written = [&entry = each, change, former = each.written] {
          change(entry);
          if (former) former();
        };
      }
    }
  };
}

}  // namespace

DefectTable dictionary_value_defects() {
  return {
      {"missing-object-sub-written-wrong-abort",
       "Writing a sub-index above 00h of an absent object is aborted with 0609 0011h",
       {"OD-GEN-06"},
       Change(looks_up_sub_index_first)},
      {"missing-object-sub-by-segments-wrong-abort",
       "A segmented download to a sub-index above 00h of an absent object is aborted with 0609 0011h",
       {"SDO-SDN-22"},
       patch(
           [](const SdoExchange& e) {
             return e.step == SdoStep::download_initiate && !is_expedited(e) && absent_above_00(e);
           },
           say_no_sub_index)},
      {"missing-object-sub-by-block-download-wrong-abort",
       "A block download to a sub-index above 00h of an absent object is aborted with 0609 0011h",
       {"SDO-BDN-23"},
       patch(
           [](const SdoExchange& e) {
             return e.step == SdoStep::block_download_initiate && absent_above_00(e);
           },
           say_no_sub_index)},
      {"missing-object-sub-by-block-upload-wrong-abort",
       "A block upload of a sub-index above 00h of an absent object is aborted with 0609 0011h",
       {"SDO-BUP-23"},
       patch(
           [](const SdoExchange& e) {
             return e.step == SdoStep::block_upload_initiate && absent_above_00(e);
           },
           say_no_sub_index)},
      {"const-write-by-block-accepted",
       "A block download to a const entry is confirmed without effect",
       {"SDO-BDN-23"},
       Change(const_taken_by_block)},
      {"shorter-text-by-block-keeps-the-old-tail",
       "Of a text that a block download replaces by a shorter one the end stays",
       {"SDO-BDN-17"},
       Change(tail_left_by_block)},
      {"longest-text-loses-its-last-character",
       "A text of the greatest length that the entry takes ends with 00h in place of its last character",
       {"OD-ACC-04"},
       changes_written(DataType::visible_string,
                       [](Entry& entry) {
                         if (!entry.value.empty() && entry.value.size() == entry.max_size)
                           entry.value.back() = 0;
                       })},
      {"application-read-fills-one-byte",
       "Of read-only entries of 32 bits of the application three bytes are those of the upload before",
       {"SDO-UPL-06"},
       Change(fills_one_byte)},
      {"octet-string-loses-zeros-at-its-end",
       "Bytes 00h at the end of an OCTET_STRING are dropped",
       {"OD-ACC-04"},
       changes_written(DataType::octet_string,
                       [](Entry& entry) {
                         while (!entry.value.empty() && entry.value.back() == 0) entry.value.pop_back();
                       })},
  };
}

}  // namespace refnode
