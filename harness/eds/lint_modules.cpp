// SPDX-License-Identifier: Apache-2.0
// Modular devices: the coupler's file and the sections of its modules.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/text.hpp"
#include "eds/lint_rules.hpp"
#include "eds/same_value.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view modules = "CiA 306, modules";

constexpr Rule no_module_list{"EDS420", Severity::warning, "1027h exists, but there is no [SupportedModules]",
                              modules};
constexpr Rule no_1027{"EDS421", Severity::warning, "There is [SupportedModules], but 1027h is missing",
                       modules};
constexpr Rule module_count{"EDS422", Severity::error,
                            "A module that NrOfEntries of [SupportedModules] counts is not described",
                            modules};
constexpr Rule no_info{"EDS423", Severity::error, "A module has no [MxModuleInfo]", modules};
constexpr Rule beyond{"EDS424", Severity::error, "A module has a number above NrOfEntries", modules};
constexpr Rule list_count{"EDS425", Severity::error,
                          "NrOfEntries of a list of a module is not the number of entries", modules};
constexpr Rule not_described{"EDS426", Severity::error, "An object in a list of a module has no section",
                             modules};
constexpr Rule not_listed{"EDS427", Severity::error, "A section of a module is in no list", modules};
constexpr Rule different{"EDS428", Severity::error, "A fixed object differs between modules", modules};

constexpr Rule bad_extension{"EDS429", Severity::error,
                             "An object that grows with a module has no Count, or one that is no number",
                             modules};
constexpr Rule bad_extend{"EDS430", Severity::error, "ObjExtend is not 0 or 1", modules};
constexpr Rule no_detail{"EDS431", Severity::warning, "An entry of [MxModuleInfo] is missing", modules};
constexpr Rule fixed_and_extended{"EDS432", Severity::error,
                                  "A module has an object both as fixed and as growing", modules};
constexpr Rule twice{"EDS433", Severity::warning, "A fixed object of a module is one of the device, too",
                     modules};
constexpr Rule connected{"EDS434", Severity::error, "[ConnectedModules] does not fit [SupportedModules]",
                         "CiA 306, DCF of modular devices"};
constexpr Rule no_objects{"EDS435", Severity::note, "A module has no objects", modules};

constexpr const Rule* all[] = {
    &no_module_list,     &no_1027,    &module_count, &no_info,       &beyond,     &list_count,
    &not_described,      &not_listed, &different,    &bad_extension, &bad_extend, &no_detail,
    &fixed_and_extended, &twice,      &connected,    &no_objects};

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

/// Whether two fields of entries say the same, however they write it.
bool same_field(const Entry& a, const Entry& b, const FieldRow<Entry>& row) {
  const auto& left = a.*row.field;
  const auto& right = b.*row.field;
  // Words mean the same in any case; names and texts are compared as they stand.
  if (row.key == "AccessType") return access(a) == access(b);
  if (row.key == "ObjectType") return object_code(a) == object_code(b);
  const bool has_type = row.key == "DefaultValue" || row.key == "LowLimit" || row.key == "HighLimit";
  const bool is_text = row.key == "ParameterName" || row.key == "Denotation";
  return left.text == right.text ||
         (!is_text && may_be_same_value(left, right, has_type ? data_type(a) : std::nullopt, {}));
}

bool same_entry(const Entry& a, const Entry& b) {
  return std::ranges::all_of(entry_fields, [&](const auto& row) { return same_field(a, b, row); });
}

bool same_object(const Object& a, const Object& b) {
  return same_entry(a.entry, b.entry) && std::ranges::equal(a.subs, b.subs, [](const auto& x, const auto& y) {
           return x.sub == y.sub && same_entry(x.entry, y.entry);
         });
}

/// "1", or "1;2": so many sub-indices for each module, or for each of so many modules.
bool is_count(std::string_view text) {
  const auto parts = split(text, ';');
  return parts.size() <= 2 && std::ranges::all_of(parts, [](std::string_view part) {
           const auto number = parse_number(trim(part));
           return number && !number->negative && !number->node_id && number->magnitude <= 0xFF;
         });
}

void check_extensions(const Module& module, Findings& findings) {
  for (const auto& extension : module.extensions) {
    const auto name = fmt::format("[M{}SubExt{:04X}]", module.number, extension.index.value());
    if (extension.count.empty() || !is_count(extension.count.text))
      findings.add(
          bad_extension, place_of(extension.count, extension.entry.at),
          fmt::format("{}: Count '{}' is no number of sub-indices", name, shortened(extension.count.text)));
    if (!extension.obj_extend.empty() && !flag_of(extension.obj_extend))
      findings.add(
          bad_extend, extension.obj_extend.at,
          fmt::format("{}: ObjExtend '{}' is not 0 or 1", name, shortened(extension.obj_extend.text)));
    if (find_object(module.fixed_objects, extension.index) != nullptr)
      findings.add(
          fixed_and_extended, extension.entry.at,
          fmt::format("{}: [M{}Fixed{:04X}] is there, too", name, module.number, extension.index.value()));
  }
}

void check_module(const EdsFile& file, const Module& module, Findings& findings) {
  if (module.has_info) {
    for (const auto& row : module_fields) {
      const auto& field = module.*row.field;
      if (field.empty())
        findings.add(no_detail, place_of(field, module.at),
                     fmt::format("[M{}ModuleInfo]: {} is missing", module.number, row.key));
    }
    if (module.fixed_objects.empty() && module.extensions.empty())
      findings.add(no_objects, module.at,
                   fmt::format("module {} has neither fixed nor growing objects", module.number));
  }
  check_extensions(module, findings);
  for (const auto& object : module.fixed_objects) {
    if (file.find(object.index) != nullptr)
      findings.add(twice, object.entry.at,
                   fmt::format("[M{}Fixed{:04X}]: {} is there, too", module.number, object.index.value(),
                               section_name(object.index)));
  }
}

void check_connected(const EdsFile& file, Findings& findings) {
  check_count(file.connected_modules, connected, findings);
  const auto count = number_of(file.supported_modules.count).value_or(0);
  for (const auto& entry : file.connected_modules.entries) {
    const auto module = number_of(entry.field);
    if (!module || *module == 0 || *module > count)
      findings.add(
          connected, entry.field.at,
          fmt::format("'{}' is none of the {} supported modules", shortened(entry.field.text), count));
  }
}

/// A count alone: the modules are sections, [M1ModuleInfo] and so on.
void check_supported(const EdsFile& file, std::uint64_t count, Findings& findings) {
  const auto& supported = file.supported_modules;
  if (!supported.present) return;
  if (supported.count.empty())
    findings.add(module_count, place_of(supported.count, supported.at),
                 "[SupportedModules]: NrOfEntries is missing");
  std::uint64_t expected = 1;
  for (const auto& module : file.modules) {
    if (module.number == expected) ++expected;
  }
  if (expected <= count)
    findings.add(module_count, supported.count.at,
                 fmt::format("[SupportedModules]: NrOfEntries says {}, but there is no [M{}ModuleInfo]",
                             count, expected));
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
  const auto count = number_of(supported.count).value_or(0);
  check_supported(file, count, findings);
  check_connected(file, findings);
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
    check_module(file, module, findings);
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
