// SPDX-License-Identifier: Apache-2.0
// Examples of the file as a whole: its bytes, the sections that it must have, and comments for the lint.
#include "eds/lint_examples_tables.hpp"

namespace conform::eds {
namespace {

// Each section in a line.
// clang-format off
constexpr LintExample examples[] = {
    {"EDS007",
     "Description=An example\n[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\n",
     "[FileInfo]\nDescription=An example\nFileName=example.eds\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\n"},
    {"EDS013",
     "[2000]\nParameterName=Temp\xE9rature\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n",
     "[2000]\nParameterName=Temperature\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n"},
    {"EDS014",
     "[2000]\nParameterName=Speed\x07\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n"},
    {"EDS015",
     "[2000]\r\nParameterName=Speed\r\nObjectType=0x7\r\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n"},
    {"EDS016",
     "[2000]\rParameterName=Speed\rObjectType=0x7\rDataType=0x0006\rAccessType=rw\rDefaultValue=100\r",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n"},
    {"EDS017",
     "\xEF\xBB\xBF; The example\n[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\n",
     "; The example\n[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\n"},
    {"EDS100",
     "; no [FileInfo]\n",
     "[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\n"},
    {"EDS101",
     "; no [DeviceInfo]\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n"},
    {"EDS102",
     "; no [DummyUsage]\n",
     "[DummyUsage]\nDummy0001=0\nDummy0002=0\nDummy0003=0\nDummy0004=0\nDummy0005=1\nDummy0006=0\nDummy0007=0\n"},
    {"EDS113",
     "; no [DeviceComissioning]\n",
     "[DeviceComissioning]\nNodeID=5\nBaudrate=125\n",
     "example.dcf"},
    {"EDS121",
     "[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\nCreationDate=03-31-2024\nModificationDate=02-12-2024\n",
     "[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\nCreationDate=03-31-2024\nModificationDate=12-02-2024\n"},
    {"EDS150",
     "; no [MandatoryObjects]\n",
     "[MandatoryObjects]\nSupportedObjects=3\n1=0x1000\n2=0x1001\n3=0x1018\n"},
    {"EDS151",
     "; no [ManufacturerObjects]\n",
     "[ManufacturerObjects]\nSupportedObjects=0\n"},
    {"EDS158",
     "; no [1001]\n"
     "[MandatoryObjects]\nSupportedObjects=2\n1=0x1000\n2=0x1018\n",
     "[MandatoryObjects]\nSupportedObjects=3\n1=0x1000\n2=0x1001\n3=0x1018\n"
     "[1001]\nParameterName=Error register\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\n"},
    {"EDS159",
     "; no [1018]\n"
     "[MandatoryObjects]\nSupportedObjects=2\n1=0x1000\n2=0x1001\n",
     "[MandatoryObjects]\nSupportedObjects=3\n1=0x1000\n2=0x1001\n3=0x1018\n"
     "[1018]\nParameterName=Identity\nObjectType=0x9\nSubNumber=4\n"
     "[1018sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=3\n"
     "[1018sub1]\nParameterName=Vendor-ID\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x1F\n"
     "[1018sub2]\nParameterName=Product code\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x2\n"
     "[1018sub3]\nParameterName=Revision number\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x10000\n"},
    {"EDS440",
     "; no [1017]\n"
     "[OptionalObjects]\nSupportedObjects=0\n",
     "[OptionalObjects]\nSupportedObjects=1\n1=0x1017\n"
     "[1017]\nParameterName=Producer heartbeat time\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n"},
    {"EDS900",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\n; lint: ignore EDS053\nDefaultValue=05\n",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\n; lint: allow EDS053 our editor writes two digits\nDefaultValue=05\n"},
    {"EDS901",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\n; lint: allow EDS999 our editor writes two digits\nDefaultValue=05\n",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\n; lint: allow EDS053 our editor writes two digits\nDefaultValue=05\n"},
    {"EDS902",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\n; lint: allow EDS053\nDefaultValue=05\n",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\n; lint: allow EDS053 our editor writes two digits\nDefaultValue=05\n"},
    {"EDS903",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\n; lint: allow EDS053 our editor writes two digits\nDefaultValue=5\n",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=5\n"},
};
// clang-format on

}  // namespace

constinit const std::span<const LintExample> files_examples{examples};

}  // namespace conform::eds
