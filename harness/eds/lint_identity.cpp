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
constexpr Rule revision{"EDS402", Severity::error, "RevisionNumber is not the default of 1018h:03", identity};

constexpr const Rule* all[] = {&vendor, &product, &revision};

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
    const auto value = number_of(entry->default_value);
    if (said && value && *said != *value)
      findings.add(*row.rule, field.at,
                   fmt::format("{} is {:X}h, but 1018h:0{} is {:X}h in line {}", row.key, *said, row.sub,
                               *value, entry->default_value.at.line));
  }
}

}  // namespace

constinit const Group identity_rules{{"Identity", all}, check};

}  // namespace conform::eds
