// SPDX-License-Identifier: Apache-2.0
// Objects that a device need not have: identity, names, descriptions, operating system, modules.
#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <string_view>
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
      {"1027-no-modules", "a modular device without modules", "OD-1027-01: 00h", no_modules, "1027"},
  };
}

}  // namespace refnode
