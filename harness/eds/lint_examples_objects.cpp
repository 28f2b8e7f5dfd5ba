// SPDX-License-Identifier: Apache-2.0
// Examples of information sections, lists, objects and structures.
#include "eds/lint_examples_tables.hpp"

namespace conform::eds {
namespace {

// Each section in a line.
// clang-format off
constexpr LintExample examples[] = {
    {"EDS103",
     "[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=1\n",
     "[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\n"},
    {"EDS104",
     "[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=1\nEDSVersion=4\n",
     "[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\n"},
    {"EDS105",
     "[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\nCreationDate=2024-03-31\n",
     "[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\nCreationDate=03-31-2024\n"},
    {"EDS106",
     "[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\nCreationTime=14:05\n",
     "[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\nCreationTime=02:05PM\n"},
    {"EDS107",
     "[FileInfo]\nFileName=another.eds\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\n",
     "[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\n"},
    {"EDS108",
     "[FileInfo]\nFileName=example.eds\nFileRevision=1\nEDSVersion=4.0\n",
     "[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\n"},
    {"EDS109",
     "[DeviceInfo]\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n"},
    {"EDS110",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=0\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n"},
    {"EDS111",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\nBaudRate_100=1\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\nBaudRate_250=1\n"},
    {"EDS112",
     "[Comments]\nLines=2\nLine1=Made for the first series\n",
     "[Comments]\nLines=1\nLine1=Made for the first series\n"},
    {"EDS114",
     "[DeviceComissioning]\nNodeID=128\nBaudrate=125\n",
     "[DeviceComissioning]\nNodeID=127\nBaudrate=125\n"},
    {"EDS115",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\nBaudRate_250=0\n"
     "[DeviceComissioning]\nNodeID=5\nBaudrate=250\n",
     "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\nRevisionNumber=0x10000\nOrderCode=E2\nBaudRate_125=1\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\nBaudRate_250=1\n"
     "[DeviceComissioning]\nNodeID=5\nBaudrate=250\n"},
    {"EDS119",
     "[DummyUsage]\nDummy0009=1\n",
     "[DummyUsage]\nDummy0009=0\n"},
    {"EDS152",
     "[OptionalObjects]\nSupportedObjects=2\n1=0x1017\n"
     "[1017]\nParameterName=Producer heartbeat time\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n",
     "[OptionalObjects]\nSupportedObjects=1\n1=0x1017\n"
     "[1017]\nParameterName=Producer heartbeat time\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n"},
    {"EDS153",
     "[OptionalObjects]\nSupportedObjects=2\n1=0x1008\n3=0x1017\n"
     "[1008]\nParameterName=Manufacturer device name\nObjectType=0x7\nDataType=0x0009\nAccessType=const\nDefaultValue=Example\n"
     "[1017]\nParameterName=Producer heartbeat time\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n",
     "[OptionalObjects]\nSupportedObjects=2\n1=0x1008\n2=0x1017\n"
     "[1008]\nParameterName=Manufacturer device name\nObjectType=0x7\nDataType=0x0009\nAccessType=const\nDefaultValue=Example\n"
     "[1017]\nParameterName=Producer heartbeat time\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n"},
    {"EDS154",
     "[OptionalObjects]\nSupportedObjects=2\n1=0x1008\n2=0x1017\n"
     "[1017]\nParameterName=Producer heartbeat time\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n",
     "[OptionalObjects]\nSupportedObjects=1\n1=0x1017\n"
     "[1017]\nParameterName=Producer heartbeat time\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n"},
    {"EDS155",
     "[OptionalObjects]\nSupportedObjects=0\n"
     "[1017]\nParameterName=Producer heartbeat time\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n",
     "[OptionalObjects]\nSupportedObjects=1\n1=0x1017\n"
     "[1017]\nParameterName=Producer heartbeat time\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n"},
    {"EDS156",
     "[OptionalObjects]\nSupportedObjects=1\n1=0x2000\n"
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n",
     "[ManufacturerObjects]\nSupportedObjects=1\n1=0x2000\n"
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n"},
    {"EDS157",
     "[OptionalObjects]\nSupportedObjects=2\n1=0x1017\n2=0x1017\n"
     "[1017]\nParameterName=Producer heartbeat time\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n",
     "[OptionalObjects]\nSupportedObjects=1\n1=0x1017\n"
     "[1017]\nParameterName=Producer heartbeat time\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n"},
    {"EDS160",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n"
     "[2000ObjectLinks]\nObjectLinks=2\n1=0x1000\n",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n"
     "[2000ObjectLinks]\nObjectLinks=1\n1=0x1000\n"},
    {"EDS161",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n"
     "[2000ObjectLinks]\nObjectLinks=1\n1=0x3000\n",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n"
     "[2000ObjectLinks]\nObjectLinks=1\n1=0x1000\n"},
    {"EDS200",
     "[2000]\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n"},
    {"EDS201",
     "[2000]\nParameterName=Speed\nObjectType=0x1\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n"},
    {"EDS202",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nAccessType=rw\nDefaultValue=100\n",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n"},
    {"EDS203",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0017\nAccessType=rw\nDefaultValue=100\n",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n"},
    {"EDS204",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nDefaultValue=100\n",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n"},
    {"EDS205",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=read-only\nDefaultValue=100\n",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=ro\nDefaultValue=100\n"},
    {"EDS206",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\nSubNumber=1\n",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n"},
    {"EDS207",
     "[2000]\nParameterName=Gains\nSubNumber=2\n"
     "[2000sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[2000sub1]\nParameterName=Part\nDataType=0x0006\nAccessType=rw\n",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nSubNumber=2\n"
     "[2000sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[2000sub1]\nParameterName=Part\nDataType=0x0006\nAccessType=rw\n"},
    {"EDS208",
     "[2000]\nParameterName=Gains\nObjectType=0x7\nSubNumber=2\n"
     "[2000sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[2000sub1]\nParameterName=Part\nDataType=0x0006\nAccessType=rw\n",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nSubNumber=2\n"
     "[2000sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[2000sub1]\nParameterName=Part\nDataType=0x0006\nAccessType=rw\n"},
    {"EDS209",
     "[2000]\nParameterName=Speed\nObjectType=0x2\nDataType=0x000F\nAccessType=rw\nPDOMapping=1\n",
     "[2000]\nParameterName=Speed\nObjectType=0x2\nDataType=0x000F\nAccessType=rw\nPDOMapping=0\n"},
    {"EDS210",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\nPDOMapping=1\n",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rww\nDefaultValue=100\nPDOMapping=1\n"},
    {"EDS211",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\nObjFlags=0x10\n",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\nObjFlags=0x1\n"},
    {"EDS212",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=const\nDefaultValue=100\nParameterValue=200\n",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=const\nDefaultValue=100\nParameterValue=100\n"},
    {"EDS213",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0021\nAccessType=rw\n",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n"},
    {"EDS230",
     "[1017]\nParameterName=Producer heartbeat time\nObjectType=0x7\nDataType=0x0007\nAccessType=rw\nDefaultValue=0\n",
     "[1017]\nParameterName=Producer heartbeat time\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n"},
    {"EDS231",
     "[1003]\nParameterName=Pre-defined error field\nObjectType=0x9\nSubNumber=2\n"
     "[1003sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=rw\nDefaultValue=0\n"
     "[1003sub1]\nParameterName=Part\nDataType=0x0007\nAccessType=ro\n"
     "[1014]\nParameterName=COB-ID EMCY\nObjectType=0x7\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x80\n",
     "[1003]\nParameterName=Pre-defined error field\nObjectType=0x8\nSubNumber=2\n"
     "[1003sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=rw\nDefaultValue=0\n"
     "[1003sub1]\nParameterName=Part\nDataType=0x0007\nAccessType=ro\n"
     "[1014]\nParameterName=COB-ID EMCY\nObjectType=0x7\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x80\n"},
    {"EDS232",
     "[1008]\nParameterName=Manufacturer device name\nObjectType=0x7\nDataType=0x0009\nAccessType=rw\nDefaultValue=Example\n",
     "[1008]\nParameterName=Manufacturer device name\nObjectType=0x7\nDataType=0x0009\nAccessType=const\nDefaultValue=Example\n"},
    {"EDS233",
     "[1017]\nParameterName=Producer heartbeat time\nObjectType=0x7\nDataType=0x0006\nAccessType=wo\nDefaultValue=0\n",
     "[1017]\nParameterName=Producer heartbeat time\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n"},
    {"EDS234",
     "[1017]\nParameterName=Producer heartbeat time\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\nPDOMapping=1\n",
     "[1017]\nParameterName=Producer heartbeat time\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\nPDOMapping=0\n"},
    {"EDS250",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nSubNumber=0\n",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nSubNumber=2\n"
     "[2000sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[2000sub1]\nParameterName=Part\nDataType=0x0006\nAccessType=rw\n"},
    {"EDS251",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nSubNumber=1\n"
     "[2000sub1]\nParameterName=Part\nDataType=0x0006\nAccessType=rw\n",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nSubNumber=2\n"
     "[2000sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[2000sub1]\nParameterName=Part\nDataType=0x0006\nAccessType=rw\n"},
    {"EDS252",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nSubNumber=3\n"
     "[2000sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[2000sub1]\nParameterName=Part\nDataType=0x0006\nAccessType=rw\n",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nSubNumber=2\n"
     "[2000sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[2000sub1]\nParameterName=Part\nDataType=0x0006\nAccessType=rw\n"},
    {"EDS253",
     "[2000]\nParameterName=Gains\nObjectType=0x8\n"
     "[2000sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[2000sub1]\nParameterName=Part\nDataType=0x0006\nAccessType=rw\n",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nSubNumber=2\n"
     "[2000sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[2000sub1]\nParameterName=Part\nDataType=0x0006\nAccessType=rw\n"},
    {"EDS254",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nSubNumber=2\n"
     "[2000sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[2000sub1]\nParameterName=Part\nDataType=0x0006\nAccessType=rw\n",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nSubNumber=2\n"
     "[2000sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[2000sub1]\nParameterName=Part\nDataType=0x0006\nAccessType=rw\n"},
    {"EDS255",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nSubNumber=2\n"
     "[2000sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=rw\nDefaultValue=2\n"
     "[2000sub1]\nParameterName=Part\nDataType=0x0006\nAccessType=rw\n",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nSubNumber=2\n"
     "[2000sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\n"
     "[2000sub1]\nParameterName=Part\nDataType=0x0006\nAccessType=rw\n"},
    {"EDS256",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nSubNumber=2\n"
     "[2000sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\n"
     "[2000sub1]\nParameterName=Part\nDataType=0x0006\nAccessType=rw\n",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nSubNumber=2\n"
     "[2000sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[2000sub1]\nParameterName=Part\nDataType=0x0006\nAccessType=rw\n"},
    {"EDS257",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nSubNumber=2\n"
     "[2000sub0]\nParameterName=Highest sub-index\nDataType=0x0006\nAccessType=ro\nDefaultValue=1\n"
     "[2000sub1]\nParameterName=Part\nDataType=0x0006\nAccessType=rw\n",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nSubNumber=2\n"
     "[2000sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[2000sub1]\nParameterName=Part\nDataType=0x0006\nAccessType=rw\n"},
    {"EDS258",
     "[1003]\nParameterName=Pre-defined error field\nObjectType=0x8\nSubNumber=3\n"
     "[1003sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=rw\nDefaultValue=0\n"
     "[1003sub1]\nParameterName=Part\nDataType=0x0007\nAccessType=ro\n"
     "[1003sub2]\nParameterName=Part\nDataType=0x0006\nAccessType=ro\n"
     "[1014]\nParameterName=COB-ID EMCY\nObjectType=0x7\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x80\n",
     "[1003]\nParameterName=Pre-defined error field\nObjectType=0x8\nSubNumber=3\n"
     "[1003sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=rw\nDefaultValue=0\n"
     "[1003sub1]\nParameterName=Part\nDataType=0x0007\nAccessType=ro\n"
     "[1003sub2]\nParameterName=Part\nDataType=0x0007\nAccessType=ro\n"
     "[1014]\nParameterName=COB-ID EMCY\nObjectType=0x7\nDataType=0x0007\nAccessType=rw\nDefaultValue=$NODEID+0x80\n"},
    {"EDS259",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nSubNumber=2\n"
     "[2000sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[2000sub1]\nParameterName=Part\nDataType=0x0006\nAccessType=rw\nObjectType=0x9\n",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nSubNumber=2\n"
     "[2000sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[2000sub1]\nParameterName=Part\nDataType=0x0006\nAccessType=rw\nObjectType=0x7\n"},
    {"EDS270",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nDataType=0x0006\nAccessType=rw\nCompactSubObj=2\nSubNumber=3\n",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nDataType=0x0006\nAccessType=rw\nCompactSubObj=2\n"},
    {"EDS272",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nDataType=0x0006\nAccessType=rw\nCompactSubObj=255\n",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nDataType=0x0006\nAccessType=rw\nCompactSubObj=254\n"},
    {"EDS273",
     "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=100\n"
     "[2000Name]\nNrOfEntries=1\n1=First\n",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nDataType=0x0006\nAccessType=rw\nCompactSubObj=2\n"
     "[2000Name]\nNrOfEntries=1\n1=First\n"},
    {"EDS274",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nDataType=0x0006\nAccessType=rw\nCompactSubObj=2\n"
     "[2000Name]\nNrOfEntries=1\n3=Third\n",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nDataType=0x0006\nAccessType=rw\nCompactSubObj=2\n"
     "[2000Name]\nNrOfEntries=1\n2=Second\n"},
    {"EDS275",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nDataType=0x0006\nAccessType=rw\nCompactSubObj=2\n"
     "[2000Name]\nNrOfEntries=2\n1=First\n",
     "[2000]\nParameterName=Gains\nObjectType=0x8\nDataType=0x0006\nAccessType=rw\nCompactSubObj=2\n"
     "[2000Name]\nNrOfEntries=1\n1=First\n"},
};
// clang-format on

}  // namespace

constinit const std::span<const LintExample> objects_examples{examples};

}  // namespace conform::eds
