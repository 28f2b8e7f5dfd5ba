// SPDX-License-Identifier: Apache-2.0
#include "eds/lint_fix.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "catch.hpp"
#include "eds/lint_fix_forms.hpp"
#include "eds/read.hpp"

namespace {

namespace fs = std::filesystem;
using namespace conform::eds;

std::vector<Fix> fixes_of(const std::string& text, const std::string& name = "a.eds") {
  const auto file = read(text, name);
  REQUIRE(file);
  std::vector<Fix> out;
  for (const auto& finding : lint(*file).findings) {
    if (auto fix = Fixer(text, *file).fix(finding)) out.push_back(std::move(*fix));
  }
  return out;
}

std::string fixed(std::string text, const std::string& name = "a.eds") {
  for (int round = 0; round < 8; ++round) text = with_fixes(text, fixes_of(text, name));
  return text;
}

std::multiset<std::string_view> codes(const std::string& text, const std::string& name) {
  const auto file = read(text, name);
  REQUIRE(file);
  std::multiset<std::string_view> out;
  for (const auto& finding : lint(*file).findings) out.insert(finding.rule->code);
  return out;
}

TEST_CASE("A count is put right and every other byte stays, whatever the lines end in") {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const auto text = [&end](const std::string& count) {
      return "\xEF\xBB\xBF; \xE4" + end + "[OptionalObjects]" + end + "SupportedObjects = " + count + " " +
             end + "1=0x1017" + end + end + "[1017] " + end + "ParameterName=T";
    };
    auto file = read(text("7"), "a.eds");
    std::vector<Fix> only;
    for (const auto& finding : lint(*file).findings) {
      const auto bytes = text("7");
      if (finding.rule->code == "EDS152") only.push_back(*Fixer(bytes, *file).fix(finding));
    }
    CHECK(with_fixes(text("7"), only) == text("1"));
  }
}

TEST_CASE("Lists are numbered in a row, and hexadecimal counts stay hexadecimal") {
  CHECK(fixed("[OptionalObjects]\nSupportedObjects=0x05\n1=0x1008\n3=0x1017\n3=0x1016\n")
            .starts_with("[OptionalObjects]\nSupportedObjects=0x03\n1=0x1008\n2=0x1017\n3=0x1016\n"));
}

TEST_CASE("What is missing and obvious is written, in the way the file ends its lines") {
  const auto text =
      fixed("[FileInfo]\r\nFileVersion=1\r\n[2000]\r\nParameterName=A\r\nObjectType=8\r\n"
            "[2000sub0]\r\nDataType=5\r\nAccessType=ro\r\n[2000sub1]\r\nDataType=5\r\nAccessType=rw",
            "folder/my.eds");
  CHECK(text.find("FileName=my.eds\r\n") != std::string::npos);
  CHECK(text.find("EDSVersion=4.0\r\n") != std::string::npos);
  CHECK(text.find("[2000]\r\nSubNumber=2\r\n") != std::string::npos);
  CHECK(text.find("[2000sub0]\r\nDefaultValue=1\r\n") != std::string::npos);
  CHECK(text.find("AccessType=rw\r\n\r\n[OptionalObjects]\r\nSupportedObjects=0\r\n") != std::string::npos);
  // An object of the manufacturer would have to be listed.
  CHECK(text.find("[ManufacturerObjects]") == std::string::npos);
}

TEST_CASE("Dates are mended where month and day are certain") {
  CHECK(standard_date("2024-03-31") == "03-31-2024");
  CHECK(standard_date("31.03.2024") == "03-31-2024");
  CHECK(standard_date("3-1-2024") == "03-01-2024");
  CHECK(standard_date("31-3-2024") == "03-31-2024");
  CHECK(standard_date("3/31/2024") == "03-31-2024");
  for (const auto* text :
       {"03.04.2024", "3/4/2024", "13-13-2024", "03-31-24", "2024", "", "a-b-c", "1-2-3-4"}) {
    CAPTURE(text);
    CHECK_FALSE(standard_date(text));
  }
}

TEST_CASE("Times of 12 and of 24 hours are mended") {
  CHECK(standard_time("14:05") == "02:05PM");
  CHECK(standard_time("00:15:33") == "12:15AM");
  CHECK(standard_time("12:00") == "12:00PM");
  CHECK(standard_time("2:05 pm") == "02:05PM");
  CHECK(standard_time("9:05 a.m.") == "09:05AM");
  CHECK(standard_time("14:05PM") == "02:05PM");
  for (const auto* text : {"14:05AM", "24:00", "1:5", "12:60", "noon", "", "1405", "12:00 Uhr"}) {
    CAPTURE(text);
    CHECK_FALSE(standard_time(text));
  }
}

TEST_CASE("Formulas and numbers are written in the way of the standard") {
  CHECK(standard_formula("0x80+$NODEID") == "$NODEID+0x80");
  CHECK(standard_formula("$NodeID + 0x180") == "$NODEID+0x180");
  CHECK_FALSE(standard_formula("0x80"));
  CHECK_FALSE(standard_formula("$NODEID+0x80 ; EMCY"));
  CHECK(standard_number("1Ah") == "0x1A");
  CHECK(standard_number("0x1Ah") == "0x1A");
  CHECK(standard_number("0x10UL") == "0x10");
  CHECK(standard_number("+5") == "5");
  CHECK_FALSE(standard_number("five"));
}

TEST_CASE("A section is renamed only when it is not there under the right name as well") {
  CHECK(fixed("[0x2000]\nObjectType=7\n[2001sub01]\nDataType=5\n")
            .starts_with("[2000]\nObjectType=7\n[2001sub1]\n"));
  CHECK(fixed("[02000]\nObjectType=7\n[2000]\nObjectType=7\n").starts_with("[02000]\n"));
}

TEST_CASE(
    "Of every fixture the fixed file has no finding more, none that can be fixed, and is fixed for good") {
  for (const auto& entry :
       fs::directory_iterator(fs::path(CONFORM_SOURCE_DIR) / "harness/eds/tests/fixtures")) {
    const auto name = entry.path().filename().string();
    CAPTURE(name);
    std::ifstream stream(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const auto after = fixed(text, name);
    CHECK(fixes_of(after, name).empty());
    CHECK(fixed(after, name) == after);
    const auto before = codes(text, name);
    for (const auto code : codes(after, name)) CHECK(before.contains(code));
    if (fixes_of(text, name).empty()) CHECK(after == text);
  }
}

TEST_CASE("Counts and formulas in attributes of an XDD are put right, and every other byte stays") {
  std::ifstream file(fs::path(CONFORM_SOURCE_DIR) / "harness/eds/tests/fixtures/legal-xml.xdd",
                     std::ios::binary);
  const std::string right{std::istreambuf_iterator<char>(file), {}};
  const auto with = [&right](const std::string& from, const std::string& to) {
    auto text = right;
    const auto at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
  };
  const std::string identity = "name=\"Identity\" objectType=\"9\" subNumber=\"2\"";
  CHECK(fixed(with(identity, "name=\"Identity\" objectType=\"9\" subNumber=\"0x4\""), "legal-xml.xdd") ==
        with(identity, "name=\"Identity\" objectType=\"9\" subNumber=\"0x2\""));
  const std::string gain = "<defaultValue value=\"0x10\"/>";
  CHECK(fixed(with(gain, "<defaultValue value='0x10+$NODEID'/>"), "legal-xml.xdd") ==
        with(gain, "<defaultValue value='$NODEID+0x10'/>"));
  // Where an attribute is missing nothing is written.
  const auto without = with(identity, "name=\"Identity\" objectType=\"9\"");
  CHECK(fixed(without, "legal-xml.xdd") == without);
}

}  // namespace
