// SPDX-License-Identifier: Apache-2.0
// Structure: what the reader had to pass over or to put right.
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "base/text.hpp"
#include "eds/ini_file.hpp"
#include "eds/lint_rules.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view syntax = "CiA 306, syntax";
constexpr std::string_view sections = "CiA 306, sections";
constexpr std::string_view xml = "CiA 311";

constexpr Rule junk_line{"EDS001", Severity::error, "A line is neither a section, an entry nor a comment",
                         syntax};
constexpr Rule unclosed_section{"EDS002", Severity::error, "The name of a section is not closed by ]",
                                syntax};
constexpr Rule indented_section{"EDS003", Severity::error, "The [ of a section is not in column 1", syntax};
constexpr Rule text_after_section{"EDS004", Severity::error, "Text follows the ] of a section", syntax};
constexpr Rule duplicate_section{"EDS005", Severity::error, "A section is there twice", sections};
constexpr Rule duplicate_entry{"EDS006", Severity::error, "An entry is there twice in one section", sections};
constexpr Rule entry_outside{"EDS007", Severity::error, "An entry stands before the first section", syntax};
constexpr Rule no_key{"EDS008", Severity::error, "An entry has no key before the =", syntax};
constexpr Rule hash_comment{"EDS009", Severity::error, "A comment begins with # instead of ;", syntax};
constexpr Rule indented_comment{"EDS010", Severity::warning, "The ; of a comment is not in column 1", syntax};
constexpr Rule blank_around_key{"EDS011", Severity::note,
                                "Blanks stand before a key or between key and =", syntax};
constexpr Rule long_line{"EDS012", Severity::warning, "A line is longer than 255 characters", syntax};
constexpr Rule non_ascii{"EDS013", Severity::warning, "A line holds bytes that are no ASCII", syntax};
constexpr Rule control_character{"EDS014", Severity::error, "A line holds control characters", syntax};
constexpr Rule mixed_line_ends{"EDS015", Severity::warning, "The lines end in different ways", syntax};
constexpr Rule carriage_return{"EDS016", Severity::warning, "Lines end in CR alone", syntax};
constexpr Rule byte_order_mark{"EDS017", Severity::warning, "The file begins with a byte order mark", syntax};
constexpr Rule section_form{
    "EDS018", Severity::error,
    "The name of a section has 0x, leading zeros, blanks or the wrong number of digits", sections};
constexpr Rule unknown_section{"EDS019", Severity::note, "A section is not known", sections};
constexpr Rule unknown_entry{"EDS020", Severity::note, "An entry is not known in its section", sections};
constexpr Rule empty_section_name{"EDS021", Severity::error, "A section has no name", syntax};
constexpr Rule sub_without_object{"EDS022", Severity::error,
                                  "A sub-object or list belongs to an object without section", sections};
constexpr Rule two_commissionings{"EDS023", Severity::error,
                                  "The device is commissioned twice, in two spellings", "CiA 306, DCF"};
constexpr Rule commissioning_spelling{"EDS024", Severity::note, "DeviceCommissioning is spelled with two m",
                                      "CiA 306, DCF"};
constexpr Rule xml_bad_index{"EDS040", Severity::error,
                             "An index or sub-index is no hexadecimal number of its range", xml};
constexpr Rule xml_no_object_list{"EDS041", Severity::error, "There is no CANopenObjectList", xml};
constexpr Rule xml_reference{"EDS042", Severity::error, "A uniqueIDRef refers to no parameter", xml};
constexpr Rule xml_duplicate{"EDS043", Severity::error, "An object or sub-object is there twice", xml};
constexpr Rule xml_mapping{"EDS044", Severity::error,
                           "PDOmapping is none of no, default, optional, TPDO and RPDO", xml};

constexpr const Rule* all[] = {
    &junk_line,          &unclosed_section,   &indented_section,   &text_after_section,
    &duplicate_section,  &duplicate_entry,    &entry_outside,      &no_key,
    &hash_comment,       &indented_comment,   &blank_around_key,   &long_line,
    &non_ascii,          &control_character,  &mixed_line_ends,    &carriage_return,
    &byte_order_mark,    &section_form,       &unknown_section,    &unknown_entry,
    &empty_section_name, &sub_without_object, &two_commissionings, &commissioning_spelling,
    &xml_bad_index,      &xml_no_object_list, &xml_reference,      &xml_duplicate,
    &xml_mapping,
};

constexpr RemarkRow rows[] = {
    {Deviation::byte_order_mark, &byte_order_mark, "the file begins with a byte order mark",
     "save it without BOM"},
    {Deviation::mixed_line_ends,
     &mixed_line_ends,
     "from here on lines end differently than the first line",
     {}},
    {Deviation::carriage_return_only, &carriage_return, "the line ends in CR alone", "use LF or CR LF"},
    {Deviation::long_line, &long_line, "the line has {} characters, more than 255", "many tools cut it off"},
    {Deviation::non_ascii, &non_ascii, "byte '{}' is no ASCII", "readers will disagree about what it means"},
    {Deviation::control_character, &control_character, "control character '{}'", {}},
    {Deviation::junk_line, &junk_line, "'{}' is neither a section, an entry nor a comment", {}},
    {Deviation::hash_comment, &hash_comment, "'{}' is no comment by the standard", "comments begin with ;"},
    {Deviation::indented_comment, &indented_comment, "the ; of a comment must stand in column 1", {}},
    {Deviation::blank_around_key, &blank_around_key, "blanks around the key '{}'", {}},
    {Deviation::no_key, &no_key, "'{}' has no key", {}},
    {Deviation::entry_outside_section, &entry_outside, "'{}' stands in no section and is ignored", {}},
    {Deviation::unclosed_section, &unclosed_section, "'{}' lacks the ]", {}},
    {Deviation::indented_section, &indented_section, "'{}' must begin in column 1", {}},
    {Deviation::text_after_section, &text_after_section, "'{}' after the ]",
     "put comments on a line of their own"},
    {Deviation::empty_section_name, &empty_section_name, "a section without name", {}},
    {Deviation::blank_in_section_name, &section_form, "blanks between the brackets of '{}'", {}},
    {Deviation::section_name_form, &section_form, "[{}] is not how the standard writes it",
     "four digits of index, no 0x; the sub-index without leading zero: [1A00sub1]"},
    {Deviation::duplicate_section, &duplicate_section, "section [{}] is there a second time", {}},
    {Deviation::duplicate_entry, &duplicate_entry, "entry '{}' is there a second time", {}},
    {Deviation::unknown_section, &unknown_section, "section [{}] is not known", {}},
    {Deviation::unknown_entry, &unknown_entry, "entry '{}' is not known here", {}},
    {Deviation::sub_without_object, &sub_without_object, "object {} has no section of its own", {}},
    {Deviation::two_commissionings, &two_commissionings, "[{}] is there in another spelling, too", {}},
    {Deviation::commissioning_spelling, &commissioning_spelling,
     "the standard spells it [DeviceComissioning]", "many tools know only the spelling of the standard"},
    {Deviation::xml_bad_index, &xml_bad_index, "'{}' is no index", {}},
    {Deviation::xml_no_object_list, &xml_no_object_list, "no CANopenObjectList", {}},
    {Deviation::xml_unknown_reference,
     &xml_reference,
     "no parameter or template of this kind has the uniqueID '{}'",
     {}},
    {Deviation::xml_duplicate_object, &xml_duplicate, "{} is there a second time", {}},
    {Deviation::xml_unknown_mapping, &xml_mapping, "'{}' is no PDOmapping", {}},
};

/// The keys that an unknown one could have been meant to be.
std::vector<std::string_view> known_keys() {
  std::vector<std::string_view> out{"SupportedObjects", "NrOfEntries", "Lines", "ObjectLinks"};
  const auto add = [&out](const auto& fields) {
    for (const auto& row : fields) out.push_back(row.key);
  };
  add(file_info_fields);
  add(device_info_fields);
  add(commissioning_fields);
  add(entry_fields);
  add(object_fields);
  return out;
}

void check(const Subject& subject, Findings& findings) {
  const auto keys = known_keys();
  for (const auto& remark : subject.file.remarks.all()) {
    const auto* row = row_of(rows, remark);
    if (row == nullptr) continue;
    auto hint = std::string(row->hint);
    if (remark.first.known()) hint = fmt::format("the first one, in line {}, counts", remark.first.line);
    if (remark.what == Deviation::unknown_entry) {
      const auto meant = did_you_mean(remark.detail, keys);
      if (!meant.empty() && !same_word(meant, remark.detail)) hint = fmt::format("did you mean {}?", meant);
    }
    findings.add(*row->rule, remark.at, row->text_of(remark), std::move(hint));
  }
}

}  // namespace

constinit const Group structure_rules{{"Structure", all}, check};

}  // namespace conform::eds
