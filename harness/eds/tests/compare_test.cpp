// SPDX-License-Identifier: Apache-2.0
// Two descriptions side by side.
#include "eds/compare.hpp"

#include <string>
#include <vector>

#include "catch.hpp"
#include "eds/read.hpp"

namespace {

using namespace conform::eds;

std::vector<std::string> differences(std::string_view before, std::string_view after) {
  const auto a = read(before, "a.eds");
  const auto b = read(after, "b.eds");
  REQUIRE(a);
  REQUIRE(b);
  const auto found = compare(*a, *b);
  REQUIRE(found);
  std::vector<std::string> out;
  for (const auto& each : *found) {
    const char sign = each.kind == Difference::Kind::added     ? '+'
                      : each.kind == Difference::Kind::removed ? '-'
                                                               : '~';
    out.push_back(sign + each.where + " " + each.key + " " + each.before + ">" + each.after);
  }
  return out;
}

TEST_CASE("Objects that came, went or changed are told with what changed in them") {
  CHECK(
      differences(
          "[DeviceInfo]\nRevisionNumber=1\n[2000]\nDataType=7\nDefaultValue=5\n[2001]\nDataType=5\n[2002]\n[2002sub1]\nAccessType=rw\n",
          "[DeviceInfo]\nRevisionNumber=2\n[2000]\nDataType=7\nDefaultValue=6\nLowLimit=0\n[2002]\n[2002sub1]\nAccessType=ro\n[2002sub2]\n[2003]\n") ==
      std::vector<std::string>{"~[DeviceInfo] RevisionNumber 1>2", "~2000h DefaultValue 5>6",
                               "~2000h LowLimit >0", "-2001h  >", "~2002h:01 AccessType rw>ro",
                               "+2002h:02  >", "+2003h  >"});
}

TEST_CASE("The same said in another way is no difference") {
  CHECK(
      differences(
          "[FileInfo]\nFileVersion=1\n[DeviceInfo]\nBaudRate_10=0\n[1000]\nDataType=0x0007\nObjectType=7\nAccessType=RO\nLowLimit=\nPDOMapping=0\n",
          "[DeviceInfo]\n[1000]\nAccessType=ro\nDataType=7\n")
          .empty());
  CHECK(differences("[2000]\nParameterName=a\nObjectType=8\nDataType=5\nAccessType=rw\nCompactSubObj=1\n",
                    "[2000]\nParameterName=a\nObjectType=8\nDataType=5\nAccessType=rw\n"
                    "[2000sub0]\nParameterName=NrOfObjects\nDataType=5\nAccessType=ro\nDefaultValue=1\n"
                    "[2000sub1]\nParameterName=a1\nDataType=5\nAccessType=rw\n")
            .empty());
}

TEST_CASE("What CompactSubObj implies is compared as if it were written out") {
  CHECK(differences("[2000]\nObjectType=8\nCompactSubObj=2\n", "[2000]\nObjectType=8\nCompactSubObj=3\n") ==
        std::vector<std::string>{"~2000h:00 DefaultValue 2>3", "+2000h:03  >"});
}

}  // namespace
