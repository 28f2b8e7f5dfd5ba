// SPDX-License-Identifier: Apache-2.0
// Device profiles: what they say, and how mistakes in them are reported.
#include "device/profile.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>

#include "base/text.hpp"
#include "catch.hpp"

using namespace conform;
using namespace conform::device;
using canopen::DataType;
using namespace std::chrono_literals;

namespace {

Multiplexer mux(std::uint16_t index, std::uint8_t sub = 0) { return {Index{index}, SubIndex{sub}}; }

struct Loaded {
  Profile profile;
  std::string messages;
  bool usable = false;
};

Loaded load(std::string_view text) {
  const auto source = yaml::make_source("device.yaml", text);
  yaml::Diagnostics diagnostics(source);
  const auto root = yaml::load(*source, diagnostics);
  REQUIRE(root.has_value());
  Loaded out;
  out.profile = load_profile(*root, diagnostics);
  out.usable = !diagnostics.has_errors();
  out.messages = diagnostics.render();
  return out;
}

Profile good(std::string_view text) {
  const Loaded loaded = load(text);
  INFO(loaded.messages);
  REQUIRE(loaded.usable);
  return loaded.profile;
}

bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

const std::string head = "format: 1\nname: Pump\nnode: 5\n";

}  // namespace

TEST_CASE("A minimal profile has the default times and the heartbeat trigger") {
  const Profile profile = good(head);
  CHECK(profile.name == "Pump");
  CHECK(profile.node == NodeId{5});
  CHECK(profile.interface.empty());
  CHECK(profile.boot_time == 5s);
  CHECK(profile.sdo_timeout == 1s);
  CHECK(profile.store_timeout == 10s);
  CHECK(profile.nmt_time == 100ms);
  CHECK(profile.quiet_time == 300ms);
  CHECK_FALSE(profile.factory_defaults.has_value());
  CHECK_FALSE(profile.store_fault.has_value());
  REQUIRE(profile.errors.size() == 1);
  CHECK(profile.errors[0].code == 0x8130);
  CHECK(profile.errors[0].heartbeat_node == NodeId{0x7E});
}

TEST_CASE("Every key of a profile is read") {
  const Profile profile = good(head + R"(about: A pump
interface: can0
eds: pump.eds
boot_time: 2 s
sdo_timeout: 250 ms
claims: [emcy, heartbeat producer, block sdo]
not_claimed: [tpdo]
objects:
  - 1017h:00
  - 1003h:00..03
  - {object: 1014h, access: const, default: 90h + N}
  - {object: 2000h:05, name: Speed, type: INTEGER16, access: rww, low: -1000, high: 1000, default: -5, mappable: true}
  - {object: 6000h:01..02, name: Inputs, type: UNSIGNED8, access: ro, kind: ARRAY, may_change: true}
  - {object: 2F00h:01, name: Raise, type: UNSIGNED16, access: wo, command: true}
errors:
  - {name: generic, code: 1000h, raise: {object: 2F00h:01, value: 1000h}, clear: {object: 2F00h:01, value: 0}}
  - {name: heartbeat, heartbeat: {node: 7Dh}}
store_fault: {arm: {object: 2000h:05, value: 1}, disarm: {object: 2000h:05, value: 0}}
safe_objects: [2000h:05, 1016h:01..02]
untouchable: [1F50h:01]
power_cycle: relay 3 cycle
factory_defaults: true
identity: {vendor: 5AFEh, serial: 17}
device_info: {rpdos: 4, lss: false, bit_rates: [500, 125]}
known_deviations:
  - {requirement: OD-1014-06, reason: fixed in 2.0}
  - {requirement: OD-1014-06, case: cia301/1014/a, reason: other}
)");
  CHECK(profile.interface == "can0");
  CHECK(profile.eds == "pump.eds");
  CHECK(profile.power_cycle == "relay 3 cycle");
  CHECK(profile.duration("boot_time") == Duration{2s});
  CHECK(profile.duration("T_SDO") == Duration{250ms});
  CHECK_FALSE(profile.duration("T_NONE").has_value());
  CHECK(profile.claimed("block sdo"));
  CHECK_FALSE(profile.claimed("tpdo"));
  CHECK(profile.not_claimed.contains("tpdo"));
  REQUIRE(profile.objects.size() == 10);
  CHECK(std::ranges::all_of(profile.objects, &Entry::claimed));
  const Entry& speed = profile.objects[6];
  CHECK(speed.mux == mux(0x2000, 5));
  CHECK(speed.type == DataType::integer16);
  CHECK(speed.access == Access::rww);
  CHECK(speed.low == Bytes{0x18, 0xFC});
  CHECK(speed.high == Bytes{0xE8, 0x03});
  CHECK(speed.default_value == Bytes{0xFB, 0xFF});
  CHECK(speed.object == ObjectCode::record);
  CHECK(profile.objects[7].object == ObjectCode::array);
  CHECK(profile.objects[8].mux == mux(0x6000, 2));
  CHECK(profile.objects[8].may_change);
  REQUIRE(profile.errors.size() == 2);
  CHECK(profile.errors[0].raise->object == mux(0x2F00, 1));
  CHECK(profile.errors[0].raise->bytes == Bytes{0x00, 0x10});
  CHECK(profile.errors[0].clear->bytes == Bytes{0, 0});
  CHECK_FALSE(profile.errors[0].heartbeat_node.has_value());
  CHECK(profile.errors[1].heartbeat_node == NodeId{0x7D});
  CHECK(profile.errors[1].code == 0x8130);
  REQUIRE(profile.store_fault.has_value());
  CHECK(profile.store_fault->arm.object == mux(0x2000, 5));
  CHECK(profile.store_fault->arm.bytes == Bytes{1, 0});
  CHECK(profile.store_fault->disarm.bytes == Bytes{0, 0});
  CHECK(profile.is_safe(mux(0x1016, 2)));
  CHECK_FALSE(profile.is_safe(mux(0x1016, 3)));
  CHECK(profile.is_untouchable(mux(0x1F50, 1)));
  CHECK(profile.factory_defaults == true);
  CHECK(profile.identity.vendor == 0x5AFEU);
  CHECK_FALSE(profile.identity.product.has_value());
  CHECK(profile.told("rpdos") == 4U);
  CHECK(profile.told("lss") == 0U);
  CHECK_FALSE(profile.told("tpdos").has_value());
  CHECK(profile.device_info.bit_rates == std::vector<std::uint32_t>{125, 500});
  CHECK(profile.waivers.size() == 2);
}

TEST_CASE("The dictionary lays the profile over the standard and adds the node-ID") {
  const Profile profile = good(head + R"(objects:
  - 1003h:01..03
  - {object: 1014h:00, access: const, default: 90h + N}
  - {object: 2000h:05, name: Speed, type: INTEGER16, access: rw}
  - {object: 2001h:00, name: Position, type: INTEGER32, access: ro}
)");
  const Dictionary dictionary = dictionary_of(profile);
  const Entry* emcy = dictionary.find(mux(0x1014));
  REQUIRE(emcy != nullptr);
  CHECK(emcy->access == Access::constant);
  CHECK_FALSE(emcy->access_open);
  CHECK(emcy->default_value == Bytes{0x95, 0, 0, 0});
  CHECK(emcy->presence() == Presence::claimed);
  CHECK(emcy->name == "COB-ID emergency message");
  CHECK(dictionary.find(mux(0x1003, 3))->claimed);
  CHECK_FALSE(dictionary.find(mux(0x1015))->claimed);
  const Entry* count = dictionary.find(mux(0x2000, 0));
  REQUIRE(count != nullptr);
  CHECK(count->type == DataType::unsigned8);
  CHECK(count->access == Access::constant);
  CHECK(count->object == ObjectCode::record);
  CHECK(count->claimed);
  CHECK(dictionary.object(Index{0x2001}).size() == 1);
  CHECK(dictionary.find(mux(0x2001))->object == ObjectCode::var);
}

TEST_CASE("What is wired brings the claim that a change sends, unless that is denied") {
  const std::string wired = R"(objects:
  - {object: 6000h:00, name: Input, type: UNSIGNED8, access: ro}
  - {object: 6200h:00, name: Output, type: UNSIGNED8, access: rww}
  - {object: 6411h:00, name: Output, type: INTEGER16, access: rww}
wired: [{output: 6200h:00, input: 6000h:00}]
)";
  const Profile profile = good(head + wired);
  CHECK(profile.claimed("tpdo on change"));
  const Dictionary dictionary = dictionary_of(profile);
  CHECK(dictionary.find(mux(0x6200))->wired_input == mux(0x6000));
  CHECK_FALSE(dictionary.find(mux(0x6000))->wired_input.has_value());
  CHECK_FALSE(good(head + wired + "not_claimed: [tpdo on change]\n").claimed("tpdo on change"));

  const auto mistake = [&](const std::string& wire) {
    return load(head + wired.substr(0, wired.find("wired")) + "wired: [" + wire + "]\n").messages;
  };
  CHECK(contains(mistake("{output: 6200h:00, input: 6200h:00}"), "6200h:00 is wired to itself"));
  CHECK(contains(mistake("{output: 6411h:00, input: 6000h:00}"), "different lengths"));
  CHECK(contains(mistake("{output: 6200h:00, input: 6000h:00}, {output: 6200h:00, input: 6000h:00}"),
                 "6200h:00 is wired twice"));
}

TEST_CASE("The clock is the entry that is named, or else any time that the device keeps itself") {
  const std::string times = R"(objects:
  - {object: 2000h:00, name: Time, type: TIME_OF_DAY, access: ro, may_change: true}
  - {object: 2001h:00, name: Last service, type: TIME_OF_DAY, access: ro, may_change: true}
  - {object: 2002h:00, name: Produced, type: TIME_OF_DAY, access: const}
  - {object: 2003h:00, name: Number, type: UNSIGNED16, access: ro, may_change: true}
)";
  const auto clocks = [](const Profile& profile) {
    std::vector<Multiplexer> out;
    const Dictionary dictionary = dictionary_of(profile);
    for (const Entry& entry : dictionary.entries()) {
      if (entry.clock) out.push_back(entry.mux);
    }
    return out;
  };
  const Profile unknown = good(head + times);
  CHECK_FALSE(unknown.claimed("clock"));
  CHECK(clocks(unknown) == std::vector{mux(0x2000), mux(0x2001)});
  const Profile named = good(head + times + "clock: 2001h:00\n");
  CHECK(named.claimed("clock"));
  CHECK(clocks(named) == std::vector{mux(0x2001)});
  CHECK(contains(load(head + times + "clock: 2003h:00\n").messages, "2003h:00 has not the six bytes"));
}

TEST_CASE("Of the data types up to UNSIGNED32 those that are not listed as placeholders are forbidden") {
  const Profile profile = good(head + "placeholders: [0005h, 0007h]\n");
  CHECK(profile.placeholders.at(Index(0x0005)));
  CHECK_FALSE(profile.placeholders.at(Index(0x0001)));
  CHECK_FALSE(profile.placeholders.contains(Index(0x0008)));
  CHECK(good(head).placeholders.empty());
}

TEST_CASE("A bit rate that CiA 301 does not have is a mistake") {
  const auto loaded = load("format: 1\nname: a\nnode: 1\ndevice_info: {bit_rates: [100]}\n");
  CHECK_FALSE(loaded.usable);
  CHECK(loaded.messages.find("100 kbit/s is no bit rate of CiA 301") != std::string::npos);
}

TEST_CASE("All mistakes of a profile are reported at their places") {
  const Loaded loaded = load(R"(format: 1
name: Pump
node: 128
boot_time: 5
claims: [emyc, tpdo, tpdo]
objects:
  - 2000h:00
  - {object: 2001h:00, name: A, type: UNSIGNED12, access: rw}
  - {object: 2002h:00, name: B, type: UNSIGNED8, access: read, default: 256}
  - {object: 2003h:00, name: C, type: UNSIGNED8, access: rw, low: 5, high: 4}
  - {object: 2004h:00, name: D, type: UNSIGNED8, access: rw, low: 5, default: 4}
  - 1003h:03..01
  - 1017h:00
  - 1017h:00
errors:
  - {name: x, code: 1000h, raise: {object: 2F00h:01, value: 1}}
  - {name: y, code: 1000h}
known_deviations:
  - {requirement: OD-1014-06}
node_id: 3
)");
  CHECK_FALSE(loaded.usable);
  INFO(loaded.messages);
  CHECK(contains(loaded.messages, "device.yaml:3:7: error: 'node' is 128"));
  CHECK(contains(loaded.messages, "device.yaml:4:12: error: expected a duration for 'boot_time'"));
  CHECK(contains(loaded.messages, "device.yaml:5:10: error: unknown feature 'emyc'; did you mean 'emcy'?"));
  CHECK(contains(loaded.messages, "device.yaml:5:22: error: 'tpdo' is claimed twice"));
  CHECK(contains(loaded.messages, "device.yaml:7:5: error: CiA 301 defines no 2000h:00"));
  CHECK(contains(loaded.messages, "device.yaml:8:39: error: expected "));
  CHECK(contains(loaded.messages,
                 "device.yaml:9:58: error: expected ro, wo, rw, rwr, rww or const for 'access'"));
  CHECK(contains(loaded.messages, "256 is out of the range 0..255 of UNSIGNED8"));
  CHECK(contains(loaded.messages, "the limits of 2003h:00 are crossed"));
  CHECK(contains(loaded.messages, "the default of 2004h:00 is outside its limits"));
  CHECK(contains(loaded.messages, "the last sub-index is below the first"));
  CHECK(contains(loaded.messages, "device.yaml:14:5: error: 1017h:00 is listed twice"));
  CHECK(contains(loaded.messages, "the type of 2F00h:01 is not known"));
  CHECK(contains(loaded.messages, "the error trigger needs one of raise or heartbeat"));
  CHECK(contains(loaded.messages, "the waiver needs a key 'reason'"));
  CHECK(contains(loaded.messages, "device.yaml:20:1: error: unknown key 'node_id' in the device profile"));
}

TEST_CASE("A type that contradicts the standard is a warning, for a test to judge") {
  const Loaded loaded = load(head + "objects:\n  - {object: 1017h:00, type: UNSIGNED32, default: 70000}\n");
  CHECK(loaded.usable);
  CHECK(contains(loaded.messages, "warning: CiA 301 makes 1017h:00 UNSIGNED16"));
  REQUIRE(loaded.profile.objects.size() == 1);
  CHECK(loaded.profile.objects[0].default_value == Bytes{0x70, 0x11, 0x01, 0x00});
}

TEST_CASE("A document that is no profile is refused without harm") {
  CHECK_FALSE(load("[1, 2]").usable);
  CHECK_FALSE(load("claims: emcy\nobjects: {}\nerrors: 1\nidentity: 5\nknown_deviations: [1]\n").usable);
  CHECK_FALSE(load("format: 2\nname: x\nnode: 1\n").usable);
  CHECK_FALSE(load_profile_file("/nonexistent/device.yaml").has_value());
}

TEST_CASE("The heartbeat of an error trigger is never that of the device") {
  const Loaded loaded = load(head + "errors:\n  - {name: a, heartbeat: {node: 5}}\n");
  CHECK(contains(loaded.messages, "cannot be that of the device itself"));
}

TEST_CASE("What is claimed cannot be taken back in the same profile") {
  const Loaded loaded = load(head + "claims: [emcy, tpdo]\nnot_claimed: [emcy, rpdo, rpdo, pdo]\n");
  CHECK(contains(loaded.messages, "device.yaml:5:15: error: 'emcy' is claimed, too"));
  CHECK(contains(loaded.messages, "device.yaml:5:27: error: 'rpdo' is listed twice"));
  CHECK(contains(loaded.messages, "device.yaml:5:33: error: unknown feature 'pdo'"));
}

TEST_CASE("The type of what an error trigger writes may stand in the device description") {
  const std::string errors = "errors:\n  - {name: x, code: 1000h, raise: {object: 2F00h:01, value: 1}}\n";
  CHECK(contains(load(head + errors).messages, "the type of 2F00h:01 is not known"));
  const Profile profile = good(head + "eds: pump.eds\n" + errors);
  REQUIRE(profile.errors.size() == 1);
  REQUIRE(profile.errors[0].raise);
  CHECK(profile.errors[0].raise->open == "6:44");
  CHECK(profile.errors[0].raise->bytes.empty());
}

TEST_CASE("A store fault is armed and disarmed by writes to known objects") {
  const Loaded half = load(head + "store_fault: {arm: {object: 1017h:00, value: 1}}\n");
  CHECK_FALSE(half.usable);
  CHECK(contains(half.messages, "the store fault needs a key 'disarm'"));
  const Loaded unknown =
      load(head + "store_fault: {arm: {object: 2F20h:00, value: 1}, disarm: {object: 1017h:00, value: 0}}\n");
  CHECK(contains(unknown.messages, "the type of 2F20h:00 is not known"));
  CHECK_FALSE(unknown.profile.store_fault.has_value());
}

TEST_CASE("The default profile of a node can raise the heartbeat error") {
  const Profile profile = default_profile(NodeId{9});
  CHECK(profile.node == NodeId{9});
  REQUIRE(profile.errors.size() == 1);
  CHECK(profile.errors[0].heartbeat_node == NodeId{0x7E});
}

TEST_CASE("The schema for editors knows every feature and key") {
  std::ifstream file(CONFORM_SOURCE_DIR "/suites/schema/device.schema.json");
  const std::string schema{std::istreambuf_iterator<char>(file), {}};
  REQUIRE_FALSE(schema.empty());
  for (const Feature& feature : features()) {
    INFO(feature.word);
    CHECK(contains(schema, "\"" + std::string(feature.word) + "\""));
  }
  for (const char* key :
       {"boot_time",        "sdo_timeout",    "store_timeout", "nmt_time",     "quiet_time",
        "process_time",     "server_timeout", "block_timeout", "lss_timeout",  "claims",
        "not_claimed",      "objects",        "errors",        "safe_objects", "untouchable",
        "factory_defaults", "wired",          "placeholders",  "identity",     "known_deviations",
        "store_fault",      "device_info",    "clock"}) {
    INFO(key);
    CHECK(contains(schema, "\"" + std::string(key) + "\""));
  }
}

TEST_CASE("The profile of the reference node is valid") {
  const auto document = load_profile_file(CONFORM_SOURCE_DIR "/suites/devices/reference-node.yaml");
  REQUIRE(document.has_value());
  INFO(document->diagnostics.render());
  CHECK(document->diagnostics.empty());
  CHECK(document->profile.factory_defaults == true);
  const Dictionary dictionary = dictionary_of(document->profile);
  REQUIRE(dictionary.find(mux(0x2000, 0x1B)) != nullptr);
  CHECK(dictionary.find(mux(0x2000, 0x1B))->type == DataType::unsigned64);
  REQUIRE_FALSE(document->profile.errors.empty());
  CHECK(document->profile.errors[0].raise->object == mux(0x2F00, 1));
}
