// SPDX-License-Identifier: Apache-2.0
// Examples of services, COB-IDs and information sections.
#include "eds/lint_examples_tables.hpp"

namespace conform::eds {
namespace {

// Each section in a line.
// clang-format off
constexpr LintExample examples[] = {
    {"EDS441",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=2\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
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
    {"EDS442",
     "[1015]\nParameterName=Inhibit time EMCY\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n",
     "[1014]\nParameterName=COB-ID EMCY\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x80\n"
     "[1015]\nParameterName=Inhibit time EMCY\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n"},
    {"EDS443",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n",
     "[1005]\nParameterName=COB-ID SYNC\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x80\n"
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n"},
    {"EDS444",
     "[1006]\nParameterName=Communication cycle period\nDataType=0x0007\nAccessType=rw\nDefaultValue=0\n",
     "[1005]\nParameterName=COB-ID SYNC\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x80\n"
     "[1006]\nParameterName=Communication cycle period\nDataType=0x0007\nAccessType=rw\nDefaultValue=0\n"},
    {"EDS445",
     "[1005]\nParameterName=COB-ID SYNC\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x40000080\n",
     "[1005]\nParameterName=COB-ID SYNC\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x40000080\n"
     "[1006]\nParameterName=Communication cycle period\nDataType=0x0007\nAccessType=rw\nDefaultValue=0\n"},
    {"EDS450",
     "[1014]\nParameterName=COB-ID EMCY\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x10080\n",
     "[1014]\nParameterName=COB-ID EMCY\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x80\n"},
    {"EDS451",
     "[1014]\nParameterName=COB-ID EMCY\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x40000080\n",
     "[1014]\nParameterName=COB-ID EMCY\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x80\n"},
    {"EDS452",
     "[1200]\nParameterName=SDO server\nObjectType=0x9\nSubNumber=3\n"
     "[1200sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1200sub1]\nParameterName=Client to server\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x80000000\n"
     "[1200sub2]\nParameterName=Server to client\nDataType=0x0007\nAccessType=ro\nDefaultValue=$NODEID+0x580\n",
     "[1200]\nParameterName=SDO server\nObjectType=0x9\nSubNumber=3\n"
     "[1200sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1200sub1]\nParameterName=Client to server\nDataType=0x0007\nAccessType=ro\nDefaultValue=$NODEID+0x600\n"
     "[1200sub2]\nParameterName=Server to client\nDataType=0x0007\nAccessType=ro\nDefaultValue=$NODEID+0x580\n"},
    {"EDS453",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=2\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1801]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1801sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1801sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x380\n"
     "[1801sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[1A01]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A01sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A01sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=2\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1801]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1801sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1801sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x280\n"
     "[1801sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[1A01]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A01sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A01sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n"},
    {"EDS454",
     "[1014]\nParameterName=COB-ID EMCY\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x80\nHighLimit=0x7FF\n",
     "[1014]\nParameterName=COB-ID EMCY\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x80\nHighLimit=0xFFFFFFFF\n"},
    {"EDS455",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=0xF5\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n"
     "[1005]\nParameterName=COB-ID SYNC\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x80\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=0xF0\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n"
     "[1005]\nParameterName=COB-ID SYNC\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x80\n"},
    {"EDS456",
     "[1005]\nParameterName=COB-ID SYNC\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x80\n"
     "[1019]\nParameterName=Synchronous counter overflow value\nDataType=0x0005\nAccessType=rw\nDefaultValue=241\n",
     "[1005]\nParameterName=COB-ID SYNC\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x80\n"
     "[1019]\nParameterName=Synchronous counter overflow value\nDataType=0x0005\nAccessType=rw\nDefaultValue=240\n"},
    {"EDS457",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=2\nNrOfTXPDO=0\nLSS_Supported=0\n"
     "[1400]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1400sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1400sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x200\n"
     "[1400sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1401]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1401sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1401sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x200\n"
     "[1401sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1600]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1600sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1600sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[1601]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1601sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1601sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=rww\nDefaultValue=0\nPDOMapping=1\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=2\nNrOfTXPDO=0\nLSS_Supported=0\n"
     "[1400]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1400sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1400sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x200\n"
     "[1400sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1401]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1401sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1401sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x300\n"
     "[1401sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1600]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1600sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1600sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[1601]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1601sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1601sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=rww\nDefaultValue=0\nPDOMapping=1\n"},
    {"EDS458",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=1\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1400]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1400sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1400sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1400sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1600]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1600sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1600sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20010010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=rww\nDefaultValue=0\nPDOMapping=1\n"
     "[2001]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=1\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1400]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1400sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1400sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x200\n"
     "[1400sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1600]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1600sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1600sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20010010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=rww\nDefaultValue=0\nPDOMapping=1\n"
     "[2001]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n"},
    {"EDS459",
     "[1015]\nParameterName=Inhibit time EMCY\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n"
     "[1014]\nParameterName=COB-ID EMCY\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x80\n",
     "[1015]\nParameterName=Inhibit time EMCY\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n"
     "[1014]\nParameterName=COB-ID EMCY\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x80\n"},
    {"EDS460",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1804]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1804sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1804sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x1C0\n"
     "[1804sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A04]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A04sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A04sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1804]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1804sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1804sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x80000000\n"
     "[1804sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A04]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A04sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A04sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n"},
    {"EDS461",
     "[1016]\nParameterName=Consumer heartbeat time\nObjectType=0x8\nSubNumber=3\n"
     "[1016sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1016sub1]\nParameterName=Node 2, 500 ms\nDataType=0x0007\nAccessType=rw\nDefaultValue=0\nParameterValue=0x000201F4\n"
     "[1016sub2]\nParameterName=Node 2, 300 ms\nDataType=0x0007\nAccessType=rw\nDefaultValue=0\nParameterValue=0x0002012C\n",
     "[1016]\nParameterName=Consumer heartbeat time\nObjectType=0x8\nSubNumber=3\n"
     "[1016sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1016sub1]\nParameterName=Node 2, 500 ms\nDataType=0x0007\nAccessType=rw\nDefaultValue=0\nParameterValue=0x000201F4\n"
     "[1016sub2]\nParameterName=Node 3, 300 ms\nDataType=0x0007\nAccessType=rw\nDefaultValue=0\nParameterValue=0x0003012C\n",
     "example.dcf"},
    {"EDS462",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x40000180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=253\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x40000180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n"},
    {"EDS470",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n"},
    {"EDS471",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n"},
    {"EDS472",
     "[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\nDescription=An example\nCreationTime=09:00AM\nCreationDate=03-31-2024\nModificationTime=09:00AM\nModificationDate=03-31-2024\nModifiedBy=Example\n",
     "[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\nDescription=An example\nCreationTime=09:00AM\nCreationDate=03-31-2024\nCreatedBy=Example\nModificationTime=09:00AM\nModificationDate=03-31-2024\nModifiedBy=Example\n"},
    {"EDS473",
     "[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\nDescription=A device that has a long name, that has a long name, that has a long name, that has a long name, that has a long name, that has a long name, that has a long name, that has a long name, that has a long name, that has a long name, that has a long name, that has a long name, \nCreationTime=09:00AM\nCreationDate=03-31-2024\nCreatedBy=Example\nModificationTime=09:00AM\nModificationDate=03-31-2024\nModifiedBy=Example\n",
     "[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\nDescription=An example\nCreationTime=09:00AM\nCreationDate=03-31-2024\nCreatedBy=Example\nModificationTime=09:00AM\nModificationDate=03-31-2024\nModifiedBy=Example\n"},
    {"EDS474",
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\nParameterValue=200\n",
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n"},
    {"EDS475",
     "[Comments]\nLines=2\nLine1=First line\nLine3=Second line\n",
     "[Comments]\nLines=2\nLine1=First line\nLine2=Second line\n"},
    {"EDS476",
     "[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=1\nEDSVersion=5.0\nDescription=An example\nCreationTime=09:00AM\nCreationDate=03-31-2024\nCreatedBy=Example\nModificationTime=09:00AM\nModificationDate=03-31-2024\nModifiedBy=Example\n",
     "[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\nDescription=An example\nCreationTime=09:00AM\nCreationDate=03-31-2024\nCreatedBy=Example\nModificationTime=09:00AM\nModificationDate=03-31-2024\nModifiedBy=Example\n"},
    {"EDS477",
     "[DummyUsage]\nDummy0005=1\nDummy0020=1\n",
     "[DummyUsage]\nDummy0005=1\n"},
    {"EDS478",
     "[DeviceComissioning]\nNodeID=5\n",
     "[DeviceComissioning]\nNodeID=5\nBaudrate=125\n"},
};
// clang-format on

}  // namespace

constinit const std::span<const LintExample> services_examples{examples};

}  // namespace conform::eds
