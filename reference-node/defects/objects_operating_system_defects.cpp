// SPDX-License-Identifier: Apache-2.0
// Defects of the operating system objects (1023h to 1026h) and of the module list (1027h).
#include <memory>

#include "defects/hooks.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr DataType u8 = DataType::unsigned8;
constexpr DataType u32 = DataType::unsigned32;

/// The entry always reads as these bytes.
DictionaryEdit reads_as(std::uint16_t index, std::uint8_t sub, Bytes value) {
  return [index, sub, value = std::move(value)](ObjectDictionary& od, std::uint8_t) {
    if (Entry* entry = od.entry(index, sub)) entry->read = [value]() -> Upload { return value; };
  };
}

/// Every reply is another one.
DictionaryEdit changing_reply() {
  return [](ObjectDictionary& od, std::uint8_t) {
    if (Entry* entry = od.entry(0x1023, 3)) {
      entry->read = [reply = std::uint8_t{0}]() mutable -> Upload { return Bytes{'0', ++reply}; };
    }
  };
}

/// Status or reply that can be written, and forgets it.
DictionaryEdit writable(std::uint16_t index, std::uint8_t sub) {
  return [index, sub](ObjectDictionary& od, std::uint8_t) {
    if (Entry* entry = od.entry(index, sub)) {
      entry->access = Access::rw;
      entry->command = true;
      entry->max_size = 64;
    }
  };
}

/// A mode that is confirmed and forgotten, where `which` holds.
Change mode_without_effect(bool (*which)(std::uint8_t mode)) {
  return checking(0x1024, 0, [which](Parts&, const Check& former, ByteView bytes) -> Accepted {
    return which(bytes[0]) ? Accepted{} : former(bytes);
  });
}

/// The status of the debugger once a command was given.
Change debugger_status_after_command(std::uint8_t status) {
  return [status](Parts& parts) {
    const auto given = std::make_shared<bool>(false);
    checking(0x1025, 1, [given](Parts&, const Check& former, ByteView bytes) {
      *given = true;
      return former(bytes);
    })(parts);
    reading(0x1025, 2, [given, status](Parts&, const Read& former) -> Upload {
      if (*given) return Bytes{status};
      return former();
    })(parts);
  };
}

/// Where a command left no reply, that of an earlier one is still there.
Change keeps_former_reply() {
  return [](Parts& parts) {
    const auto reply = since_boot_up<Bytes>(parts);
    reading(0x1023, 3, [reply](Parts&, const Read& former) -> Upload {
      const Upload now = former();
      if (now) *reply = *now;
      return now || reply->empty() ? now : Upload(*reply);
    })(parts);
  };
}

/// A reply that came to `other` is delivered by `index`.
Change shares_reply(std::uint16_t index, std::uint16_t other) {
  return [index, other](Parts& parts) {
    const auto later = since_boot_up<bool>(parts);
    for (const std::uint16_t each : {index, other}) {
      checking(each, 1, [later, given = each == other](Parts&, const Check& former, ByteView bytes) {
        const Accepted taken = former(bytes);
        if (taken) *later = given;
        return taken;
      })(parts);
    }
    reading(index, 3, [later, other](Parts& node, const Read& former) -> Upload {
      const Entry* entry = *later ? node.device.dictionary.entry(other, 3) : nullptr;
      return entry != nullptr && entry->read ? entry->read() : former();
    })(parts);
  };
}

}  // namespace

DefectTable objects_operating_system_defects() {
  return {
      {"1023-sub0-wrong", "1023h:00 is 02h", {"OD-1023-01", "OD-GEN-11"}, preset(0x1023, 0, 2)},
      {"1023-sub0-writable",
       "1023h:00 can be written",
       {"OD-1023-01", "OD-ACC-02", "SDO-DNL-09"},
       access(0x1023, 0, Access::rw)},
      {"1023-sub-missing",
       "1023h:03 does not exist",
       {"OD-1023-01", "OD-CAT-02", "OD-GEN-11", "OD-GEN-17"},
       [](ObjectDictionary& od, std::uint8_t) { od.objects()[0x1023].entries.erase(3); }},
      {"1023-status-reserved-value",
       "The status of 1023h is 04h",
       {"OD-1023-02", "OD-1023-05"},
       reads_as(0x1023, 2, {0x04})},
      {"1023-status-tells-of-reply",
       "The status of 1023h is 01h though there is no reply",
       {"OD-1023-05"},
       reads_as(0x1023, 2, {0x01})},
      {"1023-status-is-u32",
       "1023h:02 has four bytes",
       {"OD-1023-02", "OD-LEN-04", "OD-GEN-17"},
       type(0x1023, 2, u32)},
      {"1023-status-writable", "1023h:02 can be written", {"OD-1023-03", "OD-ACC-01"}, writable(0x1023, 2)},
      {"1023-reply-writable", "1023h:03 can be written", {"OD-1023-03", "OD-ACC-01"}, writable(0x1023, 3)},
      {"1023-command-wrong-abort",
       "Reading 1023h:01 is aborted with 0606 0000h",
       {"OD-1023-04", "OD-GEN-17", "OD-CAT-02", "OD-1023-01"},
       [](ObjectDictionary& od, std::uint8_t) {
         if (Entry* entry = od.entry(0x1023, 1))
           entry->read = []() -> Upload { return refuse(abort_code::hardware_error); };
       }},
      {"1023-command-never-ends",
       "The status of 1023h stays FFh",
       {"OD-1023-05"},
       reads_as(0x1023, 2, {0xFF})},
      {"1023-reply-changes",
       "The reply of 1023h differs with every upload",
       {"OD-1023-05"},
       changing_reply()},
      {"1023-former-reply-kept",
       "Where the status tells of no reply 1023h:03 delivers that of an earlier command",
       {"OD-1023-05"},
       keeps_former_reply()},
      {"1023-reply-of-debugger",
       "A command of the debugger (1025h) leaves its reply in 1023h:03",
       {"OD-1023-05"},
       shares_reply(0x1023, 0x1025)},
      {"1024-readable", "1024h can be read", {"OD-1024-01", "OD-ACC-03"}, access(0x1024, 0, Access::rw)},
      {"1024-is-u16", "1024h has two bytes", {"OD-1024-02"}, type(0x1024, 0, DataType::unsigned16)},
      {"1024-mode-without-effect",
       "A command is executed at once, whatever the mode",
       {"OD-1024-02"},
       mode_without_effect([](std::uint8_t) { return true; })},
      {"1024-abort-keeps-commands",
       "Mode 03h drops no command that is kept",
       {"OD-1024-02"},
       mode_without_effect([](std::uint8_t mode) { return mode == 0x03; })},
      {"1025-sub0-wrong", "1025h:00 is 02h", {"OD-1025-01", "OD-GEN-11"}, preset(0x1025, 0, 2)},
      {"1025-sub0-writable",
       "1025h:00 can be written",
       {"OD-1025-01", "OD-ACC-02", "SDO-DNL-09"},
       access(0x1025, 0, Access::rw)},
      {"1025-status-reserved-value",
       "The status of 1025h is 02h",
       {"OD-1025-02"},
       reads_as(0x1025, 2, {0x02})},
      {"1025-status-reserved-after-command",
       "After a command the status of 1025h is 02h",
       {"OD-1025-02"},
       debugger_status_after_command(0x02)},
      {"1025-status-is-u32", "1025h:02 has four bytes", {"OD-1025-02", "OD-LEN-04"}, type(0x1025, 2, u32)},
      {"1025-status-writable", "1025h:02 can be written", {"OD-1025-03", "OD-ACC-01"}, writable(0x1025, 2)},
      {"1025-reply-writable", "1025h:03 can be written", {"OD-1025-03", "OD-ACC-01"}, writable(0x1025, 3)},
      {"1025-command-wrong-abort",
       "Reading 1025h:01 is aborted with 0606 0000h",
       {"OD-1025-04", "OD-GEN-17", "OD-CAT-02", "OD-1025-01"},
       [](ObjectDictionary& od, std::uint8_t) {
         if (Entry* entry = od.entry(0x1025, 1))
           entry->read = []() -> Upload { return refuse(abort_code::hardware_error); };
       }},
      {"1026-sub0-out-of-range", "1026h:00 is 04h", {"OD-1026-01", "OD-GEN-11"}, preset(0x1026, 0, 4)},
      {"1026-sub0-writable",
       "1026h:00 can be written",
       {"OD-1026-01", "OD-ACC-02", "SDO-DNL-09"},
       access(0x1026, 0, Access::rw)},
      {"1026-stdin-readable",
       "1026h:01 can be read",
       {"OD-1026-02", "OD-ACC-03"},
       access(0x1026, 1, Access::rw)},
      {"1026-stdin-is-u16", "1026h:01 has two bytes", {"OD-1026-02"}, type(0x1026, 1, DataType::unsigned16)},
      {"1026-stdout-is-u32",
       "1026h:02 has four bytes",
       {"OD-1026-03", "OD-LEN-04", "OD-GEN-19"},
       both(reads_as(0x1026, 2, {0, 0, 0, 0}), type(0x1026, 2, u32))},
      {"1026-stdout-writable", "1026h:02 can be written", {"OD-1026-03"}, writable(0x1026, 2)},
      {"1027-entry-wrong-size",
       "1027h:02 has one byte",
       {"OD-1027-01", "OD-GEN-19", "OD-LEN-04"},
       type(0x1027, 2, u8)},
      {"1027-sub0-is-u32", "1027h:00 has four bytes", {"OD-1027-01", "OD-GEN-10"}, type(0x1027, 0, u32)},
      {"1027-empty-read-returns-data",
       "1027h:01 delivers a module although there is none",
       {"OD-1027-01"},
       preset(0x1027, 0, 0)},
      {"1027-writable",
       "1027h can be written",
       {"OD-1027-02", "OD-ACC-01"},
       both(access(0x1027, 0, Access::rw), access(0x1027, 1, Access::rw))},
  };
}

}  // namespace refnode
