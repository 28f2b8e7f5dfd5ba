// SPDX-License-Identifier: Apache-2.0
// The standard's table, spot-checked against CiA 301 by literals, and the container.
#include "device/dictionary.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "catch.hpp"
#include "device/standard_objects.hpp"

using namespace conform;
using namespace conform::device;
using canopen::DataType;

namespace {

Multiplexer mux(std::uint16_t index, std::uint8_t sub = 0) { return {Index{index}, SubIndex{sub}}; }

Entry standard(std::uint16_t index, std::uint8_t sub = 0) {
  const auto entry = standard_entry(mux(index, sub));
  INFO(to_string(mux(index, sub)));
  REQUIRE(entry.has_value());
  return *entry;
}

}  // namespace

TEST_CASE("Every device has 1000h, 1001h and 1018h:00 and :01, and only these are mandatory") {
  std::vector<Multiplexer> mandatory;
  for (unsigned index = 0; index <= 0xFFFF; ++index) {
    for (unsigned sub = 0; sub <= 1; ++sub) {
      const auto entry =
          standard_entry(mux(static_cast<std::uint16_t>(index), static_cast<std::uint8_t>(sub)));
      if (entry && entry->category == Category::mandatory) mandatory.push_back(entry->mux);
    }
  }
  CHECK(mandatory == std::vector<Multiplexer>{mux(0x1000), mux(0x1001), mux(0x1018, 0), mux(0x1018, 1)});
  CHECK(standard(0x1000).presence() == Presence::claimed_mandatory);
  CHECK(standard(0x1014).presence() == Presence::unclaimed);
}

TEST_CASE("Types and access are those of CiA 301") {
  CHECK(standard(0x1000).type == DataType::unsigned32);
  CHECK(standard(0x1000).access == Access::ro);
  CHECK(standard(0x1001).type == DataType::unsigned8);
  CHECK(standard(0x1001).pdo_mappable);
  CHECK(standard(0x1001).may_change);
  CHECK(standard(0x1003, 0).type == DataType::unsigned8);
  CHECK(standard(0x1003, 0).access == Access::rw);
  CHECK(standard(0x1003, 0).command);
  CHECK(standard(0x1003, 0xFE).access == Access::ro);
  CHECK(standard(0x1003, 0xFE).object == ObjectCode::array);
  CHECK(standard(0x1008).type == DataType::visible_string);
  CHECK(standard(0x1008).access == Access::constant);
  CHECK(standard(0x100C).type == DataType::unsigned16);
  CHECK(standard(0x100D).type == DataType::unsigned8);
  CHECK(standard(0x1010, 1).command);
  CHECK(standard(0x1010, 0x7F).type == DataType::unsigned32);
  CHECK(standard(0x1011, 0).access == Access::constant);
  CHECK(standard(0x1015).type == DataType::unsigned16);
  CHECK(standard(0x1016, 0x7F).type == DataType::unsigned32);
  CHECK(standard(0x1017).access_open);
  CHECK(standard(0x1018, 4).access == Access::ro);
  CHECK(standard(0x1019).high == Bytes{240});
  CHECK(standard(0x1020, 2).type == DataType::unsigned32);
  CHECK(standard(0x1021).object == ObjectCode::domain);
  CHECK(standard(0x1024).access == Access::wo);
  CHECK(standard(0x1029, 0xFE).type == DataType::unsigned8);
  CHECK(standard(0x1201, 3).type == DataType::unsigned8);
  CHECK(standard(0x1400, 0).access == Access::constant);
  CHECK(standard(0x15FF, 5).type == DataType::unsigned16);
  CHECK(standard(0x17FF, 0x40).type == DataType::unsigned32);
  CHECK(standard(0x1800, 6).type == DataType::unsigned8);
  CHECK(standard(0x1BFF, 0).type == DataType::unsigned8);
}

TEST_CASE("What CiA 301 does not define is no entry") {
  for (const Multiplexer absent :
       {mux(0x0000), mux(0x1004), mux(0x100B), mux(0x1003, 0xFF), mux(0x1010, 0x80), mux(0x1017, 1),
        mux(0x1018, 5), mux(0x1200, 3), mux(0x1300), mux(0x1400, 6), mux(0x1600, 0x41), mux(0x1800, 7),
        mux(0x1C00), mux(0x2000)}) {
    INFO(to_string(absent));
    CHECK_FALSE(standard_entry(absent).has_value());
  }
}

TEST_CASE("Defaults follow the pre-defined connection set") {
  const Dictionary dictionary = standard_dictionary(NodeId{5});
  const auto value = [&](std::uint16_t index, std::uint8_t sub = 0) {
    return load_le(dictionary.find(mux(index, sub))->default_value.value());
  };
  CHECK(value(0x1005) == 0x80);
  CHECK(value(0x1012) == 0x100);
  CHECK(value(0x1014) == 0x85);
  CHECK(value(0x1200, 1) == 0x605);
  CHECK(value(0x1200, 2) == 0x585);
  CHECK(value(0x1400, 1) == 0x205);
  CHECK(value(0x1403, 1) == 0x505);
  CHECK(value(0x1800, 1) == 0x185);
  CHECK(value(0x1803, 1) == 0x485);
  CHECK(value(0x1016, 1) == 0);
  CHECK(standard(0x1014).default_value == Bytes{0x80, 0, 0, 0});
  CHECK(standard(0x1014).default_adds_node_id);
  CHECK_FALSE(standard(0x1404, 1).default_value.has_value());
}

TEST_CASE("The standard dictionary shows what the standard names one by one") {
  const Dictionary dictionary = standard_dictionary(NodeId{5});
  CHECK(dictionary.has(mux(0x1003, 1)));
  CHECK_FALSE(dictionary.has(mux(0x1003, 2)));
  CHECK(dictionary.has(mux(0x1010, 3)));
  CHECK_FALSE(dictionary.has(mux(0x1010, 4)));
  CHECK(dictionary.has(mux(0x1018, 4)));
  CHECK(dictionary.has(mux(0x1A03, 8)));
  CHECK_FALSE(dictionary.has(mux(0x1A03, 9)));
  CHECK_FALSE(dictionary.has(Index{0x1404}));
  CHECK(dictionary.has(mux(0x1201, 3)));
  CHECK_FALSE(dictionary.has(Index{0x1202}));
  CHECK(dictionary.has(mux(0x1280, 3)));
  CHECK(std::ranges::is_sorted(dictionary.entries(), {}, &Entry::mux));
}

TEST_CASE("Limits and defaults have the length of their type, and defaults lie inside") {
  for (unsigned index = 0x1000; index <= 0x1FFF; ++index) {
    for (unsigned sub = 0; sub <= 0xFF; ++sub) {
      const auto entry =
          standard_entry(mux(static_cast<std::uint16_t>(index), static_cast<std::uint8_t>(sub)));
      if (!entry) continue;
      for (const auto& value : {entry->low, entry->high, entry->default_value}) {
        if (value && value->size() != entry->size()) FAIL(to_string(entry->mux));
      }
      if (entry->default_value && entry->high && load_le(*entry->default_value) > load_le(*entry->high))
        FAIL(to_string(entry->mux));
      if (entry->name.empty()) FAIL(to_string(entry->mux));
    }
  }
}

TEST_CASE("A dictionary is ordered and holds an entry once") {
  Dictionary dictionary;
  const auto add = [&](std::uint16_t index, std::uint8_t sub, const char* name) {
    Entry entry;
    entry.mux = mux(index, sub);
    entry.name = name;
    dictionary.add(entry);
  };
  add(0x2001, 0, "c");
  add(0x2000, 1, "b");
  add(0x2000, 0, "a");
  add(0x2000, 1, "B");
  CHECK(dictionary.size() == 3);
  REQUIRE(dictionary.find(mux(0x2000, 1)) != nullptr);
  CHECK(dictionary.find(mux(0x2000, 1))->name == "B");
  CHECK(dictionary.find(mux(0x2000, 2)) == nullptr);
  CHECK(dictionary.object(Index{0x2000}).size() == 2);
  CHECK(dictionary.object(Index{0x2002}).empty());
  CHECK(dictionary.objects() == std::vector<Index>{Index{0x2000}, Index{0x2001}});
  dictionary.remove(mux(0x2001, 0));
  CHECK_FALSE(dictionary.has(Index{0x2001}));
}

TEST_CASE("Access words are those of the standard and of EDS files") {
  for (const char* word : {"ro", "wo", "rw", "rwr", "rww", "const"}) {
    const auto access = parse_access(word);
    REQUIRE(access.has_value());
    CHECK(to_string(*access) == word);
  }
  CHECK_FALSE(parse_access("RO").has_value());
  CHECK_FALSE(is_readable(Access::wo));
  CHECK(is_writable(Access::wo));
  CHECK(is_writable(Access::rwr));
  CHECK_FALSE(is_writable(Access::constant));
  CHECK(parse_object_code("RECORD") == ObjectCode::record);
  CHECK(to_string(Category::conditional) == "conditional");
}
