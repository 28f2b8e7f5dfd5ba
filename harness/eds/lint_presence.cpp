// SPDX-License-Identifier: Apache-2.0
// What belongs together by CiA 301: entries that their object must have, and objects that a feature needs.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "eds/lint_rules.hpp"
#include "eds/standard_table.hpp"

namespace conform::eds {
namespace {

constexpr Rule no_error_control{
    "EDS440", Severity::error, "Neither 1017h (heartbeat) nor 100Ch (guarding) is there", "CiA 301, 7.2.8.3"};
constexpr Rule missing_sub{"EDS441", Severity::error,
                           "An object of CiA 301 lacks a sub-index that it must have", "CiA 301, 7.5.2"};
constexpr Rule no_emergency{"EDS442", Severity::warning,
                            "There are objects of the emergency service, but no 1014h", "CiA 301, 7.5.2.17"};
constexpr Rule no_sync{"EDS443", Severity::warning,
                       "A PDO is synchronous by default, but there is no 1005h, the COB-ID of SYNC",
                       "CiA 301, 7.5.2.5"};
constexpr Rule sync_without{"EDS444", Severity::warning,
                            "There are objects of the SYNC service, but no 1005h", "CiA 301, 7.5.2.5"};
constexpr Rule no_period{"EDS445", Severity::warning,
                         "The device produces SYNC by default, but has no 1006h, the cycle period",
                         "CiA 301, 7.5.2.6"};

constexpr const Rule* all[] = {&no_error_control, &missing_sub,  &no_emergency,
                               &no_sync,          &sync_without, &no_period};

/// Modules come and go; and of 1010h and 1011h CiA 306 itself shows an example without sub-index 01h.
bool may_lack_subs(Index index) { return index == Index(0x1027) || between(index, 0x1010, 0x1011); }

void check_subs(const Object& object, Findings& findings) {
  // Without any sub-objects there is another finding; so there is where sub-index 00h is missing.
  if (object.subs.empty() || may_lack_subs(object.index)) return;
  for (const auto* row : rows_of(object.index)) {
    const auto sub = SubIndex(row->first_sub);
    if (row->category == Category::optional || row->first_sub == 0 || object.find(sub) != nullptr) continue;
    // The COB-ID of a PDO has a rule of its own.
    if (is_communication_parameter(object.index) && row->first_sub == 1) continue;
    findings.add(missing_sub, object.entry.at,
                 fmt::format("{}: sub-index {:02X}h, {}, is missing", section_name(object.index), sub.value(),
                             row->name));
  }
}

class Check {
 public:
  Check(const Subject& subject, Findings& findings) : subject_(subject), findings_(findings) {}

  void run() {
    for (const auto& object : subject_.objects) {
      if (object.index.value() > 0x1FFF) break;
      check_subs(object, findings_);
    }
    if (!has(0x1017) && !has(0x100C))
      findings_.add(no_error_control, subject_.file.optional_objects.at, "1017h and 100Ch are both missing",
                    "every device has one of the two");
    needs(no_emergency, std::array<std::uint16_t, 2>{0x1003, 0x1015}, 0x1014);
    needs(sync_without, std::array<std::uint16_t, 2>{0x1006, 0x1007}, 0x1005);
    synchronous();
    producer();
  }

 private:
  [[nodiscard]] const Object* find(std::uint16_t index) const {
    return find_object(subject_.objects, Index(index));
  }
  [[nodiscard]] bool has(std::uint16_t index) const { return find(index) != nullptr; }

  void needs(const Rule& rule, const std::array<std::uint16_t, 2>& some, std::uint16_t missing) {
    if (has(missing)) return;
    for (const auto index : some) {
      if (const auto* object = find(index))
        findings_.add(
            rule, object->entry.at,
            fmt::format("{} is there without {}", section_name(Index(index)), section_name(Index(missing))));
    }
  }

  /// Transmission types 00h to F0h follow SYNC, FCh waits for it.
  void synchronous() {
    if (has(0x1005)) return;
    for (const auto& object : subject_.objects) {
      if (!is_communication_parameter(object.index)) continue;
      const auto* type = object.find(SubIndex(2));
      const auto* cob_id = object.find(SubIndex(1));
      if (type == nullptr) continue;
      const auto& field = effective_value(*type);
      const auto value = number_of(field);
      const auto id = cob_id == nullptr ? std::nullopt : cob_id_of(effective_value(*cob_id));
      const bool is_valid = id && (id->magnitude & 0x8000'0000U) == 0;
      if (!value || !is_valid || (*value > 0xF0 && *value != 0xFC)) continue;
      findings_.add(no_sync, field.at,
                    fmt::format("{}: transmission type {:02X}h follows SYNC, but there is no 1005h",
                                section_name(object.index, SubIndex(2)), *value));
      return;
    }
  }

  void producer() {
    const auto* object = find(0x1005);
    if (object == nullptr || has(0x1006)) return;
    const auto& field = effective_value(object->entry);
    const auto value = cob_id_of(field);
    constexpr std::uint64_t generates = 0x4000'0000;
    if (value && (value->magnitude & generates) != 0)
      findings_.add(no_period, field.at, "[1005]: bit 30 says that it produces SYNC, but there is no 1006h");
  }

  const Subject& subject_;
  Findings& findings_;
};

void check(const Subject& subject, Findings& findings) { Check(subject, findings).run(); }

}  // namespace

constinit const Group presence_rules{{"What belongs together", all}, check};

}  // namespace conform::eds
