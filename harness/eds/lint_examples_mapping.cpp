// SPDX-License-Identifier: Apache-2.0
// More examples of PDO mapping, and of the identity.
#include "eds/lint_examples_tables.hpp"

namespace conform::eds {
namespace {

// Each section in a line.
// clang-format off
constexpr LintExample examples[] = {
    {"EDS330",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=3\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=2\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0\n"
     "[1A00sub2]\nParameterName=Object 2\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n"},
    {"EDS335",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=3\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=2\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[1A00sub2]\nParameterName=Object 2\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20020040\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n"
     "[2002]\nParameterName=Position\nDataType=0x001B\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20020040\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n"
     "[2002]\nParameterName=Position\nDataType=0x001B\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n"},
    {"EDS336",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=3\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=2\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x00050008\n"
     "[1A00sub2]\nParameterName=Object 2\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n"},
    {"EDS337",
     "[DummyUsage]\nDummy0005=0\n"
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=1\nNrOfTXPDO=0\nLSS_Supported=0\n"
     "[1400]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1400sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1400sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x200\n"
     "[1400sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1600]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=3\n"
     "[1600sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=2\n"
     "[1600sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x00050008\n"
     "[1600sub2]\nParameterName=Object 2\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=rww\nDefaultValue=0\nPDOMapping=1\n",
     "[DummyUsage]\nDummy0005=1\n"
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=1\nNrOfTXPDO=0\nLSS_Supported=0\n"
     "[1400]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1400sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1400sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x200\n"
     "[1400sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1600]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=3\n"
     "[1600sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=2\n"
     "[1600sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x00050008\n"
     "[1600sub2]\nParameterName=Object 2\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=rww\nDefaultValue=0\nPDOMapping=1\n"},
    {"EDS338",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=2\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n"},
    {"EDS339",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=255\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=1\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=255\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n"},
    {"EDS340",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=0\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x80000180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=0\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n"},
    {"EDS341",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20010010\n"
     "[2001]\nParameterName=Motor\nObjectType=0x9\nSubNumber=2\n"
     "[2001sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[2001sub1]\nParameterName=Current\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20010110\n"
     "[2001]\nParameterName=Motor\nObjectType=0x9\nSubNumber=2\n"
     "[2001sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[2001sub1]\nParameterName=Current\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n"},
    {"EDS342",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=32\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=16\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n"},
    {"EDS343",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=rww\nDefaultValue=0\nPDOMapping=1\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n"},
    {"EDS344",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=0\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=3\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x20000010\n"
     "[1A00sub2]\nParameterName=Object 2\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=0\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n"},
    {"EDS401",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n"
     "[1018]\nParameterName=Identity\nObjectType=0x9\nSubNumber=4\n"
     "[1018sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=3\n"
     "[1018sub1]\nParameterName=Vendor-ID\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x1F\n"
     "[1018sub2]\nParameterName=Product code\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x3\n"
     "[1018sub3]\nParameterName=Revision number\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x10000\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n"
     "[1018]\nParameterName=Identity\nObjectType=0x9\nSubNumber=4\n"
     "[1018sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=3\n"
     "[1018sub1]\nParameterName=Vendor-ID\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x1F\n"
     "[1018sub2]\nParameterName=Product code\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x2\n"
     "[1018sub3]\nParameterName=Revision number\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x10000\n"},
    {"EDS402",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n"
     "[1018]\nParameterName=Identity\nObjectType=0x9\nSubNumber=4\n"
     "[1018sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=3\n"
     "[1018sub1]\nParameterName=Vendor-ID\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x1F\n"
     "[1018sub2]\nParameterName=Product code\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x2\n"
     "[1018sub3]\nParameterName=Revision number\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x10001\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n"
     "[1018]\nParameterName=Identity\nObjectType=0x9\nSubNumber=4\n"
     "[1018sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=3\n"
     "[1018sub1]\nParameterName=Vendor-ID\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x1F\n"
     "[1018sub2]\nParameterName=Product code\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x2\n"
     "[1018sub3]\nParameterName=Revision number\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x10000\n"},
    {"EDS403",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n"
     "[1018]\nParameterName=Identity\nObjectType=0x9\nSubNumber=4\n"
     "[1018sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=3\n"
     "[1018sub1]\nParameterName=Vendor-ID\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x1F\n"
     "[1018sub2]\nParameterName=Product code\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x2\n"
     "[1018sub3]\nParameterName=Revision number\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x10000\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n"
     "[1018]\nParameterName=Identity\nObjectType=0x9\nSubNumber=4\n"
     "[1018sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=3\n"
     "[1018sub1]\nParameterName=Vendor-ID\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x1F\n"
     "[1018sub2]\nParameterName=Product code\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x2\n"
     "[1018sub3]\nParameterName=Revision number\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x10000\n"},
    {"EDS404",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n"
     "[1018]\nParameterName=Identity\nObjectType=0x9\nSubNumber=4\n"
     "[1018sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=3\n"
     "[1018sub1]\nParameterName=Vendor-ID\nDataType=0x0007\nAccessType=ro\nDefaultValue=0\n"
     "[1018sub2]\nParameterName=Product code\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x2\n"
     "[1018sub3]\nParameterName=Revision number\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x10000\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n"
     "[1018]\nParameterName=Identity\nObjectType=0x9\nSubNumber=4\n"
     "[1018sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=3\n"
     "[1018sub1]\nParameterName=Vendor-ID\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x1F\n"
     "[1018sub2]\nParameterName=Product code\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x2\n"
     "[1018sub3]\nParameterName=Revision number\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x10000\n"},
};
// clang-format on

}  // namespace

constinit const std::span<const LintExample> mapping_examples{examples};

}  // namespace conform::eds
