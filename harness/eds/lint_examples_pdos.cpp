// SPDX-License-Identifier: Apache-2.0
// Examples of PDOs, their mapping and the identity.
#include "eds/lint_examples_tables.hpp"

namespace conform::eds {
namespace {

// Each section in a line.
// clang-format off
constexpr LintExample examples[] = {
    {"EDS300",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=1\nNrOfTXPDO=0\nLSS_Supported=0\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n"},
    {"EDS301",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n"},
    {"EDS302",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=ro\nDefaultValue=100\nPDOMapping=1\n"},
    {"EDS303",
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=ro\nDefaultValue=100\nPDOMapping=1\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=ro\nDefaultValue=100\nPDOMapping=1\n"},
    {"EDS308",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\nCompactPDO=3\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\nCompactPDO=0\n"},
    {"EDS313",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x701\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=ro\nDefaultValue=100\nPDOMapping=1\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=ro\nDefaultValue=100\nPDOMapping=1\n"},
    {"EDS331",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20010010\n"
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=ro\nDefaultValue=100\nPDOMapping=1\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=ro\nDefaultValue=100\nPDOMapping=1\n"},
    {"EDS332",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=ro\nDefaultValue=100\nPDOMapping=0\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=ro\nDefaultValue=100\nPDOMapping=1\n"},
    {"EDS333",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000008\n"
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=ro\nDefaultValue=100\nPDOMapping=1\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=ro\nDefaultValue=100\nPDOMapping=1\n"},
    {"EDS334",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=wo\nDefaultValue=100\nPDOMapping=1\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=1\nLSS_Supported=0\n"
     "[1800]\nParameterName=PDO communication\nObjectType=0x9\nSubNumber=3\n"
     "[1800sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[1800sub1]\nParameterName=COB-ID\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
     "[1800sub2]\nParameterName=Transmission type\nDataType=0x0005\nAccessType=rw\nDefaultValue=254\n"
     "[1A00]\nParameterName=PDO mapping\nObjectType=0x9\nSubNumber=2\n"
     "[1A00sub0]\nParameterName=Number of mapped objects\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[1A00sub1]\nParameterName=Object\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x20000010\n"
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=ro\nDefaultValue=100\nPDOMapping=1\n"},
    {"EDS400",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x20\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n"},
};
// clang-format on

}  // namespace

constinit const std::span<const LintExample> pdos_examples{examples};

}  // namespace conform::eds
