// SPDX-License-Identifier: Apache-2.0
// From EDS to XDD and back, and the other way round.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "catch.hpp"
#include "eds/compare.hpp"
#include "eds/convert/to_ini.hpp"
#include "eds/convert/to_xdd.hpp"
#include "eds/convert/write_ini.hpp"
#include "eds/convert/write_xdd.hpp"
#include "eds/lint.hpp"
#include "eds/read.hpp"

namespace {

namespace fs = std::filesystem;
using namespace conform;
using namespace conform::eds;

const fs::path folder = fs::path(CONFORM_SOURCE_DIR) / "harness/eds/tests/fixtures";

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

struct Written {
  std::string text;
  EdsFile file;
  std::vector<Unsaid> unsaid;
};

/// In the other of the two languages; configured when the source is.
Written converted(const EdsFile& source) {
  Written out;
  if (source.is_xml()) {
    auto done = to_ini(source, source.format == Format::xdc ? Format::dcf : Format::eds, "b.eds");
    out.text = write_ini(done.file);
    out.unsaid = std::move(done.unsaid);
  } else {
    auto done = to_xdd(source, source.format == Format::dcf ? Format::xdc : Format::xdd, "b.xdd");
    REQUIRE(done);
    out.text = write_xdd(done->file);
    out.unsaid = std::move(done->unsaid);
  }
  auto again = read(out.text, source.is_xml() ? "b.eds" : "b.xdd");
  REQUIRE(again);
  out.file = std::move(*again);
  return out;
}

/// Differences that the list does not tell.
std::vector<std::string> untold(const EdsFile& before, const EdsFile& after,
                                const std::vector<Unsaid>& told) {
  const auto found = compare(before, after);
  REQUIRE(found);
  std::vector<std::string> out;
  for (const auto& each : *found) {
    const bool is_told = std::ranges::any_of(told, [&](const Unsaid& other) {
      return other.where == each.where && (other.key.empty() || other.key == each.key);
    });
    if (!is_told) out.push_back(each.where + " " + each.key + ": " + each.before + " -> " + each.after);
  }
  return out;
}

std::size_t errors_of(const EdsFile& file) { return lint(file).count(Severity::error); }

TEST_CASE("Every right description goes to the other language and back, and what changes is told") {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const auto name = entry.path().filename().string();
    CAPTURE(name);
    if (!name.starts_with("legal-")) continue;
    const auto source = read(content(entry.path()), name);
    REQUIRE(source);
    const auto there = converted(*source);
    CHECK(untold(*source, there.file, there.unsaid).empty());
    CHECK(errors_of(there.file) == 0);
    const auto back = converted(there.file);
    CHECK(back.file.format == source->format);
    CHECK(errors_of(back.file) == 0);
    auto told = there.unsaid;
    told.insert(told.end(), back.unsaid.begin(), back.unsaid.end());
    CHECK(untold(*source, back.file, told).empty());
    CHECK(converted(*source).text == there.text);
  }
}

TEST_CASE("A file with mistakes is converted without new ones that CiA 311 would not have") {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const auto name = entry.path().filename().string();
    CAPTURE(name);
    const auto source = read(content(entry.path()), name);
    REQUIRE(source);
    if (name == "bad-too-many-implied.eds") continue;  // refused, as everywhere
    const auto there = converted(*source);
    CHECK(untold(*source, there.file, there.unsaid).empty());
  }
}

constexpr std::string_view eds_text =
    "[FileInfo]\nFileName=a.eds\nFileVersion=3\nFileRevision=1\nEDSVersion=4.0\nDescription=A \"device\" <of> A&B\n"
    "CreationTime=09:15PM\nCreationDate=02-28-2021\nCreatedBy=me\n"
    "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=D\nProductNumber=2\nRevisionNumber=3\n"
    "OrderCode=X1\nBaudRate_125=1\nBaudRate_250=0\nSimpleBootUpSlave=1\nGranularity=0x8\nNrOfTXPDO=1\nLSS_Supported=1\n"
    "[DummyUsage]\nDummy0002=1\n[Comments]\nLines=1\nLine1=hello\n"
    "[2000]\nParameterName=Both\nObjectType=7\nDataType=0x0006\nAccessType=rw\nPDOMapping=1\n"
    "[2001]\nParameterName=In\nObjectType=7\nDataType=0x0006\nAccessType=rwr\nPDOMapping=1\nLowLimit=0\nHighLimit=9\n"
    "[2002]\nParameterName=Quiet\nObjectType=7\nDataType=0x0006\nAccessType=rwr\nDefaultValue=5\nPDOMapping=0\n"
    "[2003]\nParameterName=Odd\nObjectType=7\nDataType=0x0016\nAccessType=rww\nPDOMapping=0\nObjFlags=3\n"
    "[2004]\nParameterName=Text\nDataType=0x0009\nAccessType=const\nDefaultValue=a\tb \x94\n"
    "[2005]\nParameterName=Type\nDataType=0x0120\nAccessType=ro\n";

TEST_CASE("An XDD is built as CiA 311 wants it") {
  const auto source = read(eds_text, "a.eds");
  REQUIRE(source);
  const auto xdd = converted(*source);
  for (const auto& finding : lint(xdd.file).findings) {
    CAPTURE(finding.message);
    CHECK(finding.rule->code < "EDS700");
  }
  const auto has = [&](std::string_view what) { return xdd.text.find(what) != std::string::npos; };
  CHECK(has("<ProfileBody xmlns=\"\" xsi:type=\"c:ProfileBody_Device_CANopen\""));
  CHECK(has("fileCreationDate=\"2021-02-28\" fileCreationTime=\"21:15:00\""));
  CHECK(has("<description lang=\"en\">A \"device\" &lt;of&gt; A&amp;B</description>"));
  CHECK(has("<c:orderNumber>X1</c:orderNumber>"));
  CHECK(has("<supportedBaudRate value=\"125 Kbps\" />"));
  CHECK_FALSE(has("250 Kbps"));
  CHECK(has("<dummy entry=\"Dummy0002=1\" />"));
  CHECK(has(
      "granularity=\"8\" nrOfRxPDO=\"0\" nrOfTxPDO=\"1\" bootUpSlave=\"true\" layerSettingServiceSlave=\"true\""));
  CHECK(has("<CANopenObject index=\"2000\" name=\"Both\" objectType=\"7\" dataType=\"06\" accessType=\"rw\" "
            "PDOmapping=\"optional\" />"));
  CHECK(has("lowLimit=\"0\" highLimit=\"9\" accessType=\"rw\" PDOmapping=\"TPDO\""));
  CHECK(has("<c:parameter uniqueID=\"UID_OBJ_2002\" access=\"readWriteInput\">"));
  CHECK(has(
      "<CANopenObject index=\"2002\" name=\"Quiet\" objectType=\"7\" PDOmapping=\"no\" uniqueIDRef=\"UID_OBJ_2002\" />"));
  CHECK(has("objFlags=\"0003\""));
  CHECK(has("dataType=\"0120\""));
  CHECK(has("mandatoryObjects=\"0\" optionalObjects=\"0\" manufacturerObjects=\"6\""));
}

TEST_CASE("What CiA 311 cannot say is told with its place") {
  const auto source = read(eds_text, "a.eds");
  REQUIRE(source);
  std::vector<std::string> told;
  for (const auto& each : converted(*source).unsaid) {
    told.push_back(each.where + " " + each.key);
    CHECK(each.at.known());
  }
  CHECK(told == std::vector<std::string>{"[FileInfo] FileRevision", "[FileInfo] EDSVersion",
                                         "2003h AccessType", "2004h DefaultValue",
                                         "[DeviceInfo] RevisionNumber", "[Comments] "});
}

TEST_CASE("A description is not configured: an XDD and an EDS leave that out, an XDC and a DCF have it") {
  const std::string_view dcf =
      "[DeviceComissioning]\nNodeID=5\nNodeName=five\nBaudrate=250\nNetNumber=1\nLSS_SerialNumber=7\n"
      "[2000]\nParameterName=A\nDataType=5\nAccessType=rw\nParameterValue=3\nDenotation=mine\n";
  const auto source = read(dcf, "a.dcf");
  REQUIRE(source);
  const auto xdc = converted(*source);
  CHECK(xdc.file.format == Format::xdc);
  CHECK(xdc.text.find("<deviceCommissioning nodeID=\"5\" nodeName=\"five\" actualBaudRate=\"250 Kbps\"") !=
        std::string::npos);
  CHECK(xdc.file.commissioning.baudrate.text == "250");
  CHECK(untold(*source, xdc.file, xdc.unsaid).empty());
  const auto back = to_ini(xdc.file, Format::dcf, "b.dcf");
  CHECK(write_ini(back.file).find("ParameterValue=3\r\nDenotation=mine\r\n") != std::string::npos);
  const auto xdd = to_xdd(*source, Format::xdd, "b.xdd");
  REQUIRE(xdd);
  CHECK(write_xdd(xdd->file).find("actualValue") == std::string::npos);
  const auto eds = to_ini(xdc.file, Format::eds, "b.eds");
  const auto again = read(write_ini(eds.file), "b.eds");
  REQUIRE(again);
  CHECK(again->format == Format::eds);
  CHECK(std::ranges::count(eds.unsaid, "2000h", &Unsaid::where) == 2);
}

TEST_CASE("What CompactSubObj and CompactPDO imply is written out") {
  const auto source = read(content(folder / "legal-compact-sub-objects.eds"), "a.eds");
  REQUIRE(source);
  const auto xdd = converted(*source);
  CHECK(xdd.text.find("subIndex=\"03\"") != std::string::npos);
  CHECK(std::ranges::count(xdd.unsaid, "CompactSubObj", &Unsaid::key) > 0);
}

TEST_CASE("A process input is rwr, a process output rww") {
  const auto file = read(
      "<ISO15745ProfileContainer><ProfileBody><parameterList>"
      "<parameter uniqueID=\"I\" access=\"readWriteInput\"><USINT/></parameter>"
      "<parameter uniqueID=\"O\" access=\"readWriteOutput\"><USINT/></parameter></parameterList><CANopenObjectList>"
      "<CANopenObject index=\"2000\" objectType=\"7\" uniqueIDRef=\"I\"/>"
      "<CANopenObject index=\"2001\" objectType=\"7\" uniqueIDRef=\"O\"/></CANopenObjectList></ProfileBody>"
      "</ISO15745ProfileContainer>",
      "a.xdd");
  REQUIRE(file);
  CHECK(access(file->find(Index(0x2000))->entry) == Access::rwr);
  CHECK(access(file->find(Index(0x2001))->entry) == Access::rww);
  CHECK(file->unmodelled.empty());
}

TEST_CASE("What an EDS has no room for is counted") {
  const auto file = read(content(folder / "legal-xml-structure.xdd"), "a.xdd");
  REQUIRE(file);
  std::vector<std::string> what;
  for (const auto& each : file->unmodelled) what.push_back(each.what);
  CHECK(what == std::vector<std::string>{"orderNumber", "version", "characteristicsList",
                                         "parameter/@persistent", "description", "baudRate/@defaultValue",
                                         "supportedBaudRate auto-baudRate"});
}

}  // namespace
