// SPDX-License-Identifier: Apache-2.0
// The twin on the bus: the services of what its description tells of, and none of the others.
#include <algorithm>

#include "defects/defect.hpp"
#include "node/tests/bench.hpp"
#include "twin/tests/twin_text.hpp"
#include "variants/variant.hpp"

using namespace refnode;
using namespace refnode::testing;

namespace {

Bench::Wanted described(const std::string& text, std::vector<std::string> defects = {},
                        std::vector<std::string> variants = {}) {
  Options options;
  options.node_id = 5;
  options.defects = std::move(defects);
  options.variants = std::move(variants);
  options.description = describe(text);
  return {std::move(options)};
}

const std::string identity = entry("1000", u32, "ro", "0x191") + entry("1001", u8, "ro", "") +
                             record("1018") + entry("1018sub0", u8, "const", "1") +
                             entry("1018sub1", u32, "ro", "0x5AFE");

/// Four bytes each, outputs and inputs.
const std::string process = entry("6200", u32, "rww", "0", mapped) + entry("6000", u32, "rwr", "7", mapped) +
                            entry("6100", u16, "ro", "0x1234", mapped);

const std::string no_object = "00 00 02 06";

}  // namespace

TEST_CASE("What the file does not describe does not exist, and its service is off") {
  Bench bench(described(entry("1000", u32, "ro", "0x191")));
  CHECK(bench.wait(100ms) == Frames{"705: 00"});
  CHECK(bench.sdo("40 00 10 00 00 00 00 00") == "43 00 10 00 91 01 00 00");
  for (const char* index : {"01 10", "03 10", "05 10", "10 10", "14 10", "16 10", "17 10", "18 10", "00 12",
                            "01 12", "00 14", "00 18", "00 20", "00 2F", "00 60"}) {
    CAPTURE(index);
    CHECK(bench.sdo("40 " + std::string(index) + " 00 00 00 00 00") ==
          "80 " + std::string(index) + " 00 " + no_object);
  }
  bench.send("000: 01 05");
  // An RPDO too short and a SYNC with data would be errors; without heartbeat nothing comes by itself.
  CHECK(bench.send("205:\n080: 01\n085: 00\n100: 00 00 00 00 00 00").empty());
  CHECK(bench.wait(10s).empty());
  CHECK(bench.send("000: 81 05").empty());
  CHECK(bench.wait(100ms) == Frames{"705: 00"});
}

TEST_CASE("Access and limits of the file are kept") {
  Bench bench(described(identity + entry("2000", "0x0003", "rw", "0", "LowLimit=-5\nHighLimit=0x0005\n") +
                        entry("2001", "0x0008", "rw", "0", "LowLimit=-1.5\nHighLimit=1.5\n") +
                        entry("2002", "0x001B", "rw", "0", "HighLimit=0x8000000000000000\n") +
                        entry("2003", u8, "rw", "0", "LowLimit=300\nHighLimit=9\n") +
                        entry("2004", u8, "wo", "3") + entry("2005", u8, "const", "3") +
                        entry("2006", "0x0001", "rw", "0") + entry("1F50", u8, "wo", "0")));
  bench.wait(100ms);
  CHECK(bench.sdo("2B 00 20 00 05 00 00 00") == "60 00 20 00 00 00 00 00");
  CHECK(bench.sdo("2B 00 20 00 06 00 00 00") == "80 00 20 00 31 00 09 06");
  CHECK(bench.sdo("2B 00 20 00 FA FF 00 00") == "80 00 20 00 32 00 09 06");
  CHECK(bench.sdo("23 01 20 00 00 00 C0 3F") == "60 01 20 00 00 00 00 00");
  CHECK(bench.sdo("23 01 20 00 00 00 C8 3F") == "80 01 20 00 31 00 09 06");
  CHECK(bench.sdo("23 01 20 00 00 00 C8 BF") == "80 01 20 00 32 00 09 06");
  bench.sdo("21 02 20 00 08 00 00 00");
  CHECK(bench.sdo("00 00 00 00 00 00 00 00") == "20 00 00 00 00 00 00 00");
  CHECK(bench.sdo("1D 80 00 00 00 00 00 00") == "30 00 00 00 00 00 00 00");
  bench.sdo("21 02 20 00 08 00 00 00");
  bench.sdo("00 01 00 00 00 00 00 00");
  CHECK(bench.sdo("1D 80 00 00 00 00 00 00") == "80 02 20 00 31 00 09 06");
  CHECK(bench.sdo("2F 03 20 00 09 00 00 00") == "60 03 20 00 00 00 00 00");  // no value can be below 300
  CHECK(bench.sdo("2F 03 20 00 0A 00 00 00") == "80 03 20 00 31 00 09 06");
  CHECK(bench.sdo("40 04 20 00 00 00 00 00") == "80 04 20 00 01 00 01 06");
  CHECK(bench.sdo("2F 05 20 00 03 00 00 00") == "80 05 20 00 02 00 01 06");
  CHECK(bench.sdo("2F 06 20 00 02 00 00 00") == "80 06 20 00 31 00 09 06");
  CHECK(bench.sdo("2F 50 1F 00 07 00 00 00") == "60 50 1F 00 00 00 00 00");
  CHECK(bench.node().dictionary().number(0x1F50, 0) == 7);
}

TEST_CASE("A device that is described as it should not be is as described") {
  Bench bench(described(entry("1000", u32, "rw", "0x191") + record("1018") +
                        entry("1018sub0", u8, "rw", "9") + entry("1001", u32, "ro", "")));
  bench.wait(100ms);
  CHECK(bench.sdo("23 00 10 00 01 00 00 00") == "60 00 10 00 00 00 00 00");
  CHECK(bench.sdo("40 00 10 00 00 00 00 00") == "43 00 10 00 01 00 00 00");
  CHECK(bench.sdo("40 18 10 00 00 00 00 00") == "4F 18 10 00 09 00 00 00");
  CHECK(bench.sdo("40 01 10 00 00 00 00 00") == "43 01 10 00 00 00 00 00");
}

TEST_CASE("An identity without values of its own is that of DeviceInfo") {
  const std::string info =
      "[DeviceInfo]\nVendorNumber=0x1234\nProductNumber=77\nRevisionNumber=0x00010002\n\n";
  const std::string object = record("1018") + entry("1018sub0", u8, "const", "4");
  const auto number = [](const std::string& text, std::uint8_t sub) {
    const auto twin = twin_of(text);
    CHECK(twin.remarks.all().empty());
    return twin.objects.at(0x1018).entries.at(sub).number();
  };
  std::string silent = info + object, own = info + object;
  for (const char* sub : {"1", "2", "3", "4"}) {
    silent += entry("1018sub" + std::string(sub), u32, "ro", "");
    own += entry("1018sub" + std::string(sub), u32, "ro", std::string("9") + sub);
  }
  CHECK(number(silent, 1) == 0x1234);
  CHECK(number(silent, 2) == 77);
  CHECK(number(silent, 3) == 0x0001'0002);
  CHECK(number(silent, 4) == 0);  // each device has its own serial number
  CHECK(number(own, 1) == 91);
  CHECK(number(own, 3) == 93);
  CHECK(number(object + entry("1018sub1", u32, "ro", ""), 1) == 0);
}

TEST_CASE("PDOs that CompactPDO implies can be mapped and carry what is mapped") {
  const auto info = [](const std::string& granularity) {
    return "[DeviceInfo]\nCompactPDO=0x03\nNrOfRXPDO=1\nNrOfTXPDO=0\n" + granularity + "\n";
  };
  const auto last = [&](const std::string& granularity) {
    return twin_of(info(granularity) + identity).objects.at(0x1600).entries.rbegin()->first;
  };
  CHECK(last("Granularity=16\n") == 4);
  CHECK(last("Granularity=1\n") == 64);
  CHECK(last("Granularity=0\n") == 8);
  CHECK(last("") == 8);
  Bench bench(described(info("Granularity=8\n") + identity + process));
  bench.wait(100ms);
  CHECK(bench.sdo("40 00 16 00 00 00 00 00") == "4F 00 16 00 00 00 00 00");
  CHECK(bench.sdo("23 00 14 01 05 02 00 80") == "60 00 14 01 00 00 00 00");
  CHECK(bench.sdo("23 00 16 01 20 00 00 62") == "60 00 16 01 00 00 00 00");
  CHECK(bench.sdo("2F 00 16 00 01 00 00 00") == "60 00 16 00 00 00 00 00");
  CHECK(bench.sdo("23 00 14 01 05 02 00 00") == "60 00 14 01 00 00 00 00");
  bench.send("000: 01 05");
  bench.send("205: 11 22 33 44");
  CHECK(bench.sdo("40 00 62 00 00 00 00 00") == "43 00 62 00 11 22 33 44");
}

TEST_CASE("LSS is there where the description says so, and moves what adds the node-ID, nothing else") {
  const auto text = identity + entry("1014", u32, "rw", "$NODEID+0x80") + entry("1200", u32, "ro", "0x605");
  Bench without(described(text));
  without.wait(100ms);
  CHECK(without.send("7E5: 04 01 00 00 00 00 00 00\n7E5: 5E 00 00 00 00 00 00 00").empty());
  Bench bench(described(text + "[DeviceInfo]\nLSS_Supported=1\n"));
  bench.wait(100ms);
  bench.send("7E5: 04 01 00 00 00 00 00 00\n7E5: 11 07 00 00 00 00 00 00\n000: 82 05");
  CHECK(bench.wait(100ms) == Frames{"707: 00"});
  CHECK(bench.send("607: 40 14 10 00 00 00 00 00") == Frames{"587: 43 14 10 00 87 00 00 00"});
  CHECK(bench.send("607: 40 18 10 01 00 00 00 00") == Frames{"587: 43 18 10 01 FE 5A 00 00"});
}

TEST_CASE("Any number of PDOs is served") {
  std::string text = identity + process + entry("1005", u32, "rw", "0x80");
  for (const char* number : {"00", "03", "25"})
    text += pdo(number, false, "0x80000000", "0x62000020") + pdo(number, true, "0xC0000000", "0x60000020");
  text +=
      pdo("FF", false, "$NODEID+0x300", "0x62000020") + pdo("01", true, "$NODEID+0x40000280", "0x60000020");
  Bench bench(described(text));
  bench.wait(100ms);
  CHECK(bench.sdo("23 25 14 01 10 03 00 00") == "60 25 14 01 00 00 00 00");
  CHECK(bench.sdo("23 25 18 01 90 02 00 40") == "60 25 18 01 00 00 00 00");
  bench.send("000: 01 05");
  CHECK(bench.send("305: 11 22 33 44").empty());
  CHECK(bench.sdo("40 00 62 00 00 00 00 00") == "43 00 62 00 11 22 33 44");
  bench.send("310: 55 66 77 88");
  CHECK(bench.sdo("40 00 62 00 00 00 00 00") == "43 00 62 00 55 66 77 88");
  // What an input is said to be can be changed by SDO, and both event-driven TPDOs tell of it.
  CHECK(bench.send("605: 23 00 60 00 08 00 00 00") ==
        Frames{"285: 08 00 00 00", "290: 08 00 00 00", "585: 60 00 60 00 00 00 00 00"});
  CHECK(bench.sdo("40 26 14 00 00 00 00 00") == "80 26 14 00 " + no_object);
}

TEST_CASE(
    "PDOs that begin with identifiers of 29 bits are served with 29 bits, and with 11 where they get them") {
  Bench bench(described(identity + process + pdo("00", false, "0x20018105", "0x62000020") +
                        pdo("00", true, "0x60018205", "0x60000020")));
  bench.wait(100ms);
  bench.send("000: 01 05");
  bench.send("105: 11 22 33 44");
  CHECK(bench.sdo("40 00 62 00 00 00 00 00") == "43 00 62 00 00 00 00 00");
  bench.send_extended("18105: 11 22 33 44");
  CHECK(bench.take().empty());
  CHECK(bench.sdo("40 00 62 00 00 00 00 00") == "43 00 62 00 11 22 33 44");
  CHECK(bench.send("605: 23 00 60 00 08 00 00 00") ==
        Frames{"ext 18205: 08 00 00 00", "585: 60 00 60 00 00 00 00 00"});
  CHECK(bench.sdo("23 00 18 01 05 82 01 E0") == "60 00 18 01 00 00 00 00");
  CHECK(bench.sdo("23 00 18 01 A0 06 00 C0") == "60 00 18 01 00 00 00 00");
  CHECK(bench.sdo("23 00 18 01 A0 06 00 40") == "60 00 18 01 00 00 00 00");
  CHECK(bench.send("605: 23 00 60 00 09 00 00 00") ==
        Frames{"6A0: 09 00 00 00", "585: 60 00 60 00 00 00 00 00"});
}

TEST_CASE("A static mapping works and cannot be changed, a PDO without mapping does nothing") {
  Bench bench(described(identity + process + pdo("00", true, "$NODEID+0x40000180", "0x61000010", "const") +
                        record("1801") + entry("1801sub0", u8, "ro", "2") +
                        entry("1801sub1", u32, "rw", "$NODEID+0x40000280") +
                        entry("1801sub2", u8, "rw", "1") + entry("1005", u32, "const", "0x80")));
  bench.wait(100ms);
  CHECK(bench.sdo("2F 00 1A 00 00 00 00 00") == "80 00 1A 00 02 00 01 06");
  CHECK(bench.sdo("23 00 18 01 85 01 00 C0") == "80 00 18 01 02 00 01 06");
  bench.send("000: 01 05");
  CHECK(bench.send("080:").empty());
  CHECK(bench.sdo("2F 01 18 02 01 00 00 00") == "60 01 18 02 00 00 00 00");
}

TEST_CASE("BOOLEANs are mapped bit by bit") {
  std::string text = identity;
  for (const char* sub : {"1", "2", "3"}) {
    text += entry("2000sub" + std::string(sub), "0x0001", "rww", "0", mapped) +
            entry("2001sub" + std::string(sub), "0x0001", "rwr", std::string(sub) == "2" ? "1" : "0", mapped);
  }
  text += record("2000") + record("2001") + record("1400") + entry("1400sub1", u32, "rw", "$NODEID+0x200") +
          entry("1400sub2", u8, "rw", "0xFF") + record("1600") + entry("1600sub0", u8, "rw", "3") +
          entry("1600sub1", u32, "rw", "0x20000101") + entry("1600sub2", u32, "rw", "0x20000201") +
          entry("1600sub3", u32, "rw", "0x20000301") + record("1800") +
          entry("1800sub1", u32, "rw", "$NODEID+0x180") + entry("1800sub2", u8, "rw", "0xFF") +
          record("1A00") + entry("1A00sub0", u8, "rw", "3") + entry("1A00sub1", u32, "rw", "0x20010101") +
          entry("1A00sub2", u32, "rw", "0x20010201") + entry("1A00sub3", u32, "rw", "0x20010301");
  Bench bench(described(text));
  bench.wait(100ms);
  bench.send("000: 01 05");
  CHECK(bench.send("605: 2F 01 20 03 01 00 00 00") == Frames{"185: 06", "585: 60 01 20 03 00 00 00 00"});
  bench.send("205: 05");
  CHECK(bench.sdo("40 00 20 01 00 00 00 00") == "4F 00 20 01 01 00 00 00");
  CHECK(bench.sdo("40 00 20 02 00 00 00 00") == "4F 00 20 02 00 00 00 00");
  CHECK(bench.sdo("40 00 20 03 00 00 00 00") == "4F 00 20 03 01 00 00 00");
}

TEST_CASE("An RPDO takes the placeholders of DummyUsage, and no others") {
  Bench bench(described("[DummyUsage]\nDummy0005=1\nDummy0006=0\n\n" + identity + process +
                        pdo("00", false, "$NODEID+0x80000200", "0")));
  bench.wait(100ms);
  bench.sdo("2F 00 16 00 00 00 00 00");
  CHECK(bench.sdo("23 00 16 01 08 00 05 00") == "60 00 16 01 00 00 00 00");
  CHECK(bench.sdo("23 00 16 01 10 00 06 00") == "80 00 16 01 " + no_object);
}

TEST_CASE("Without 1005h no PDO can be made synchronous") {
  Bench bench(described(identity + process + pdo("00", true, "$NODEID+0xC0000180", "0x60000020")));
  bench.wait(100ms);
  CHECK(bench.sdo("2F 00 18 02 01 00 00 00") == "80 00 18 02 30 00 09 06");
  CHECK(bench.sdo("2F 00 18 02 FE 00 00 00") == "60 00 18 02 00 00 00 00");
}

TEST_CASE("Errors are reported as far as there are objects for it") {
  const std::string history = record("1003") + entry("1003sub0", u8, "rw", "0") +
                              entry("1003sub1", u32, "ro", "") + entry("1003sub2", u32, "ro", "");
  const std::string rpdo = pdo("02", false, "$NODEID+0x400", "0x62000020") +
                           pdo("03", false, "$NODEID+0x500", "0x62000020") + process;
  const std::string cob_id = entry("1014", u32, "rw", "$NODEID+0x80");
  SECTION("EMCY, register and a history as deep as it is described") {
    Bench bench(described(identity + history + rpdo + cob_id + entry("1005", u32, "rw", "0x80")));
    bench.wait(100ms);
    bench.send("000: 01 05");
    CHECK(bench.send("405: 01") == Frames{"085: 10 82 11 01 02 00 00 00"});
    CHECK(bench.send("505: 01 02") == Frames{"085: 10 82 11 02 02 00 00 00"});
    CHECK(bench.send("080: 01") == Frames{"085: 40 82 11 01 03 00 00 00"});
    CHECK(bench.sdo("40 01 10 00 00 00 00 00") == "4F 01 10 00 11 00 00 00");
    CHECK(bench.sdo("40 03 10 00 00 00 00 00") == "4F 03 10 00 02 00 00 00");
    CHECK(bench.sdo("40 03 10 01 00 00 00 00") == "43 03 10 01 40 82 01 03");
    CHECK(bench.sdo("40 03 10 03 00 00 00 00") == "80 03 10 03 11 00 09 06");
    CHECK(bench.send("405: 01 02 03 04\n080:").empty());
    CHECK(bench.send("505: 01 02 03 04") == Frames{"085: 00 00 00 00 02 00 00 00"});
    CHECK(bench.sdo("2F 03 10 00 00 00 00 00") == "60 03 10 00 00 00 00 00");
    CHECK(bench.sdo("40 03 10 00 00 00 00 00") == "4F 03 10 00 00 00 00 00");
  }
  SECTION("no EMCY without 1014h") {
    Bench bench(described(identity + history + rpdo));
    bench.wait(100ms);
    bench.send("000: 01 05");
    CHECK(bench.send("405: 01").empty());
    CHECK(bench.sdo("40 01 10 00 00 00 00 00") == "4F 01 10 00 11 00 00 00");
    CHECK(bench.sdo("40 03 10 00 00 00 00 00") == "4F 03 10 00 01 00 00 00");
  }
  SECTION("no EMCY on the CAN-ID of NMT") {
    Bench bench(described(identity + rpdo + entry("1014", u32, "rw", "0")));
    bench.wait(100ms);
    bench.send("000: 01 05");
    CHECK(bench.send("405: 01").empty());
  }
}

TEST_CASE("Heartbeats are produced and consumed as described") {
  std::string text = identity + entry("1017", u16, "ro", "200") + entry("1014", u32, "ro", "$NODEID+0x80") +
                     record("1016") + entry("1016sub0", u8, "ro", "7");
  for (const char* sub : {"1", "2", "3", "4", "5", "6", "7"})
    text += entry("1016sub" + std::string(sub), u32, "rw", "0");
  Bench bench(described(text));
  CHECK(bench.wait(500ms, true) == Frames{"@20 705: 00", "@220 705: 7F", "@420 705: 7F"});
  CHECK(bench.sdo("2B 17 10 00 00 00 00 00") == "80 17 10 00 02 00 01 06");
  CHECK(bench.sdo("23 16 10 07 64 00 09 00") == "60 16 10 07 00 00 00 00");
  CHECK(bench.sdo("23 16 10 01 C8 00 09 00") == "80 16 10 01 43 00 04 06");
  bench.send("709: 05");
  CHECK(bench.wait(110ms, true) == Frames{"@600 085: 30 81 11 09 01 00 00 00"});
  CHECK(bench.send("709: 05") == Frames{"085: 00 00 00 00 01 00 00 00"});
}

TEST_CASE("Each SDO server that is described has a channel of its own") {
  std::string text = identity + entry("2000", u8, "rw", "7");
  for (const char* index : {"1201", "1203", "127F"}) {
    text += record(index) + entry(index + std::string("sub0"), u8, "ro", "2") +
            entry(index + std::string("sub1"), u32, "rw", "0x80000000") +
            entry(index + std::string("sub2"), u32, "rw", "0x80000000");
  }
  Bench bench(described(text));
  bench.wait(100ms);
  bench.sdo("23 7F 12 01 A0 06 00 00");
  bench.sdo("23 7F 12 02 A1 06 00 00");
  CHECK(bench.sdo("23 7F 12 02 A2 06 00 00") == "80 7F 12 02 30 00 09 06");
  CHECK(bench.send("6A0: 40 00 20 00 00 00 00 00") == Frames{"6A1: 4F 00 20 00 07 00 00 00"});
  CHECK(bench.sdo("40 02 12 01 00 00 00 00") == "80 02 12 01 " + no_object);
}

TEST_CASE("Parameters are stored and restored where 1010h and 1011h say so") {
  const auto storage = std::make_shared<MemoryStorage>();
  const std::string text = identity + record("1010") + entry("1010sub0", u8, "const", "2") +
                           entry("1010sub1", u32, "rw", "1", "LowLimit=0x65766173\nHighLimit=0x65766173\n") +
                           entry("1010sub2", u32, "rw", "0") + record("1011") +
                           entry("1011sub1", u32, "rw", "") + entry("2000", u8, "rw", "7");
  auto wanted = described(text);
  wanted.options.storage = storage;
  Bench bench(std::move(wanted));
  bench.wait(100ms);
  bench.sdo("2F 00 20 00 09 00 00 00");
  CHECK(bench.sdo("23 10 10 01 6C 6F 61 64") == "80 10 10 01 20 00 00 08");
  CHECK(bench.sdo("23 10 10 02 73 61 76 65") == "80 10 10 02 20 00 00 08");
  CHECK(bench.sdo("23 10 10 01 73 61 76 65") == "60 10 10 01 00 00 00 00");
  CHECK(bench.sdo("40 11 10 01 00 00 00 00") == "43 11 10 01 01 00 00 00");
  bench.sdo("2F 00 20 00 0A 00 00 00");
  bench.send("000: 81 05");
  bench.wait(100ms);
  CHECK(bench.sdo("40 00 20 00 00 00 00 00") == "4F 00 20 00 09 00 00 00");
  CHECK(bench.sdo("23 11 10 01 6C 6F 61 64") == "60 11 10 01 00 00 00 00");
  bench.send("000: 81 05");
  bench.wait(100ms);
  CHECK(bench.sdo("40 00 20 00 00 00 00 00") == "4F 00 20 00 07 00 00 00");
}

TEST_CASE("Where 1010h says so, parameters are stored without a command") {
  Bench bench(described(identity + record("1010") + entry("1010sub1", u32, "rw", "0") +
                        entry("1010sub2", u32, "rw", "2") + entry("1017", u16, "rw", "0") +
                        entry("2000", u8, "rw", "7")));
  bench.wait(100ms);
  bench.sdo("2B 17 10 00 88 13 00 00");
  bench.sdo("2F 00 20 00 09 00 00 00");
  bench.wait(5s);
  bench.sdo("2B 17 10 00 10 27 00 00");  // a reset comes before this is stored
  bench.send("000: 81 05");
  bench.wait(100ms);
  CHECK(bench.sdo("40 17 10 00 00 00 00 00") == "4B 17 10 00 88 13 00 00");
  CHECK(bench.sdo("40 00 20 00 00 00 00 00") == "4F 00 20 00 07 00 00 00");
}

TEST_CASE("A TPDO with a SYNC start value begins at the SYNC of this counter") {
  Bench bench(described(identity + process + entry("1005", u32, "rw", "0x80") + entry("1019", u8, "rw", "8") +
                        entry("1014", u32, "rw", "$NODEID+0x80") +
                        pdo("00", true, "$NODEID+0xC0000180", "0x60000020") +
                        entry("1800sub6", u8, "rw", "0")));
  bench.wait(100ms);
  CHECK(bench.sdo("2F 00 18 02 02 00 00 00") == "60 00 18 02 00 00 00 00");
  CHECK(bench.sdo("2F 00 18 06 F1 00 00 00") == "80 00 18 06 30 00 09 06");
  CHECK(bench.sdo("2F 00 18 06 03 00 00 00") == "60 00 18 06 00 00 00 00");
  CHECK(bench.sdo("23 00 18 01 85 01 00 40") == "60 00 18 01 00 00 00 00");
  CHECK(bench.sdo("2F 00 18 06 04 00 00 00") == "80 00 18 06 30 00 09 06");
  bench.send("000: 01 05");
  CHECK(bench.send("080: 01\n080: 02").empty());
  CHECK(bench.send("080: 03") == Frames{"185: 07 00 00 00"});
  CHECK(bench.send("080: 04").empty());
  CHECK(bench.send("080: 05\n080: 06\n080: 07") == Frames{"185: 07 00 00 00", "185: 07 00 00 00"});
  CHECK(bench.send("080:") == Frames{"085: 40 82 11 00 03 00 00 00"});
}

TEST_CASE("Objects at the indices of the node's own extras are plain data") {
  Bench bench(described(identity + entry("1012", u32, "rw", "0x80000100") + entry("2F10", u8, "rw", "1") +
                        entry("2F20", u8, "rw", "1") + entry("2F00", u16, "rw", "1") +
                        entry("6000", u8, "ro", "3") + entry("6200", u8, "rw", "4") + record("1010") +
                        entry("1010sub1", u32, "rw", "1")));
  bench.wait(100ms);
  bench.send("100: 01 02 03 04 05 06");
  CHECK(bench.sdo("40 10 2F 00 00 00 00 00") == "4F 10 2F 00 01 00 00 00");
  CHECK(bench.sdo("2B 00 2F 00 10 42 00 00") == "60 00 2F 00 00 00 00 00");
  CHECK(bench.sdo("23 10 10 01 73 61 76 65") == "60 10 10 01 00 00 00 00");
  CHECK(bench.sdo("40 00 60 00 00 00 00 00") == "4F 00 60 00 03 00 00 00");
}

TEST_CASE("Every defect and every variant can be had with any twin") {
  const std::string odd = record("1018") + record("1600") + entry("1600sub1", u32, "rw", "0x20000008") +
                          record("1A00") + record("1400") + entry("1400sub1", u32, "const", "0x205") +
                          record("1800") + record("2004") + entry("2004sub2", u8, "rw", "0") +
                          record("1010") + record("1003") + entry("1008", "0x0009", "ro", "") +
                          record("2001") + entry("2001sub4", "0x0009", "ro", "") + record("1201") +
                          record("1280") + entry("1017", "0x0009", "rw", "x");
  const std::string empty = "[DeviceInfo]\nVendorName=none\n";
  const auto live = [](Bench::Wanted wanted) {
    Bench bench(std::move(wanted));
    bench.wait(5s);
    bench.send("000: 01 05\n080:\n205: 01 02 03 04\n605: 40 18 10 01 00 00 00 00\n"
               "605: 40 01 20 04 00 00 00 00\n605: 2F 04 20 02 01 00 00 00");
    bench.wait(1s);
    bench.send("000: 82 05");
    bench.wait(100ms);
  };
  for (const std::string& text : {empty, odd, odd + identity + process}) {
    for (const Defect& row : defects()) {
      CAPTURE(row.id);
      live(described(text, {std::string(row.id)}));
    }
    for (const Variant& row : variants()) {
      CAPTURE(row.id);
      live(described(text, {}, {std::string(row.id)}));
    }
  }
}
