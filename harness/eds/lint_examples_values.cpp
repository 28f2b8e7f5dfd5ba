// SPDX-License-Identifier: Apache-2.0
// More examples of structure, values and objects.
#include "eds/lint_examples_tables.hpp"

namespace conform::eds {
namespace {

// Each section in a line.
// clang-format off
constexpr LintExample examples[] = {
    {"EDS012",
     "[2000]\nParameterName=Speed of the motor, measured behind the gear, measured behind the gear, measured behind the gear, measured behind the gear, measured behind the gear, measured behind the gear, measured behind the gear, measured behind the gear, measured behind the gear, measured behind the gear, \nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n",
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n"},
    {"EDS021",
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n"
     "[]\n",
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n"},
    {"EDS023",
     "[DeviceComissioning]\nNodeID=5\nBaudrate=125\n"
     "[DeviceCommissioning]\nNodeID=6\nBaudrate=125\n",
     "[DeviceComissioning]\nNodeID=5\nBaudrate=125\n"},
    {"EDS080",
     "[2000]\nParameterName=Table\nObjectType=0x2\nAccessType=rw\nDefaultValue=0x0102\n",
     "[2000]\nParameterName=Table\nObjectType=0x2\nAccessType=rw\nDefaultValue=01 02\n"},
    {"EDS081",
     "[2000]\nParameterName=Offset\nDataType=0x0003\nAccessType=rw\nDefaultValue=0xFFFFFFFB\n",
     "[2000]\nParameterName=Offset\nDataType=0x0003\nAccessType=rw\nDefaultValue=-5\n"},
    {"EDS116",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\nLMT_ProductName=Example\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n"},
    {"EDS117",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=16\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n"
     "[DummyUsage]\nDummy0005=1\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n"
     "[DummyUsage]\nDummy0005=1\n"},
    {"EDS118",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=1\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n"},
    {"EDS120",
     "[Comments]\nLines=1\nLine1=First line\nLine2=Second line\n",
     "[Comments]\nLines=2\nLine1=First line\nLine2=Second line\n"},
    {"EDS162",
     "[MandatoryObjects]\nSupportedObjects=2\n1=0x1000\n2=0x1001\n"
     "[OptionalObjects]\nSupportedObjects=2\n1=0x1017\n2=0x1018\n",
     "[MandatoryObjects]\nSupportedObjects=3\n1=0x1000\n2=0x1001\n3=0x1018\n"
     "[OptionalObjects]\nSupportedObjects=1\n1=0x1017\n"},
    {"EDS214",
     "[2000]\nParameterName=Table\nObjectType=0x2\nDataType=0x0005\nAccessType=rw\n",
     "[2000]\nParameterName=Table\nObjectType=0x2\nDataType=0x000F\nAccessType=rw\n"},
    {"EDS215",
     "[2001]\nParameterName=Motor\nObjectType=0x9\nAccessType=ro\nSubNumber=3\n"
     "[2001sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[2001sub1]\nParameterName=Current\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"
     "[2001sub2]\nParameterName=Voltage\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n",
     "[2001]\nParameterName=Motor\nObjectType=0x9\nSubNumber=3\n"
     "[2001sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[2001sub1]\nParameterName=Current\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"
     "[2001sub2]\nParameterName=Voltage\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"},
    {"EDS216",
     "[2000]\nParameterName=Name\nDataType=0x0009\nAccessType=ro\nDefaultValue=Motor\nPDOMapping=1\n",
     "[2000]\nParameterName=Name\nDataType=0x0009\nAccessType=ro\nDefaultValue=Motor\nPDOMapping=0\n"},
    {"EDS217",
     "[2000]\nParameterName=Version\nDataType=0x0006\nAccessType=const\nDefaultValue=1\nPDOMapping=1\n",
     "[2000]\nParameterName=Version\nDataType=0x0006\nAccessType=const\nDefaultValue=1\nPDOMapping=0\n"},
    {"EDS235",
     "[100C]\nParameterName=Guard time\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n",
     "[100C]\nParameterName=Guard time\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n"
     "[100D]\nParameterName=Life time factor\nDataType=0x0005\nAccessType=rw\nDefaultValue=0\n"},
    {"EDS236",
     "[1019]\nParameterName=Synchronous counter overflow value\nDataType=0x0005\nAccessType=rw\nDefaultValue=0\n",
     "[1005]\nParameterName=COB-ID SYNC\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x80\n"
     "[1019]\nParameterName=Synchronous counter overflow value\nDataType=0x0005\nAccessType=rw\nDefaultValue=0\n"},
    {"EDS237",
     "[1005]\nParameterName=COB-ID SYNC\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x80\n"
     "[1006]\nParameterName=Communication cycle period\nDataType=0x0007\nAccessType=ro\nDefaultValue=0\n",
     "[1005]\nParameterName=COB-ID SYNC\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x80\n"
     "[1006]\nParameterName=Communication cycle period\nDataType=0x0007\nAccessType=rw\nDefaultValue=0\n"},
    {"EDS238",
     "[1018]\nParameterName=Identity\nObjectType=0x9\nSubNumber=6\n"
     "[1018sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=5\n"
     "[1018sub1]\nParameterName=Vendor-ID\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x1F\n"
     "[1018sub2]\nParameterName=Product code\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x2\n"
     "[1018sub3]\nParameterName=Revision number\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x10000\n"
     "[1018sub4]\nParameterName=Serial number\nDataType=0x0007\nAccessType=ro\nDefaultValue=0\n"
     "[1018sub5]\nParameterName=Hardware\nDataType=0x0007\nAccessType=ro\nDefaultValue=0\n",
     "[1018]\nParameterName=Identity\nObjectType=0x9\nSubNumber=5\n"
     "[1018sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=4\n"
     "[1018sub1]\nParameterName=Vendor-ID\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x1F\n"
     "[1018sub2]\nParameterName=Product code\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x2\n"
     "[1018sub3]\nParameterName=Revision number\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x10000\n"
     "[1018sub4]\nParameterName=Serial number\nDataType=0x0007\nAccessType=ro\nDefaultValue=0\n"},
    {"EDS239",
     "[1017]\nParameterName=Producer heartbeat time\nObjectType=0x9\nSubNumber=2\n"
     "[1017sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1017sub1]\nParameterName=Time\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n",
     "[1017]\nParameterName=Producer heartbeat time\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n"},
    {"EDS260",
     "[2001]\nParameterName=Set points\nObjectType=0x9\nSubNumber=3\n"
     "[2001sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[2001sub1]\nParameterName=First\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n"
     "[2001sub2]\nParameterName=Second\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n",
     "[2001]\nParameterName=Set points\nObjectType=0x9\nSubNumber=3\n"
     "[2001sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=rw\nDefaultValue=2\n"
     "[2001sub1]\nParameterName=First\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n"
     "[2001sub2]\nParameterName=Second\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n"},
    {"EDS261",
     "[2001]\nParameterName=Set points\nObjectType=0x8\nSubNumber=3\n"
     "[2001sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[2001sub1]\nParameterName=First\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n"
     "[2001sub2]\nParameterName=Second\nDataType=0x0007\nAccessType=rw\nDefaultValue=0\n",
     "[2001]\nParameterName=Set points\nObjectType=0x8\nSubNumber=3\n"
     "[2001sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[2001sub1]\nParameterName=First\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n"
     "[2001sub2]\nParameterName=Second\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n"},
    {"EDS263",
     "[2001]\nParameterName=Motor\nObjectType=0x9\nSubNumber=2\n"
     "[2001sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[2001sub1]\nParameterName=Current\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"
     "[2001sub2]\nParameterName=Voltage\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n",
     "[2001]\nParameterName=Motor\nObjectType=0x9\nSubNumber=3\n"
     "[2001sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[2001sub1]\nParameterName=Current\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"
     "[2001sub2]\nParameterName=Voltage\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"},
    {"EDS271",
     "[2001]\nParameterName=Set point\nObjectType=0x8\nDataType=0x0006\nAccessType=rw\nCompactSubObj=2\n"
     "[2001sub1]\nParameterName=First\nDataType=0x0006\nAccessType=rw\n",
     "[2001]\nParameterName=Set point\nObjectType=0x8\nDataType=0x0006\nAccessType=rw\nCompactSubObj=2\n"},
};
// clang-format on

}  // namespace

constinit const std::span<const LintExample> values_examples{examples};

}  // namespace conform::eds
