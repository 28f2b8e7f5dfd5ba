// SPDX-License-Identifier: Apache-2.0
// Examples of modules.
#include "eds/lint_examples_tables.hpp"

namespace conform::eds {
namespace {

// Each section in a line.
// clang-format off
constexpr LintExample examples[] = {
    {"EDS262",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"
     "[2000]\nParameterName=Gains\nObjectType=0x8\nSubNumber=2\n"
     "[2000sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=2\n"
     "[2000sub1]\nParameterName=Part\nDataType=0x0006\nAccessType=rw\n",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"
     "[2000]\nParameterName=Gains\nObjectType=0x8\nSubNumber=2\n"
     "[2000sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[2000sub1]\nParameterName=Part\nDataType=0x0006\nAccessType=rw\n"},
    {"EDS420",
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"},
    {"EDS421",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"},
    {"EDS422",
     "[SupportedModules]\nNrOfEntries=2\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"},
    {"EDS423",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"},
    {"EDS424",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[M2ModuleInfo]\nProductName=Input 2\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M2FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M2Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n",
     "[SupportedModules]\nNrOfEntries=2\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[M2ModuleInfo]\nProductName=Input 2\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M2FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M2Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"},
    {"EDS425",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=2\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"},
    {"EDS426",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"},
    {"EDS427",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[M1Fixed2101]\nParameterName=Error\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=2\n1=0x2100\n2=0x2101\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[M1Fixed2101]\nParameterName=Error\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"},
    {"EDS428",
     "[SupportedModules]\nNrOfEntries=2\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[M2ModuleInfo]\nProductName=Input 2\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M2FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M2Fixed2100]\nParameterName=State\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n",
     "[SupportedModules]\nNrOfEntries=2\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[M2ModuleInfo]\nProductName=Input 2\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M2FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M2Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"},
    {"EDS429",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1SubExtends]\nNrOfEntries=1\n1=0x6000\n"
     "[M1SubExt6000]\nParameterName=Input\nDataType=0x0005\nAccessType=ro\nObjExtend=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1SubExtends]\nNrOfEntries=1\n1=0x6000\n"
     "[M1SubExt6000]\nParameterName=Input\nDataType=0x0005\nAccessType=ro\nCount=1\nObjExtend=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"},
    {"EDS430",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1SubExtends]\nNrOfEntries=1\n1=0x6000\n"
     "[M1SubExt6000]\nParameterName=Input\nDataType=0x0005\nAccessType=ro\nCount=1\nObjExtend=2\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1SubExtends]\nNrOfEntries=1\n1=0x6000\n"
     "[M1SubExt6000]\nParameterName=Input\nDataType=0x0005\nAccessType=ro\nCount=1\nObjExtend=1\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"},
    {"EDS431",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"},
    {"EDS432",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x6000\n"
     "[M1Fixed6000]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[M1SubExtends]\nNrOfEntries=1\n1=0x6000\n"
     "[M1SubExt6000]\nParameterName=Input\nDataType=0x0005\nAccessType=ro\nCount=1\nObjExtend=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[M1SubExtends]\nNrOfEntries=1\n1=0x6000\n"
     "[M1SubExt6000]\nParameterName=Input\nDataType=0x0005\nAccessType=ro\nCount=1\nObjExtend=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"},
    {"EDS433",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"
     "[2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"
     "[2101]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"},
    {"EDS434",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[ConnectedModules]\nNrOfEntries=1\n1=2\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[ConnectedModules]\nNrOfEntries=1\n1=1\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"},
    {"EDS435",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n",
     "[SupportedModules]\nNrOfEntries=1\n"
     "[M1ModuleInfo]\nProductName=Input 1\nProductVersion=1\nProductRevision=1\nOrderCode=E2\n"
     "[M1FixedObjects]\nNrOfEntries=1\n1=0x2100\n"
     "[M1Fixed2100]\nParameterName=State\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\n"
     "[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=2\n"
     "[1027sub0]\nParameterName=Highest sub-index\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n"
     "[1027sub1]\nParameterName=Module 1\nDataType=0x0006\nAccessType=ro\nDefaultValue=0\n"},
};
// clang-format on

}  // namespace

constinit const std::span<const LintExample> modules_examples{examples};

}  // namespace conform::eds
