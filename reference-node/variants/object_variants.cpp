// SPDX-License-Identifier: Apache-2.0
// Objects a device need not have, and access the standard leaves to the device.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "variants/tools.hpp"

namespace refnode {

using namespace variant;

namespace {

/// Sub-index FFh of every array and record: bits 15-8 data type, 7-0 object code (CiA 301, 7.4.3, 7.5.2).
void add_structure(Parts& parts) {
  constexpr std::uint8_t array_code = 0x08;
  constexpr std::uint8_t record_code = 0x09;
  const auto record_type = [](std::uint16_t index) -> unsigned {
    switch (index & 0xFE00U) {
      case 0x1400:
      case 0x1800: return 0x20;
      case 0x1600:
      case 0x1A00: return 0x21;
      case 0x1200: return 0x22;
      case 0x1000: return index == 0x1023 ? 0x25 : index == 0x1025 ? 0x24 : 0x23;
      default: return 0x40;  // a structure of the manufacturer
    }
  };
  for (auto& [index, object] : parts.device.dictionary.objects()) {
    if (object.kind == ObjectKind::variable) continue;
    const auto first = object.entries.upper_bound(0);
    const bool array = object.kind == ObjectKind::array && first != object.entries.end();
    const unsigned type = array ? static_cast<unsigned>(first->second.type) : record_type(index);
    const std::uint64_t value = (type << 8U) | (array ? array_code : record_code);
    object.entries[0xFF] = integer_entry("Structure", DataType::unsigned32, Access::constant, value);
  }
}

void add_types(Parts& parts) {
  constexpr std::uint8_t bits[] = {1, 8, 16, 32, 8, 16, 32};
  for (std::uint16_t type = 1; type <= 7; ++type) {
    if (parts.device.dictionary.objects().contains(type)) continue;
    parts.device.dictionary.add_variable(
        type, integer_entry("Data type", DataType::unsigned32, Access::ro, bits[type - 1U]));
  }
}

/// 1010h, bit 1 of every sub-index.
How stores_by_itself(Duration rest) {
  return [rest](Parts& parts) {
    const auto object = parts.device.dictionary.objects().find(0x1010);
    if (object == parts.device.dictionary.objects().end()) return;
    for (auto& [sub, entry] : object->second.entries) {
      if (sub == 0 || sub == 0xFF) continue;
      entry.default_value[0] |= 2U;
      entry.value = entry.default_value;
    }
    parts.store.choices.rest_before_storing = rest;
  };
}

/// Writable entries of type DOMAIN.
template <typename Change>
void change_domains(Parts& parts, Change change) {
  for (auto& [index, object] : parts.device.dictionary.objects()) {
    for (auto& [sub, entry] : object.entries) {
      if (entry.type == DataType::domain && entry.access == Access::rw) change(entry);
    }
  }
}

/// A window on a memory: what is written goes to its beginning, and reading gives all of it.
How domain_windows(std::size_t bytes) {
  return [bytes](Parts& parts) {
    change_domains(parts, [bytes](Entry& entry) {
      entry.value.resize(bytes);
      entry.default_value = entry.value;
      entry.max_size = bytes;
      auto held = std::make_shared<Bytes>(entry.value);
      entry.written = [&entry, held] {
        std::ranges::copy(entry.value, held->begin());
        entry.value = *held;
      };
    });
  };
}

/// A program for another processor is refused when all of it is there.
void domains_look_at_content(Parts& parts) {
  change_domains(parts, [](Entry& entry) {
    entry.check = [&entry](ByteView bytes) -> Accepted {
      if (std::ranges::equal(bytes, entry.value)) return {};
      return refuse(abort_code::invalid_value);
    };
  });
}

void empty_domains(Parts& parts) {
  change_domains(parts, [](Entry& entry) {
    entry.value.clear();
    entry.default_value.clear();
  });
}

/// 1010h, bit 1 of one sub-index only.
How stores_by_itself_as_said_in(std::uint8_t sub) {
  return [sub](Parts& parts) {
    Entry* entry = parts.device.dictionary.entry(0x1010, sub);
    if (entry == nullptr) return;
    entry->default_value[0] |= 2U;
    entry->value = entry->default_value;
  };
}

/// A complex data type entry with the types of its elements (CiA 301, 7.4.8).
How structure(std::uint16_t index, std::vector<std::uint16_t> elements) {
  return [index, elements = std::move(elements)](Parts& parts) {
    auto& entries = parts.device.dictionary.objects()[index].entries;
    entries[0] = integer_entry("Number of elements", DataType::unsigned8, Access::ro, elements.size());
    std::uint8_t sub = 1;
    for (const auto type : elements)
      entries[sub++] = integer_entry("Element", DataType::unsigned16, Access::ro, type);
  };
}

/// 1010h:03 and 1011h:03 are missing, and nothing above 1FFFh is stored with "all parameters" either.
void store_communication_only(Parts& parts) {
  absent_from(0x1010, 3)(parts);
  absent_from(0x1011, 3)(parts);
  for (auto& [index, object] : parts.device.dictionary.objects()) {
    if (index < 0x2000) continue;
    for (auto& [sub, entry] : object.entries) entry.storable = false;
  }
}

void remove_range(Parts& parts, std::uint16_t first, std::uint16_t last) {
  std::erase_if(parts.device.dictionary.objects(),
                [=](const auto& object) { return object.first >= first && object.first <= last; });
}

}  // namespace

VariantTable object_variants() {
  return {
      {"1002-absent", "no manufacturer status register", "7.5.2.3: optional", absent({0x1002})},
      {"1003-absent", "no error history", "7.5.2.4: optional", absent({0x1003}), "1003"},
      {"1003-depth-1", "a history of one error", "7.5.2.4: 1 to 254 fields",
       both(absent_from(0x1003, 2), [](Parts& node) { node.emergency.history.choices.depth = 1; }), "1003"},
      {"1003-depth-2", "a history of two errors", "7.5.2.4: 1 to 254 fields",
       both(absent_from(0x1003, 3), [](Parts& node) { node.emergency.history.choices.depth = 2; }), "1003"},
      {"1003-depth-7", "a history of seven errors", "7.5.2.4: 1 to 254 fields",
       both(absent_from(0x1003, 8), [](Parts& node) { node.emergency.history.choices.depth = 7; }), "1003"},
      {.id = "sync-absent",
       .summary = "no SYNC: 1005h to 1007h and 1019h absent, no synchronous PDO",
       .legal = "7.5.2.5: 1005h is for devices that support SYNC",
       .how = both(absent({0x1005, 0x1006, 0x1007, 0x1019}),
                   choose_of_pdos([](PdoChoices& c) { c.synchronous_types = c.remote_types = false; })),
       .group = "sync",
       .lacks = {"sync consumer", "sync counter"}},
      {"1006-1007-absent", "neither cycle period nor window length",
       "7.5.2.6, 7.5.2.7: for SYNC producers; optional", absent({0x1006, 0x1007})},
      {"1007-absent", "no synchronous window", "7.5.2.7: optional", absent({0x1007})},
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
      {.id = "storage-absent",
       .summary = "neither stores nor restores",
       .legal = "7.5.2.13, 7.5.2.14: optional",
       .how = absent({0x1010, 0x1011, 0x2F20}),
       .group = "storage",
       .lacks = {"store", "restore"}},
      {.id = "1010-only",
       .summary = "stores, but does not restore",
       .legal = "7.5.2.14: 1011h is optional",
       .how = absent({0x1011}),
       .group = "storage",
       .lacks = {"restore"}},
      {"1010-sub-1-only", "stores and restores everything at once only", "OD-1010-05, OD-1011-05",
       both(absent_from(0x1010, 2), absent_from(0x1011, 2)), "storage"},
      {"1010-sub-2-absent", "stores and restores all, or the application parameters", "OD-1010-05: a gap",
       both(gap(0x1010, 2), gap(0x1011, 2)), "storage"},
      {"1010-communication-only", "stores no application parameter", "OD-1010-10: what the device can store",
       store_communication_only, "storage"},
      {"1010-autonomous", "stores by itself what was written, after 4 s of rest",
       "OD-1010-04, OD-1010-17: bit 1", stores_by_itself(std::chrono::seconds(4)), "storage"},
      {"1010-autonomous-at-once", "stores by itself with each write", "OD-1010-04, OD-1010-17: bit 1",
       stores_by_itself(Duration::zero()), "storage"},
      {"1010-autonomous-01-only",
       "bit 1 of 1010h:01, not of :02 and :03: what belongs to neither is stored by itself",
       "7.5.2.13: a group's own sub-index says more of it", stores_by_itself_as_said_in(1), "storage"},
      {"1010-autonomous-02-only", "communication parameters alone are stored by themselves",
       "7.5.2.13: bit 1 of 1010h:02", stores_by_itself_as_said_in(2), "storage"},
      {"1010-autonomous-03-only", "application parameters alone are stored by themselves",
       "7.5.2.13: bit 1 of 1010h:03", stores_by_itself_as_said_in(3), "storage"},
      {.id = "1012-absent",
       .summary = "does not know TIME",
       .legal = "7.5.2.15: for devices that support TIME",
       .how = absent({0x1012, 0x2F10}),
       .group = "time",
       .lacks = {"time consumer"}},
      {.id = "emcy-absent",
       .summary = "no EMCY: 1014h and 1015h absent",
       .legal = "7.2.7.1: optional",
       .how = absent({0x1014, 0x1015}),
       .group = "emcy",
       .lacks = {"emcy"}},
      {"1015-absent", "no EMCY inhibit time", "7.5.2.18: optional", absent({0x1015}), "1015"},
      {.id = "1016-absent",
       .summary = "no heartbeat consumer",
       .legal = "7.5.2.19: optional",
       .how = absent({0x1016}),
       .group = "1016",
       .lacks = {"heartbeat consumer"}},
      {"1016-one", "monitors one node", "7.5.2.19: 1 to 127", absent_from(0x1016, 2), "1016"},
      {"1016-two", "monitors two nodes", "7.5.2.19: 1 to 127", absent_from(0x1016, 3), "1016"},
      {"1018-vendor-only", "identity with the vendor-ID alone", "7.5.2.21: 02h to 04h are optional",
       absent_from(0x1018, 2), "1018"},
      {"1018-no-serial", "no serial number", "7.5.2.21: optional", absent_from(0x1018, 4), "1018"},
      {"1018-gap", "a serial number, but no product code", "OD-1018-05: gaps are allowed", gap(0x1018, 2),
       "1018"},
      {"1018-const", "identity constant in place of read-only", "7.4.5: alike for a client",
       access_all(0x1018, Access::ro, Access::constant)},
      {"1000-const", "device type constant", "7.4.5: alike for a client",
       access(0x1000, 0, Access::constant)},
      {"1200-absent", "the default SDO is not described", "OD-1200-01", absent({0x1200})},
      {"1200-const", "1200h constant", "OD-1200-04", access_all(0x1200, Access::ro, Access::constant)},
      {.id = "rpdo-absent",
       .summary = "receives no PDO",
       .legal = "7.5.2.35: if RPDOs are supported",
       .how = absent({0x1400, 0x1600}),
       .group = "rpdo",
       .lacks = {"rpdo"}},
      {.id = "tpdo-absent",
       .summary = "transmits no PDO",
       .legal = "7.5.2.37: if TPDOs are supported",
       .how = absent({0x1800, 0x1A00}),
       .group = "tpdo",
       .lacks = {"tpdo", "remote frames"}},
      {.id = "pdo-absent",
       .summary = "no PDOs",
       .legal = "7.5.2.35, 7.5.2.37: if PDOs are supported",
       .how = absent({0x1400, 0x1600, 0x1800, 0x1A00}),
       .group = "rpdo",
       .excludes = {"tpdo"},
       .lacks = {"rpdo", "tpdo", "variable mapping", "remote frames"}},
      {"manufacturer-objects-absent", "no manufacturer-specific objects", "7.4.1: optional",
       [](Parts& parts) { remove_range(parts, 0x2000, 0x5FFF); }, "manufacturer"},
      {"empty-entries-absent", "no object without content", "7.4.7: lengths are the device's own",
       [](Parts& parts) { parts.device.dictionary.remove_sub(0x2005, 1); }},
      {"domain-1000", "every writable DOMAIN is a window of 1000 bytes",
       "7.4.7: lengths are the device's own", domain_windows(1000), "domain"},
      {"domain-1778", "every writable DOMAIN is a window of 1778 bytes: two full sub-blocks",
       "7.4.7: lengths are the device's own", domain_windows(1778), "domain"},
      {"domain-content", "a DOMAIN refuses what is no program for it", "7.2.4.3.17: 0609 0030h",
       domains_look_at_content, "domain"},
      {"domain-empty", "nothing is in the DOMAINs yet", "7.4.7: lengths are the device's own", empty_domains,
       "domain"},
      {"types-readable", "lengths of data types 0001h to 0007h can be read", "OD-TYP-01", add_types},
      {"0020-four-elements", "a PDO communication record of four elements", "OD-TYP-14",
       structure(0x0020, {7, 5, 6, 5}), "0020"},
      {"0020-five-elements", "a PDO communication record with an event timer", "OD-TYP-14",
       structure(0x0020, {7, 5, 6, 5, 6}), "0020"},
      {"0020-six-elements", "a PDO communication record with a SYNC start value", "OD-TYP-14",
       structure(0x0020, {7, 5, 6, 5, 6, 5}), "0020"},
      {"0021-0023-readable", "the structures of mapping, SDO parameter and identity can be read",
       "OD-TYP-15, OD-TYP-16, OD-TYP-17",
       both(both(structure(0x0021, std::vector<std::uint16_t>(64, 7)), structure(0x0022, {7, 7, 5})),
            structure(0x0023, {7, 7, 7, 7}))},
      {"own-structures-readable", "a structure of the manufacturer and one of a device profile can be read",
       "OD-TYP-18, OD-TYP-19", both(structure(0x0040, {7}), structure(0x0080, {5, 7}))},
      {"0024-0025-readable", "the records of debugger and OS command can be read", "7.4.8 tables 50, 51",
       both(structure(0x0024, {0x0A, 5, 0x0A}), structure(0x0025, {0x0A, 5, 0x0A}))},
      {"structure-readable", "sub-index FFh tells the structure of communication objects", "OD-OBJ-01",
       add_structure, "structure"},
  };
}

}  // namespace refnode
