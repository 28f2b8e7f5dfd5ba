// SPDX-License-Identifier: Apache-2.0
#include "eds/lint_examples.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "catch.hpp"
#include "eds/lint.hpp"
#include "eds/read.hpp"
#include "eds/section_name.hpp"

namespace {

using namespace conform;
using namespace conform::eds;

/// A section and its text, with the lines before the first one under an empty name.
using Sections = std::vector<std::pair<std::string, std::string>>;

constexpr std::string_view right_file =
    "[FileInfo]\nFileName=example.eds\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\nDescription=An example\n"
    "CreationTime=09:00AM\nCreationDate=03-31-2024\nCreatedBy=Example\nModificationTime=09:00AM\n"
    "ModificationDate=03-31-2024\nModifiedBy=Example\n"
    "[DeviceInfo]\nVendorName=Example\nVendorNumber=0x1F\nProductName=Example\nProductNumber=0x2\n"
    "RevisionNumber=0x10000\nOrderCode=E2\nBaudRate_10=0\nBaudRate_20=0\nBaudRate_50=0\nBaudRate_125=1\n"
    "BaudRate_250=0\nBaudRate_500=0\nBaudRate_800=0\nBaudRate_1000=0\nSimpleBootUpMaster=0\nSimpleBootUpSlave=0\n"
    "Granularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n"
    "[DummyUsage]\nDummy0001=0\nDummy0002=0\nDummy0003=0\nDummy0004=0\nDummy0005=1\nDummy0006=0\nDummy0007=0\n"
    "[MandatoryObjects]\nSupportedObjects=3\n1=0x1000\n2=0x1001\n3=0x1018\n"
    "[OptionalObjects]\nSupportedObjects=1\n1=0x1017\n"
    "[ManufacturerObjects]\nSupportedObjects=0\n"
    "[1000]\nParameterName=Device type\nObjectType=0x7\nDataType=0x0007\nAccessType=ro\nDefaultValue=0\n"
    "PDOMapping=0\n"
    "[1001]\nParameterName=Error register\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\nPDOMapping=0\n"
    "[1017]\nParameterName=Producer heartbeat time\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=0\n"
    "PDOMapping=0\n"
    "[1018]\nParameterName=Identity\nObjectType=0x9\nSubNumber=4\n"
    "[1018sub0]\nParameterName=Highest sub-index\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\nDefaultValue=3\n"
    "PDOMapping=0\n"
    "[1018sub1]\nParameterName=Vendor-ID\nObjectType=0x7\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x1F\n"
    "PDOMapping=0\n"
    "[1018sub2]\nParameterName=Product code\nObjectType=0x7\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x2\n"
    "PDOMapping=0\n"
    "[1018sub3]\nParameterName=Revision number\nObjectType=0x7\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x10000\n"
    "PDOMapping=0\n";

Sections sections_of(std::string_view text) {
  Sections out{{"", ""}};
  for (const auto line : split(text, '\n')) {
    if (line.empty()) continue;
    const auto begin = line.find('[');
    if (begin != std::string_view::npos && begin < 2)
      out.emplace_back(lower(line.substr(begin, line.find(']') - begin)), "");
    out.back().second += std::string(line) + "\n";
  }
  return out;
}

/// The right file with the sections of a snippet; objects that no list of the snippet has are listed.
std::string with_snippet(std::string_view snippet) {
  auto file = sections_of(right_file);
  const auto mine = sections_of(snippet);
  const auto has = [&mine](std::string_view name) {
    return std::ranges::any_of(mine, [name](const auto& each) { return each.first == name; });
  };
  std::erase_if(file, [&](const auto& each) { return !each.first.empty() && has(each.first); });
  std::vector<std::string> optional{"0x1017"};
  std::vector<std::string> manufacturer;
  for (const auto& [name, text] : mine) {
    const auto parsed = name.empty() ? SectionName() : parse_section_name(name.substr(1));
    if (parsed.kind != SectionKind::object || parsed.index <= Index(0x1001) || parsed.index == Index(0x1018))
      continue;
    auto& list = parsed.index >= Index(0x2000) && parsed.index < Index(0x6000) ? manufacturer : optional;
    const auto index = "0x" + name.substr(1);
    if (std::ranges::find(list, index) == list.end()) list.push_back(index);
  }
  const bool listed = has("[optionalobjects") || has("[manufacturerobjects");
  std::string out;
  for (auto& [name, text] : file) {
    const auto& list = name == "[optionalobjects" ? optional : manufacturer;
    if (!listed && (name == "[optionalobjects" || name == "[manufacturerobjects")) {
      text = text.substr(0, text.find('=') + 1) + std::to_string(list.size()) + "\n";
      for (std::size_t i = 0; i < list.size(); ++i) text += std::to_string(i + 1) + "=" + list[i] + "\n";
    }
    out += text;
  }
  for (const auto& each : mine) out += each.second;
  return out;
}

std::set<std::string_view> codes(const std::string& text) {
  const auto file = read(text, "example.eds");
  REQUIRE(file);
  std::set<std::string_view> out;
  for (const auto& finding : lint(*file).findings) out.insert(finding.rule->code);
  return out;
}

TEST_CASE("The file into which examples are put has no mistake") {
  const auto text = with_snippet("");
  const auto file = read(text, "example.eds");
  REQUIRE(file);
  const auto report = lint(*file);
  CHECK(report.count(Severity::error) == 0);
  CHECK(report.count(Severity::warning) == 0);
}

TEST_CASE("Of every example the rule finds what is wrong and nothing in what is right") {
  std::string_view last;
  for (const auto& example : lint_examples()) {
    CAPTURE(example.code, with_snippet(example.wrong), with_snippet(example.right));
    CHECK(last < example.code);
    last = example.code;
    CHECK(find_rule(example.code) != nullptr);
    CHECK(find_example(example.code) == &example);
    CHECK(codes(with_snippet(example.wrong)).contains(example.code));
    CHECK_FALSE(codes(with_snippet(example.right)).contains(example.code));
  }
  CHECK(find_example("EDS999") == nullptr);
}

}  // namespace
