// SPDX-License-Identifier: Apache-2.0
// What CiA 311 wants of an XDD, one edit of a right file at a time.
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "catch.hpp"
#include "eds/lint.hpp"
#include "eds/read.hpp"

namespace {

using namespace conform;
using namespace conform::eds;

std::string right_file() {
  std::ifstream file(std::string(CONFORM_SOURCE_DIR) + "/harness/eds/tests/fixtures/legal-xml-structure.xdd");
  REQUIRE(file);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// "EDS705 12:5" for each finding of the group after the edit.
std::vector<std::string> found(std::string_view old, std::string_view now) {
  auto text = right_file();
  const auto at = text.find(old);
  REQUIRE(at != std::string::npos);
  text.replace(at, old.size(), now);
  const auto file = eds::read(text, "a.xdd");
  REQUIRE(file);
  std::vector<std::string> out;
  for (const auto& finding : lint(*file).findings) {
    if (finding.rule->code >= "EDS700")
      out.push_back(std::string(finding.rule->code) + " " + finding.message);
  }
  return out;
}

using Found = std::vector<std::string>;

TEST_CASE("The right file has no finding") { CHECK(found("Blue", "Green").empty()); }

TEST_CASE("Values that no schema accepts are found") {
  CHECK(found("dataType=\"07\"", "dataType=\"0x07\"") ==
        Found{"EDS705 dataType=\"0x07\" is not an even number of hexadecimal digits without 0x"});
  CHECK(found("dataType=\"07\"", "dataType=\"7\"").size() == 1);
  CHECK(found("objectType=\"7\"", "objectType=\"0x7\"").size() == 1);
  CHECK(found("granularity=\"8\"", "granularity=\"256\"").size() == 1);
  CHECK(found("nrOfTxPDO=\"0\"", "nrOfTxPDO=\"none\"").size() == 1);
  CHECK(found("fileCreationDate=\"2024-02-29\"", "fileCreationDate=\"2023-02-29\"").size() == 1);
  CHECK(found("10:00:00.0000000+02:00", "10:00AM").size() == 1);
  CHECK(found("value=\"250 Kbps\"", "value=\"250 kbit/s\"").size() == 1);
  CHECK(found("value=\"auto-baudRate\"", "value=\"300 Kbps\"").size() == 1);
  CHECK(found("Dummy0005=1", "Dummy0005=2").size() == 1);
  CHECK(found("accessType=\"ro\"", "accessType=\"rwr\"").size() == 1);
}

TEST_CASE("What the schema accepts is silent") {
  CHECK(found("dataType=\"07\"", "dataType=\"00000007\"").empty());
  CHECK(found("bootUpSlave=\"true\"", "bootUpSlave=\"1\"").empty());
  CHECK(found("value=\"250 Kbps\"", "value=\"100 Kbps\"").empty());
  CHECK(found("<UINT/>", "<DWORD/>").empty());
  CHECK(found("access=\"readWrite\"", "access=\"readWriteInput\"").empty());
  CHECK(found("<CANopenMasterFeatures bootUpMaster=\"false\"/>", "<!-- none -->").empty());
  CHECK(found("<CANopenObject index", "<!-- a --><CANopenObject index").empty());
}

TEST_CASE("Elements that are missing, too many or misplaced are found with their place") {
  CHECK(found("<UINT/>", "") == Found{"EDS702 <BOOL> in <parameter> is missing"});
  CHECK(
      found("<CANopenMasterFeatures bootUpMaster=\"false\"/>",
            "<CANopenMasterFeatures/><CANopenMasterFeatures/>") ==
      Found{
          "EDS701 <CANopenMasterFeatures> in <NetworkManagement> stands in the wrong place, or there is one "
          "too many"});
  CHECK(found("<dummyUsage>", "<dummyUsages>x</dummyUsages><dummyUsage>") ==
        Found{"EDS700 <dummyUsages> in <ApplicationLayers> is not known"});
}

TEST_CASE("Required attributes are missed, and unknown ones told") {
  CHECK(found("granularity=\"8\" ", "") ==
        Found{"EDS704 granularity of <CANopenGeneralFeatures> is missing"});
  CHECK(found("subIndex=\"01\" name=\"Vendor-ID\"", "subIndex=\"01\" label=\"Vendor-ID\"") ==
        Found{"EDS704 name of <CANopenSubObject> is missing",
              "EDS703 label of <CANopenSubObject> is not known"});
}

TEST_CASE("Of a file of version 1.0 only the values are looked at") {
  CHECK(found("granularity=\"8\" ", "").size() == 1);
  const auto old = eds::read(
      "<ISO15745ProfileContainer xmlns=\"http://www.canopen.org/xml/1.0\"><ISO15745Profile><ProfileBody>"
      "<NetworkManagement><CANopenGeneralFeatures nrOfRxPDO=\"many\" own=\"1\"/></NetworkManagement>"
      "<CANopenObjectList/></ProfileBody></ISO15745Profile></ISO15745ProfileContainer>",
      "a.xdd");
  REQUIRE(old);
  std::vector<Deviation> what;
  for (const auto& remark : old->remarks.all()) what.push_back(remark.what);
  CHECK(what == std::vector<Deviation>{Deviation::xml_bad_value});
}

}  // namespace
