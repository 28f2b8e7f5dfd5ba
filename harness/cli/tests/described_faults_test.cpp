// SPDX-License-Identifier: Apache-2.0
// Mistakes of descriptions, one in each file: the suite against the twin finds that mistake with its place,
// and blames nothing else. And what looks like a mistake and is none.
#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "catch.hpp"
#include "cli/proof/selftest.hpp"
#include "device/description.hpp"
#include "eds/read.hpp"
#include "shipped.hpp"

using namespace conform;
using result::Verdict;
namespace shipped = cli::shipped;

namespace {

std::string entry(const std::string& name, int type, const std::string& access, const std::string& value,
                  const std::string& more = {}) {
  return "[" + name + "]\nParameterName=" + name + "\nDataType=" + std::to_string(type) +
         "\nAccessType=" + access + "\nDefaultValue=" + value + "\n" + more + "\n";
}
std::string record(const std::string& name) {
  return "[" + name + "]\nParameterName=" + name + "\nObjectType=9\n\n";
}

const std::string type = entry("1000", 7, "ro", "0");
const std::string error_register = entry("1001", 5, "ro", "0");
const std::string identity =
    record("1018") + entry("1018sub0", 5, "const", "1") + entry("1018sub1", 7, "ro", "0x1234");
const std::string heartbeat = entry("1017", 6, "rw", "0");
const std::string signals =
    entry("6200", 5, "rww", "0", "PDOMapping=1\n") + entry("6201", 5, "rww", "0", "PDOMapping=1\n") +
    entry("6000", 5, "ro", "0", "PDOMapping=1\n") + entry("6001", 5, "ro", "0", "PDOMapping=1\n");

result::RunResult judged(const std::string& text, const char* name = "device.eds") {
  auto file = eds::read(text, name);
  REQUIRE(file.has_value());
  auto description = device::describe(*file);
  REQUIRE(description.has_value());
  const auto held = std::make_shared<const eds::EdsFile>(std::move(*file));
  auto profile = device::default_profile(NodeId(5));
  profile.description = held;
  device::add_description(profile, std::move(*description));
  profile.writes_described = true;
  auto done = cli::simulate({.description = held}, profile, shipped::suites().suite,
                            shipped::suites().catalogue, {}, 1);
  REQUIRE(done.has_value());
  return std::move(done->result);
}

/// "OD-1000-01 device.eds, without 1000h", each requirement that failed with the place of its finding; and
/// everything that could not be judged.
std::set<std::string> blamed(const result::RunResult& run) {
  std::set<std::string> out;
  for (const auto& each : run.cases) {
    if (each.verdict == Verdict::inconclusive || each.verdict == Verdict::error)
      out.insert(std::string(to_string(each.verdict)) + " " + each.name() + ": " + each.reason);
    for (const auto& judgement : each.judgements) {
      if (judgement.verdict != Verdict::fail) continue;
      for (const auto& finding : judgement.findings)
        out.insert(judgement.requirement + " " + finding.declared_at);
    }
  }
  return out;
}

using Blamed = std::set<std::string>;

/// The worst of each requirement that was judged.
std::map<std::string, Verdict> verdicts(const result::RunResult& run) {
  std::map<std::string, Verdict> out;
  for (const auto& each : run.cases) {
    for (const auto& judgement : each.judgements) {
      const auto [place, fresh] = out.emplace(judgement.requirement, judgement.verdict);
      if (!fresh) place->second = worst(place->second, judgement.verdict);
    }
  }
  return out;
}

}  // namespace

TEST_CASE("A small right description is blamed for nothing") {
  CHECK(blamed(judged(type + error_register + identity + heartbeat + signals)) == Blamed{});
}

TEST_CASE(
    "A file without a mandatory object is blamed for the lack of it, and for nothing that rests on it") {
  CHECK(blamed(judged(error_register + identity + heartbeat + signals)) ==
        Blamed{"OD-1000-01 device.eds, without 1000h", "OD-CAT-01 device.eds, without 1000h"});
  CHECK(blamed(judged(type + identity + heartbeat + signals)) ==
        Blamed{"OD-1001-01 device.eds, without 1001h", "OD-CAT-01 device.eds, without 1001h"});
  CHECK(blamed(judged(type + error_register + heartbeat + signals)) ==
        Blamed{"OD-1018-01 device.eds, without 1018h", "OD-CAT-01 device.eds, without 1018h"});
}

TEST_CASE("A file without error control is blamed for the lack of it, in one cause") {
  const auto run = judged(type + error_register + identity + signals);
  for (const auto& line : blamed(run)) {
    CAPTURE(line);
    CHECK(line.find("device.eds, without 1017h") != std::string::npos);
  }
  CHECK(blamed(run).size() == 3);
}

TEST_CASE("The vendor-ID of DeviceInfo is that of an identity without values") {
  const std::string silent =
      record("1018") + entry("1018sub0", 5, "const", "1") + entry("1018sub1", 7, "ro", "");
  CHECK(blamed(judged("[DeviceInfo]\nVendorNumber=0x1234\n" + type + error_register + silent + heartbeat)) ==
        Blamed{});
  CHECK(blamed(judged("[DeviceInfo]\nVendorName=a\n" + type + error_register + silent + heartbeat)) ==
        Blamed{"OD-1018-03 device.eds:25"});
}

TEST_CASE("PDOs of CompactPDO work, and a mapping that is described without entries is none to be changed") {
  const std::string device = type + error_register + identity + heartbeat + signals;
  const auto compact =
      judged("[DeviceInfo]\nCompactPDO=0x03\nNrOfRXPDO=2\nNrOfTXPDO=2\nGranularity=8\n" + device);
  CHECK(blamed(compact) == Blamed{});
  CHECK(verdicts(compact).at("OD-1600-05") == Verdict::pass);
  CHECK(verdicts(compact).at("OD-1A00-05") == Verdict::pass);
  const std::string communication = record("1800") + entry("1800sub0", 5, "const", "2") +
                                    entry("1800sub1", 7, "rw", "$NODEID+0x180") +
                                    entry("1800sub2", 5, "rw", "255");
  const std::string count = record("1A00") + entry("1A00sub0", 5, "rw", "0");
  const auto bare = judged(device + communication + count);
  CHECK(blamed(bare) == Blamed{});
  CHECK_FALSE(verdicts(bare).contains("OD-1A00-05"));
  // Nor can a PDO be mapped anew that has no COB-ID to switch it off by: only the lack of that is told.
  const std::string mapping = count + entry("1A00sub1", 7, "rw", "0x60000008");
  for (const auto& line : blamed(judged(device + mapping))) {
    CAPTURE(line);
    CHECK(line.find("without 1800h") != std::string::npos);
  }
}

TEST_CASE("Entries that ObjFlags keep from being written or read leave the others to be judged") {
  const std::string device = type + error_register + identity + heartbeat;
  const auto flagged = [](const std::string& name, const std::string& access, const char* flags) {
    return entry(name, 5, access, "1", "ObjFlags=" + std::string(flags) + "\n");
  };
  std::string all;
  int index = 0x2000;
  for (const char* access : {"ro", "const", "rw", "wo"}) {
    for (const char* flags : {"1", "2", "3"})
      all += flagged(std::to_string(index++ - 0x2000 + 2100), access, flags);
  }
  const auto run =
      judged(device + all + flagged("1F70", "ro", "1") + entry("1005", 7, "rw", "0x80", "ObjFlags=1\n"));
  CHECK(blamed(run) == Blamed{});
  CHECK(verdicts(run).at("EDS-VSD-04") == Verdict::pass);
  // Program control is left alone as well.
  const auto program =
      judged(device + record("1F51") + entry("1F51sub0", 5, "ro", "1") + entry("1F51sub1", 5, "rw", "0"));
  CHECK(blamed(program) == Blamed{});
  CHECK(verdicts(program).at("EDS-VSD-04") == Verdict::pass);
}

TEST_CASE("DummyUsage decides which placeholders RPDOs are tried with") {
  const std::string device = type + error_register + identity + heartbeat + signals + record("1400") +
                             entry("1400sub0", 5, "const", "2") +
                             entry("1400sub1", 7, "rw", "$NODEID+0x200") + entry("1400sub2", 5, "rw", "255") +
                             record("1600") + entry("1600sub0", 5, "rw", "1") +
                             entry("1600sub1", 7, "rw", "0x62000008") + entry("1600sub2", 7, "rw", "0");
  for (const char* dummy : {"0", "1", "0x1"})
    CHECK(blamed(judged("[DummyUsage]\nDummy0005=" + std::string(dummy) + "\n" + device)) == Blamed{});
}

TEST_CASE("What a DCF configures is what its twin holds and what is expected of it") {
  const std::string device = "[DeviceComissioning]\nNodeID=5\n" + type + error_register + identity +
                             entry("1017", 6, "const", "0", "ParameterValue=500\n") +
                             entry("2000", 5, "const", "1", "ParameterValue=2\n");
  CHECK(blamed(judged(device, "device.dcf")) == Blamed{});
}

TEST_CASE("A finding about DeviceInfo names its line, and a twin is on a bus of a bit rate of its own") {
  const std::string device = type + error_register + identity + heartbeat;
  CHECK(blamed(judged("[DeviceInfo]\nBaudRate_125=1\nBaudRate_500=0\nNrOfRXPDO=0\n" + device)) == Blamed{});
  CHECK(blamed(judged("[DeviceInfo]\nBaudRate_500=1\nNrOfRXPDO=3\n" + device)) ==
        Blamed{"EDS-VSD-10 device.eds:3"});
}

TEST_CASE("A compact error history is cleared as one that is written out") {
  const std::string history =
      "[1003]\nParameterName=Errors\nObjectType=8\nDataType=7\nAccessType=ro\nCompactSubObj=4\n\n";
  const auto run = judged(type + error_register + history + entry("1014", 7, "rw", "$NODEID+0x80") +
                          identity + heartbeat + signals);
  CHECK(blamed(run) == Blamed{});
  CHECK(verdicts(run).at("OD-1003-05") == Verdict::pass);
}

TEST_CASE("What is found with one of many objects, or behind what was written, names the line of it") {
  const auto tpdo = [](const std::string& number, const std::string& cob_id, const std::string& mapped) {
    return record("18" + number) + entry("18" + number + "sub0", 5, "const", "5") +
           entry("18" + number + "sub1", 7, "rw", cob_id) + entry("18" + number + "sub2", 5, "rw", "1") +
           entry("18" + number + "sub5", 6, "rw", "0") + record("1A" + number) +
           entry("1A" + number + "sub0", 5, "const", "1") + entry("1A" + number + "sub1", 7, "const", mapped);
  };
  const std::string device = type + error_register + identity + heartbeat + signals;
  const std::string two =
      tpdo("00", "$NODEID+0x180", "0x60000008") + tpdo("01", "$NODEID+0x180", "0x60010008");
  const auto names_a_line = [](const std::string& line) {
    return line.starts_with("inconclusive ") || line.find(" device.eds") != std::string::npos;
  };
  const auto shared = blamed(judged(device + entry("1005", 7, "rw", "0x80") + two));
  CHECK(std::ranges::any_of(shared,
                            [](const auto& line) { return line.starts_with("PDO-TX-27 device.eds:"); }));
  CHECK(std::ranges::all_of(shared, names_a_line));
  const std::string period = entry("1006", 7, "rw", "100000", "LowLimit=10000\n");
  const auto limited = blamed(judged(device + entry("1005", 7, "rw", "0x80") + period));
  CHECK(std::ranges::any_of(limited,
                            [](const auto& line) { return line.starts_with("SYNC-PRO-03 device.eds:"); }));
  CHECK(std::ranges::all_of(limited, names_a_line));
}
