// SPDX-License-Identifier: Apache-2.0
// Objects that a device need not have: identity, names, descriptions, operating system, modules.
#include <algorithm>
#include <cctype>
#include <chrono>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "variants/tools.hpp"

namespace refnode {

using namespace variant;

namespace {

/// Device types of logical devices of the same profile, and FFFFh in the upper half of 1000h (CiA
/// 301, 7.5.2.1).
How logical_devices(std::initializer_list<std::uint16_t> described) {
  return [all = std::vector<std::uint16_t>(described)](Parts& parts) {
    preset(0x1000, 0, 0xFFFF0191)(parts);
    for (const std::uint16_t index : all) {
      parts.device.dictionary.remove(index);  // a twin may have one
      parts.device.dictionary.add_variable(
          index, integer_entry("Device type", DataType::unsigned32, Access::ro, 0x00030191));
    }
  };
}

/// Nothing is plugged in: sub-index 01h is there and holds nothing.
void no_modules(Parts& parts) {
  preset(0x1027, 0, 0)(parts);
  parts.device.dictionary.remove_sub(0x1027, 2);
  if (Entry* entry = parts.device.dictionary.entry(0x1027, 1))
    entry->read = []() -> Upload { return refuse(abort_code::no_data); };
}

void empty_description(Parts& parts) {
  if (Entry* entry = parts.device.dictionary.entry(0x1021, 0))
    entry->read = []() -> Upload { return refuse(abort_code::no_data); };
}

/// [1000], [1018sub1] ...: what a description says of one object or entry.
bool is_object(std::string_view section) {
  constexpr std::size_t digits = 4;
  return section.size() > digits && std::ranges::all_of(section.substr(1, digits), [](unsigned char letter) {
           return std::isxdigit(letter) != 0;
         });
}

bool is_mandatory(std::string_view section) {
  constexpr std::string_view indices[] = {"[1000", "[1001", "[1018"};
  return std::ranges::any_of(indices, [&](auto index) { return section.starts_with(index); });
}

/// A description of the mandatory objects, without the lists of others.
void short_description(Parts& parts) {
  Entry* entry = parts.device.dictionary.entry(0x1021, 0);
  if (entry == nullptr) return;
  entry->read = [whole = entry->read]() -> Upload {
    const Upload text = whole();
    if (!text) return text;
    const std::string_view all(reinterpret_cast<const char*>(text->data()), text->size());
    Bytes out;
    for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
      const auto next = all.find("\n[", begin);
      end = next == std::string_view::npos ? all.size() : next + 1;
      const auto section = all.substr(begin, end - begin);
      const bool of_others = section.starts_with("[OptionalObjects") ||
                             section.starts_with("[ManufacturerObjects") ||
                             (is_object(section) && !is_mandatory(section));
      if (!of_others) out.insert(out.end(), section.begin(), section.end());
    }
    return out;
  };
}

/// The prompt reads as 00h when there is nothing to read.
void silent_prompt(Parts& parts) {
  for (const std::uint8_t sub : {std::uint8_t{2}, std::uint8_t{3}}) {
    Entry* entry = parts.device.dictionary.entry(0x1026, sub);
    if (entry == nullptr) continue;
    entry->read = [read = entry->read]() -> Upload {
      Upload value = read();
      return value ? value : Upload(Bytes{0});
    };
  }
}

/// Inputs that never rest.
void noisy_inputs(Parts& parts) {
  for (const std::uint8_t sub : {std::uint8_t{1}, std::uint8_t{2}}) {
    Entry* input = parts.device.dictionary.entry(0x6401, sub);
    if (input == nullptr) continue;
    read_by(*input, [looks = 0U]() mutable -> Upload { return conform::to_le(0x0100U + ++looks % 4, 2); });
  }
}

/// CiA 401: what the outputs do outside of Operational is theirs; here they are switched off, and the inputs
/// show it.
void outputs_fall(Parts& parts) {
  static constexpr std::uint16_t channels[] = {0x6000, 0x6200, 0x6401, 0x6411, 0x6402, 0x6412};
  const auto switch_off = [&objects = parts.device.dictionary.objects()] {
    for (const std::uint16_t index : channels) {
      const auto found = objects.find(index);
      if (found == objects.end()) continue;
      for (auto& [sub, entry] : found->second.entries) {
        if (entry.rx_mappable || entry.tx_mappable) std::ranges::fill(entry.value, std::uint8_t{0});
      }
    }
  };
  parts.nmt.on_change = [switch_off, former = parts.nmt.on_change](NmtState from) {
    if (from == NmtState::operational) switch_off();
    former(from);
  };
}

/// Outputs belong to RPDOs and to Operational: elsewhere a write is refused with 0800 0022h.
void outputs_in_operational_only(Parts& parts) {
  const auto locked = [&device = parts.device](Multiplexer mux) {
    const unsigned index = mux.index.value();
    return device.state != NmtState::operational && (index == 0x6200 || index == 0x6411 || index == 0x6412);
  };
  ObjectDictionary& dictionary = parts.device.dictionary;
  const auto refused = [&dictionary, locked](Multiplexer mux) {
    const Entry* entry = dictionary.entry(mux.index.value(), mux.sub.value());
    return entry != nullptr && (entry->access == Access::rw || entry->access == Access::wo) && locked(mux);
  };
  dictionary.may_download.replace(
      [refused](const auto& former, Multiplexer mux, std::optional<std::size_t> size) -> Accepted {
        Accepted granted = former(mux, size);
        if (granted && refused(mux)) return refuse(abort_code::device_state);
        return granted;
      });
  dictionary.download.replace([refused](const auto& former, Multiplexer mux, ByteView bytes) -> Accepted {
    if (refused(mux)) return refuse(abort_code::device_state);
    return former(mux, bytes);
  });
}

/// Another condition for the values of an entry.
void check(Entry* entry, std::function<Accepted(ByteView)> condition) {
  if (entry != nullptr) entry->check = std::move(condition);
}

void known_error_modes(Parts& parts) {
  for (std::uint8_t sub = 1; sub <= 8; ++sub) {
    check(parts.device.dictionary.entry(0x6206, sub), [](ByteView bytes) -> Accepted {
      if (bytes[0] > 1 && bytes[0] != 0xFF) return refuse(abort_code::invalid_value);
      return {};
    });
  }
}

void even_numbers(Parts& parts) {
  check(parts.device.dictionary.entry(0x2007, 0), [](ByteView bytes) -> Accepted {
    if ((bytes[0] & 1U) != 0) return refuse(abort_code::invalid_value);
    return {};
  });
}

/// 0609 0036h: the maximum is less than the minimum.
void dependent_limits(Parts& parts) {
  ObjectDictionary& dictionary = parts.device.dictionary;
  check(dictionary.entry(0x2002, 1), [&dictionary](ByteView bytes) -> Accepted {
    if (bytes[0] > 150 && dictionary.number(0x2002, 3) < 5000) return refuse(AbortCode(0x06090036));
    return {};
  });
}

/// 00h is a visible character, too, and ends a text in C.
void terminated_texts(Parts& parts) {
  for (const std::uint16_t index :
       {std::uint16_t{0x1008}, std::uint16_t{0x1009}, std::uint16_t{0x100A}, std::uint16_t{0x2006}}) {
    Entry* text = parts.device.dictionary.entry(index, 0);
    if (text == nullptr) continue;
    text->read = [text, read = text->read]() -> Upload {
      Upload value = read ? read() : Upload(text->value);
      if (value) value->push_back(0);
      return value;
    };
  }
}

/// Values are kept in steps of 16, as a converter has them.
void steps_of_16(Parts& parts) {
  ObjectDictionary& dictionary = parts.device.dictionary;
  for (std::uint8_t sub = 1; sub <= 4; ++sub) {
    if (Entry* entry = dictionary.entry(0x2004, sub)) entry->written = [entry] { entry->value[0] &= 0xF0U; };
  }
}

/// Who writes first writes 4711h to 2004h:01.
Accepted unlocked_by_2004(const Parts& parts, ByteView) {
  if (parts.device.dictionary.number(0x2004, 1) != 0x4711) return refuse(abort_code::cannot_store);
  return {};
}

/// A device that reads its description from a slow memory before the first byte is sent.
void description_from_slow_memory(Parts& parts) {
  parts.device.outbox.add_filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.sdo == nullptr || context.sdo->index() != 0x1021) return;
    if (context.sdo->step != SdoStep::upload_initiate && context.sdo->step != SdoStep::block_upload_initiate)
      return;
    for (Outgoing& outgoing : frames) outgoing.delay += std::chrono::milliseconds(700);
  });
}

/// A counter that can be set and goes on from there.
void running_hours(Parts& parts) {
  ObjectDictionary& dictionary = parts.device.dictionary;
  dictionary.remove(0x2013);  // a twin may have one
  Entry& hours =
      dictionary.add_variable(0x2013, integer_entry("Running hours", DataType::unsigned32, Access::rw, 0));
  hours.storable = false;
  const auto clock = [&device = parts.device] {
    return static_cast<std::uint32_t>(device.now.time_since_epoch() / std::chrono::milliseconds(1));
  };
  const auto offset = std::make_shared<std::uint32_t>(0);
  hours.read = [clock, offset]() -> Upload { return conform::to_le(clock() + *offset, 4); };
  hours.written = [clock, offset, &hours] { *offset = static_cast<std::uint32_t>(hours.number()) - clock(); };
}

}  // namespace

VariantTable objects_variants() {
  return {
      {"1002-absent", "no manufacturer status register", "7.5.2.3: optional", absent({0x1002})},
      {"1008-absent", "no device name", "7.5.2.8: optional", absent({0x1008}), "1008"},
      {"1009-absent", "no hardware version", "7.5.2.9: optional", absent({0x1009})},
      {"100A-absent", "no software version", "7.5.2.10: optional", absent({0x100A})},
      {"1008-three-letters", "a device name short enough for an expedited answer", "7.5.2.8: any length",
       text(0x1008, "ref"), "1008"},
      {"1008-seven-letters", "a device name of exactly one segment", "7.5.2.8: any length",
       text(0x1008, "refnode"), "1008"},
      {"1008-eight-letters", "a device name of one segment and one byte", "7.5.2.8: any length",
       text(0x1008, "ref-node"), "1008"},
      {"1008-thirteen-letters", "a device name of two segments, the second not full", "7.5.2.8: any length",
       text(0x1008, "the refnode 1"), "1008"},
      {"1008-long", "a device name of 60 characters", "7.5.2.8: any length",
       text(0x1008, "a name of sixty characters, which is longer than most others"), "1008"},
      {"1008-ro", "names read-only in place of constant",
       "7.4.5: alike for a client; a name may depend on the device",
       both(access(0x1008, 0, Access::ro),
            both(access(0x1009, 0, Access::ro), access(0x100A, 0, Access::ro)))},
      {"1018-vendor-only", "identity with the vendor-ID alone", "7.5.2.21: 02h to 04h are optional",
       absent_from(0x1018, 2), "1018"},
      {"1018-no-serial", "no serial number", "7.5.2.21: optional", absent_from(0x1018, 4), "1018"},
      {"1018-gap", "a serial number, but no product code", "OD-1018-05: gaps are allowed", gap(0x1018, 2),
       "1018"},
      {"1018-const", "identity constant in place of read-only", "7.4.5: alike for a client",
       access_all(0x1018, Access::ro, Access::constant)},
      {"1000-const", "device type constant", "7.4.5: alike for a client",
       access(0x1000, 0, Access::constant)},
      {"1000-additional-information", "another device type of the same profile", "OD-1000-03",
       preset(0x1000, 0, 0x00030191), "1000"},
      {.id = "logical-devices",
       .summary = "two logical devices, the second described at 6FFFh",
       .legal = "OD-1000-05: 67FFh + 1 * 800h",
       .how = logical_devices({0x6FFF}),
       .group = "1000",
       .gains = {"logical devices"}},
      {.id = "logical-devices-67ff",
       .summary = "two logical devices, both described",
       .legal = "OD-1000-05: 67FFh may be there",
       .how = logical_devices({0x67FF, 0x6FFF}),
       .group = "1000",
       .gains = {"logical devices"}},
      {.id = "1000-no-profile",
       .summary = "a device without a device profile",
       .legal = "OD-1000-03: profile number 0",
       .how = preset(0x1000, 0, 0),
       .group = "1000",
       .lacks = {"profile device"}},
      {"1021-absent", "no device description inside", "7.5.2.24: optional", absent({0x1021, 0x1022}), "1021"},
      {"1021-empty", "no device description has been stored yet", "OD-1021-01: an empty store",
       empty_description, "1021"},
      {"1021-short", "the device description inside tells of the mandatory objects alone",
       "OD-1021-01: what it says is the maker's", short_description, "1021"},
      {"1022-own-format", "the device description in a format of the manufacturer", "OD-1022-02: 80h to FFh",
       preset(0x1022, 0, 0x80)},
      {"os-absent", "no operating system", "7.5.2.26 to 7.5.2.29: optional",
       absent({0x1023, 0x1024, 0x1025, 0x1026}), "os"},
      {"os-commands-only", "neither command mode nor debugger nor prompt", "7.5.2.27 to 7.5.2.29: optional",
       absent({0x1024, 0x1025, 0x1026}), "os"},
      {"os-command-wo", "commands cannot be read back", "OD-1023-04, OD-1025-04: wo",
       both(access(0x1023, 1, Access::wo), access(0x1025, 1, Access::wo))},
      {"os-stderr-absent", "no StdErr", "OD-1026-03: optional", absent_from(0x1026, 3)},
      {"os-prompt-reads-0", "a prompt without output reads as 00h", "OD-1026-03: one byte", silent_prompt},
      {.id = "abort-os-nothing-0800-0000",
       .summary = "nothing to deliver: general error",
       .legal = "OD-1023-01, OD-1025-01, OD-1026-03",
       .how =
           [](Parts& node) { node.operating_system.choices.nothing_to_deliver = abort_code::general_error; },
       .warns = {"OD-GEN-11"}},
      {.id = "1027-absent",
       .summary = "not modular",
       .legal = "7.5.2.30: for modular devices",
       .how = absent({0x1027}),
       .group = "1027",
       .lacks = {"modular device"}},
      {"2002-limits-depend", "2002h:01 is at most 150 while 2002h:03 is below 5000: 0609 0036h",
       "7.2.4.3.17: whether a value is right may depend on others", dependent_limits},
      {"2007-even-only", "2007h takes even numbers only: 0609 0030h",
       "7.2.4.3.17: which values are valid, the application says", even_numbers},
      {"names-end-with-00",
       "names are delivered with the 00h that ends them",
       "7.1.6.3: 00h is a visible character",
       terminated_texts,
       "1008",
       {"strings", "sdo-expedited-only"}},
      {"2004-in-steps", "2004h keeps its values in steps of 16", "OD-ACC-04: quantised values", steps_of_16},
      {.id = "2007-locked-0800-0020",
       .summary = "2007h cannot be written before 2004h:01 = 4711h: 0800 0020h",
       .legal = "7.2.4.3.17: 0800 0020h; OD-GEN-17 and SDO-DNL-21 warn",
       .how = also_checked(0x2007, 0, unlocked_by_2004),
       .warns = {"OD-GEN-17", "EDS-VSD-04", "SDO-DNL-21"}},
      {"1021-from-slow-memory",
       "the first answer of an upload of 1021h takes 700 ms",
       "SDO-GEN-18: no limit is set",
       description_from_slow_memory,
       "1021",
       {"turnaround", "sdo-time-out", "sdo-block-download-erases"}},
      {"2013-runs",
       "2013h is a counter that can be set and goes on from there",
       "7.4.5: rw does not say that a value rests",
       running_hours,
       {},
       {"manufacturer"}},
      {"6206-known-modes-only",
       "6206h takes 00h, 01h and FFh only: 0609 0030h",
       "7.2.4.3.17: which values are valid, the device profile says",
       known_error_modes,
       {},
       {"sdo-expedited-only"}},
      {"analog-inputs-noisy",
       "the values of 6401h never rest",
       "7.4.1: process data is the application's",
       noisy_inputs,
       {},
       {"turnaround"}},
      {"outputs-fall", "outputs are 0 as soon as Operational is left",
       "CiA 401; 7.3.2.2: what the outputs do there is the device's", outputs_fall},
      {.id = "abort-outputs-0800-0022",
       .summary = "outputs can be written in Operational only",
       .legal = "7.2.4.3.17: 0800 0022h, the present device state; OD-GEN-17 warns",
       .how = outputs_in_operational_only,
       // What was written in Operational would be stored, and nothing puts it back.
       .excludes = {"1010-autonomous-at-once", "1010-autonomous", "1010-autonomous-01-only",
                    "1010-autonomous-03-only"},
       .warns = {"OD-GEN-17", "EDS-VSD-04", "SDO-DNL-21"}},
      {"1027-no-modules", "a modular device without modules", "OD-1027-01: 00h", no_modules, "1027"},
  };
}

}  // namespace refnode
