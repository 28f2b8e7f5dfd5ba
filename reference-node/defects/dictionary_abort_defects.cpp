// SPDX-License-Identifier: Apache-2.0
// Defects of access rights, existence, lengths and ranges, wherever in the dictionary: mostly wrong abort
// codes.
#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "defects/sdo_rules.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr Range usable_indices{0x1000, 0x9FFF};

bool upload(const SdoExchange& e) { return e.step == SdoStep::upload_initiate; }
bool download(const SdoExchange& e) { return e.step == SdoStep::download_initiate; }
bool no_object(const SdoExchange& e) { return e.aborted == abort_code::no_object; }
bool no_sub_index(const SdoExchange& e) { return e.aborted == abort_code::no_sub_index; }
bool read_only(const SdoExchange& e) { return e.aborted == abort_code::read_only; }

using Data = std::array<std::uint8_t, 8>;
void put(Data& data, AbortCode code) { conform::store_le(std::span(data).subspan(4), code.value()); }

/// Downloads to an entry of fixed length are taken for another number of bytes than they have: what is
/// missing is zero, what is too much is cut off.
Change takes_length(std::size_t (*taken)(std::size_t size, std::size_t right)) {
  return [taken](Parts& parts) {
    ObjectDictionary& od = parts.device.dictionary;
    const auto length = [&od, taken](Multiplexer mux, std::size_t size) {
      const Entry* entry = od.entry(mux.index.value(), mux.sub.value());
      const std::size_t right = entry == nullptr ? 0 : fixed_size(entry->type);
      return right == 0 ? size : taken(size, right);
    };
    od.may_download.replace([length](const auto& former, Multiplexer mux, std::optional<std::size_t> size) {
      return former(mux, size ? std::optional(length(mux, *size)) : std::nullopt);
    });
    od.download.replace([length](const auto& former, Multiplexer mux, ByteView bytes) {
      Bytes value(bytes.begin(), bytes.end());
      value.resize(length(mux, bytes.size()));
      return former(mux, value);
    });
  };
}

Change writes_read_only_in_segments() {
  return [](Parts& parts) {
    ObjectDictionary& od = parts.device.dictionary;
    const auto is_read_only = [](const Accepted& done) {
      return !done && done.error() == abort_code::read_only;
    };
    SegmentedRules& rules = of_segments(parts);
    rules.granted.replace(
        [is_read_only](const auto& former, Multiplexer mux, std::optional<std::size_t> size) {
          const Accepted granted = former(mux, size);
          return is_read_only(granted) ? Accepted{} : granted;
        });
    rules.store.replace([&od, is_read_only](const auto& former, Multiplexer mux, ByteView data) -> Accepted {
      const Accepted stored = former(mux, data);
      if (!is_read_only(stored)) return stored;
      if (Entry* entry = od.entry(mux.index.value(), mux.sub.value()))
        entry->value.assign(data.begin(), data.end());
      return {};
    });
  };
}

DefectTable existence_rows() {
  return {
      {"missing-object-wrong-abort",
       "Absent objects are aborted with 0609 0011h instead of 0602 0000h",
       {"OD-GEN-04", "OD-GEN-05", "SDO-UPL-07", "SDO-DNL-15", "SDO-SDN-22"},
       wrong_abort(abort_code::no_object, abort_code::no_sub_index, usable_indices)},
      {"missing-object-silent",
       "Reading an absent object gets no answer",
       {"OD-GEN-04", "OD-GEN-12", "SDO-UPL-07"},
       silent([](const SdoExchange& e) { return upload(e) && no_object(e); })},
      {"missing-object-returns-zero",
       "Reading an absent object gives 0000 0000h",
       {"OD-GEN-04", "OD-GEN-06", "SDO-UPL-07"},
       respond([](const SdoExchange& e) { return upload(e) && no_object(e); }, 0x43, 0)},
      {"missing-object-write-accepted",
       "Writing an absent object is confirmed",
       {"OD-GEN-05", "SDO-DNL-15"},
       respond([](const SdoExchange& e) { return download(e) && no_object(e); }, 0x60, 0)},
      {"missing-object-write-wrong-abort",
       "Writing an absent object is aborted with 0607 0010h",
       {"OD-GEN-05", "SDO-DNL-15"},
       patch([](const SdoExchange& e) { return download(e) && no_object(e); },
             [](const SdoExchange&, Data& data) { put(data, abort_code::length_mismatch); })},
      {"missing-object-sub-wrong-abort",
       "A sub-index above 00h of an absent object is aborted with 0609 0030h",
       {"OD-GEN-06"},
       patch([](const SdoExchange& e) { return no_object(e) && e.sub() != 0; },
             [](const SdoExchange&, Data& data) { put(data, abort_code::invalid_value); })},
      {"idx0000-readable",
       "Index 0000h can be read",
       {"OD-GEN-01"},
       extra(0x0000, 0, integer_entry("Nothing", DataType::unsigned32, Access::ro, 0))},
      {"idx0000-no-response",
       "Reading index 0000h gets no answer",
       {"OD-GEN-01", "SDO-UPL-07"},
       silent([](const SdoExchange& e) { return upload(e) && e.index() == 0; })},
      {"reserved-area-readable",
       "There is an object at 0800h",
       {"OD-GEN-02"},
       extra(0x0800, 0, integer_entry("Reserved area", DataType::unsigned8, Access::ro, 0))},
      {"reserved-area-wrong-abort",
       "0260h-0FFFh is aborted with 0800 0000h",
       {"OD-GEN-02"},
       wrong_abort(abort_code::no_object, abort_code::general_error, {0x0260, 0x0FFF})},
      {"high-area-readable",
       "There is an object at D000h",
       {"OD-GEN-03"},
       extra(0xD000, 0, integer_entry("Reserved area", DataType::unsigned32, Access::ro, 0))},
      {"high-area-wrong-abort",
       "C000h-FFFFh is aborted with 0609 0011h",
       {"OD-GEN-03", "SDO-UPL-07"},
       wrong_abort(abort_code::no_object, abort_code::no_sub_index, {0xC000, 0xFFFF})},
      {"network-variable-area-undeclared-object",
       "There is an undeclared object at A480h",
       {"OD-GEN-16"},
       extra(0xA480, 0, integer_entry("Network variable", DataType::unsigned8, Access::ro, 0))},
      {"hidden-object",
       "There is an undeclared object at 5FFEh",
       {"OD-GEN-18"},
       extra(0x5FFE, 0, integer_entry("Hidden", DataType::unsigned32, Access::rw, 0))},
      {"manufacturer-object-missing",
       "2007h of the device description is missing",
       {"OD-GEN-14", "OD-GEN-17", "SDO-UPL-16"},
       absent(0x2007)},
      {"manufacturer-object-wrong-size",
       "2007h has two bytes instead of four",
       {"OD-GEN-14", "OD-GEN-17", "SDO-UPL-16"},
       type(0x2007, 0, DataType::unsigned16)},
      {"profile-object-missing",
       "6207h of the device description is missing",
       {"OD-GEN-15", "OD-GEN-17", "SDO-UPL-16"},
       absent(0x6207)},
      {"missing-sub-wrong-abort",
       "Absent sub-indices are aborted with 0602 0000h instead of 0609 0011h",
       {"OD-GEN-07", "OD-GEN-08", "OD-GEN-09", "SDO-UPL-08", "SDO-UPL-09", "SDO-DNL-16"},
       wrong_abort(abort_code::no_sub_index, abort_code::no_object)},
      {"missing-sub-returns-zero",
       "Reading an absent sub-index of 1018h gives 0000 0000h",
       {"OD-GEN-07", "OD-GEN-11", "SDO-UPL-09"},
       respond([](const SdoExchange& e) { return upload(e) && no_sub_index(e) && e.index() == 0x1018; }, 0x43,
               0)},
      {"missing-sub-silent",
       "Reading an absent sub-index gets no answer",
       {"OD-GEN-07", "OD-GEN-09", "SDO-UPL-08", "SDO-UPL-09"},
       silent([](const SdoExchange& e) { return upload(e) && no_sub_index(e); })},
      {"missing-sub-write-accepted",
       "Writing an absent sub-index is confirmed",
       {"OD-GEN-08", "SDO-DNL-16"},
       respond([](const SdoExchange& e) { return download(e) && no_sub_index(e); }, 0x60, 0)},
      {"missing-sub-write-wrong-abort",
       "Writing an absent sub-index is aborted with 0607 0010h",
       {"OD-GEN-08", "SDO-DNL-16"},
       patch([](const SdoExchange& e) { return download(e) && no_sub_index(e); },
             [](const SdoExchange&, Data& data) { put(data, abort_code::length_mismatch); })},
      {"var-answers-on-other-subs",
       "Variables answer on every sub-index",
       {"OD-GEN-09", "SDO-UPL-08"},
       Change([](Parts& parts) {
         ObjectDictionary& od = parts.device.dictionary;
         od.upload.replace([&od](const auto& former, Multiplexer mux) {
           const auto object = od.objects().find(mux.index.value());
           if (object != od.objects().end() && object->second.kind == ObjectKind::variable)
             mux.sub = conform::SubIndex(0);
           return former(mux);
         });
       })},
      {"array-elements-shifted",
       "Reading an element of 2004h gives the element before it",
       {"OD-DSC-03", "SDO-DNL-03", "OD-ACC-04"},
       [](ObjectDictionary& od, std::uint8_t) {
         for (std::uint8_t sub = 4; sub > 1; --sub) {
           const Entry* before = od.entry(0x2004, static_cast<std::uint8_t>(sub - 1));
           Entry* entry = od.entry(0x2004, sub);
           if (before == nullptr || entry == nullptr) continue;
           entry->read = [before]() -> Upload { return before->value; };
         }
       }},
      {"1800-event-timer-silent",
       "Reading 1800h:05 gets no answer",
       {"OD-GEN-17", "SDO-UPL-03", "OD-1800-20"},
       silent([](const SdoExchange& e) { return upload(e) && e.index() == 0x1800 && e.sub() == 5; })},
      {"optional-object-silent",
       "Reading absent SDO server parameters 1203h-127Fh gets no answer",
       {"OD-GEN-12"},
       silent(
           [](const SdoExchange& e) { return no_object(e) && e.index() >= 0x1203 && e.index() <= 0x127F; })},
  };
}

DefectTable access_rows() {
  return {
      {"ro-write-accepted",
       "Writing a read-only entry is confirmed without effect",
       {"OD-ACC-01", "OD-1000-02", "OD-1001-02", "SDO-DNL-07", "EDS-VSD-04", "OD-1200-04"},
       respond([](const SdoExchange& e) { return download(e) && read_only(e); }, 0x60, 0)},
      {"ro-write-wrong-abort",
       "Writing a read-only or const entry is aborted with 0609 0030h",
       {"OD-ACC-01", "OD-ACC-02", "OD-1000-02", "OD-1018-02", "OD-1018-04", "SDO-DNL-07", "SDO-DNL-08",
        "SDO-DNL-09"},
       wrong_abort(abort_code::read_only, abort_code::invalid_value)},
      {"ro-write-silent",
       "Writing a read-only entry gets no answer",
       {"OD-ACC-01", "SDO-DNL-07"},
       silent(read_only)},
      {"wo-read-accepted",
       "2001h:02 is write-only in the description, but can be read",
       {"OD-ACC-03", "SDO-UPL-10", "EDS-VSD-04"},
       access(0x2001, 2, Access::rw)},
      {"wo-read-wrong-abort",
       "Reading a write-only entry is aborted with 0601 0002h",
       {"OD-ACC-03", "SDO-UPL-10", "SDO-BUP-23", "OD-1024-01", "OD-1026-02"},
       wrong_abort(abort_code::write_only, abort_code::read_only)},
      {"rw-object-not-writable",
       "2007h is rw in the description, but refuses writing",
       {"SDO-DNL-21", "OD-GEN-17", "EDS-VSD-04"},
       access(0x2007, 0, Access::ro)},
      {"rejected-write-still-stored",
       "A value out of range is refused and stored all the same",
       {"OD-ACC-05", "SDO-DNL-20", "SDO-DNL-13", "SDO-DNL-14", "OD-CID-03", "CAN-RID-01"},
       Change([](Parts& parts) {
         ObjectDictionary& od = parts.device.dictionary;
         od.download.replace([&od](const auto& former, Multiplexer mux, ByteView bytes) {
           const Accepted done = former(mux, bytes);
           Entry* entry = od.entry(mux.index.value(), mux.sub.value());
           if (!done && od.may_download(mux, bytes.size()) && !entry->command)
             entry->value.assign(bytes.begin(), bytes.end());
           return done;
         });
       })},
      {"const-changes-in-operational",
       "1018h:00 reads 03h in Operational",
       {"OD-ACC-06"},
       Filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
         if (context.sdo == nullptr || context.state != NmtState::operational || !upload(*context.sdo))
           return;
         if (context.sdo->mux != mux(0x1018, 0)) return;
         for (Outgoing& outgoing : frames) outgoing.frame.data[4] = 3;
       })},
      {"ro-writable-in-operational",
       "Read-only entries confirm writing in Operational",
       {"OD-ACC-07"},
       Filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
         if (context.sdo == nullptr || context.state != NmtState::operational || !read_only(*context.sdo))
           return;
         for (Outgoing& outgoing : frames) {
           outgoing.frame.data[0] = 0x60;
           put(outgoing.frame.data, AbortCode(0));
         }
       })},
      {"ro-writable-by-segmented-download",
       "Segmented downloads do not look at the access right",
       {"OD-ACC-08", "SDO-SDN-21", "OD-ACC-01", "OD-1008-02", "OD-1009-02"},
       writes_read_only_in_segments()},
  };
}

DefectTable length_and_range_rows() {
  return {
      {"short-write-accepted",
       "A value with too few bytes is padded with zeros",
       {"OD-LEN-01", "OD-1017-09", "SDO-DNL-11", "SDO-DNL-12", "SDO-SDN-07", "SDO-DNL-19"},
       takes_length([](std::size_t size, std::size_t right) { return std::max(size, right); })},
      {"long-write-accepted",
       "Surplus bytes of a value are cut off",
       {"OD-LEN-02", "OD-LEN-03", "OD-1017-09", "SDO-DNL-10", "SDO-DNL-12", "SDO-SDN-06"},
       takes_length([](std::size_t size, std::size_t right) { return std::min(size, right); })},
      {"high-low-length-codes-swapped",
       "A value too short is aborted as too long",
       {"SDO-DNL-12", "SDO-DNL-11", "OD-LEN-01", "OD-1017-09"},
       wrong_abort(abort_code::length_too_low, abort_code::length_too_high)},
      {"wrong-abort-length",
       "Length errors are aborted with the undefined code 0606 0012h",
       {"SDO-DNL-10", "OD-LEN-02", "SDO-ERR-05"},
       wrong_abort(abort_code::length_too_high, AbortCode(0x06060012))},
      {"short-write-wrong-abort",
       "A value too short is aborted with 0609 0030h",
       {"OD-LEN-01", "SDO-DNL-11", "OD-1017-09"},
       wrong_abort(abort_code::length_too_low, abort_code::invalid_value)},
      {"high-limit-not-checked",
       "Upper limits are not checked",
       {"OD-RNG-01", "SDO-DNL-13", "SDO-SDN-23", "OD-1201-07", "OD-1280-06"},
       everywhere([](Entry& entry) { entry.high.reset(); })},
      {"low-limit-not-checked",
       "Lower limits are not checked",
       {"OD-RNG-02", "SDO-DNL-14", "OD-1201-07", "OD-1280-06"},
       everywhere([](Entry& entry) { entry.low.reset(); })},
      {"high-limit-clamped",
       "A value above the limit is confirmed and limited",
       {"OD-RNG-01", "SDO-DNL-13", "SDO-SDN-23"},
       Change([](Parts& parts) {
         ObjectDictionary& od = parts.device.dictionary;
         od.download.replace([&od](const auto& former, Multiplexer mux, ByteView bytes) -> Accepted {
           const Accepted done = former(mux, bytes);
           const Entry* entry = od.entry(mux.index.value(), mux.sub.value());
           if (done || done.error() != od.choices.value_above_limit || !entry->high) return done;
           return former(mux, conform::to_le(static_cast<std::uint64_t>(*entry->high), bytes.size()));
         });
       })},
      {"high-limit-wrong-abort",
       "A value above the limit is aborted with 0607 0012h",
       {"OD-RNG-01", "SDO-DNL-13", "SDO-SDN-23", "OD-1201-07", "OD-1280-06"},
       wrong_abort(abort_code::value_too_high, abort_code::length_too_high)},
      {"low-limit-wrong-abort",
       "A value below the limit is aborted with 0607 0013h",
       {"OD-RNG-02", "SDO-DNL-14", "OD-1201-07", "OD-1280-06"},
       wrong_abort(abort_code::value_too_low, abort_code::length_too_low)},
      {"limit-value-rejected",
       "The upper limit itself is refused",
       {"OD-RNG-03"},
       everywhere([](Entry& entry) {
         if (entry.high && entry.type != DataType::boolean) --*entry.high;
       })},
  };
}

}  // namespace

DefectTable dictionary_abort_defects() {
  DefectTable rows = existence_rows();
  for (DefectTable part : {access_rows(), length_and_range_rows()}) {
    append(rows, std::move(part));
  }
  return rows;
}

}  // namespace refnode
