// SPDX-License-Identifier: Apache-2.0
// Expressions, objects, conditions and times where they stand in a file: read, or explained at their place.
#include <algorithm>
#include <utility>

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

/// "2 T_NMT" is {2, "T_NMT"}, and "T_NMT" {1, "T_NMT"}.
std::pair<std::int64_t, std::string_view> split_multiple(std::string_view text) {
  constexpr std::uint64_t most = 99;
  const auto space = text.find(' ');
  const auto times = parse_number(text.substr(0, space));
  if (space == std::string_view::npos || !times || *times < 1 || *times > most) return {1, text};
  return {static_cast<std::int64_t>(*times), trim(text.substr(space))};
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
  return profile_name.empty() ? fixed : times * profile.duration(profile_name).value_or(fixed);
}

std::string TimeReference::text() const {
  if (profile_name.empty()) return to_string(fixed);
  const auto name = profile_name.starts_with("T_") ? profile_name : "$profile." + profile_name;
  return times == 1 ? name : std::to_string(times) + " " + name;
}

Result<TimeReference> TimeReference::parse(std::string_view text) {
  TimeReference out;
  const auto [times, named] = split_multiple(text);
  const auto name = named.starts_with("$profile.") ? named.substr(9)
                    : named.starts_with("T_")      ? named
                                                   : std::string_view();
  if (!name.empty()) {
    if (!device::Profile{}.duration(name)) {
      return fail("unknown time '" + std::string(named) + "'", {},
                  "$profile.boot_time, $profile.sdo_timeout, T_NMT, T_QUIET, ...");
    }
    out.profile_name = name;
    out.times = times;
    return out;
  }
  const auto time = parse_duration(text);
  if (!time) {
    return fail("'" + std::string(text) + "' is not a duration", {},
                "write 100 ms, 1.5 s, $profile.boot_time, T_NMT or 2 T_NMT");
  }
  out.fixed = *time;
  return out;
}

std::optional<TimeReference> parse_time_at(const yaml::Field& field) {
  const auto text = field.text();
  if (!text) return std::nullopt;
  auto time = TimeReference::parse(*text);
  if (time) return *time;
  field.error(time.error().what, time.error().hint);
  return std::nullopt;
}

}  // namespace conform::steps
