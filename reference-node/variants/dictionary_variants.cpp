// SPDX-License-Identifier: Apache-2.0
// The object dictionary: data types, lengths, structures, and how what does not fit is refused.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "variants/tools.hpp"

namespace refnode {

using namespace variant;

namespace {

/// The entry of one of the types 0001h to 0007h as a placeholder has it: as long as the type. What a request
/// for it is refused with, `otherwise` where the length is right or does not matter.
std::optional<AbortCode> refused_placeholder(Multiplexer mux, std::optional<std::size_t> size,
                                             AbortCode otherwise) {
  constexpr std::uint16_t last_placeholder = 0x0007;
  const std::uint16_t index = mux.index.value();
  if (index == 0 || index > last_placeholder) return std::nullopt;
  if (mux.sub.value() != 0) return abort_code::no_sub_index;
  const bool wrong_length = size && *size != fixed_size(static_cast<DataType>(index));
  return wrong_length ? abort_code::length_mismatch : otherwise;
}
void types_for_mapping_only(Parts& parts) {
  ObjectDictionary& dictionary = parts.device.dictionary;
  dictionary.upload.replace([](const auto& former, Multiplexer mux) -> Upload {
    if (const auto code = refused_placeholder(mux, std::nullopt, abort_code::write_only))
      return refuse(*code);
    return former(mux);
  });
  dictionary.may_download.replace(
      [](const auto& former, Multiplexer mux, std::optional<std::size_t> size) -> Accepted {
        if (const auto code = refused_placeholder(mux, size, abort_code::read_only)) return refuse(*code);
        return former(mux, size);
      });
  dictionary.download.replace([](const auto& former, Multiplexer mux, ByteView data) -> Accepted {
    if (const auto code = refused_placeholder(mux, data.size(), abort_code::read_only)) return refuse(*code);
    return former(mux, data);
  });
}

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

/// Nothing is there to be read until something has been written.
void domains_without_data(Parts& parts) {
  empty_domains(parts);
  change_domains(parts, [](Entry& entry) {
    entry.read = [&entry]() -> Upload {
      if (entry.value.empty()) return refuse(abort_code::no_data);
      return entry.value;
    };
  });
}

/// Writable entries of variable length, DOMAINs and commands left alone.
template <typename Change>
void change_strings(Parts& parts, Change change) {
  for (auto& [index, object] : parts.device.dictionary.objects()) {
    for (auto& [sub, entry] : object.entries) {
      if (fixed_size(entry.type) == 0 && entry.type != DataType::domain && entry.access == Access::rw &&
          !entry.command)
        change(entry);
    }
  }
}

/// Texts have a fixed length and are filled up with 00h.
void fixed_texts(Parts& parts) {
  change_strings(parts, [](Entry& entry) {
    if (entry.type != DataType::visible_string) return;
    entry.value.resize(entry.max_size);
    entry.default_value = entry.value;
    entry.written = [&entry, former = entry.written] {
      entry.value.resize(entry.max_size);
      if (former) former();
    };
  });
}

void strings_of(Parts& parts, std::size_t bytes) {
  change_strings(parts, [bytes](Entry& entry) {
    entry.max_size = bytes;
    if (entry.value.size() <= bytes) return;
    entry.value.resize(bytes);
    entry.default_value = entry.value;
  });
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

/// Two entries in the gaps of the record for the manufacturer's own use; the description has neither.
void hide_entries(Parts& parts) {
  const auto found = parts.device.dictionary.objects().find(0x2003);
  if (found == parts.device.dictionary.objects().end()) return;
  auto& entries = found->second.entries;
  entries.try_emplace(3, integer_entry("Service counter", DataType::unsigned16, Access::ro, 0));
  entries.try_emplace(6, integer_entry("Service key", DataType::unsigned16, Access::wo, 0));
}

void remove_range(Parts& parts, std::uint16_t first, std::uint16_t last) {
  std::erase_if(parts.device.dictionary.objects(),
                [=](const auto& object) { return object.first >= first && object.first <= last; });
}

}  // namespace

VariantTable dictionary_variants() {
  return {
      {"manufacturer-objects-absent", "no manufacturer-specific objects", "7.4.1: optional",
       [](Parts& parts) { remove_range(parts, 0x2000, 0x5FFF); }, "manufacturer"},
      {"empty-entries-absent", "no object without content", "7.4.7: lengths are the device's own",
       [](Parts& parts) { parts.device.dictionary.remove_sub(0x2005, 1); }},
      {.id = "undescribed-entries",
       .summary = "a record has two entries that the description leaves out",
       .legal = "7.4.1: 2000h to 5FFFh are the manufacturer's",
       .how = hide_entries,
       .warns = {"OD-GEN-07"}},
      {"domain-1000", "every writable DOMAIN is a window of 1000 bytes",
       "7.4.7: lengths are the device's own", domain_windows(1000), "domain"},
      {"domain-1778", "every writable DOMAIN is a window of 1778 bytes: two full sub-blocks",
       "7.4.7: lengths are the device's own", domain_windows(1778), "domain"},
      {"domain-content", "a DOMAIN refuses what is no program for it", "7.2.4.3.17: 0609 0030h",
       domains_look_at_content, "domain"},
      {"domain-empty", "nothing is in the DOMAINs yet", "7.4.7: lengths are the device's own", empty_domains,
       "domain"},
      {"abort-domain-0800-0024", "the DOMAINs have no data until something is written to them",
       "7.2.4.3.17: 0800 0024h", domains_without_data, "domain"},
      {"strings-fixed", "writable texts have a fixed length and are filled up with 00h",
       "7.4.7: lengths are the device's own", fixed_texts, "strings"},
      {"strings-of-eight-bytes",
       "writable strings hold at most eight bytes",
       "7.4.7: lengths are the device's own",
       [](Parts& parts) { strings_of(parts, 8); },
       "strings",
       {"abort-segments-length-0609-0030"}},
      {"types-for-mapping-only",
       "data types 0001h to 0007h are there for mapping: not read, and a write is asked for its length first",
       "7.4.7.1: reading them is optional",
       types_for_mapping_only,
       {},
       {"types-readable"}},
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
      {"abort-too-long-0607-0010", "too many bytes are refused as a wrong length", "OD-LEN-02",
       [](Parts& node) { node.device.dictionary.choices.value_too_long = abort_code::length_mismatch; }},
      {"abort-too-short-0607-0010", "too few bytes are refused as a wrong length", "OD-LEN-01",
       [](Parts& node) { node.device.dictionary.choices.value_too_short = abort_code::length_mismatch; }},
      {"abort-above-limit-0609-0030", "a value above its limit is an invalid value", "OD-RNG-01",
       [](Parts& node) { node.device.dictionary.choices.value_above_limit = abort_code::invalid_value; }},
      {"abort-below-limit-0609-0030", "a value below its limit is an invalid value", "OD-RNG-02",
       [](Parts& node) { node.device.dictionary.choices.value_below_limit = abort_code::invalid_value; }},
  };
}

}  // namespace refnode
