// SPDX-License-Identifier: Apache-2.0
// XDD and XDC: whether they are built as CiA 311 says.
#include <string>
#include <string_view>

#include "eds/lint_rules.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view source = "CiA 311, annex A";

constexpr Rule unknown_element{"EDS700", Severity::warning, "An element is not known where it stands",
                               source};
constexpr Rule order{"EDS701", Severity::warning, "An element stands in the wrong order, or too often",
                     source};
constexpr Rule missing_element{"EDS702", Severity::error, "A required element is missing", source};
constexpr Rule unknown_attribute{"EDS703", Severity::note, "An attribute is not known", source};
constexpr Rule missing_attribute{"EDS704", Severity::error, "A required attribute is missing", source};
constexpr Rule bad_value{"EDS705", Severity::error,
                         "The value of an attribute has not the form that it must have", source};
constexpr Rule no_name_space{"EDS706", Severity::warning, "The file is in no namespace of CiA 311", source};
constexpr Rule qualified{"EDS707", Severity::warning,
                         "An element is in another namespace than the schema puts it", source};

constexpr const Rule* all[] = {&unknown_element,   &order,     &missing_element, &unknown_attribute,
                               &missing_attribute, &bad_value, &no_name_space,   &qualified};

constexpr RemarkRow rows[] = {
    {Deviation::xml_unknown_element, &unknown_element, "{} is not known",
     "tools that validate refuse the file"},
    {Deviation::xml_order, &order, "{} stands in the wrong place, or there is one too many", {}},
    {Deviation::xml_missing_element, &missing_element, "{} is missing", {}},
    {Deviation::xml_unknown_attribute, &unknown_attribute, "{} is not known", {}},
    {Deviation::xml_missing_attribute, &missing_attribute, "{} is missing", {}},
    {Deviation::xml_bad_value, &bad_value, "{}", {}},
    {Deviation::xml_namespace, &no_name_space, "the namespace of the file is '{}'",
     "xmlns=\"http://www.canopen.org/xml/1.1\""},
    {Deviation::xml_qualified, &qualified, "{}", "readers that go by the schema do not find it"},
};

void check(const Subject& subject, Findings& findings) {
  for (const auto& remark : subject.file.remarks.all()) {
    if (const auto* row = row_of(rows, remark))
      findings.add(*row->rule, remark.at, row->text_of(remark), std::string(row->hint));
  }
}

}  // namespace

constinit const Group xdd_rules{{"Structure of XDD and XDC", all}, check};

}  // namespace conform::eds
