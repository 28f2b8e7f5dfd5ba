// SPDX-License-Identifier: Apache-2.0
// The device description agrees with the node.
#include <string>

#include "node/eds_text.hpp"
#include "node/tests/bench.hpp"

using namespace refnode;

namespace {
bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}
}  // namespace

TEST_CASE("The EDS lists every object with type, access, default and limits") {
  const std::string eds = eds_text();
  CHECK(contains(eds, "[1000]\nParameterName=Device type\nObjectType=0x7\nDataType=0x0007\nAccessType=ro\n"
                      "DefaultValue=0xf0191\n\n"));
  CHECK(contains(eds, "[1014]\nParameterName=COB-ID EMCY\nObjectType=0x7\nDataType=0x0007\nAccessType=rw\n"
                      "DefaultValue=$NODEID+0x80\n"));
  CHECK(contains(eds, "DefaultValue=$NODEID+0x40000180\n"));
  CHECK(contains(eds,
                 "[2002sub2]\nParameterName=-1000 to 1000\nObjectType=0x7\nDataType=0x0003\nAccessType=rw\n"
                 "DefaultValue=0\nLowLimit=-1000\nHighLimit=1000\n"));
  CHECK(contains(eds, "[2003]\nParameterName=Record with gaps\nObjectType=0x9\nSubNumber=0x5\n"));
  CHECK(contains(eds, "AccessType=rww\n"));
  CHECK(contains(eds, "[MandatoryObjects]\nSupportedObjects=3\n1=0x1000\n2=0x1001\n3=0x1018\n"));
  CHECK(contains(eds, "[2000subF]\nParameterName=DOMAIN\nObjectType=0x2\nDataType=0x000F\n"));
  CHECK(contains(
      eds,
      "[2000sub8]\nParameterName=REAL32\nObjectType=0x7\nDataType=0x0008\nAccessType=rw\nDefaultValue=1.5\n"));
}
