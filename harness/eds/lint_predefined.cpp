// SPDX-License-Identifier: Apache-2.0
// Objects that CiA 301 defines: their object code, data types, access and mapping, by the table that the
// dictionary of `run` is made of (standard_table.hpp).
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "eds/lint_rules.hpp"
#include "eds/standard_table.hpp"
#include "eds/type_table.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view dictionary = "CiA 301, 7.5.2";

constexpr Rule other_type{"EDS230", Severity::error, "An object of CiA 301 has another data type",
                          dictionary};
constexpr Rule other_code{"EDS231", Severity::warning, "An object of CiA 301 has another object code",
                          dictionary};
constexpr Rule too_open{"EDS232", Severity::error, "An object of CiA 301 that is read-only can be written",
                        dictionary};
constexpr Rule not_readable{"EDS233", Severity::error, "An object of CiA 301 cannot be read", dictionary};
constexpr Rule mappable{"EDS234", Severity::error, "An object that CiA 301 keeps out of PDOs can be mapped",
                        dictionary};
constexpr Rule half_guarding{"EDS235", Severity::error, "Of guard time and life time factor one is missing",
                             "CiA 301, 7.5.2.11 and 7.5.2.12"};
constexpr Rule incomplete{"EDS236", Severity::warning, "An object lacks the one that it works with",
                          dictionary};
constexpr Rule too_closed{"EDS237", Severity::error, "An object of CiA 301 that can be written is read-only",
                          dictionary};
constexpr Rule unknown_sub{"EDS238", Severity::warning,
                           "An object of CiA 301 has a sub-index that the standard does not define",
                           dictionary};
constexpr Rule other_kind{"EDS239", Severity::error,
                          "A variable stands where CiA 301 has a structure, or a structure for a variable",
                          dictionary};

constexpr const Rule* all[] = {&other_type,    &other_code, &too_open,   &not_readable, &mappable,
                               &half_guarding, &incomplete, &too_closed, &unknown_sub,  &other_kind};

std::string type_name(std::uint16_t code) {
  const auto* info = find_type(code);
  return info == nullptr ? fmt::format("type {:04X}h", code) : std::string(info->name);
}

std::string_view code_name(ObjectCode code) {
  switch (code) {
    case ObjectCode::array: return "an array";
    case ObjectCode::record: return "a record";
    case ObjectCode::domain: return "a DOMAIN";
    default: return "a variable";
  }
}

bool has_subs(ObjectCode code) {
  return code == ObjectCode::array || code == ObjectCode::record || code == ObjectCode::defstruct;
}

/// What the standard's clauses leave to the device beyond its tables of access: whether a command is read
/// back, and whether what it restores (1011h) can be chosen at all.
bool leaves_reading(Index index) { return between(index, 0x1023, 0x1026); }
bool leaves_writing(Index index) { return between(index, 0x1010, 0x1011); }

void check_type(const Spot& spot, const StandardRow& row, Findings& findings) {
  // A DOMAIN is told by its object code, and may leave the type out.
  if (row.object == ObjectCode::domain) return;
  const auto type = data_type(spot.entry);
  if (type && *type != row.type)
    findings.add(
        other_type, spot.entry.data_type.at,
        fmt::format("{}: DataType is {}, by CiA 301 {}", spot.name(), type_name(*type), type_name(row.type)));
}

void check_access(const Spot& spot, const StandardRow& row, Findings& findings) {
  const auto& word = spot.entry.access_type;
  const auto allowed = access(spot.entry);
  const auto index = spot.object.index;
  if (!allowed) return;
  if (!can_be_written(row.access) && can_be_written(*allowed))
    findings.add(
        too_open, word.at,
        fmt::format("{}: AccessType is {}, by CiA 301 it is read-only", spot.name(), shortened(word.text)));
  if (can_be_read(row.access) && !can_be_read(*allowed) && !leaves_reading(index))
    findings.add(not_readable, word.at, fmt::format("{}: by CiA 301 it can be read", spot.name()));
  const bool may_be_fixed = row.has(StandardFlag::leaves_access) || leaves_writing(index);
  if (can_be_written(row.access) && !can_be_written(*allowed) && !may_be_fixed)
    findings.add(
        too_closed, word.at,
        fmt::format("{}: AccessType is {}, by CiA 301 it can be written", spot.name(), shortened(word.text)));
}

/// Also where the standard itself defines no sub-index: nothing of such an object goes into a PDO.
void check_mappable(const Spot& spot, bool may_be_mapped, Findings& findings) {
  const auto& field = spot.entry.pdo_mapping;
  if (may_be_mapped || field.empty() || pdo_mapping(spot.entry) == PdoMapping::no) return;
  findings.add(mappable, field.at, fmt::format("{}: by CiA 301 it cannot be mapped into a PDO", spot.name()));
}

/// False when the object is of another kind, so that its entries cannot be compared.
bool check_head(const Object& object, const StandardRow& row, Findings& findings) {
  const auto code = object_code(object.entry);
  // Without ObjectType, or with an unknown one, there is a finding already.
  if (!object.described || !code || (object.entry.object_type.empty() && !object.subs.empty())) return true;
  if (object.entry.object_type.empty() && number_of(object.compact_sub_obj).value_or(0) > 0) return true;
  const auto at = place_of(object.entry.object_type, object.entry.at);
  const auto name = section_name(object.index);
  if (has_subs(*code) != has_subs(row.object)) {
    findings.add(other_kind, at,
                 fmt::format("{} is {}, by CiA 301 {}", name, code_name(*code), code_name(row.object)));
    return false;
  }
  if (*code != row.object)
    findings.add(other_code, at, fmt::format("{}: by CiA 301 it is {}", name, code_name(row.object)));
  return true;
}

void check_object(const Object& object, Findings& findings) {
  const auto rows = rows_of(object.index);
  if (rows.empty()) return;
  const bool may_be_mapped =
      std::ranges::any_of(rows, [](const auto* row) { return row->has(StandardFlag::pdo_mappable); });
  const bool same_kind = check_head(object, *rows.front(), findings);
  const StandardRow* implied = nullptr;  // of alike implied entries the first speaks for all
  const auto look = [&](const Spot& spot, SubIndex sub) {
    const auto row = std::ranges::find_if(rows, [sub](const auto* each) {
      return sub.value() >= each->first_sub && sub.value() <= each->last_sub;
    });
    if (row == rows.end()) {
      check_mappable(spot, may_be_mapped, findings);
      // FFh describes the structure of any object; CompactPDO has one mask for PDOs of both directions.
      if (same_kind && sub != SubIndex(0xFF) && !spot.entry.implied_by.known())
        findings.add(unknown_sub, spot.entry.at,
                     fmt::format("{}: CiA 301 does not define this sub-index", spot.name()));
      return;
    }
    if (spot.entry.implied_by.known()) {
      // How sub-index 00h of CompactSubObj can be accessed the file does not choose.
      if (sub == SubIndex(0) || std::exchange(implied, *row) == *row) return;
    }
    check_mappable(spot, (*row)->has(StandardFlag::pdo_mappable), findings);
    if (!same_kind) return;
    check_type(spot, **row, findings);
    check_access(spot, **row, findings);
  };
  if (object.described && !is_structured(object)) look({object, {}, object.entry}, SubIndex(0));
  for (const auto& sub : object.subs) look({object, sub.sub, sub.entry}, sub.sub);
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
  for (const auto& object : subject.objects) {
    if (object.index.value() > 0x1FFF) break;  // they are in ascending order
    check_object(object, findings);
  }
}

}  // namespace

constinit const Group predefined_rules{{"Objects of CiA 301", all}, check};

}  // namespace conform::eds
