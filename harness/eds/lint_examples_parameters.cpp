// SPDX-License-Identifier: Apache-2.0
// More examples of PDO parameters.
#include "eds/lint_examples_tables.hpp"

namespace conform::eds {
namespace {

// Each section in a line.
// clang-format off
constexpr LintExample examples[] = {
    {"EDS304",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
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
    {"EDS305",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x20000010\n"
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
    {"EDS306",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=0\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
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
    {"EDS307",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=ro\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
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
    {"EDS309",
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
    {"EDS310",
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=1\n",
     "[2000]\nParameterName=Speed\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\nPDOMapping=0\n"},
    {"EDS311",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=2\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
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
    {"EDS312",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=2\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1801]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1801sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1801sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
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
    {"EDS314",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object 1\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x20000010\n"
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
    {"EDS315",
     "[1004]\nParameterName=Number of PDOs supported\nObjectType=0x7\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x00010002\n",
     "[1004]\nParameterName=Number of PDOs supported\nObjectType=0x7\nDataType=0x0007\nAccessType=ro\nDefaultValue=0\n"},
    {"EDS316",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\nCompactPDO=0x41\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\nCompactPDO=0x03\n"},
};
// clang-format on

}  // namespace

constinit const std::span<const LintExample> parameters_examples{examples};

}  // namespace conform::eds
