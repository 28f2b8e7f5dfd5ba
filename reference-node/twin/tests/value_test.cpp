// SPDX-License-Identifier: Apache-2.0
// What a description says and the bytes that a client gets for it.
#include "base/text.hpp"
#include "node/eds_text.hpp"
#include "node/tests/bench.hpp"
#include "twin/tests/twin_text.hpp"

using namespace refnode;
using namespace refnode::testing;

namespace {

struct Row {
  const char* type;
  std::string text;
  std::string bytes;
};

const Entry& only(const Twin& twin) { return twin.objects.at(0x2000).entries.at(0); }

std::string shown(const Twin& twin, std::uint16_t index, std::uint8_t sub = 0) {
  return conform::hex_bytes(twin.objects.at(index).entries.at(sub).value);
}

}  // namespace

TEST_CASE("A default has the bytes of its data type") {
  const Row rows[] = {
      {"0x0001", "1", "01"},
      {"0x0001", "true", "01"},
      {"0x0002", "-2", "FE"},
      {"0x0002", "0xFE", "FE"},
      {"0x0002", "0376", "FE"},
      {"0x0003", "-3", "FD FF"},
      {"0x0003", "0x8000", "00 80"},
      {"0x0004", "0xFFFFFFFB", "FB FF FF FF"},
      {"0x0005", "18", "12"},
      {"5", "0X12", "12"},
      {"0x0005", "017", "0F"},
      {"0x0005", "12h", "12"},
      {"0x0005", "18 ; eighteen", "12"},
      {"0x0005 # UNSIGNED8", "0x12 # as above", "12"},
      {"0x0006", "$NODEID", "05 00"},
      {"0x0007", "$NODEID+0x40000180", "85 01 00 40"},
      {"0x0007", "0x180 + $NodeId", "85 01 00 00"},
      {"0x0007", "0x12345678UL", "78 56 34 12"},
      {"0x0008", "1.5", "00 00 C0 3F"},
      {"0x0008", "-2.5e-1", "00 00 80 BE"},
      {"0x0008", "7", "00 00 E0 40"},
      {"0x0008", "0x40490FDB", "DB 0F 49 40"},
      {"0x0009", "red and blue", "72 65 64 20 61 6E 64 20 62 6C 75 65"},
      {"0x0009", "\"q\"", "22 71 22"},
      {"0x0009", "M\xFChle", "4D FC 68 6C 65"},
      {"0x000A", "00 01 fE", "00 01 FE"},
      {"0x000A", "0123456789abcdef", "01 23 45 67 89 AB CD EF"},
      {"0x000B", "abc\xE2\x9C\x93", "61 00 62 00 63 00 13 27"},
      {"0x000B", "\xF0\x9F\x98\x80", "3D D8 00 DE"},
      {"0x000B", "\xFCx", "FC 00 78 00"},
      {"0x000C", "365 43200000", "00 2E 93 02 6D 01"},
      {"0x000C", "00 2E 93 02 10 27", "00 2E 93 02 10 27"},
      {"0x000C", "0", "00 00 00 00 00 00"},
      {"0x000D", "1 1000", "E8 03 00 00 01 00"},
      {"0x000F", "C83DBB", "C8 3D BB"},
      {"0x0010", "-4", "FC FF FF"},
      {"0x0011", "0.5", "00 00 00 00 00 00 E0 3F"},
      {"0x0011", "0x400921FB54442D18", "18 2D 44 54 FB 21 09 40"},
      {"0x0012", "-6", "FA FF FF FF FF"},
      {"0x0013", "-7", "F9 FF FF FF FF FF"},
      {"0x0014", "-8", "F8 FF FF FF FF FF FF"},
      {"0x0015", "-9223372036854775808", "00 00 00 00 00 00 00 80"},
      {"0x0015", "0x1234567890ABCDEFLL", "EF CD AB 90 78 56 34 12"},
      {"0x0016", "0x123456", "56 34 12"},
      {"0x0018", "0x123456789A", "9A 78 56 34 12"},
      {"0x0019", "0x123456789ABC", "BC 9A 78 56 34 12"},
      {"0x001A", "0x123456789ABCDE", "DE BC 9A 78 56 34 12"},
      {"0x001B", "18446744073709551615", "FF FF FF FF FF FF FF FF"},
  };
  for (const Row& row : rows) {
    CAPTURE(row.type, row.text);
    const Twin twin = twin_of(entry("2000", row.type, "rw", row.text));
    CHECK(conform::hex_bytes(only(twin).value) == row.bytes);
    CHECK(only(twin).default_value == only(twin).value);
    CHECK(twin.remarks.all().empty());
  }
}

TEST_CASE("A default that is no value is remarked with its place, and something is served") {
  const Row rows[] = {
      {"0x0001", "2", "00"},
      {"0x0002", "200", "00"},
      {"0x0005", "256", "00"},
      {"0x0005", "-1", "00"},
      {"0x0005", "09", "00"},
      {"0x0007", "$NODEID+$NODEID", "00 00 00 00"},
      {"0x0008", "one", "00 00 00 00"},
      {"0x0008", "1e99", "00 00 00 00"},
      {"0x000C", "yesterday", "00 00 00 00 00 00"},
      {"0x000A", "xyz", "78 79 7A"},
      {"0x000F", "0", "30"},
      {"0x0040", "7", "07 00 00 00"},
      {"", "7", "07 00 00 00"},
  };
  for (const Row& row : rows) {
    CAPTURE(row.type, row.text);
    const Twin twin = twin_of(entry("2000", row.type, "rw", row.text));
    CHECK(conform::hex_bytes(only(twin).value) == row.bytes);
    CHECK(twin.remarks.all().size() == 1);
  }
  CHECK(remarks_of(twin_of(entry("2000", "0x0005", "rw", "256"))) ==
        std::vector<std::string>{"6:14 2000h:00: '256' is no value of UNSIGNED8; it starts with 00"});
  CHECK(remarks_of(twin_of(entry("2000", "0x0040", "rw", "7"))) ==
        std::vector<std::string>{
            "4:10 2000h:00: the data type '0x0040' is not known; it is served as UNSIGNED32"});
}

TEST_CASE("Where the file gives no default, the standard's or the nearest to zero is served") {
  const Twin twin = twin_of(
      entry("1005", u32, "rw", "") + entry("1012", u32, "rw", "") + entry("1014", u32, "rw", "") +
      record("1018") + entry("1018sub0", u8, "ro", "") + entry("1018sub1", u32, "ro", "7") +
      entry("1018sub4", u32, "ro", "") + record("1401") + entry("1401sub0", u8, "ro", "2") +
      entry("1401sub1", u32, "rw", "") + entry("1401sub2", u8, "rw", "") + record("1804") +
      entry("1804sub0", u8, "ro", "1") + entry("1804sub1", u32, "rw", "") + record("1601") +
      entry("1601sub0", u8, "rw", "") + entry("1601sub1", u32, "rw", "") +
      entry("2000", u16, "rw", "", "LowLimit=10\n") + entry("2001", "0x0008", "rw", "", "LowLimit=1.5\n") +
      entry("2002", "0x0002", "rw", "", "HighLimit=-1\n") + entry("2003", "0x0009", "rw", ""));
  CHECK(shown(twin, 0x1005) == "80 00 00 00");
  CHECK(shown(twin, 0x1012) == "00 01 00 00");
  CHECK(shown(twin, 0x1014) == "85 00 00 00");
  CHECK(shown(twin, 0x1018, 0) == "04");
  CHECK(shown(twin, 0x1018, 4) == "00 00 00 00");
  CHECK(shown(twin, 0x1401, 1) == "05 03 00 00");
  CHECK(shown(twin, 0x1401, 2) == "FF");
  CHECK(shown(twin, 0x1804, 1) == "00 00 00 80");
  CHECK(shown(twin, 0x1601, 0) == "00");
  CHECK(shown(twin, 0x2000) == "0A 00");
  CHECK(shown(twin, 0x2001) == "00 00 C0 3F");
  CHECK(shown(twin, 0x2002) == "FF");
  CHECK(shown(twin, 0x2003).empty());
  CHECK(twin.remarks.all().empty());
}

TEST_CASE("Access and PDO mapping are those of the file") {
  struct Case {
    const char* access;
    const char* mapping;
    Access served;
    bool rx, tx;
  };
  const Case cases[] = {
      {"ro", "PDOMapping=1\n", Access::ro, false, true},
      {"const", "", Access::constant, false, false},
      {"wo", "PDOMapping=1\n", Access::wo, true, false},
      {"rw", "PDOMapping=1\n", Access::rw, true, true},
      {"RW # all", "PDOMapping=0\n", Access::rw, false, false},
      {"rww", "PDOMapping=1\n", Access::rw, true, false},
      {"rwr", "PDOMapping=1\n", Access::rw, false, true},
      {"rww", "", Access::rw, true, false},
      {"rwr", "PDOMapping=0\n", Access::rw, false, false},
  };
  for (const Case& row : cases) {
    CAPTURE(row.access, row.mapping);
    const Twin twin = twin_of(entry("2000", u8, row.access, "0", row.mapping));
    CHECK(only(twin).access == row.served);
    CHECK(only(twin).rx_mappable == row.rx);
    CHECK(only(twin).tx_mappable == row.tx);
    CHECK(twin.remarks.all().empty());
  }
  CHECK(remarks_of(twin_of(entry("2000", u8, "all", "0"))) ==
        std::vector<std::string>{"5:12 2000h:00: the access 'all' is not known; it is served as ro"});
}

TEST_CASE("Compact arrays and PDOs are served in full") {
  const Twin twin = twin_of(
      "[DeviceInfo]\nNrOfRXPDO=2\nNrOfTXPDO=1\nCompactPDO=0x03\n\n"
      "[2001]\nParameterName=Speed\nObjectType=0x8\nDataType=0x0006\nAccessType=rw\nDefaultValue=300\n"
      "CompactSubObj=9\n\n[2001Value]\nNrOfEntries=1\n3=0x0101\n");
  CHECK(twin.objects.at(0x2001).entries.size() == 10);
  CHECK(shown(twin, 0x2001, 0) == "09");
  CHECK(shown(twin, 0x2001, 2) == "2C 01");
  CHECK(shown(twin, 0x2001, 3) == "01 01");
  CHECK(shown(twin, 0x1400, 1) == "05 02 00 00");
  CHECK(shown(twin, 0x1401, 1) == "05 03 00 00");
  CHECK(shown(twin, 0x1800, 1) == "85 01 00 40");
  CHECK(shown(twin, 0x1A00, 0) == "00");
  CHECK_FALSE(twin.objects.contains(0x1402));
  CHECK_FALSE(twin.objects.contains(0x1801));
}

TEST_CASE("A DCF gives the configured values and the node-ID") {
  const std::string text = "[DeviceComissioning]\nNodeID=0x22\n\n" +
                           entry("1014", u32, "rw", "$NODEID+0x80", "ParameterValue=$NODEID+0x90\n") +
                           entry("1017", u16, "rw", "0", "ParameterValue=250\n");
  CHECK(configured_node_id(*describe(text)) == 0x22);
  CHECK_FALSE(configured_node_id(*describe("[DeviceComissioning]\nNodeID=200\n")).has_value());
  const Twin twin = twin_of(text, 0x22);
  CHECK(shown(twin, 0x1014) == "B2 00 00 00");
  CHECK(shown(twin, 0x1017) == "FA 00");
}

TEST_CASE("What cannot be served is remarked") {
  CHECK(remarks_of(twin_of("[OptionalObjects]\nSupportedObjects=1\n1=0x1017\n")) ==
        std::vector<std::string>{
            "3:3 1017h: the object is listed, but no section describes it; it does not exist"});
  CHECK(remarks_of(twin_of(record("2000"))).size() == 1);
  CHECK(remarks_of(twin_of("[2000]\nObjectType=0\n")).size() == 1);
  CHECK(remarks_of(twin_of("[2000]\nObjectType=3\nDataType=5\nAccessType=ro\n")).size() == 1);
  CHECK(remarks_of(twin_of(entry("1014", u32, "rw", "0x20000085"))).size() == 1);
  // PDOs are served with 29 bits, also where the lower 11 are 0.
  CHECK(remarks_of(twin_of(record("1800") + entry("1800sub0", u8, "const", "1") +
                           entry("1800sub1", u32, "rw", "0x20018000")))
            .empty());
  CHECK(remarks_of(twin_of(entry("1014", u32, "rw", "0"))).size() == 1);
  CHECK(remarks_of(twin_of(entry("1014", u32, "rw", "0x80000000"))).empty());
  CHECK(remarks_of(twin_of(entry("2000", u8, "rw", "0", "LowLimit=5\nHighLimit=4\n"))) ==
        std::vector<std::string>{"7:10 2000h:00: LowLimit is above HighLimit; both are ignored"});
  CHECK(
      remarks_of(twin_of(entry("2000", u8, "rw", "0", "HighLimit=256\n"))) ==
      std::vector<std::string>{"7:11 2000h:00: HighLimit '256' is no value of the data type and is ignored"});
  CHECK(remarks_of(twin_of(entry("2000", "0x0009", "rw", "", "HighLimit=20\n"))).size() == 1);
  // The 200 entries that repeat it make one remark.
  CHECK(remarks_of(twin_of("[2000]\nObjectType=8\nDataType=5\nAccessType=rw\nDefaultValue=x\n"
                           "CompactSubObj=200\n"))
            .size() == 1);
}

TEST_CASE("No file makes the twin hold more than it may") {
  std::string text;
  for (int index = 0x2000; index < 0x2400; ++index)
    text += "[" + conform::hex(static_cast<std::uint64_t>(index), 4).substr(0, 4) +
            "]\nObjectType=8\nDataType=5\nAccessType=rw\nCompactSubObj=254\n";
  CHECK_FALSE(make_twin(*describe(text), 5).has_value());
  const Twin cut = twin_of(entry("2000", "0x0009", "ro", std::string(70'000, 'x')));
  CHECK(only(cut).value.size() == 65'536);
  CHECK(cut.remarks.all().size() == 1);
  std::string domains;
  for (int index = 0x2000; index < 0x2100; ++index)
    domains += entry(conform::hex(static_cast<std::uint64_t>(index), 4).substr(0, 4), "0x000F", "rw", "");
  CHECK(twin_of(domains).objects.at(0x20FF).entries.at(0).max_size == 262'144);
}

TEST_CASE("The twin of the node's own description has its entries") {
  Bench own;
  const Twin twin = twin_of(eds_text());
  CHECK(twin.remarks.all().empty());
  REQUIRE(twin.objects.size() == own.node().dictionary().objects().size());
  for (const auto& [index, object] : own.node().dictionary().objects()) {
    const Object& other = twin.objects.at(index);
    CHECK(other.kind == object.kind);
    REQUIRE(other.entries.size() == object.entries.size());
    for (const auto& [sub, entry] : object.entries) {
      CAPTURE(index, sub);
      const Entry& same = other.entries.at(sub);
      CHECK(same.name == entry.name);
      CHECK(same.type == entry.type);
      CHECK(same.access == entry.access);
      CHECK(same.rx_mappable == entry.rx_mappable);
      CHECK(same.tx_mappable == entry.tx_mappable);
      if (index < 0x1200 || index > 0x12FF) {  // the rule of the node-ID of a partner is not in the file
        CHECK(same.low == entry.low);
        CHECK(same.high == entry.high);
      }
      const bool written = entry.type != DataType::domain && entry.type != DataType::unicode_string &&
                           entry.type != DataType::time_of_day && entry.type != DataType::time_difference;
      if (written && entry.read == nullptr) CHECK(same.value == entry.default_value);
    }
  }
}
