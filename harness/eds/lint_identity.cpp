// SPDX-License-Identifier: Apache-2.0
// Identity: [DeviceInfo] and object 1018h say the same.
#include <fmt/format.h>

#include "base/text.hpp"
#include "eds/lint_rules.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view identity = "CiA 306, [DeviceInfo]";

constexpr Rule vendor{"EDS400", Severity::error, "VendorNumber is not the default of 1018h:01", identity};
constexpr Rule product{"EDS401", Severity::error, "ProductNumber is not the default of 1018h:02", identity};
constexpr Rule revision{"EDS402", Severity::warning, "RevisionNumber is not the default of 1018h:03",
                        identity};
constexpr Rule half_said{"EDS403", Severity::warning,
                         "[DeviceInfo] and 1018h differ, and one of the two is 0", identity};
constexpr Rule no_vendor{"EDS404", Severity::warning, "The vendor-ID in 1018h:01 is 0, which nobody has",
                         "CiA 301, 7.5.2.21"};

constexpr const Rule* all[] = {&vendor, &product, &revision, &half_said, &no_vendor};

struct Row {
  std::string_view key;
  Field DeviceInfo::* field;
  std::uint8_t sub;
  const Rule* rule;
};
constexpr Row rows[] = {
    {"VendorNumber", &DeviceInfo::vendor_number, 1, &vendor},
    {"ProductNumber", &DeviceInfo::product_number, 2, &product},
    {"RevisionNumber", &DeviceInfo::revision_number, 3, &revision},
};

void check(const Subject& subject, Findings& findings) {
  for (const auto& row : rows) {
    const auto& field = subject.file.device_info.*row.field;
    const auto* entry = subject.file.find(Multiplexer{Index(0x1018), SubIndex(row.sub)});
    if (entry == nullptr) continue;
    const auto said = number_of(field);
    const auto& given = effective_value(*entry);
    const auto value = number_of(given);
    if (row.sub == 1 && value == 0U)
      findings.add(no_vendor, given.at, "the vendor-ID is 0", "CiA assigns one to each vendor");
    if (!said || !value || *said == *value) continue;
    const auto& rule = *said == 0 || *value == 0 ? half_said : *row.rule;
    findings.add(rule, field.at,
                 fmt::format("{} is {:X}h, but 1018h:0{} is {:X}h in line {}", row.key, *said, row.sub,
                             *value, given.at.line));
  }
}

}  // namespace

constinit const Group identity_rules{{"Identity", all}, check};

}  // namespace conform::eds
