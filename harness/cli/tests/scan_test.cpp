// SPDX-License-Identifier: Apache-2.0
// The draft that a scan makes is a description: it lints clean, its twin passes the suite, and a scan of the
// twin finds what the first one found.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "can/simulated_bus.hpp"
#include "catch.hpp"
#include "cli/descriptions/draft_eds.hpp"
#include "cli/descriptions/drafted_entry.hpp"
#include "cli/descriptions/scan_compare.hpp"
#include "cli/proof/legal_variants.hpp"
#include "cli/proof/selftest.hpp"
#include "device/description.hpp"
#include "drawn_description.hpp"
#include "eds/compare.hpp"
#include "eds/lint.hpp"
#include "eds/read.hpp"
#include "engine/recorder.hpp"
#include "engine/run_session.hpp"
#include "engine/scan.hpp"
#include "node/node.hpp"
#include "shipped.hpp"

using namespace conform;
namespace shipped = cli::shipped;

namespace {

constexpr NodeId node_id{5};
using File = std::shared_ptr<const eds::EdsFile>;
using Objects = std::vector<engine::ScannedObject>;

File read_text(const std::string& text, const char* name = "draft.eds") {
  auto file = eds::read(text, name);
  REQUIRE(file.has_value());
  return std::make_shared<const eds::EdsFile>(std::move(*file));
}

engine::ScanOptions everything(steps::Tier allow = steps::Tier::read_only) {
  engine::ScanOptions what;
  what.ranges = {{0x1000, 0x1FFF}, {0x2000, 0x2FFF}, {0x6000, 0x64FF}};
  what.allow = allow;
  return what;
}

/// Of the reference node, or of a twin.
Objects scanned(const File& description, const engine::ScanOptions& what = everything()) {
  auto node = refnode::Node::create({.node_id = node_id.value(), .description = description});
  REQUIRE(node.has_value());
  can::SimulatedBus bus(can::SimulatedBus::Options{});
  bus.attach(**node, "device");
  const auto profile = device::default_profile(node_id);
  engine::Recorder recorder(bus.transport(), nullptr);
  engine::RunSession session(recorder, profile, device::dictionary_of(profile));
  REQUIRE(recorder.wait_until(recorder.now() + std::chrono::seconds(1)));
  auto objects = engine::scan(session, what);
  REQUIRE(objects.has_value());
  return std::move(*objects);
}

std::string draft(const Objects& objects, bool tried = false) {
  return cli::draft_eds(
      objects, {.file_name = "draft.eds", .node = node_id, .bit_rate = 500'000, .access_tried = tried});
}

/// What [Comments] says.
std::string comments_of(const eds::EdsFile& file) {
  std::string out;
  for (const auto& line : file.comments.entries) out += line.field.text + "\n";
  return out;
}

/// A round through a twin: every difference that the draft does not speak of, a line each.
std::string lost(const File& first, steps::Tier allow) {
  const auto again = read_text(draft(scanned(first, everything(allow)), allow > steps::Tier::read_only));
  const auto differences = eds::compare(*first, *again);
  REQUIRE(differences.has_value());
  const auto said = comments_of(*first);
  std::string out;
  for (const auto& each : *differences) {
    const auto entry = each.where.find(':') == std::string::npos ? each.where + ":00" : each.where;
    if (said.find(entry) == std::string::npos)
      out += fmt::format("{} {}: {} -> {}\n", each.where, each.key, each.before, each.after);
  }
  return out;
}

/// What lint says, without the rules that `device` breaks already: an odd device has an odd draft.
std::string findings_of(const eds::EdsFile& file, const eds::EdsFile* device = nullptr) {
  std::set<std::string_view> known;
  if (device != nullptr) {
    for (const auto& finding : eds::lint(*device).findings) known.insert(finding.rule->code);
  }
  std::string out;
  for (const auto& finding : eds::lint(file).findings) {
    // Notes are about what the device chose, like a default of its own.
    if (finding.severity() > eds::Severity::note && !known.contains(finding.rule->code))
      out += fmt::format("{} {}\n", finding.rule->code, finding.message);
  }
  return out;
}

/// Everything that is neither passed nor not applicable in the twin of the file.
std::string complaints(const File& file) {
  auto description = device::describe(*file);
  REQUIRE(description.has_value());
  auto profile = device::default_profile(node_id);
  profile.description = file;
  device::add_description(profile, std::move(*description));
  profile.writes_described = true;
  const auto done = cli::simulate({.description = file}, profile, shipped::suites().suite,
                                  shipped::suites().catalogue, {}, 1);
  REQUIRE(done.has_value());
  std::string out;
  for (const auto& each : cli::complaints_of(done->result, {})) out += each.what + "\n";
  return out;
}

std::vector<std::string> differences(const Objects& objects, const std::string& text,
                                     const engine::ScanOptions& what = everything()) {
  const auto file = read_text(text, "device.eds");
  const auto description = device::describe(*file);
  REQUIRE(description.has_value());
  std::vector<std::string> out;
  for (const auto& row : cli::compare_scan(objects, what, *file, *description, node_id))
    out.push_back(row.object + "|" + row.property + "|" + row.device + "|" + row.described + "|" + row.where);
  return out;
}

engine::ScannedEntry entry(std::uint16_t index, std::uint8_t sub, Bytes value) {
  engine::ScannedEntry out;
  out.mux = {Index(index), SubIndex(sub)};
  out.value = std::move(value);
  return out;
}

}  // namespace

TEST_CASE("The draft of the reference node lints clean, and a scan of its twin finds the same") {
  for (const auto allow : {steps::Tier::read_only, steps::Tier::motion}) {
    const auto file = read_text(draft(scanned(nullptr, everything(allow)), allow > steps::Tier::read_only));
    CHECK(findings_of(*file) == "");
    CHECK(lost(file, allow) == "");
  }
}

TEST_CASE("Drafts of drawn devices lint clean, come back from their twins, and the twins pass") {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    CAPTURE(seed);
    const auto device = read_text(cli::draw_description(seed), "drawn.eds");
    CHECK(findings_of(*read_text(draft(scanned(device))), device.get()) == "");
    const auto file = read_text(draft(scanned(device, everything(steps::Tier::motion)), true));
    CHECK(findings_of(*file, device.get()) == "");
    CHECK(lost(file, steps::Tier::motion) == "");
    CHECK(complaints(file) == "");
  }
}

TEST_CASE("A scan that may write sees what is read-only, and changes nothing") {
  const std::string text = "[2000]\nParameterName=a\nDataType=5\nAccessType=ro\nDefaultValue=7\n"
                           "[2001]\nParameterName=b\nDataType=5\nAccessType=rw\nDefaultValue=8\n"
                           "[1017]\nParameterName=c\nDataType=6\nAccessType=const\nDefaultValue=500\n"
                           "[1000]\nParameterName=d\nDataType=7\nAccessType=ro\nDefaultValue=0\n";
  const auto device = read_text(text, "device.eds");
  const auto written = [&](steps::Tier allow) {
    std::string out;
    for (const auto& object : scanned(device, everything(allow))) {
      const auto& head = object.entries.front();
      out += !head.writable ? '?' : *head.writable ? 'w' : 'r';
    }
    return out;  // 1000h, 1017h, 2000h, 2001h
  };
  CHECK(written(steps::Tier::read_only) == "????");
  CHECK(written(steps::Tier::config) == "rr??");
  CHECK(written(steps::Tier::motion) == "rrrw");
}

TEST_CASE("Mapping entries above the count are in the draft, with the values that they hold") {
  const std::string text = "[1A00]\nParameterName=Mapping\nObjectType=9\nSubNumber=4\n"
                           "[1A00sub0]\nParameterName=n\nDataType=5\nAccessType=rw\nDefaultValue=1\n"
                           "[1A00sub1]\nParameterName=1\nDataType=7\nAccessType=rw\nDefaultValue=0x20000008\n"
                           "[1A00sub2]\nParameterName=2\nDataType=7\nAccessType=rw\nDefaultValue=0x20010008\n"
                           "[1A00sub3]\nParameterName=3\nDataType=7\nAccessType=rw\nDefaultValue=0\n"
                           "[2000]\nParameterName=a\nDataType=5\nAccessType=ro\nPDOMapping=1\n"
                           "[2001]\nParameterName=b\nDataType=5\nAccessType=ro\nPDOMapping=1\n";
  const auto file = read_text(draft(scanned(read_text(text, "device.eds"))));
  const auto* mapping = file->find(Index(0x1A00));
  REQUIRE(mapping != nullptr);
  REQUIRE(mapping->subs.size() == 4);
  CHECK(mapping->subs[0].entry.default_value.text == "0x1");
  CHECK(mapping->subs[0].entry.access_type.text == "rw");
  CHECK(mapping->subs[2].entry.default_value.text == "0x20010008");
  CHECK(mapping->subs[2].entry.access_type.text == "rw");
}

TEST_CASE("A draft says of which numbers only the length is known, and takes one bit for a BOOLEAN") {
  const Objects objects = {
      {Index(0x1600), {entry(0x1600, 0, {1}), entry(0x1600, 1, {0x01, 0x00, 0x01, 0x20})}},
      {Index(0x2000),
       {entry(0x2000, 0, {2}), entry(0x2000, 1, {1, 0, 0, 0}), entry(0x2000, 2, {1, 0, 0, 0})}},
      {Index(0x2001), {entry(0x2001, 0, {1})}},
      {Index(0x2002), {entry(0x2002, 0, {'a', 'b', 'c', 'd', 'e'})}},
  };
  const auto file = read_text(draft(objects));
  CHECK(comments_of(*file).find("2000h:01-02\n") != std::string::npos);
  CHECK(file->find(Multiplexer{Index(0x2001), SubIndex(0)})->data_type.text == "0x0001");
  CHECK(file->find(Multiplexer{Index(0x2002), SubIndex(0)})->default_value.text == "abcde");
}

TEST_CASE("A COB-ID that holds the node-ID is a formula, whatever its upper bits are") {
  const Objects objects = {
      {Index(0x1800),
       {entry(0x1800, 0, {2}), entry(0x1800, 1, {0x85, 0x01, 0x00, 0xC0}), entry(0x1800, 2, {0xFF})}},
      {Index(0x1801),
       {entry(0x1801, 0, {2}), entry(0x1801, 1, {0x86, 0x02, 0x00, 0x40}), entry(0x1801, 2, {0xFF})}}};
  const auto file = read_text(draft(objects));
  CHECK(file->find(Multiplexer{Index(0x1800), SubIndex(1)})->default_value.text == "$NODEID+0xC0000180");
  CHECK(file->find(Multiplexer{Index(0x1801), SubIndex(1)})->default_value.text == "0x40000286");
}

TEST_CASE("A comparison names the object, the property, both values and the line") {
  const std::string right =
      "[DeviceInfo]\nVendorNumber=0x1234\nNrOfRXPDO=0\n"
      "[1000]\nParameterName=d\nDataType=7\nAccessType=ro\nDefaultValue=0x191\n"
      "[1018]\nParameterName=i\nObjectType=9\nSubNumber=2\n"
      "[1018sub0]\nParameterName=n\nDataType=5\nAccessType=const\nDefaultValue=1\n"
      "[1018sub1]\nParameterName=v\nDataType=7\nAccessType=ro\nDefaultValue=0x1234\n"
      "[2000]\nParameterName=a\nDataType=5\nAccessType=ro\nDefaultValue=7\n"
      "[2001]\nParameterName=b\nDataType=3\nAccessType=rw\nDefaultValue=-5\nLowLimit=-5\n";
  const auto what = everything(steps::Tier::motion);
  const auto objects = scanned(read_text(right, "device.eds"), what);
  CHECK(differences(objects, right, what).empty());
  const auto with = [&](const std::string& before, const std::string& after) {
    auto text = right;
    text.replace(text.find(before), before.size(), after);
    return differences(objects, text, what);
  };
  using Lines = std::vector<std::string>;
  CHECK(with("VendorNumber=0x1234", "VendorNumber=0x1235") ==
        Lines{"[DeviceInfo]|VendorNumber|0x1234|0x1235|device.eds:2"});
  CHECK(with("NrOfRXPDO=0", "NrOfRXPDO=2") == Lines{"[DeviceInfo]|NrOfRXPDO|0|2|device.eds:3"});
  CHECK(with("=0x191", "=0x192") == Lines{"1000h:00|DefaultValue|0x191|0x192|device.eds:4"});
  CHECK(with("[2000]", "[2002]") == Lines{"2000h:00|presence|there|not described|device.eds",
                                          "2002h:00|presence|absent|described|device.eds:23"});
  CHECK(with("AccessType=ro\nDefaultValue=7", "AccessType=rw\nDefaultValue=7") ==
        Lines{"2000h:00|AccessType|read-only|rw|device.eds:23"});
  CHECK(with("AccessType=ro\nDefaultValue=7", "AccessType=wo\nDefaultValue=7") ==
        Lines{"2000h:00|AccessType|can be read|wo|device.eds:23"});
  CHECK(with("DataType=3", "DataType=4") ==
        Lines{"2001h:00|DataType|2 bytes|INTEGER32 (4 bytes)|device.eds:28"});
  CHECK(with("LowLimit=-5", "LowLimit=-4") == Lines{"2001h:00|LowLimit|0xFFFB|0xFFFC|device.eds:28"});
}

TEST_CASE("What a description keeps scans off is not looked at, and what it alone leads to is") {
  const std::string text = "[2000]\nParameterName=a\nDataType=5\nAccessType=ro\nDefaultValue=7\nObjFlags=2\n"
                           "[2001sub3]\nParameterName=b\nDataType=5\nAccessType=ro\nDefaultValue=7\n"
                           "[1000]\nParameterName=d\nDataType=7\nAccessType=ro\nDefaultValue=0\n";
  const auto file = read_text(text, "device.eds");
  const auto description = device::describe(*file);
  REQUIRE(description.has_value());
  auto what = everything();
  what.skip = cli::not_to_be_scanned(*description);
  what.also = cli::to_be_scanned(*description, what.ranges);
  const auto objects = scanned(file, what);
  REQUIRE(objects.size() == 2);
  CHECK(objects[1].index == Index(0x2001));
  CHECK(differences(objects, text, what).empty());
}
