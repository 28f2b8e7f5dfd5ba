// SPDX-License-Identifier: Apache-2.0
// Modular devices: the coupler's file and the sections of its modules.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/text.hpp"
#include "eds/lint_rules.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view modules = "CiA 306, modules";

constexpr Rule no_module_list{"EDS420", Severity::error, "1027h exists, but there is no [SupportedModules]",
                              modules};
constexpr Rule no_1027{"EDS421", Severity::error, "There is [SupportedModules], but 1027h is missing",
                       modules};
constexpr Rule module_count{"EDS422", Severity::error,
                            "NrOfEntries of [SupportedModules] is not the number of modules", modules};
constexpr Rule no_info{"EDS423", Severity::error, "A module has no [MxModuleInfo]", modules};
constexpr Rule beyond{"EDS424", Severity::error, "A module has a number above NrOfEntries", modules};
constexpr Rule list_count{"EDS425", Severity::error,
                          "NrOfEntries of a list of a module is not the number of entries", modules};
constexpr Rule not_described{"EDS426", Severity::error, "An object in a list of a module has no section",
                             modules};
constexpr Rule not_listed{"EDS427", Severity::error, "A section of a module is in no list", modules};
constexpr Rule different{"EDS428", Severity::error, "A fixed object differs between modules", modules};

constexpr const Rule* all[] = {&no_module_list, &no_1027,       &module_count, &no_info,  &beyond,
                               &list_count,     &not_described, &not_listed,   &different};

std::set<Index> indices_of(const NumberedList& list) {
  std::set<Index> out;
  for (const auto& entry : list.entries) {
    if (const auto index = number_of(entry.field); index && *index <= 0xFFFF)
      out.insert(Index(static_cast<std::uint16_t>(*index)));
  }
  return out;
}

void check_count(const NumberedList& list, const Rule& rule, Findings& findings) {
  const auto count = number_of(list.count);
  if (!list.present || (!count && !list.count.empty())) return;
  if (count.value_or(0) != list.entries.size())
    findings.add(rule, place_of(list.count, list.at),
                 fmt::format("[{}]: NrOfEntries says {}, but there are {} entries", list.name,
                             count.value_or(0), list.entries.size()));
}

/// The sections of a module against its list.
template <typename Things>
void check_list(const NumberedList& list, std::string_view word, std::uint64_t module,
                const Things& described, Findings& findings) {
  check_count(list, list_count, findings);
  std::set<Index> there;
  for (const auto& thing : described) there.insert(thing.index);
  const auto listed = indices_of(list);
  for (const auto& entry : list.entries) {
    const auto index = number_of(entry.field);
    if (index && *index <= 0xFFFF && !there.contains(Index(static_cast<std::uint16_t>(*index))))
      findings.add(not_described, entry.field.at,
                   fmt::format("there is no section [M{}{}{:04X}]", module, word, *index));
  }
  for (const auto& thing : described) {
    if (!listed.contains(thing.index))
      findings.add(not_listed, thing.entry.at,
                   fmt::format("[M{}{}{:04X}] is in no list", module, word, thing.index.value()));
  }
}

bool same_text(const Entry& a, const Entry& b) {
  return std::ranges::all_of(entry_fields,
                             [&](const auto& row) { return (a.*row.field).text == (b.*row.field).text; });
}

bool same_object(const Object& a, const Object& b) {
  return same_text(a.entry, b.entry) && std::ranges::equal(a.subs, b.subs, [](const auto& x, const auto& y) {
           return x.sub == y.sub && same_text(x.entry, y.entry);
         });
}

void check(const Subject& subject, Findings& findings) {
  const auto& file = subject.file;
  if (file.is_xml()) return;
  const auto* list_object = file.find(Index(0x1027));
  const auto& supported = file.supported_modules;
  if (list_object != nullptr && !supported.present)
    findings.add(no_module_list, list_object->entry.at,
                 "[1027] lists modules, but there is no [SupportedModules]");
  if (supported.present && list_object == nullptr && number_of(supported.count).value_or(0) > 0)
    findings.add(no_1027, supported.at, "1027h, the list of modules, is missing");
  check_count(supported, module_count, findings);
  const auto count = number_of(supported.count).value_or(0);
  struct First {
    const Object* object;
    std::uint64_t module;
  };
  std::map<Index, First> fixed;
  for (const auto& module : file.modules) {
    if (!module.has_info)
      findings.add(no_info, module.at, fmt::format("[M{}ModuleInfo] is missing", module.number));
    if (module.number == 0 || module.number > count)
      findings.add(
          beyond, module.at,
          fmt::format("module {}, but NrOfEntries of [SupportedModules] is {}", module.number, count));
    check_list(module.fixed_list, "Fixed", module.number, module.fixed_objects, findings);
    check_list(module.extension_list, "SubExt", module.number, module.extensions, findings);
    for (const auto& object : module.fixed_objects) {
      const auto [known, is_new] = fixed.try_emplace(object.index, First{&object, module.number});
      if (!is_new && !same_object(object, *known->second.object))
        findings.add(different, object.entry.at,
                     fmt::format("[M{}Fixed{:04X}] differs from that of module {}", module.number,
                                 object.index.value(), known->second.module));
    }
  }
}

}  // namespace

constinit const Group module_rules{{"Modules", all}, check};

}  // namespace conform::eds
