// SPDX-License-Identifier: Apache-2.0
#include "eds/lint_examples.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files.hpp"
#include "base/text.hpp"
#include "catch.hpp"
#include "eds/lint.hpp"
#include "eds/lint_policy.hpp"
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

/// Takes out what a comment "; no [1001]" at the head of a snippet names, with its sub-objects.
void take_out(Sections& file, std::string_view head) {
  for (const auto line : split(head, '\n')) {
    constexpr std::string_view begin = "; no ";
    if (!line.starts_with(begin)) continue;
    auto name = lower(line.substr(begin.size()));
    REQUIRE(name.ends_with(']'));
    name.pop_back();
    const auto before = file.size();
    std::erase_if(
        file, [&](const auto& each) { return each.first == name || each.first.starts_with(name + "sub"); });
    CHECK(file.size() < before);
  }
}

/// The right file with the sections of a snippet; objects that no list of the snippet has are listed.
std::string with_sections(std::string_view snippet, bool configured) {
  auto file = sections_of(right_file);
  if (configured) file.emplace_back("[devicecomissioning", "[DeviceComissioning]\nNodeID=5\nBaudrate=125\n");
  const auto mine = sections_of(snippet);
  take_out(file, mine.front().second);
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
  auto out = mine.front().second;
  for (auto& [name, text] : file) {
    const auto& list = name == "[optionalobjects" ? optional : manufacturer;
    if (!listed && (name == "[optionalobjects" || name == "[manufacturerobjects")) {
      text = text.substr(0, text.find('=') + 1) + std::to_string(list.size()) + "\n";
      for (std::size_t i = 0; i < list.size(); ++i) text += std::to_string(i + 1) + "=" + list[i] + "\n";
    }
    out += text;
  }
  for (const auto& each : mine) {
    if (!each.first.empty()) out += each.second;
  }
  // A file whose lines end in CR alone has no other line ends.
  if (snippet.ends_with('\r')) std::ranges::replace(out, '\n', '\r');
  return out;
}

/// The right file with a snippet in the place of the element, or start tag, that is like the first of
/// `right`.
std::string with_element(std::string_view snippet, std::string_view right) {
  const auto text = read_file(
      std::string(CONFORM_SOURCE_DIR) + "/harness/eds/tests/fixtures/legal-xml-structure.xdd", 1U << 20U);
  REQUIRE(text);
  constexpr std::string_view object = "<CANopenObject index=\"";
  const auto name = right.substr(0, right.find_first_of(" >"));
  const auto head = right.starts_with(object) ? right.substr(0, object.size() + 5) : name;
  const auto begin = text->find(head);
  REQUIRE(begin != std::string::npos);
  auto end = text->find('>', begin) + 1;
  const auto last = "</" + std::string(name.substr(1)) + ">";
  if (right.find(last) != std::string_view::npos) end = text->find(last, begin) + last.size();
  return text->substr(0, begin) + std::string(snippet) + text->substr(end);
}

std::string in_its_file(const LintExample& example, std::string_view snippet) {
  if (example.file.ends_with(".xdd")) return with_element(snippet, example.right);
  return with_sections(snippet, example.file.ends_with(".dcf"));
}

using Codes = std::set<std::string_view>;

Codes codes(const std::string& text, std::string_view name, Severity from = Severity::note) {
  const auto file = read(text, std::string(name));
  REQUIRE(file);
  Codes out;
  for (const auto& finding : apply({}, lint(*file), text, *file).findings) {
    if (finding.rule->severity >= from) out.insert(finding.rule->code);
  }
  return out;
}

TEST_CASE("The files into which examples are put have no mistake") {
  CHECK(codes(with_sections("", false), "example.eds", Severity::warning).empty());
  CHECK(codes(with_sections("", true), "example.dcf", Severity::warning).empty());
}

/// What else is found where a rule finds its example: the same text breaks both, or what is wrong is missing.
bool goes_with(std::string_view code, std::string_view other) {
  constexpr std::pair<std::string_view, std::string_view> rows[] = {
      {"EDS012", "EDS473"},
      {"EDS020", "EDS204"},
      {"EDS022", "EDS155"},
      {"EDS023", "EDS024"},
      {"EDS041", "EDS158 EDS159 EDS440 EDS702"},
      {"EDS042", "EDS202 EDS204"},
      {"EDS150", "EDS155"},
      {"EDS156", "EDS155"},
      {"EDS209", "EDS210"},
      {"EDS216", "EDS310"},
      {"EDS234", "EDS210"},
      {"EDS258", "EDS230"},
      {"EDS303", "EDS310"},
      {"EDS309", "EDS342"},
      {"EDS312", "EDS453"},
      {"EDS313", "EDS453"},
      {"EDS316", "EDS441"},
      {"EDS334", "EDS310"},
      {"EDS342", "EDS309"},
      {"EDS343", "EDS310"},
      {"EDS426", "EDS435"},
      {"EDS457", "EDS453"},
      {"EDS458", "EDS453"},
      {"EDS473", "EDS012"},
      {"EDS477", "EDS119"},
      {"EDS705", "EDS050"},
      {"EDS900", "EDS053"},
      {"EDS901", "EDS053"},
      {"EDS902", "EDS053"},
  };
  const auto* row = std::ranges::find(rows, code, &std::pair<std::string_view, std::string_view>::first);
  return row != std::end(rows) && row->second.find(other) != std::string_view::npos;
}

TEST_CASE("Of every example its rule alone finds what is wrong, and none anything in what is right") {
  std::string_view last;
  for (const auto& example : lint_examples()) {
    const auto wrong = in_its_file(example, example.wrong);
    const auto right = in_its_file(example, example.right);
    CAPTURE(example.code, wrong, right);
    CHECK(last < example.code);
    last = example.code;
    CHECK(find_rule(example.code) != nullptr);
    CHECK(find_example(example.code) == &example);
    const auto found = codes(wrong, example.file);
    const auto silent = codes(right, example.file);
    CHECK(found.contains(example.code));
    CHECK_FALSE(silent.contains(example.code));
    CHECK(codes(right, example.file, Severity::warning).empty());
    for (const auto code : found) {
      CAPTURE(code);
      CHECK((code == example.code || silent.contains(code) || goes_with(example.code, code)));
    }
  }
  CHECK(find_example("EDS999") == nullptr);
}

TEST_CASE("Every rule has an example, or a reason why it has none") {
  for (const auto& group : all_rule_groups()) {
    for (const auto* rule : group.rules) {
      CAPTURE(rule->code);
      CHECK((find_example(rule->code) == nullptr) == !why_no_example(rule->code).empty());
    }
  }
  CHECK(why_no_example("EDS999").empty());
}

TEST_CASE("What a terminal does not show is printed of an example as an escape") {
  CHECK(shown("[2000]\nName=a\n") == "[2000]\nName=a\n");
  CHECK(shown("a\r\nb\rc\r") == "a\\r\nb\\r\nc\\r\n");
  CHECK(shown("\xEF\xBB\xBF; a\xE9\x07\n") == "\\xEF\\xBB\\xBF; a\\xE9\\x07\n");
}

}  // namespace
