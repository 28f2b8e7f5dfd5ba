// SPDX-License-Identifier: Apache-2.0
// The text layer: every line end, every place, nothing lost.
#include <string>
#include <vector>

#include "catch.hpp"
#include "eds/ini_file.hpp"
#include "eds/section_name.hpp"

namespace {

using namespace conform::eds;
using Kinds = std::vector<Deviation>;

IniFile parse(std::string_view text) {
  auto file = IniFile::parse(text, "a.eds");
  REQUIRE(file);
  return std::move(*file);
}

Kinds kinds(const IniFile& file) {
  Kinds out;
  for (const auto& remark : file.remarks().all()) out.push_back(remark.what);
  return out;
}

TEST_CASE("Sections and entries keep their spelling and their places") {
  const auto file = parse(
      "; a comment\n[DeviceInfo]\nVendorName=Some  Name \nGranularity=8\n\n[1018sub1]\nDefaultValue=\n");
  REQUIRE(file.sections().size() == 2);
  const auto& info = file.sections()[0];
  CHECK(info.name == "DeviceInfo");
  CHECK(info.at == Position{2, 1});
  REQUIRE(info.entries.size() == 2);
  CHECK(info.entries[0].key == "VendorName");
  CHECK(info.entries[0].value == "Some  Name");
  CHECK(info.entries[0].key_at == Position{3, 1});
  CHECK(info.entries[0].value_at == Position{3, 12});
  CHECK(file.find("deviceINFO") == &info);
  CHECK(info.find("granularity") == &info.entries[1]);
  CHECK(info.find("nothing") == nullptr);
  const auto& sub = file.sections()[1];
  CHECK(sub.entries[0].value.empty());
  CHECK(sub.entries[0].value_at == Position{7, 14});
  CHECK(file.line_count() == 7);
  CHECK(kinds(file).empty());
}

TEST_CASE("Every line end is understood; a mixture and a lone CR are remarked once") {
  CHECK(kinds(parse("[A]\r\nx=1\r\ny=2\r\n")).empty());
  const auto cr = parse("[A]\rx=1\ry=2");
  CHECK(kinds(cr) == Kinds{Deviation::carriage_return_only});
  CHECK(cr.sections()[0].entries[1].key_at == Position{3, 1});
  const auto mixed = parse("[A]\r\nx=1\ny=2\r\nz=3\n");
  CHECK(kinds(mixed) == Kinds{Deviation::mixed_line_ends});
  CHECK(mixed.remarks().all()[0].at == Position{2, 4});
  CHECK(mixed.sections()[0].entries.size() == 3);
}

TEST_CASE("Bytes are neither decoded nor lost") {
  const auto file = parse(std::string_view("[A]\nx=Sch\x94n\ny=a\0b\n", 18));
  CHECK(file.sections()[0].entries[0].value == "Sch\x94n");
  CHECK(file.sections()[0].entries[1].value == std::string_view("a\0b", 3));
  REQUIRE(kinds(file) == Kinds{Deviation::non_ascii, Deviation::control_character});
  CHECK(file.remarks().all()[0].at == Position{2, 6});
  CHECK(file.remarks().all()[1].at == Position{3, 4});
}

TEST_CASE("A byte order mark is passed over") {
  const auto file = parse("\xEF\xBB\xBF[A]\nx=1\n");
  CHECK(kinds(file) == Kinds{Deviation::byte_order_mark});
  CHECK(file.find("a") != nullptr);
}

TEST_CASE("Duplicates stay; the first one is found") {
  const auto file = parse("[A]\nx=1\nX=2\n[a]\nx=3\n");
  CHECK(file.sections()[0].entries.size() == 2);
  CHECK(file.sections().size() == 2);
  CHECK(file.find("A")->find("x")->value == "1");
  REQUIRE(kinds(file) == Kinds{Deviation::duplicate_section});
  CHECK(file.remarks().all()[0].at == Position{4, 1});
  CHECK(file.remarks().all()[0].first == Position{1, 1});
}

TEST_CASE("Broken lines are remarked where they break and the rest is read") {
  const auto file = parse("early=1\n"
                          "  [A]\n"
                          "[B\n"
                          "junk\n"
                          " x = 1\n"
                          "=5\n"
                          "# no comment\n"
                          " ; indented\n"
                          "[ C ] text\n"
                          "[]\n");
  CHECK(kinds(file) == Kinds{Deviation::entry_outside_section, Deviation::indented_section,
                             Deviation::unclosed_section, Deviation::junk_line, Deviation::blank_around_key,
                             Deviation::no_key, Deviation::hash_comment, Deviation::indented_comment,
                             Deviation::text_after_section, Deviation::blank_in_section_name,
                             Deviation::empty_section_name});
  CHECK(file.find("B")->find("x")->value == "1");
  CHECK(file.find("C") != nullptr);
  CHECK(file.remarks().all()[8].at == Position{9, 7});
}

TEST_CASE("A line may have 255 characters and is read when it has more") {
  const std::string right = "[A]\nx=" + std::string(253, 'a') + "\n";
  CHECK(kinds(parse(right)).empty());
  const std::string wrong = "[A]\nx=" + std::string(254, 'a') + "\n";
  const auto file = parse(wrong);
  CHECK(kinds(file) == Kinds{Deviation::long_line});
  CHECK(file.remarks().all()[0].at == Position{2, 256});
  CHECK(file.sections()[0].entries[0].value.size() == 254);
}

TEST_CASE("What would take too much memory is refused with its place") {
  std::string many;
  for (std::size_t i = 0; i <= IniFile::most_sections; ++i) many += "[a]\n";
  const auto refused = IniFile::parse(many, "a.eds");
  REQUIRE_FALSE(refused);
  CHECK(refused.error().where == "a.eds:100001:1");
  CHECK_FALSE(IniFile::parse(std::string(IniFile::most_bytes + 1, '\n'), "a.eds"));
  const auto hostile = parse("[A]\n" + std::string(5000, '=') + std::string("\n=\n=\n"));
  CHECK(hostile.remarks().all().size() == 4);
  std::string junk;
  for (int i = 0; i < 3000; ++i) junk += "junk\n";
  const auto counted = parse(junk);
  CHECK(counted.remarks().all().size() == Remarks::most_of_a_kind);
  CHECK(counted.remarks().left_out() == 2000);
}

TEST_CASE("Section names are understood in any case and remarked when oddly written") {
  const auto name = [](std::string_view text) { return parse_section_name(text); };
  CHECK(name("1018").kind == SectionKind::object);
  CHECK(name("1018").index == conform::Index(0x1018));
  CHECK_FALSE(name("1a00SubF").odd_form);
  CHECK(name("1a00SubF").kind == SectionKind::sub_object);
  CHECK(name("1a00SubF").sub == conform::SubIndex(15));
  CHECK(name("1003sub10").sub == conform::SubIndex(16));
  CHECK(name("1003sub0A").odd_form);
  CHECK(name("0x1003").odd_form);
  CHECK(name("01003").index == conform::Index(0x1003));
  CHECK(name("1003 sub 1").odd_form);
  CHECK(name("1003sub100").kind == SectionKind::unknown);
  CHECK(name("12345").kind == SectionKind::unknown);
  CHECK(name("Fad").kind == SectionKind::unknown);
  CHECK(name("FADE").kind == SectionKind::object);
  CHECK(name("1A00Denotation").kind == SectionKind::denotations);
  CHECK(name("1A00Denotation").index == conform::Index(0x1A00));
  CHECK(name("2000ObjectLinks").kind == SectionKind::links);
  CHECK(name("M2FixedObjects").kind == SectionKind::fixed_list);
  CHECK(name("M2Fixed6000sub1").kind == SectionKind::fixed_sub_object);
  CHECK(name("M12SubExt6000").kind == SectionKind::extension);
  CHECK(name("M12SubExt6000").module == 12);
  CHECK(name("Mandatory").kind == SectionKind::unknown);
  CHECK(name("DeviceComissioning").kind == SectionKind::commissioning);
}

}  // namespace
