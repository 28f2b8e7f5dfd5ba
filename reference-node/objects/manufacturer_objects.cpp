// SPDX-License-Identifier: Apache-2.0
#include "objects/manufacturer_objects.hpp"

#include <limits>

namespace refnode {

namespace {

// The longest DOMAIN: enough to need a size above 16 bits.
constexpr std::size_t domain_capacity = 100'000;

// A buffer for whole programs. Its content fills more than one sub-block, and no two of its segments are
// equal.
constexpr std::size_t large_buffer_capacity = 4U * 1024 * 1024;
constexpr std::size_t large_buffer_content = 1000;

Entry limited(Entry entry, std::int64_t low, std::int64_t high) {
  entry.low = low;
  entry.high = high;
  return entry;
}

}  // namespace

void add_sample_objects(Device& device) {
  ObjectDictionary& od = device.dictionary;
  using enum DataType;

  // 2000h: one rw entry of every basic type; the sub-index is the number of the type (gaps as in the
  // standard).
  od.add_complex(0x2000, "One entry of every type", ObjectKind::record);
  const auto number = [&](const char* name, DataType type, std::uint64_t value) {
    od.add_sub(0x2000, static_cast<std::uint8_t>(type), integer_entry(name, type, Access::rw, value));
  };
  number("BOOLEAN", boolean, 1);
  number("INTEGER8", integer8, 0xFE);
  number("INTEGER16", integer16, 0xFFFD);
  number("INTEGER24", integer24, 0xFFFFFC);
  number("INTEGER32", integer32, 0xFFFFFFFB);
  number("INTEGER40", integer40, 0xFFFFFFFFFA);
  number("INTEGER48", integer48, 0xFFFFFFFFFFF9);
  number("INTEGER56", integer56, 0xFFFFFFFFFFFFF8);
  number("INTEGER64", integer64, 0xFFFFFFFFFFFFFFF7);
  number("UNSIGNED8", unsigned8, 0x12);
  number("UNSIGNED16", unsigned16, 0x1234);
  number("UNSIGNED24", unsigned24, 0x123456);
  number("UNSIGNED32", unsigned32, 0x12345678);
  number("UNSIGNED40", unsigned40, 0x123456789A);
  number("UNSIGNED48", unsigned48, 0x123456789ABC);
  number("UNSIGNED56", unsigned56, 0x123456789ABCDE);
  number("UNSIGNED64", unsigned64, 0x123456789ABCDEF0);
  const auto bytes = [&](const char* name, DataType type, Bytes value, std::size_t max_size = 0) {
    od.add_sub(0x2000, static_cast<std::uint8_t>(type),
               bytes_entry(name, type, Access::rw, std::move(value), max_size));
  };
  bytes("REAL32", real32, {0x00, 0x00, 0xC0, 0x3F});                          // 1.5
  bytes("REAL64", real64, {0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xF8, 0x3F});  // 1.5
  bytes("VISIBLE_STRING", visible_string, {'v', 'i', 's', 'i', 'b', 'l', 'e'}, 64);
  bytes("OCTET_STRING", octet_string, {0x00, 0x01, 0xFE, 0xFF, 0x55, 0xAA}, 64);
  bytes("UNICODE_STRING", unicode_string, {'U', 0, 'n', 0, 'i', 0}, 64);
  bytes("TIME_OF_DAY", time_of_day, {0x00, 0x2E, 0x93, 0x02, 0x10, 0x27});          // 12:00, day 10000
  bytes("TIME_DIFFERENCE", time_difference, {0xE8, 0x03, 0x00, 0x00, 0x01, 0x00});  // 1 s and 1 day
  Bytes domain_content(256);
  for (std::size_t i = 0; i < domain_content.size(); ++i) domain_content[i] = static_cast<std::uint8_t>(i);
  bytes("DOMAIN", domain, std::move(domain_content), domain_capacity);

  // 2001h: one entry of every access type.
  od.add_complex(0x2001, "One entry of every access type", ObjectKind::record);
  od.add_sub(0x2001, 1, integer_entry("Read-only", unsigned16, Access::ro, 0x0102));
  od.add_sub(0x2001, 2, integer_entry("Write-only", unsigned16, Access::wo, 0));
  od.add_sub(0x2001, 3, integer_entry("Read-write", unsigned16, Access::rw, 0x0304));
  od.add_sub(0x2001, 4, integer_entry("Constant", unsigned16, Access::constant, 0x0506));

  // 2002h: limits, at the ends of nothing so that both neighbours exist.
  od.add_complex(0x2002, "Entries with limits", ObjectKind::record);
  od.add_sub(0x2002, 1, limited(integer_entry("10 to 200", unsigned8, Access::rw, 100), 10, 200));
  od.add_sub(0x2002, 2, limited(integer_entry("-1000 to 1000", integer16, Access::rw, 0), -1000, 1000));
  od.add_sub(0x2002, 3,
             limited(integer_entry("100 to 1 000 000", unsigned32, Access::rw, 1000), 100, 1'000'000));
  od.add_sub(0x2002, 4, limited(integer_entry("-5 to 5", integer8, Access::rw, 0), -5, 5));

  // 2003h: a record with gaps below its highest sub-index; 2004h: an array.
  od.add_complex(0x2003, "Record with gaps", ObjectKind::record);
  for (const int element : {1, 2, 5, 9}) {
    const auto sub = static_cast<std::uint8_t>(element);
    od.add_sub(0x2003, sub, integer_entry("Element", unsigned16, Access::rw, sub));
  }
  od.add_complex(0x2004, "Array", ObjectKind::array);
  for (std::uint8_t sub = 1; sub <= 4; ++sub) {
    od.add_sub(0x2004, sub, integer_entry("Element", unsigned32, Access::rw, 0x1000U * sub));
  }

  // 2005h: strings whose lengths cover every remainder modulo 7; 2006h: variables outside of any record.
  od.add_complex(0x2005, "Strings of lengths 0 to 21", ObjectKind::record);
  for (std::uint8_t length = 0; length <= 21; ++length) {
    std::string text;
    for (std::uint8_t i = 0; i < length; ++i) text += static_cast<char>('a' + i);
    od.add_sub(0x2005, static_cast<std::uint8_t>(length + 1), text_entry("String", Access::ro, text));
  }
  od.add_variable(0x2006, text_entry("Writable name", Access::rw, "reference node", 32));
  Bytes large_content(large_buffer_content);
  for (std::size_t i = 0; i < large_content.size(); ++i)
    large_content[i] = static_cast<std::uint8_t>(i / 7 + i);
  od.add_variable(0x2008, bytes_entry("Large buffer", domain, Access::rw, std::move(large_content),
                                      large_buffer_capacity))
      .storable = false;
  od.add_variable(0x2007, integer_entry("Scratch value", unsigned32, Access::rw, 0));
}

}  // namespace refnode
