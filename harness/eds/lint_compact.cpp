// SPDX-License-Identifier: Apache-2.0
// CompactSubObj and the lists that belong to it.
#include <fmt/format.h>

#include <array>
#include <utility>

#include "base/text.hpp"
#include "eds/lint_rules.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view compact = "CiA 306, CompactSubObj";

constexpr Rule with_sub_number{"EDS270", Severity::warning, "CompactSubObj and SubNumber are both given",
                               compact};
constexpr Rule redundant{"EDS271", Severity::warning,
                         "A sub-object that CompactSubObj implies is described as well", compact};
constexpr Rule bad_size{"EDS272", Severity::error, "CompactSubObj is above 254", compact};
constexpr Rule list_without{"EDS273", Severity::error,
                            "A list of names, values or denotations without CompactSubObj", compact};
constexpr Rule beyond{"EDS274", Severity::error, "An entry of a list is beyond CompactSubObj", compact};
constexpr Rule wrong_count{"EDS275", Severity::error, "NrOfEntries is not the number of entries", compact};
constexpr Rule too_many{"EDS276", Severity::error, "More sub-objects are implied than can be looked at",
                        compact};

constexpr const Rule* all[] = {&with_sub_number, &redundant,   &bad_size, &list_without,
                               &beyond,          &wrong_count, &too_many};

void check_list(const NumberedList& list, std::uint64_t size, Findings& findings) {
  if (!list.present) return;
  if (size == 0) {
    findings.add(list_without, list.at,
                 fmt::format("[{}] belongs to an object without CompactSubObj", list.name));
    return;
  }
  const auto count = number_of(list.count);
  if ((count || list.count.empty()) && count.value_or(0) != list.entries.size())
    findings.add(wrong_count, place_of(list.count, list.at),
                 fmt::format("[{}]: NrOfEntries says {}, but there are {} entries", list.name,
                             count.value_or(0), list.entries.size()));
  for (const auto& entry : list.entries) {
    if (entry.number == 0 || entry.number > size)
      findings.add(
          beyond, entry.field.key_at,
          fmt::format("[{}]: there is no sub-index {}; CompactSubObj is {}", list.name, entry.number, size));
  }
}

void check(const Subject& subject, Findings& findings) {
  if (!subject.expansion_fault.empty()) findings.add(too_many, subject.expansion_at, subject.expansion_fault);
  for (const auto& object : subject.file.objects) {
    const auto size = number_of(object.compact_sub_obj).value_or(0);
    if (size > 254)
      findings.add(bad_size, object.compact_sub_obj.at,
                   fmt::format("{}: CompactSubObj {} is above 254", section_name(object.index), size));
    for (const auto* list : {&object.lists->names, &object.lists->values, &object.lists->denotations})
      check_list(*list, size, findings);
    if (size == 0) continue;
    if (number_of(object.sub_number).value_or(0) > 0)
      findings.add(with_sub_number, object.sub_number.at,
                   fmt::format("{}: SubNumber besides CompactSubObj", section_name(object.index)));
    for (const auto& sub : object.subs) {
      if (sub.sub.value() <= size)
        findings.add(
            redundant, sub.entry.at,
            fmt::format("{}: CompactSubObj={} implies it", section_name(object.index, sub.sub), size));
    }
  }
}

}  // namespace

constinit const Group compact_rules{{"Compact storage", all}, check};

}  // namespace conform::eds
