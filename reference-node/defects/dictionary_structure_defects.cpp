// SPDX-License-Identifier: Apache-2.0
// Defects of the structure a device shows of itself: data type entries (0001h-025Fh), sub-index FFh, defaults
// and limits.
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr DataType u8 = DataType::unsigned8;
constexpr DataType u16 = DataType::unsigned16;
constexpr DataType u32 = DataType::unsigned32;

/// A data type entry as CiA 301, 7.4.7.1 describes it: the length of the type in bits.
DictionaryEdit type_entry(std::uint16_t index, std::uint64_t bits, Access access = Access::ro) {
  return extra(index, 0, integer_entry("Data type", u32, access, bits));
}

/// A complex data type entry with the types of its elements.
DictionaryEdit structure(std::uint16_t index, std::uint64_t count, const std::vector<std::uint16_t>& elements,
                         DataType coding = u16) {
  return [=](ObjectDictionary& od, std::uint8_t) {
    auto& entries = od.objects()[index].entries;
    entries[0] = integer_entry("Number of elements", u8, Access::ro, count);
    std::uint8_t sub = 1;
    for (const auto type : elements) entries[sub++] = integer_entry("Element", coding, Access::ro, type);
  };
}

DictionaryEdit object_structure(std::uint16_t index, std::uint64_t value, DataType type = u32,
                                Access access = Access::ro) {
  return extra(index, 0xFF, integer_entry("Structure", type, access, value));
}

DefectTable type_rows() {
  return {
      {"type-entry-is-u8",
       "0005h has one byte",
       {"OD-TYP-01"},
       extra(0x0005, 0, integer_entry("UNSIGNED8", u8, Access::ro, 8))},
      {"type-boolean-wrong-length",
       "0001h says that a BOOLEAN has 8 bits",
       {"OD-TYP-02"},
       type_entry(0x0001, 8)},
      {"type-integer-length-in-bytes",
       "0003h holds the length in bytes",
       {"OD-TYP-03"},
       type_entry(0x0003, 2)},
      {"type-unsigned-length-in-bytes",
       "0007h holds the length in bytes",
       {"OD-TYP-04"},
       type_entry(0x0007, 4)},
      {"type-real-wrong-length",
       "0011h says that a REAL64 has 32 bits",
       {"OD-TYP-05"},
       type_entry(0x0011, 32)},
      {"type-time-with-padding",
       "000Ch counts 64 bits for TIME_OF_DAY",
       {"OD-TYP-06"},
       type_entry(0x000C, 64)},
      {"type-string-with-length",
       "0009h says that a VISIBLE_STRING has 8 bits",
       {"OD-TYP-07"},
       type_entry(0x0009, 8)},
      {"reserved-type-readable",
       "There is an entry at the reserved type 0017h",
       {"OD-TYP-08"},
       type_entry(0x0017, 32)},
      {"reserved-struct-readable",
       "There is an entry at the reserved structure 0026h",
       {"OD-TYP-09"},
       structure(0x0026, 1, {0x0007})},
      {"type-entry-writable", "0007h can be written", {"OD-TYP-10"}, type_entry(0x0007, 32, Access::rw)},
      {"type-entry-with-sub1",
       "0007h has a sub-index 01h",
       {"OD-TYP-11"},
       both(type_entry(0x0007, 32), extra(0x0007, 1, integer_entry("Element", u16, Access::ro, 7)))},
      {"struct-count-too-high",
       "0023h counts five elements and has four",
       {"OD-TYP-12", "OD-TYP-17"},
       structure(0x0023, 5, {7, 7, 7, 7})},
      {"struct-names-no-simple-type",
       "An element of 0023h names the structure 0020h",
       {"OD-TYP-13", "OD-TYP-17"},
       structure(0x0023, 4, {7, 7, 7, 0x0020})},
      {"struct-elements-are-u32",
       "The elements of 0023h have four bytes",
       {"OD-TYP-13"},
       structure(0x0023, 4, {7, 7, 7, 7}, u32)},
      {"struct-pdo-communication-wrong",
       "0020h names UNSIGNED8 for the inhibit time",
       {"OD-TYP-14"},
       structure(0x0020, 5, {7, 5, 5, 5, 6})},
      {"struct-pdo-mapping-wrong",
       "0021h names UNSIGNED8 elements",
       {"OD-TYP-15"},
       structure(0x0021, 8, {5, 5, 5, 5, 5, 5, 5, 5})},
      {"struct-sdo-parameter-wrong", "0022h lists two elements", {"OD-TYP-16"}, structure(0x0022, 2, {7, 7})},
      {"struct-identity-wrong", "0023h lists three elements", {"OD-TYP-17"}, structure(0x0023, 3, {7, 7, 7})},
      {"manufacturer-type-mixed",
       "0040h has a length of four bytes and a sub-index 01h",
       {"OD-TYP-18"},
       both(type_entry(0x0040, 32), extra(0x0040, 1, integer_entry("Element", u16, Access::ro, 7)))},
      {"profile-type-in-wrong-block",
       "There is a structure in the block of simple types at 0060h",
       {"OD-TYP-19"},
       structure(0x0060, 1, {7})},
  };
}

DefectTable structure_rows() {
  return {
      {"subff-is-u16", "1018h:FF has two bytes", {"OD-OBJ-01"}, object_structure(0x1018, 0x2309, u16)},
      {"subff-reserved-bits-set",
       "1018h:FF has reserved bits set",
       {"OD-OBJ-02"},
       object_structure(0x1018, 0x01002309)},
      {"subff-record-as-array", "1018h:FF says ARRAY", {"OD-OBJ-03"}, object_structure(0x1018, 0x2308)},
      {"subff-wrong-data-type",
       "1018h:FF names the structure of an SDO parameter",
       {"OD-OBJ-04"},
       object_structure(0x1018, 0x2209)},
      {"subff-writable",
       "1018h:FF can be written",
       {"OD-OBJ-05"},
       object_structure(0x1018, 0x2309, u32, Access::rw)},
      {"subff-counted",
       "1018h:00 counts sub-index FFh",
       {"OD-OBJ-06", "OD-1018-01", "OD-GEN-11"},
       both(object_structure(0x1018, 0x2309), preset(0x1018, 0, 0xFF))},
      {"subff-in-one-object-only",
       "Sub-index FFh is offered by 1018h and by nothing else",
       {"OD-OBJ-07"},
       object_structure(0x1018, 0x2309)},
      {"default-differs-from-description",
       "2007h starts with 1 instead of 0",
       {"OD-DSC-03"},
       preset(0x2007, 0, 1)},
      {"value-outside-its-limits",
       "2002h:01 starts with 250, above its limit of 200",
       {"OD-DSC-04", "OD-DSC-03"},
       preset(0x2002, 1, 250)},
      {"type-of-own-objects-not-delivered",
       "The INTEGER24 of 2000h:10 is delivered with four bytes",
       {"OD-TYP-20", "OD-GEN-17", "SDO-UPL-04"},
       type(0x2000, 0x10, DataType::integer32)},
  };
}

}  // namespace

DefectTable dictionary_structure_defects() {
  DefectTable rows = type_rows();
  for (auto& row : structure_rows()) rows.push_back(std::move(row));
  return rows;
}

}  // namespace refnode
