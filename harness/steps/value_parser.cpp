// SPDX-License-Identifier: Apache-2.0
// Expressions, objects, conditions and times where they stand in a file: read, or explained at their place.
#include <algorithm>

#include "base/text.hpp"
#include "steps/step.hpp"

namespace conform::steps {
namespace {

/// The parser's complaint, or unknown names in what it read, at the field.
template <typename Parsed>
std::optional<Parsed> parse_at(const yaml::Field& field, const NameCheck& names) {
  const auto text = field.text();
  if (!text) return std::nullopt;
  auto parsed = Parsed::parse(*text);
  if (!parsed) {
    field.error(parsed.error().what, parsed.error().hint);
    return std::nullopt;
  }
  report_unknown_names(parsed->names(), field, names);
  return *parsed;
}

}  // namespace

void report_unknown_names(const std::vector<std::string>& used, const yaml::Field& field,
                          const NameCheck& names) {
  for (const auto& name : used) {
    if (name.starts_with("profile.") || std::ranges::find(names, name) != names.end()) continue;
    const std::vector<std::string_view> known(names.begin(), names.end());
    const auto near = did_you_mean(name, known);
    field.error("unknown name $" + name, near.empty() ? "names come from save, for_each, over and let"
                                                      : "did you mean $" + std::string(near) + "?");
  }
}

std::optional<Expression> parse_expression_at(const yaml::Field& field, const NameCheck& names) {
  return parse_at<Expression>(field, names);
}

std::optional<ObjectReference> parse_object_at(const yaml::Field& field, const NameCheck& names) {
  return parse_at<ObjectReference>(field, names);
}

std::optional<Condition> parse_condition_at(const yaml::Field& field, const NameCheck& names) {
  return parse_at<Condition>(field, names);
}

Duration TimeReference::resolve(const device::Profile& profile) const {
  return profile_name.empty() ? fixed : profile.duration(profile_name).value_or(fixed);
}

std::string TimeReference::text() const {
  return profile_name.empty() ? to_string(fixed) : "$profile." + profile_name;
}

std::optional<TimeReference> parse_time_at(const yaml::Field& field) {
  const auto text = field.text();
  if (!text) return std::nullopt;
  TimeReference out;
  const auto name =
      text->starts_with("$profile.") ? text->substr(9) : (text->starts_with("T_") ? *text : std::string());
  if (!name.empty()) {
    if (!device::Profile{}.duration(name)) {
      field.error("unknown time '" + *text + "'",
                  "$profile.boot_time, $profile.sdo_timeout, $profile.store_timeout, T_QUIET, ...");
      return std::nullopt;
    }
    out.profile_name = name;
    return out;
  }
  const auto time = parse_duration(*text);
  if (!time) {
    field.error("'" + *text + "' is not a duration", "write 100 ms, 1.5 s or $profile.boot_time");
    return std::nullopt;
  }
  out.fixed = *time;
  return out;
}

}  // namespace conform::steps
