// SPDX-License-Identifier: Apache-2.0
// Defects of the high resolution time stamp (1013h), the SYNC counter (1019h), the configuration stamp
// (1020h) and the stored device description (1021h, 1022h).
#include <iterator>

#include "defects/hooks.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr DataType u8 = DataType::unsigned8;
constexpr DataType u16 = DataType::unsigned16;

/// Each of two entries delivers what the other one holds.
DictionaryEdit swapped(std::uint16_t index, std::uint8_t one, std::uint8_t other) {
  return [=](ObjectDictionary& od, std::uint8_t) {
    Entry* first = od.entry(index, one);
    Entry* second = od.entry(index, other);
    if (first == nullptr || second == nullptr) return;
    first->read = [second]() -> Upload { return second->value; };
    second->read = [first]() -> Upload { return first->value; };
  };
}

ClockRules& of_clock(Parts& parts) { return parts.clock.rules; }
StampRules& of_stamp(Parts& parts) { return parts.store.stamp.rules; }

/// 1013h starts there after a reset; a time that is written is kept.
Change clock_starts_at(std::uint32_t start) {
  return together(reading(0x1013, 0,
                          [start](Parts&, const Read& former) -> Upload {
                            const Upload ticks = former();
                            if (!ticks) return ticks;
                            return conform::to_le(conform::load_le(*ticks) + start, ticks->size());
                          }),
                  checking(0x1013, 0, [start](Parts&, const Check& former, ByteView bytes) {
                    return former(conform::to_le(conform::load_le(bytes) - start, bytes.size()));
                  }));
}

/// What was stored of a group goes when its defaults are restored.
bool is_restored(const Images& former, const Images& images) { return images.size() < former.size(); }

/// "load" makes date and time of the configuration what 1020h begins with after a reset.
Change stamp_becomes_default() {
  return checking_all(0x1011, [](Parts& parts, const Check& former, std::uint8_t, ByteView bytes) {
    const Accepted restored = former(bytes);
    for (const std::uint8_t sub : {std::uint8_t{1}, std::uint8_t{2}}) {
      Entry* entry = parts.device.dictionary.entry(0x1020, sub);
      if (restored && entry != nullptr) entry->default_value = entry->value;
    }
    return restored;
  });
}

DefectTable clock_rows() {
  return {
      {"1013-is-u16", "1013h has two bytes", {"OD-1013-01", "OD-LEN-04", "OD-GEN-17"}, type(0x1013, 0, u16)},
      {"1013-not-writable",
       "1013h is read-only although it is declared as writable",
       {"OD-1013-03", "OD-1013-02", "SDO-DNL-21"},
       access(0x1013, 0, Access::ro)},
      {"1013-write-ignored",
       "A time written to 1013h is confirmed and forgotten",
       {"OD-1013-03"},
       confirms(0x1013, 0, [](std::uint64_t) { return true; })},
      {"1013-default-nonzero",
       "1013h does not begin with 0 after a reset",
       {"OD-1013-04"},
       clock_starts_at(0x12345678)},
      {"1013-unit-ms",
       "1013h counts milliseconds",
       {"OD-1013-05"},
       decides(of_clock, &ClockRules::ticks,
               [](const auto& former, Duration elapsed) { return former(elapsed) / 1000; })},
  };
}

DefectTable counter_rows() {
  return {
      {"1019-absent",
       "1019h does not exist although the SYNC counter is supported",
       {"OD-1019-01", "OD-GEN-17"},
       absent(0x1019)},
      {"1019-is-u16", "1019h has two bytes", {"OD-1019-01", "OD-LEN-04", "OD-GEN-17"}, type(0x1019, 0, u16)},
      {"1019-default-wrong", "The default of 1019h is 10", {"OD-1019-02"}, preset(0x1019, 0, 10)},
      {"1019-not-writable",
       "1019h is read-only",
       {"OD-1019-03", "SDO-DNL-21"},
       access(0x1019, 0, Access::ro)},
      {"1019-change-refused",
       "1019h cannot be changed while 1006h is 0",
       {"OD-1019-03", "SYNC-CTR-02"},
       checking(0x1019, 0,
                [](Parts& parts, const Check& former, ByteView bytes) {
                  const Accepted allowed = former(bytes);
                  const bool changed = conform::load_le(bytes) != parts.device.dictionary.number(0x1019, 0);
                  return allowed && changed ? refuse(abort_code::device_state) : allowed;
                })},
      {"1019-not-stored",
       "Writing 1019h is confirmed and forgotten",
       {"OD-1019-03", "SYNC-CTR-02"},
       not_stored(0x1019, 0)},
      {"1019-reserved-value-accepted",
       "1019h takes reserved values",
       {"OD-1019-04", "SYNC-CTR-01"},
       checking(0x1019, 0,
                [](Parts&, const Check& former, ByteView bytes) {
                  const Accepted allowed = former(bytes);
                  return allowed || allowed.error() == abort_code::device_state ? allowed : Accepted{};
                })},
      {"1019-change-while-running-accepted",
       "1019h can be changed while 1006h is not 0",
       {"OD-1019-05", "SYNC-CTR-03"},
       confirms(0x1019, 0, [](std::uint64_t value) { return value == 0 || (value >= 2 && value <= 240); })},
      {"1019-change-while-running-wrong-abort",
       "A change of 1019h while 1006h is not 0 is refused with 0601 0000h",
       {"OD-1019-05", "SYNC-CTR-03"},
       wrong_abort_at(mux(0x1019, 0), abort_code::device_state, abort_code::unsupported_access)},
  };
}

DefectTable stamp_rows() {
  return {
      {"1020-sub0-wrong", "1020h:00 is 03h", {"OD-1020-01", "OD-GEN-11"}, preset(0x1020, 0, 3)},
      {"1020-sub0-writable",
       "1020h:00 can be written",
       {"OD-1020-02", "OD-ACC-02", "SDO-DNL-09"},
       access(0x1020, 0, Access::rw)},
      {"1020-not-writable",
       "1020h:01 is read-only",
       {"OD-1020-03", "STO-1020-01", "SDO-DNL-21"},
       access(0x1020, 1, Access::ro)},
      {"1020-is-u16",
       "1020h:02 has two bytes",
       {"OD-1020-03", "OD-GEN-19", "OD-LEN-04", "OD-GEN-17"},
       type(0x1020, 2, u16)},
      {"1020-subs-swapped",
       "Date and time of 1020h are exchanged when they are read",
       {"OD-1020-03", "OD-1020-04"},
       swapped(0x1020, 1, 2)},
      {"1020-not-stored",
       "1020h is not stored with the parameters",
       {"OD-1020-04", "STO-1020-02"},
       [](ObjectDictionary& od, std::uint8_t) {
         for (const std::uint8_t sub : {std::uint8_t{1}, std::uint8_t{2}}) {
           if (Entry* entry = od.entry(0x1020, sub)) entry->storable = false;
         }
       }},
      {"1020-stamp-survives-change",
       "1020h stays although another configuration is stored",
       {"OD-1020-05", "STO-1020-03"},
       decides(of_stamp, &StampRules::same_configuration,
               [](const auto& former, const Images& before, const Images& after) {
                 return !is_restored(before, after) || former(before, after);
               })},
      {"1020-survives-restore",
       "Restoring the defaults leaves 1020h",
       {"STO-1020-04"},
       together(decides(of_stamp, &StampRules::same_configuration,
                        [](const auto& former, const Images& before, const Images& after) {
                          return is_restored(before, after) || former(before, after);
                        }),
                stamp_becomes_default())},
  };
}

DefectTable description_rows() {
  return {
      {"1021-size-mismatch",
       "The upload of 1021h announces one byte more than it delivers",
       {"OD-1021-01", "SDO-SUP-02"},
       patch([](const SdoExchange& e) { return e.index() == 0x1021 && e.step == SdoStep::upload_initiate; },
             [](const SdoExchange&, std::array<std::uint8_t, 8>& data) { ++data[4]; })},
      {"1021-writable",
       "1021h can be written",
       {"OD-1021-02"},
       [](ObjectDictionary& od, std::uint8_t) {
         if (Entry* entry = od.entry(0x1021, 0)) {
           entry->access = Access::rw;
           entry->max_size = 1000;
         }
       }},
      {"1022-absent",
       "1022h does not exist although 1021h does",
       {"OD-1022-01", "OD-CAT-03", "OD-GEN-17"},
       absent(0x1022)},
      {"1022-value-above-ff",
       "1022h is 0100h",
       {"OD-1022-01", "OD-1022-02", "OD-DSC-04"},
       preset(0x1022, 0, 0x100)},
      {"1022-is-u8", "1022h has one byte", {"OD-1022-01", "OD-LEN-04", "OD-GEN-17"}, type(0x1022, 0, u8)},
      {"1022-reserved-value", "1022h is 01h", {"OD-1022-02"}, preset(0x1022, 0, 1)},
      {"1022-writable", "1022h can be written", {"OD-1022-03", "OD-ACC-01"}, access(0x1022, 0, Access::rw)},
  };
}

}  // namespace

DefectTable optional_object_defects() {
  DefectTable rows;
  for (DefectTable table : {clock_rows(), counter_rows(), stamp_rows(), description_rows()}) {
    rows.insert(rows.end(), std::make_move_iterator(table.begin()), std::make_move_iterator(table.end()));
  }
  return rows;
}

}  // namespace refnode
