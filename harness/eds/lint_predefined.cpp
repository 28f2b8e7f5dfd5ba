// SPDX-License-Identifier: Apache-2.0
// Objects that CiA 301 defines: their object code, data types and access.
#include <fmt/format.h>

#include <string>

#include "base/text.hpp"
#include "eds/lint_rules.hpp"
#include "eds/type_table.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view dictionary = "CiA 301, 7.5.2";

constexpr Rule other_type{"EDS230", Severity::error, "An object of CiA 301 has another data type",
                          dictionary};
constexpr Rule other_code{"EDS231", Severity::warning, "An object of CiA 301 has another object code",
                          dictionary};
constexpr Rule too_open{"EDS232", Severity::warning, "An object of CiA 301 that is read-only can be written",
                        dictionary};
constexpr Rule not_readable{"EDS233", Severity::warning, "An object of CiA 301 cannot be read", dictionary};
constexpr Rule mappable{"EDS234", Severity::error, "An object that CiA 301 keeps out of PDOs can be mapped",
                        dictionary};
constexpr Rule half_guarding{"EDS235", Severity::error, "Of guard time and life time factor one is missing",
                             "CiA 301, 7.5.2.9 and 7.5.2.10"};
constexpr Rule incomplete{"EDS236", Severity::warning, "An object lacks the one that it works with",
                          dictionary};

constexpr const Rule* all[] = {&other_type, &other_code,    &too_open,  &not_readable,
                               &mappable,   &half_guarding, &incomplete};

constexpr unsigned u8 = 0x05, u16 = 0x06, u32 = 0x07, text = 0x09;
constexpr int any_sub = -1;  // 01h to FEh
constexpr int head = -2;     // the object itself

struct Row {
  std::uint16_t first, last;
  int sub;
  unsigned type;  // data type; of a head: object code
  bool read_only;
};

/// CiA 301, 7.5.2. Where versions of the standard differ or devices are free, there is no row.
constexpr Row rows[] = {
    {0x1000, 0x1000, 0, u32, true},        {0x1001, 0x1001, 0, u8, true},
    {0x1002, 0x1002, 0, u32, true},        {0x1003, 0x1003, head, 8, false},
    {0x1003, 0x1003, 0, u8, false},        {0x1003, 0x1003, any_sub, u32, true},
    {0x1005, 0x1005, 0, u32, false},       {0x1006, 0x1006, 0, u32, false},
    {0x1007, 0x1007, 0, u32, false},       {0x1008, 0x1008, 0, text, true},
    {0x1009, 0x1009, 0, text, true},       {0x100A, 0x100A, 0, text, true},
    {0x100C, 0x100C, 0, u16, false},       {0x100D, 0x100D, 0, u8, false},
    {0x1010, 0x1010, any_sub, u32, false}, {0x1011, 0x1011, any_sub, u32, false},
    {0x1012, 0x1012, 0, u32, false},       {0x1013, 0x1013, 0, u32, false},
    {0x1014, 0x1014, 0, u32, false},       {0x1015, 0x1015, 0, u16, false},
    {0x1016, 0x1016, any_sub, u32, false}, {0x1017, 0x1017, 0, u16, false},
    {0x1018, 0x1018, head, 9, false},      {0x1018, 0x1018, 1, u32, true},
    {0x1018, 0x1018, 2, u32, true},        {0x1018, 0x1018, 3, u32, true},
    {0x1018, 0x1018, 4, u32, true},        {0x1019, 0x1019, 0, u8, false},
    {0x1200, 0x12FF, head, 9, false},      {0x1200, 0x12FF, 1, u32, false},
    {0x1200, 0x12FF, 2, u32, false},       {0x1280, 0x12FF, 3, u8, false},
    {0x1400, 0x15FF, head, 9, false},      {0x1400, 0x15FF, 1, u32, false},
    {0x1400, 0x15FF, 2, u8, false},        {0x1400, 0x15FF, 3, u16, false},
    {0x1400, 0x15FF, 5, u16, false},       {0x1600, 0x17FF, any_sub, u32, false},
    {0x1800, 0x19FF, head, 9, false},      {0x1800, 0x19FF, 1, u32, false},
    {0x1800, 0x19FF, 2, u8, false},        {0x1800, 0x19FF, 3, u16, false},
    {0x1800, 0x19FF, 5, u16, false},       {0x1800, 0x19FF, 6, u8, false},
    {0x1A00, 0x1BFF, any_sub, u32, false},
};

std::string type_name(unsigned code) {
  const auto* info = find_type(static_cast<std::uint16_t>(code));
  return info == nullptr ? fmt::format("type {:04X}h", code) : std::string(info->name);
}

void compare(const Spot& spot, const Row& row, Findings& findings) {
  const auto& entry = spot.entry;
  if (row.sub == head) {
    const auto code = object_code(entry);
    // Without ObjectType there is a finding already.
    if (entry.object_type.empty() || !code || static_cast<unsigned>(*code) == row.type) return;
    findings.add(
        other_code, entry.object_type.at,
        fmt::format("{}: by CiA 301 it is {}", spot.name(), row.type == 8 ? "an array" : "a record"));
    return;
  }
  const auto type = data_type(entry);
  if (type && *type != row.type)
    findings.add(
        other_type, entry.data_type.at,
        fmt::format("{}: DataType is {}, by CiA 301 {}", spot.name(), type_name(*type), type_name(row.type)));
  const auto allowed = access(entry);
  if (!allowed) return;
  if (row.read_only && can_be_written(*allowed))
    findings.add(too_open, entry.access_type.at,
                 fmt::format("{}: AccessType is {}, by CiA 301 it is read-only", spot.name(),
                             shortened(entry.access_type.text)));
  if (!can_be_read(*allowed))
    findings.add(not_readable, entry.access_type.at,
                 fmt::format("{}: by CiA 301 it can be read", spot.name()));
}

/// 1001h, 1002h, 1013h and 1026h may be mapped; what is not listed here other profiles define.
bool is_kept_out_of_pdos(Index index) {
  return index == Index(0x1000) || index == Index(0x1003) || between(index, 0x1005, 0x1012) ||
         between(index, 0x1014, 0x1020) || between(index, 0x1028, 0x1029) || between(index, 0x1400, 0x1BFF);
}

void check_mappable(const Spot& spot, Findings& findings) {
  if (!is_kept_out_of_pdos(spot.object.index)) return;
  const auto mapping = pdo_mapping(spot.entry);
  if (spot.entry.pdo_mapping.empty() || mapping == PdoMapping::no) return;
  findings.add(mappable, spot.entry.pdo_mapping.at,
               fmt::format("{}: by CiA 301 it cannot be mapped into a PDO", spot.name()));
}

struct Pair {
  std::uint16_t present, missing;
  const Rule* rule;
};
constexpr Pair pairs[] = {{0x100C, 0x100D, &half_guarding},
                          {0x100D, 0x100C, &half_guarding},
                          {0x1019, 0x1005, &incomplete},
                          {0x1021, 0x1022, &incomplete},
                          {0x1022, 0x1021, &incomplete}};

void check_pairs(const Subject& subject, Findings& findings) {
  for (const auto& pair : pairs) {
    const auto* object = find_object(subject.objects, Index(pair.present));
    if (object == nullptr || find_object(subject.objects, Index(pair.missing)) != nullptr) continue;
    findings.add(*pair.rule, object->entry.at,
                 fmt::format("{} is there without {}", section_name(Index(pair.present)),
                             section_name(Index(pair.missing))));
  }
}

void check(const Subject& subject, Findings& findings) {
  check_pairs(subject, findings);
  each_described(subject, [&](const Spot& spot) {
    if (spot.object.index.value() > 0x1FFF) return;
    check_mappable(spot, findings);
    const bool is_head = !spot.has_value();
    const int sub = spot.sub ? spot.sub->value() : 0;
    for (const auto& row : rows) {
      if (!between(spot.object.index, row.first, row.last)) continue;
      const bool fits = row.sub == head
                            ? !spot.sub && is_head
                            : !is_head && (row.sub == sub || (row.sub == any_sub && sub > 0 && sub < 0xFF));
      if (fits) compare(spot, row, findings);
    }
  });
}

}  // namespace

constinit const Group predefined_rules{{"Objects of CiA 301", all}, check};

}  // namespace conform::eds
