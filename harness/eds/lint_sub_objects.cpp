// SPDX-License-Identifier: Apache-2.0
// Structures: how many sub-objects there are and what sub-index 00h says about it.
#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "eds/lint_rules.hpp"
#include "eds/type_table.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view structures = "CiA 306, sub-objects";
constexpr std::string_view sub_index_zero = "CiA 301, 7.4.8";

constexpr Rule no_subs{"EDS250", Severity::error, "An array or record has no sub-objects", structures};
constexpr Rule no_sub_zero{"EDS251", Severity::error, "Sub-index 00h is missing", sub_index_zero};
constexpr Rule wrong_sub_number{"EDS252", Severity::error, "There are fewer sub-objects than SubNumber says",
                                structures};
constexpr Rule no_sub_number{"EDS253", Severity::error, "An array or record has no SubNumber", structures};
constexpr Rule not_the_highest{"EDS254", Severity::error,
                               "Sub-index 00h is read-only and not the highest sub-index", sub_index_zero};
constexpr Rule beyond_the_highest{
    "EDS255", Severity::warning,
    "Sub-index 00h can be written and its default is above the highest sub-index", sub_index_zero};
constexpr Rule no_sub_zero_default{"EDS256", Severity::warning,
                                   "Sub-index 00h is read-only and has no DefaultValue", structures};
constexpr Rule sub_zero_type{"EDS257", Severity::error, "Sub-index 00h is not UNSIGNED8", sub_index_zero};
constexpr Rule different_types{"EDS258", Severity::error,
                               "The elements of an array of CiA 301 or 302 have different data types",
                               "CiA 301, 7.4.3"};
constexpr Rule nested{"EDS259", Severity::error, "A sub-object is neither a variable nor a DOMAIN",
                      "CiA 301, 7.4.3"};
constexpr Rule below_the_highest{
    "EDS260", Severity::note, "Sub-index 00h can be written and its default is below the highest sub-index",
    sub_index_zero};

constexpr Rule profile_types{"EDS261", Severity::warning,
                             "The elements of an array from 2000h on have different data types",
                             "CiA 301, 7.4.3"};
constexpr Rule modular_count{"EDS262", Severity::warning,
                             "Sub-index 00h of a modular device is not the highest sub-index described",
                             sub_index_zero};

constexpr Rule more_subs{"EDS263", Severity::warning, "There are more sub-objects than SubNumber says",
                         structures};

constexpr const Rule* all[] = {&no_subs,
                               &no_sub_zero,
                               &wrong_sub_number,
                               &no_sub_number,
                               &not_the_highest,
                               &beyond_the_highest,
                               &no_sub_zero_default,
                               &sub_zero_type,
                               &different_types,
                               &nested,
                               &below_the_highest,
                               &profile_types,
                               &modular_count,
                               &more_subs};

class Check {
 public:
  Check(const Object& object, const EdsFile& file, Findings& findings)
      : object_(object), xml_(file.is_xml()), modular_(is_modular(file)), findings_(findings) {}

  void run() {
    const bool compact = number_of(object_.compact_sub_obj).value_or(0) > 0;
    if (object_.subs.empty()) {
      if (is_structured(object_) && !compact) add(no_subs, object_.entry.at, "there are no sub-objects");
      return;
    }
    count(compact);
    if (const auto* zero = object_.find(SubIndex(0)))
      sub_zero(*zero, compact);
    else if (!compact)
      add(no_sub_zero, object_.entry.at, "sub-index 00h is missing");
    for (const auto& sub : object_.subs) {
      const auto code = object_code(sub.entry);
      if (code && code != ObjectCode::var && code != ObjectCode::domain)
        add(nested, sub.entry.object_type.at, "a sub-object must be a variable or a DOMAIN", sub.sub);
    }
    if (object_code(object_.entry) == ObjectCode::array) types();
  }

 private:
  void add(const Rule& rule, Position at, std::string_view message, std::optional<SubIndex> sub = {}) {
    findings_.add(rule, at, fmt::format("{}: {}", section_name(object_.index, sub), message));
  }

  void count(bool compact) {
    if (compact || !object_.described || (xml_ && object_.sub_number.empty())) return;
    const auto described = static_cast<std::size_t>(
        std::ranges::count_if(object_.subs, [](const auto& sub) { return sub.sub != SubIndex(0xFF); }));
    if (object_.sub_number.empty())
      return add(no_sub_number, object_.entry.at,
                 fmt::format("SubNumber is missing; there are {} sub-objects", described));
    const auto said = number_of(object_.sub_number);
    if (said && *said != described)
      add(*said > described ? wrong_sub_number : more_subs, object_.sub_number.at,
          fmt::format("SubNumber says {}, but there are {} sub-objects", *said, described));
  }

  void sub_zero(const Entry& zero, bool compact) {
    const auto type = data_type(zero);
    if (type && *type != 0x05)
      add(sub_zero_type, zero.data_type.at, "sub-index 00h must be UNSIGNED8", SubIndex(0));
    // What these count are errors, modules, mapped objects and network variables, not sub-indices.
    if (object_.index == Index(0x1003) || object_.index == Index(0x1027) ||
        is_mapping_parameter(object_.index) || between(object_.index, 0xA000, 0xAFFF))
      return;
    const auto allowed = access(zero);
    const bool fixed = allowed && !can_be_written(*allowed);
    const auto& value = effective_value(zero);
    if (value.empty()) {
      if (fixed)
        add(no_sub_zero_default, zero.at, "a read-only sub-index 00h without DefaultValue", SubIndex(0));
      return;
    }
    std::uint64_t highest = compact ? number_of(object_.compact_sub_obj).value_or(0) : 0;
    for (const auto& sub : object_.subs) {
      if (sub.sub != SubIndex(0xFF)) highest = std::max<std::uint64_t>(highest, sub.sub.value());
    }
    const auto said = number_of(value);
    if (!said || *said == highest) return;
    // Modules add sub-indices to objects of the device that they are plugged into.
    const auto& rule = fixed && modular_ ? modular_count
                       : fixed           ? not_the_highest
                       : *said > highest ? beyond_the_highest
                                         : below_the_highest;
    add(rule, value.at, fmt::format("sub-index 00h is {}, the highest sub-index is {}", *said, highest),
        SubIndex(0));
  }

  void types() {
    const SubObject* first = nullptr;
    for (const auto& sub : object_.subs) {
      const auto type = data_type(sub.entry);
      if (!type || sub.sub == SubIndex(0) || sub.sub == SubIndex(0xFF)) continue;
      if (first == nullptr) {
        first = &sub;
      } else if (data_type(first->entry) != type) {
        const auto& rule = object_.index.value() < 0x2000 ? different_types : profile_types;
        add(rule, sub.entry.data_type.at,
            fmt::format("not the data type of sub-index {}", to_string(first->sub)), sub.sub);
        return;
      }
    }
  }

  const Object& object_;
  bool xml_;
  bool modular_;
  Findings& findings_;
};

void check(const Subject& subject, Findings& findings) {
  for (const auto& object : subject.file.objects) Check(object, subject.file, findings).run();
}

}  // namespace

constinit const Group sub_object_rules{{"Structures", all}, check};

}  // namespace conform::eds
