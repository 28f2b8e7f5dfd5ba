// SPDX-License-Identifier: Apache-2.0
// XML descriptions: the same model, with places in the XML.
#include <string>

#include "catch.hpp"
#include "eds/read.hpp"

namespace {

using namespace conform;
using namespace conform::eds;

constexpr std::string_view text =
    "<?xml version=\"1.0\"?>\n"
    "<ISO15745ProfileContainer xmlns=\"http://www.canopen.org/xml/1.0\">\n"
    " <ISO15745Profile><ProfileBody fileName=\"a.xdd\" fileVersion=\"2\">\n"
    "  <q1:DeviceIdentity><q1:vendorName>Example</q1:vendorName><q1:vendorID>0x1F</q1:vendorID></q1:DeviceIdentity>\n"
    "  <parameterList>\n"
    "   <parameter uniqueID=\"P1\" access=\"readWriteInput\" ><REAL/><defaultValue value=\"1.5\"/>\n"
    "    <allowedValues><range><minValue value=\"0\"/><maxValue value=\"2\"/></range></allowedValues></parameter>\n"
    "   <parameter uniqueID=\"P2\"><dataTypeIDRef uniqueIDRef=\"E1\"/></parameter>\n"
    "  </parameterList>\n"
    "  <dataTypeList><enum uniqueID=\"E1\"><USINT/></enum></dataTypeList>\n"
    " </ProfileBody></ISO15745Profile>\n"
    " <ISO15745Profile><ProfileBody>\n"
    "  <CANopenObjectList>\n"
    "   <CANopenObject index=\"1018\" name=\"Identity\" objectType=\"9\" subNumber=\"2\">\n"
    "    <CANopenSubObject subIndex=\"0001\" name=\"a &gt; b\" objectType=\"7\"\n"
    "     dataType=\"0007\" accessType=\"ro\" defaultValue=\"0x1F\" objFlags=\"10\"/>\n"
    "   </CANopenObject>\n"
    "   <CANopenObject index=\"2000\" name=\"Gain\" objectType=\"7\" PDOmapping=\"TPDO\" uniqueIDRef=\"P1\"/>\n"
    "   <CANopenObject index=\"2001\" name=\"Mode\" objectType=\"7\" uniqueIDRef=\"P2\" actualValue=\"3\"/>\n"
    "  </CANopenObjectList>\n"
    "  <dummyUsage><dummy entry=\"Dummy0005=1\"/></dummyUsage>\n"
    "  <baudRate><supportedBaudRate value=\"250 Kbps\"/></baudRate>\n"
    "  <CANopenGeneralFeatures granularity=\"8\" nrOfTxPDO=\"1\" layerSettingServiceSlave=\"true\"/>\n"
    " </ProfileBody></ISO15745Profile>\n"
    "</ISO15745ProfileContainer>\n";

TEST_CASE("XML becomes the same model, and attributes have their places") {
  const auto file = eds::read(text, "a.xdc");
  REQUIRE(file);
  CHECK(file->format == Format::xdc);
  CHECK(file->file_info.file_name.text == "a.xdd");
  CHECK(file->device_info.vendor_name.text == "Example");
  CHECK(number_of(file->device_info.vendor_number) == 0x1FU);
  CHECK(flag_of(file->device_info.lss_supported) == true);
  REQUIRE(file->device_info.baud_rates.size() == 1);
  CHECK(file->device_info.baud_rates[0].number == 250);
  REQUIRE(file->dummy_usage.entries.size() == 1);
  CHECK(file->dummy_usage.entries[0].number == 5);
  const auto* vendor = file->find(Multiplexer{Index(0x1018), SubIndex(1)});
  REQUIRE(vendor != nullptr);
  CHECK(vendor->parameter_name.text == "a > b");
  CHECK(data_type(*vendor) == 7);
  CHECK(vendor->at == Position{15, 5});
  CHECK(vendor->access_type.key_at == Position{16, 22});
  CHECK(vendor->access_type.at == Position{16, 34});
  CHECK(vendor->obj_flags.text == "0x10");
  CHECK(file->remarks.all().empty());
}

TEST_CASE("What an object leaves open comes from the parameter it refers to") {
  const auto file = eds::read(text, "a.xdc");
  REQUIRE(file);
  const auto* gain = file->find(Multiplexer{Index(0x2000), SubIndex(0)});
  REQUIRE(gain != nullptr);
  CHECK(data_type(*gain) == 8);
  CHECK(access(*gain) == Access::rwr);
  CHECK(pdo_mapping(*gain) == PdoMapping::tpdo_only);
  CHECK(gain->default_value.text == "1.5");
  CHECK(gain->default_value.at == Position{6, 82});
  CHECK(gain->low_limit.text == "0");
  CHECK(gain->high_limit.text == "2");
  const auto* mode = file->find(Multiplexer{Index(0x2001), SubIndex(0)});
  REQUIRE(mode != nullptr);
  CHECK(data_type(*mode) == 5);
  CHECK(access(*mode) == Access::ro);
  CHECK(mode->parameter_value.text == "3");
}

/// The first line of `application_process` is line 3 of the file.
std::string with_parameters(std::string_view application_process, std::string_view objects) {
  return R"(<ISO15745ProfileContainer xmlns="http://www.canopen.org/xml/1.0">
<ISO15745Profile><ProfileBody><ApplicationProcess>
)" + std::string(application_process) +
         R"(</ApplicationProcess></ProfileBody></ISO15745Profile>
<ISO15745Profile><ProfileBody><ApplicationLayers><CANopenObjectList>
)" + std::string(objects) +
         R"(</CANopenObjectList></ApplicationLayers></ProfileBody></ISO15745Profile>
</ISO15745ProfileContainer>)";
}

TEST_CASE("What a parameter leaves open comes from its template") {
  const auto file = eds::read(
      with_parameters(R"(<templateList>
<parameterTemplate uniqueID="PERCENT" access="readWrite"><USINT/><defaultValue value="50"/>
<allowedValues templateIDRef="UP_TO_100"/></parameterTemplate>
<allowedValuesTemplate uniqueID="UP_TO_100"><range><minValue value="0"/><maxValue value="100"/></range></allowedValuesTemplate>
</templateList>
<parameterList>
<parameter uniqueID="OPENING" templateIDRef="PERCENT"><defaultValue value="25"/></parameter>
<parameter uniqueID="LOST" templateIDRef="OPENING"><USINT/></parameter>
</parameterList>
)",
                      R"(<CANopenObject index="2000" name="Opening" objectType="7" uniqueIDRef="OPENING"/>
<CANopenObject index="2001" name="Lost" objectType="7" uniqueIDRef="LOST"/>
)"),
      "a.xdd");
  REQUIRE(file);
  const auto* opening = file->find(Multiplexer{Index(0x2000), SubIndex(0)});
  REQUIRE(opening != nullptr);
  CHECK(data_type(*opening) == 5);
  CHECK(access(*opening) == Access::rw);
  CHECK(opening->default_value.text == "25");
  CHECK(opening->low_limit.text == "0");
  CHECK(opening->high_limit.text == "100");
  CHECK(opening->high_limit.at.line == 6);
  // A parameter is no template.
  REQUIRE(file->remarks.all().size() == 1);
  CHECK(file->remarks.all()[0].what == Deviation::xml_unknown_reference);
  CHECK(file->remarks.all()[0].at.line == 10);
}

TEST_CASE("What a parameter says itself replaces its template, and a word nobody knows is kept") {
  const auto file =
      eds::read(with_parameters(R"(<templateList>
<parameterTemplate uniqueID="T" access="readWrite"><USINT/>
<allowedValues><range><minValue value="0"/><maxValue value="10"/></range></allowedValues></parameterTemplate>
</templateList>
<parameterList>
<parameter uniqueID="LIST" templateIDRef="T"><allowedValues><value value="1"/><value value="200"/></allowedValues></parameter>
<parameter uniqueID="WORD" access="ReadWrite"><USINT/></parameter>
</parameterList>
)",
                                R"(<CANopenObject index="2000" name="List" objectType="7" uniqueIDRef="LIST"/>
<CANopenObject index="2001" name="Word" objectType="7" uniqueIDRef="WORD"/>
)"),
                "a.xdd");
  REQUIRE(file);
  const auto* list = file->find(Multiplexer{Index(0x2000), SubIndex(0)});
  REQUIRE(list != nullptr);
  CHECK(access(*list) == Access::rw);
  CHECK(list->low_limit.empty());
  CHECK(list->high_limit.empty());
  const auto* word = file->find(Multiplexer{Index(0x2001), SubIndex(0)});
  REQUIRE(word != nullptr);
  CHECK_FALSE(access(*word).has_value());
  CHECK(word->access_type.text == "ReadWrite");
  CHECK(word->access_type.at.line == 9);
  CHECK(file->remarks.all().empty());
}

TEST_CASE("Broken, foreign and hostile XML is refused with its place") {
  const auto where = [](const std::string& xml) {
    const auto file = eds::read(xml, "a.xdd");
    REQUIRE_FALSE(file);
    return file.error().where;
  };
  CHECK(where("<a>\n<b></a>") == "a.xdd:2:6");
  CHECK(where("<?xml version=\"1.0\"?>\n<project/>") == "a.xdd:2:1");
  std::string deep = "<ISO15745ProfileContainer>";
  for (int i = 0; i < 1000; ++i) deep += "<a>";
  for (int i = 0; i < 1000; ++i) deep += "</a>";
  CHECK(where(deep + "</ISO15745ProfileContainer>").starts_with("a.xdd:1:"));
  std::string many = "<a>";
  for (int i = 0; i < 1'100'000; ++i) many += "<b/>";
  CHECK(where(many + "</a>") == "a.xdd:1:1");
}

}  // namespace
