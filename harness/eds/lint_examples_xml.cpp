// SPDX-License-Identifier: Apache-2.0
// Examples of XDD and XDC.
#include "eds/lint_examples_tables.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view file = "example.xdd";

// Each element in a line.
// clang-format off
constexpr LintExample examples[] = {
    {"EDS040",
     "<CANopenObject index=\"20x0\" name=\"Gain\" objectType=\"7\" dataType=\"0006\" accessType=\"rw\" PDOmapping=\"no\"/>\n",
     "<CANopenObject index=\"2000\" name=\"Gain\" objectType=\"7\" dataType=\"0006\" accessType=\"rw\" PDOmapping=\"no\"/>\n",
     file},
    {"EDS041",
     "<ApplicationLayers>\n"
     "  <dummyUsage>\n"
     "    <dummy entry=\"Dummy0005=1\"/>\n"
     "  </dummyUsage>\n"
     "</ApplicationLayers>\n",
     "<ApplicationLayers>\n"
     "  <c:CANopenObjectList>\n"
     "    <CANopenObject index=\"1000\" name=\"Device type\" objectType=\"7\" dataType=\"0007\" accessType=\"ro\" defaultValue=\"0\"/>\n"
     "    <CANopenObject index=\"1001\" name=\"Error register\" objectType=\"7\" dataType=\"0005\" accessType=\"ro\"/>\n"
     "    <CANopenObject index=\"1017\" name=\"Producer heartbeat time\" objectType=\"7\" dataType=\"0006\" accessType=\"rw\"/>\n"
     "    <CANopenObject index=\"1018\" name=\"Identity\" objectType=\"9\" subNumber=\"2\">\n"
     "      <CANopenSubObject subIndex=\"00\" name=\"Highest sub-index\" objectType=\"7\" dataType=\"0005\" accessType=\"ro\" defaultValue=\"1\"/>\n"
     "      <CANopenSubObject subIndex=\"01\" name=\"Vendor-ID\" objectType=\"7\" dataType=\"0007\" accessType=\"ro\" defaultValue=\"0x1F\"/>\n"
     "    </CANopenObject>\n"
     "  </c:CANopenObjectList>\n"
     "  <dummyUsage>\n"
     "    <dummy entry=\"Dummy0005=1\"/>\n"
     "  </dummyUsage>\n"
     "</ApplicationLayers>\n",
     file},
    {"EDS042",
     "<CANopenObject index=\"2000\" name=\"Gain\" objectType=\"7\" PDOmapping=\"no\" uniqueIDRef=\"GAIN_2\"/>\n",
     "<CANopenObject index=\"2000\" name=\"Gain\" objectType=\"7\" PDOmapping=\"no\" uniqueIDRef=\"GAIN\"/>\n",
     file},
    {"EDS043",
     "<CANopenObject index=\"2000\" name=\"Gain\" objectType=\"7\" dataType=\"0006\" accessType=\"rw\" PDOmapping=\"no\"/>\n"
     "<CANopenObject index=\"2000\" name=\"Speed\" objectType=\"7\" dataType=\"0006\" accessType=\"rw\" PDOmapping=\"no\"/>\n",
     "<CANopenObject index=\"2000\" name=\"Gain\" objectType=\"7\" dataType=\"0006\" accessType=\"rw\" PDOmapping=\"no\"/>\n"
     "<CANopenObject index=\"2001\" name=\"Speed\" objectType=\"7\" dataType=\"0006\" accessType=\"rw\" PDOmapping=\"no\"/>\n",
     file},
    {"EDS044",
     "<CANopenObject index=\"2000\" name=\"Gain\" objectType=\"7\" dataType=\"0006\" accessType=\"rw\" PDOmapping=\"yes\"/>\n",
     "<CANopenObject index=\"2000\" name=\"Gain\" objectType=\"7\" dataType=\"0006\" accessType=\"rw\" PDOmapping=\"optional\"/>\n",
     file},
    {"EDS700",
     "<c:DeviceIdentity>\n"
     "  <c:vendorName>Example</c:vendorName>\n"
     "  <c:vendorID>0x1F</c:vendorID>\n"
     "  <c:productName>Example</c:productName>\n"
     "  <c:firmware>7</c:firmware>\n"
     "</c:DeviceIdentity>\n",
     "<c:DeviceIdentity>\n"
     "  <c:vendorName>Example</c:vendorName>\n"
     "  <c:vendorID>0x1F</c:vendorID>\n"
     "  <c:productName>Example</c:productName>\n"
     "  <c:version versionType=\"FW\">7</c:version>\n"
     "</c:DeviceIdentity>\n",
     file},
    {"EDS701",
     "<c:DeviceIdentity>\n"
     "  <c:vendorID>0x1F</c:vendorID>\n"
     "  <c:vendorName>Example</c:vendorName>\n"
     "  <c:productName>Example</c:productName>\n"
     "</c:DeviceIdentity>\n",
     "<c:DeviceIdentity>\n"
     "  <c:vendorName>Example</c:vendorName>\n"
     "  <c:vendorID>0x1F</c:vendorID>\n"
     "  <c:productName>Example</c:productName>\n"
     "</c:DeviceIdentity>\n",
     file},
    {"EDS702",
     "<ISO15745Reference>\n"
     "  <ISO15745Part>1</ISO15745Part>\n"
     "  <ISO15745Edition>1</ISO15745Edition>\n"
     "</ISO15745Reference>\n",
     "<ISO15745Reference>\n"
     "  <ISO15745Part>1</ISO15745Part>\n"
     "  <ISO15745Edition>1</ISO15745Edition>\n"
     "  <ProfileTechnology>CANopen</ProfileTechnology>\n"
     "</ISO15745Reference>\n",
     file},
    {"EDS703",
     "<CANopenObject index=\"2000\" name=\"Gain\" objectType=\"7\" dataType=\"0006\" accessType=\"rw\" PDOmapping=\"no\" storage=\"RAM\"/>\n",
     "<CANopenObject index=\"2000\" name=\"Gain\" objectType=\"7\" dataType=\"0006\" accessType=\"rw\" PDOmapping=\"no\"/>\n",
     file},
    {"EDS704",
     "<CANopenGeneralFeatures nrOfRxPDO=\"0\" nrOfTxPDO=\"0\" bootUpSlave=\"true\"/>\n",
     "<CANopenGeneralFeatures granularity=\"8\" nrOfRxPDO=\"0\" nrOfTxPDO=\"0\" bootUpSlave=\"true\"/>\n",
     file},
    {"EDS705",
     "<CANopenGeneralFeatures granularity=\"8\" nrOfRxPDO=\"0\" nrOfTxPDO=\"0\" bootUpSlave=\"yes\"/>\n",
     "<CANopenGeneralFeatures granularity=\"8\" nrOfRxPDO=\"0\" nrOfTxPDO=\"0\" bootUpSlave=\"true\"/>\n",
     file},
    {"EDS706",
     "<ISO15745ProfileContainer xmlns=\"http://www.example.org/xml\"\n"
     "                          xmlns:c=\"http://www.canopen.org/xml/1.1\"\n"
     "                          xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\">\n",
     "<ISO15745ProfileContainer xmlns=\"http://www.canopen.org/xml/1.1\"\n"
     "                          xmlns:c=\"http://www.canopen.org/xml/1.1\"\n"
     "                          xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\">\n",
     file},
    {"EDS707",
     "<ProfileHeader>\n",
     "<ProfileHeader xmlns=\"\">\n",
     file},
};
// clang-format on

}  // namespace

constinit const std::span<const LintExample> xml_examples{examples};

}  // namespace conform::eds
