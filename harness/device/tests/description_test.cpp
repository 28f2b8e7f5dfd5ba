// SPDX-License-Identifier: Apache-2.0
// What a device description claims, against literal bytes.
#include "device/description.hpp"

#include "catch.hpp"
#include "device/described_value.hpp"
#include "eds/read.hpp"

using namespace conform;
using namespace conform::device;
using canopen::DataType;

namespace {

Description described(std::string_view text, const char* name = "a.eds") {
  const auto file = eds::read(text, name);
  REQUIRE(file);
  auto out = describe(*file);
  REQUIRE(out);
  return std::move(*out);
}

const Entry& entry_of(const Description& description, std::uint16_t index, std::uint8_t sub) {
  for (const auto& entry : description.entries) {
    if (entry.mux == Multiplexer{Index(index), SubIndex(sub)}) return entry;
  }
  FAIL("no entry " << index << ":" << int{sub});
  std::abort();
}

std::string variable(std::string_view section, std::string_view type, std::string_view access,
                     std::string_view more = "") {
  std::string out = "[";
  out.append(section).append("]\nParameterName=A name\nObjectType=0x7\nDataType=").append(type);
  return out.append("\nAccessType=").append(access).append("\n").append(more).append("\n");
}

std::string reason(DataType type, std::string_view text) {
  const auto value = read_described_value(type, text);
  return value ? "" : value.error().what;
}

Bytes bytes(DataType type, std::string_view text) {
  const auto value = read_described_value(type, text);
  CAPTURE(text);
  REQUIRE(value);
  return value->bytes;
}

}  // namespace

TEST_CASE("Numbers are read in every notation, as bytes of their type") {
  CHECK(bytes(DataType::unsigned16, "4660") == Bytes{0x34, 0x12});
  CHECK(bytes(DataType::unsigned16, "0x1234") == Bytes{0x34, 0x12});
  CHECK(bytes(DataType::unsigned8, "017") == Bytes{0x0F});
  CHECK(bytes(DataType::integer16, "-5") == Bytes{0xFB, 0xFF});
  CHECK(bytes(DataType::integer16, "0xFFFB") == Bytes{0xFB, 0xFF});
  CHECK(bytes(DataType::integer8, "-128") == Bytes{0x80});
  CHECK(bytes(DataType::unsigned24, "0x123456") == Bytes{0x56, 0x34, 0x12});
  CHECK(bytes(DataType::integer64, "-1") == Bytes(8, 0xFF));
  CHECK(bytes(DataType::boolean, "1") == Bytes{1});
  CHECK(bytes(DataType::boolean, "true") == Bytes{1});
}

TEST_CASE("A number that the type cannot hold is no value") {
  CHECK(reason(DataType::unsigned8, "256") == "is no value of UNSIGNED8: it is too large");
  CHECK(reason(DataType::unsigned8, "-1") == "is no value of UNSIGNED8: it is too small");
  CHECK(reason(DataType::integer8, "128") == "is no value of INTEGER8: it is too large");
  CHECK(reason(DataType::integer8, "-129") == "is no value of INTEGER8: it is too small");
  CHECK(reason(DataType::boolean, "2") == "is no value of BOOLEAN: it is too large");
  CHECK(reason(DataType::unsigned16, "abc") == "is no value of UNSIGNED16: it is no number");
  CHECK(reason(DataType::domain, "00") == "is no value of DOMAIN: CiA 306 gives it no notation");
}

TEST_CASE("A formula of the node-ID keeps its constant part") {
  const auto value = read_described_value(DataType::unsigned32, "$NODEID+0x180");
  REQUIRE(value);
  CHECK(value->adds_node_id);
  CHECK(value->bytes == Bytes{0x80, 0x01, 0, 0});
}

TEST_CASE("REAL is read as a decimal number and as its bits") {
  CHECK(bytes(DataType::real32, "1.5") == Bytes{0, 0, 0xC0, 0x3F});
  CHECK(bytes(DataType::real32, "0x3FC00000") == Bytes{0, 0, 0xC0, 0x3F});
  CHECK(bytes(DataType::real64, "-1") == Bytes{0, 0, 0, 0, 0, 0, 0xF0, 0xBF});
  CHECK(reason(DataType::real32, "1e40") == "is no value of REAL32: it is too large");
}

TEST_CASE("Text is taken as it stands and octets as pairs of digits") {
  CHECK(bytes(DataType::visible_string, "abc\xE4") == Bytes{'a', 'b', 'c', 0xE4});
  CHECK(bytes(DataType::octet_string, "01 A0 ff") == Bytes{0x01, 0xA0, 0xFF});
  CHECK_FALSE(read_described_value(DataType::octet_string, "01 A"));
}

TEST_CASE("An entry has what the file says of it, and where") {
  const auto description =
      described("[2001]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rww\n"
                "DefaultValue=100\nLowLimit=10\nHighLimit=0xC8\nPDOMapping=1\n");
  const auto& entry = entry_of(description, 0x2001, 0);
  CHECK(entry.name == "Speed");
  CHECK(entry.type == DataType::unsigned16);
  CHECK(entry.access == Access::rww);
  CHECK(entry.object == ObjectCode::var);
  CHECK(entry.claimed);
  CHECK(entry.default_value == Bytes{0x64, 0});
  CHECK(entry.declared_default);
  CHECK(entry.low == Bytes{0x0A, 0});
  CHECK(entry.high == Bytes{0xC8, 0});
  CHECK(entry.pdo_mappable);
  CHECK_FALSE(entry.may_change);
  CHECK(entry.described);
  CHECK(description.places.entries.at(entry.mux) == "a.eds:1");
}

TEST_CASE("PDOMapping goes above what rww and rwr suggest") {
  CHECK(entry_of(described(variable("2000", "5", "rww")), 0x2000, 0).pdo_mappable);
  CHECK_FALSE(entry_of(described(variable("2000", "5", "rww", "PDOMapping=0")), 0x2000, 0).pdo_mappable);
  CHECK(entry_of(described(variable("2000", "5", "ro", "PDOMapping=1")), 0x2000, 0).pdo_mappable);
}

TEST_CASE("What the device writes by itself is never compared with a default") {
  CHECK(entry_of(described(variable("6000", "5", "ro", "DefaultValue=0")), 0x6000, 0).may_change);
  CHECK(entry_of(described(variable("2000", "5", "rwr", "DefaultValue=0")), 0x2000, 0).may_change);
  CHECK_FALSE(entry_of(described(variable("2000", "5", "const", "DefaultValue=0")), 0x2000, 0).may_change);
  const auto array =
      described("[6000]\nParameterName=In\nObjectType=8\nSubNumber=2\n" +
                variable("6000sub0", "5", "ro", "DefaultValue=1") + variable("6000sub1", "5", "ro"));
  CHECK_FALSE(entry_of(array, 0x6000, 0).may_change);
  CHECK(entry_of(array, 0x6000, 1).may_change);
}

TEST_CASE("What CiA 301 says of an entry stays where the file is about something else") {
  const auto description =
      described(variable("1000", "7", "ro", "DefaultValue=0x00020192") +
                variable("1014", "0x0007", "rw", "DefaultValue=$NODEID+0x80") + variable("1017", "6", "rw"));
  CHECK(entry_of(description, 0x1000, 0).category == Category::mandatory);
  const auto& emcy = entry_of(description, 0x1014, 0);
  CHECK(emcy.default_adds_node_id);
  CHECK(emcy.default_value == Bytes{0x80, 0, 0, 0});
  CHECK(emcy.declared_default);
  CHECK_FALSE(entry_of(description, 0x1017, 0).declared_default);
  CHECK(description.claims ==
        std::set<std::string, std::less<>>{"emcy", "heartbeat producer", "profile device"});
}

TEST_CASE("The defaults of 1005h and 1012h tell who consumes and who produces") {
  const auto claims = [](std::string_view section, std::string_view value) {
    return described(variable(section, "7", "rw", "DefaultValue=" + std::string(value))).claims;
  };
  using Claims = std::set<std::string, std::less<>>;
  CHECK(claims("1005", "0x80") == Claims{"sync consumer"});
  CHECK(claims("1005", "0x40000080") == Claims{"sync producer"});
  CHECK(claims("1012", "0x100").empty());
  CHECK(claims("1012", "0xC0000100") == Claims{"time consumer", "time producer"});
}

TEST_CASE("Implied entries of CompactSubObj are claimed as well") {
  const auto description = described(
      "[2010]\nParameterName=List\nObjectType=0x8\nDataType=0x0006\nAccessType=rw\nDefaultValue=7\nCompactSubObj=3\n");
  CHECK(entry_of(description, 0x2010, 0).default_value == Bytes{3});
  CHECK(entry_of(description, 0x2010, 3).default_value == Bytes{7, 0});
  CHECK(entry_of(description, 0x2010, 3).object == ObjectCode::array);
  CHECK(description.places.entries.at({Index(0x2010), SubIndex(3)}) == "a.eds:7");
}

TEST_CASE("ObjFlags keep writes and reads off an entry") {
  const auto description =
      described(variable("2000", "5", "rw", "ObjFlags=1") + variable("2001", "5", "rw", "ObjFlags=2"));
  CHECK(entry_of(description, 0x2000, 0).untouchable);
  CHECK_FALSE(entry_of(description, 0x2000, 0).not_to_be_read);
  CHECK(entry_of(description, 0x2001, 0).not_to_be_read);
  // The rules of commands of CiA 301 are for the suite to judge, whatever a configuration tool should do.
  CHECK_FALSE(entry_of(described(variable("1014", "7", "rw", "ObjFlags=1")), 0x1014, 0).untouchable);
}

TEST_CASE("What cannot be used is said with its place and not expected of the device") {
  const auto description = described(variable("2000", "5", "rw", "DefaultValue=300\nLowLimit=x") +
                                     variable("2001", "0x0041", "rw"));
  CHECK_FALSE(entry_of(description, 0x2000, 0).declared_default);
  REQUIRE(description.unused.size() == 3);
  CHECK(description.unused[0].where == "a.eds:7:10");
  CHECK(description.unused[0].what ==
        "the low limit of 2000h:00, 'x', is no value of UNSIGNED8: it is no number: it is not used");
  CHECK(description.unused[1].where == "a.eds:6:14");
  CHECK(description.unused[2].what ==
        "the data type 0041h of 2001h:00 is none of the basic ones: its length is not compared");
}

TEST_CASE("Limits that exclude each other are not used") {
  // 65535 of an INTEGER16 and FFFFFFFFh of an INTEGER32 are -1, below the low limit.
  const auto description = described(variable("2000", "4", "rw", "LowLimit=0\nHighLimit=0xFFFFFFFF") +
                                     variable("2001", "4", "rw", "LowLimit=-5\nHighLimit=5"));
  CHECK_FALSE(entry_of(description, 0x2000, 0).low.has_value());
  CHECK_FALSE(entry_of(description, 0x2000, 0).high.has_value());
  REQUIRE(description.unused.size() == 1);
  CHECK(description.unused[0].what ==
        "the low limit of 2000h:00, '0', is above the high limit, '0xFFFFFFFF': neither is used");
  CHECK(entry_of(description, 0x2001, 0).high.has_value());
}

TEST_CASE("An entry without an access type is not said to be writable or not") {
  const auto description = described("[2000]\nParameterName=A\nObjectType=7\nDataType=5\n");
  CHECK(entry_of(description, 0x2000, 0).access_open);
}

TEST_CASE("The profile's own list goes above the description") {
  Profile profile = default_profile(NodeId(5));
  Entry own;
  own.mux = {Index(0x2000), SubIndex(0)};
  own.name = "Own";
  own.claimed = true;
  profile.objects.push_back(own);
  add_description(profile,
                  described(variable("2000", "5", "rw") + variable("2001", "5", "rw", "ObjFlags=1")));
  const auto dictionary = dictionary_of(profile);
  CHECK(dictionary.find({Index(0x2000), SubIndex(0)})->name == "Own");
  CHECK_FALSE(dictionary.find({Index(0x2000), SubIndex(0)})->described);
  CHECK(dictionary.find({Index(0x2001), SubIndex(0)})->described);
  CHECK(profile.place_of({Index(0x2001), SubIndex(0)}) == "a.eds:7");
  CHECK(profile.is_untouchable({Index(0x2001), SubIndex(0)}));
}

TEST_CASE("Claims of the profile and of the description add up, without those that are taken back") {
  Profile profile = default_profile(NodeId(5));
  profile.claims = {"block sdo"};
  profile.not_claimed = {"variable mapping"};
  add_description(profile, described(variable("1014", "7", "rw") + variable("1600", "5", "rw")));
  CHECK(profile.claimed("block sdo"));
  CHECK(profile.claimed("emcy"));
  CHECK_FALSE(profile.claimed("variable mapping"));
}

TEST_CASE("An error trigger may write what only the description describes") {
  Profile profile = default_profile(NodeId(5));
  ErrorTrigger trigger;
  trigger.name = "hot";
  trigger.raise = TriggerWrite{{Index(0x2F00), SubIndex(0)}, "2", {}, "8:40"};
  profile.errors = {trigger};
  CHECK(complete_writes(profile).error().what ==
        "2F00h:00 is neither under 'objects' nor in the device description");
  CHECK(complete_writes(profile).error().where == "8:40");
  add_description(profile, described(variable("2F00", "6", "rw")));
  REQUIRE(complete_writes(profile));
  CHECK(profile.errors[0].raise->bytes == Bytes{2, 0});
  CHECK(complete_writes(profile));

  profile.errors[0].raise = TriggerWrite{{Index(0x2F00), SubIndex(0)}, "70000", {}, "8:40"};
  CHECK_FALSE(complete_writes(profile));
}

TEST_CASE("A DCF names the node-ID") {
  CHECK(described("[DeviceComissioning]\nNodeID=0x10\n" + variable("1000", "7", "ro"), "a.dcf").node ==
        NodeId(16));
}

TEST_CASE("What a DCF configures is expected in the place of the default") {
  const auto description = described("[DeviceComissioning]\nNodeID=5\n" +
                                         variable("2000", "5", "rw", "DefaultValue=1\nParameterValue=0x2\n") +
                                         variable("2001", "5", "rw", "DefaultValue=1\nParameterValue=\n") +
                                         variable("2002", "7", "rw", "ParameterValue=$NODEID+0x80\n") +
                                         variable("2003", "5", "rw", "DefaultValue=1\nParameterValue=x\n"),
                                     "a.dcf");
  CHECK(entry_of(description, 0x2000, 0).default_value == Bytes{2});
  CHECK(entry_of(description, 0x2000, 0).configured);
  CHECK_FALSE(entry_of(description, 0x2001, 0).configured);
  CHECK(entry_of(description, 0x2001, 0).default_value == Bytes{1});
  CHECK(entry_of(description, 0x2002, 0).default_adds_node_id);
  CHECK_FALSE(entry_of(description, 0x2003, 0).declared_default);
  REQUIRE(description.unused.size() == 1);
  CHECK(description.unused[0].what ==
        "the value of 2003h:00, 'x', is no value of UNSIGNED8: it is no number: it is not compared");
}

TEST_CASE("What a draft tells as defaults is what the device held when it was scanned") {
  const auto text = [](const std::string& program) {
    return "[FileInfo]\nCreatedBy=" + program + "\n" + variable("2000", "5", "rw", "DefaultValue=1\n");
  };
  CHECK(entry_of(described(text("canopen-conform scan")), 0x2000, 0).configured);
  CHECK_FALSE(entry_of(described(text("somebody")), 0x2000, 0).configured);
}

TEST_CASE("[DeviceInfo] tells how many PDOs there are, whether there is LSS, and the bit rates") {
  const auto info = described("[DeviceInfo]\nNrOfRXPDO=2\nNrOfTXPDO=0x3\nLSS_Supported=0\nBaudRate_500=1\n"
                              "BaudRate_250=0\nBaudRate_125=1\n")
                        .info;
  CHECK(info.rpdos == 2U);
  CHECK(info.tpdos == 3U);
  CHECK(info.lss == false);
  CHECK(info.bit_rates == std::vector<std::uint32_t>{125, 500});
  const auto nothing = described("[DeviceInfo]\nVendorName=a\n").info;
  CHECK_FALSE(nothing.rpdos.has_value());
  CHECK_FALSE(nothing.lss.has_value());
  CHECK(nothing.bit_rates.empty());
}

TEST_CASE("What the profile says of the whole device goes before the description") {
  Profile profile;
  profile.device_info.rpdos = 1;
  add_description(profile, described("[DeviceInfo]\nNrOfRXPDO=2\nNrOfTXPDO=3\n"));
  CHECK(profile.told("rpdos") == 1U);
  CHECK(profile.told("tpdos") == 3U);
}
