// SPDX-License-Identifier: Apache-2.0
// Two descriptions side by side.
#include "eds/compare.hpp"

#include <string>
#include <vector>

#include "catch.hpp"
#include "eds/read.hpp"

namespace {

using namespace conform::eds;

std::vector<std::string> differences(std::string_view before, std::string_view after) {
  const auto a = read(before, "a.eds");
  const auto b = read(after, "b.eds");
  REQUIRE(a);
  REQUIRE(b);
  const auto found = compare(*a, *b);
  REQUIRE(found);
  std::vector<std::string> out;
  for (const auto& each : *found) {
    const char sign = each.kind == Difference::Kind::added     ? '+'
                      : each.kind == Difference::Kind::removed ? '-'
                                                               : '~';
    out.push_back(sign + each.where + " " + each.key + " " + each.before + ">" + each.after);
  }
  return out;
}

TEST_CASE("Objects that came, went or changed are told with what changed in them") {
  CHECK(
      differences(
          "[DeviceInfo]\nRevisionNumber=1\n[2000]\nDataType=7\nDefaultValue=5\n[2001]\nDataType=5\n[2002]\n[2002sub1]\nAccessType=rw\n",
          "[DeviceInfo]\nRevisionNumber=2\n[2000]\nDataType=7\nDefaultValue=6\nLowLimit=0\n[2002]\n[2002sub1]\nAccessType=ro\n[2002sub2]\n[2003]\n") ==
      std::vector<std::string>{"~[DeviceInfo] RevisionNumber 1>2", "~2000h DefaultValue 5>6",
                               "~2000h LowLimit >0", "-2001h  >", "~2002h:01 AccessType rw>ro",
                               "+2002h:02  >", "+2003h  >"});
}

TEST_CASE("The same said in another way is no difference") {
  CHECK(
      differences(
          "[FileInfo]\nFileVersion=1\n[DeviceInfo]\nBaudRate_10=0\n[1000]\nDataType=0x0007\nObjectType=7\nAccessType=RO\nLowLimit=\nPDOMapping=0\n",
          "[DeviceInfo]\n[1000]\nAccessType=ro\nDataType=7\n")
          .empty());
  CHECK(differences("[2000]\nParameterName=a\nObjectType=8\nDataType=5\nAccessType=rw\nCompactSubObj=1\n",
                    "[2000]\nParameterName=a\nObjectType=8\nDataType=5\nAccessType=rw\n"
                    "[2000sub0]\nParameterName=NrOfObjects\nDataType=5\nAccessType=ro\nDefaultValue=1\n"
                    "[2000sub1]\nParameterName=a1\nDataType=5\nAccessType=rw\n")
            .empty());
}

TEST_CASE("What CompactSubObj implies is compared as if it were written out") {
  CHECK(differences("[2000]\nObjectType=8\nCompactSubObj=2\n", "[2000]\nObjectType=8\nCompactSubObj=3\n") ==
        std::vector<std::string>{"~2000h:00 DefaultValue 2>3", "+2000h:03  >"});
}

constexpr std::string_view in_eds =
    "[FileInfo]\nFileName=a.eds\nFileRevision=2\nCreationDate=12-31-2020\nCreationTime=11:59PM\n"
    "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nRevisionNumber=1\nBaudRate_10=0\nBaudRate_250=1\n"
    "SimpleBootUpMaster=0\nSimpleBootUpSlave=1\nGranularity=0x8\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
    "[DummyUsage]\nDummy0005=1\nDummy0006=0\n"
    "[2000]\nParameterName=In\nObjectType=7\nDataType=0x0006\nAccessType=ro\nPDOMapping=1\n"
    "[2001]\nParameterName=Out\nObjectType=7\nDataType=0x0006\nAccessType=rww\nPDOMapping=1\nObjFlags=0x1\n"
    "[2002]\nParameterName=On\nObjectType=7\nDataType=0x0001\nAccessType=rw\nDefaultValue=1\nPDOMapping=0\n"
    "[2003]\nParameterName=Id\nObjectType=7\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x80+$NODEID\n";

std::string in_xdd(std::string_view objects) {
  return "<ISO15745ProfileContainer><ISO15745Profile><ProfileBody fileName=\"b.xdd\" "
         "fileCreationDate=\"2020-12-31\" fileCreationTime=\"23:59:00\"><DeviceIdentity><vendorName>Example"
         "</vendorName><vendorID>31</vendorID></DeviceIdentity></ProfileBody></ISO15745Profile>"
         "<ISO15745Profile><ProfileBody><ApplicationLayers><CANopenObjectList>" +
         std::string(objects) +
         "</CANopenObjectList><dummyUsage><dummy entry=\"Dummy0005=1\"/></dummyUsage></ApplicationLayers>"
         "<TransportLayers><PhysicalLayer><baudRate><supportedBaudRate value=\"250 Kbps\"/></baudRate>"
         "</PhysicalLayer></TransportLayers><NetworkManagement><CANopenGeneralFeatures granularity=\"8\" "
         "nrOfTxPDO=\"1\" bootUpSlave=\"true\" groupMessaging=\"false\"/></NetworkManagement></ProfileBody>"
         "</ISO15745Profile></ISO15745ProfileContainer>";
}

constexpr std::string_view same_objects =
    "<CANopenObject index=\"2000\" name=\"In\" objectType=\"7\" dataType=\"0006\" accessType=\"ro\" "
    "PDOmapping=\"default\"/>"
    "<CANopenObject index=\"2001\" name=\"Out\" objectType=\"7\" dataType=\"06\" accessType=\"rw\" "
    "PDOmapping=\"RPDO\" objFlags=\"0005\"/>"
    "<CANopenObject index=\"2002\" name=\"On\" objectType=\"7\" dataType=\"01\" accessType=\"rw\" "
    "defaultValue=\"true\" PDOmapping=\"no\"/>"
    "<CANopenObject index=\"2003\" name=\"Id\" objectType=\"7\" dataType=\"07\" accessType=\"rw\" "
    "defaultValue=\"$NODEID+128\"/>";

std::vector<std::string> keys(const std::vector<Difference>& differences) {
  std::vector<std::string> out;
  for (const auto& each : differences) out.push_back(each.where + " " + each.key);
  return out;
}

TEST_CASE("An EDS and an XDD that say the same do not differ") {
  const auto eds = read(in_eds, "a.eds");
  const auto xdd = read(in_xdd(same_objects), "b.xdd");
  REQUIRE(eds);
  REQUIRE(xdd);
  const auto found = compare_in_full(*eds, *xdd);
  REQUIRE(found);
  CHECK(keys(found->of_device).empty());
  CHECK(keys(found->of_file) == std::vector<std::string>{"[FileInfo] FileName"});
  // What CiA 311 has no room for, and bit 2 of objFlags, for which CiA 306 has none.
  CHECK(keys(found->unsayable) ==
        std::vector<std::string>{"[FileInfo] FileRevision", "[DeviceInfo] RevisionNumber", "2001h ObjFlags"});
}

TEST_CASE("What an EDS and an XDD say differently is told") {
  const auto eds = read(in_eds, "a.eds");
  const auto xdd = read(
      in_xdd("<CANopenObject index=\"2000\" name=\"In\" objectType=\"7\" dataType=\"07\" accessType=\"ro\"/>"
             "<CANopenObject index=\"2001\" name=\"Out\" objectType=\"7\" dataType=\"06\" accessType=\"rw\" "
             "PDOmapping=\"TPDO\" objFlags=\"0000\"/>"
             "<CANopenObject index=\"2002\" name=\"On\" objectType=\"7\" dataType=\"01\" accessType=\"rw\" "
             "defaultValue=\"false\"/>"),
      "b.xdd");
  REQUIRE(eds);
  REQUIRE(xdd);
  const auto found = compare(*eds, *xdd);
  REQUIRE(found);
  CHECK(keys(*found) == std::vector<std::string>{"2000h DataType", "2000h PDOMapping", "2001h AccessType",
                                                 "2001h PDOMapping", "2001h ObjFlags", "2002h DefaultValue",
                                                 "2003h "});
}

TEST_CASE("A mapping that CiA 306 cannot say is told apart") {
  const auto eds = read("[2000]\nObjectType=7\nDataType=5\nAccessType=ro\nPDOMapping=1\n", "a.eds");
  const auto xdd = read(in_xdd("<CANopenObject index=\"2000\" objectType=\"7\" dataType=\"05\" "
                               "accessType=\"ro\" PDOmapping=\"RPDO\"/>"),
                        "b.xdd");
  REQUIRE(eds);
  REQUIRE(xdd);
  const auto found = compare_in_full(*eds, *xdd);
  REQUIRE(found);
  CHECK(keys(found->unsayable) == std::vector<std::string>{"2000h PDOMapping"});
}

TEST_CASE("Between two XDDs the words of a mapping count as far as they mean something else") {
  const auto with = [](std::string_view mapping) {
    return read(in_xdd("<CANopenObject index=\"2000\" objectType=\"7\" dataType=\"05\" accessType=\"ro\" "
                       "PDOmapping=\"" +
                       std::string(mapping) + "\"/>"),
                "b.xdd");
  };
  CHECK(compare(*with("TPDO"), *with("optional"))->empty());
  CHECK(compare(*with("default"), *with("optional"))->size() == 1);
  CHECK(compare(*with("no"), *with("optional"))->size() == 1);
}

TEST_CASE("Another access is one change, also where it changes what PDOMapping means") {
  CHECK(differences("[2000]\nAccessType=rw\nPDOMapping=1\n", "[2000]\nAccessType=ro\nPDOMapping=1\n") ==
        std::vector<std::string>{"~2000h AccessType rw>ro"});
}

TEST_CASE("A DOMAIN needs neither type nor access") {
  CHECK(differences("[2000]\nObjectType=2\n", "[2000]\nObjectType=2\nDataType=0x000F\nAccessType=rw\n")
            .empty());
}

TEST_CASE("Who wrote the file and when is no difference of the device") {
  const auto a = read(
      "[FileInfo]\nCreatedBy=a\nCreationDate=01-02-2020\n[Comments]\nLines=1\nLine1=x\n[2000]\n", "a.eds");
  const auto b = read("[FileInfo]\nCreatedBy=b\nCreationDate=1-2-2020\n[2000]\n", "b.eds");
  REQUIRE(a);
  REQUIRE(b);
  const auto found = compare_in_full(*a, *b);
  REQUIRE(found);
  CHECK(found->of_device.empty());
  CHECK(keys(found->of_file) == std::vector<std::string>{"[FileInfo] CreatedBy", "[Comments] Line1"});
}

}  // namespace
