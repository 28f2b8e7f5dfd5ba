// SPDX-License-Identifier: Apache-2.0
#include "usage/model.hpp"

#include <optional>

#include "base/text.hpp"

namespace conform::usage {
namespace {

/// "x not in {a,b}" -> a, b
std::optional<std::vector<std::string>> set_in(std::string_view complaint, std::string_view word) {
  const std::string begin = std::string(word) + " not in {";
  if (!complaint.starts_with(begin) || !complaint.ends_with('}')) return std::nullopt;
  complaint.remove_prefix(begin.size());
  complaint.remove_suffix(1);
  std::vector<std::string> out;
  for (const auto each : split(complaint, ',')) out.emplace_back(each);
  return out;
}

/// What a validator says of a word that is in no set. A set of numbers takes only a number for a word.
std::string complaint_about(const CLI::Validator& validator, std::string word) {
  try {
    return validator(word);
  } catch (const CLI::Error&) {
    return {};
  }
}

}  // namespace

std::vector<CLI::App*> commands_of(CLI::App& app) {
  return app.get_subcommands(
      [](CLI::App* sub) { return !sub->get_group().empty() && !sub->get_name().empty(); });
}

std::vector<CLI::Option*> options_of(CLI::App& app) {
  return app.get_options(
      [](CLI::Option* option) { return !option->get_group().empty() && option->nonpositional(); });
}

std::vector<CLI::Option*> arguments_of(CLI::App& app) {
  return app.get_options(
      [](CLI::Option* option) { return !option->get_group().empty() && option->get_positional(); });
}

std::string path_of(const CLI::App& app) {
  if (app.get_parent() == nullptr) return {};
  const auto above = path_of(*app.get_parent());
  return above.empty() ? app.get_name() : above + " " + app.get_name();
}

std::string name_of(const CLI::Option& option) {
  return option.nonpositional() ? option.get_name() : option.get_name(true);
}

std::string type_of(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return {};
  const auto type = option.get_type_name();
  // What validators say of themselves stands behind a colon.
  return type.substr(0, type.find(':'));
}

bool is_repeatable(const CLI::Option& option) { return option.get_items_expected_max() > 1; }

std::vector<std::string> closed_set_of(CLI::Option& option) {
  // The library tells a set in its description, which the help leaves out, and in the complaint about a word.
  for (int i = 0;; ++i) {
    const CLI::Validator* validator = nullptr;
    try {
      validator = option.get_validator(i);
    } catch (const CLI::OptionNotFound&) {
      return {};
    }
    for (const std::string word : {"?", "-1"}) {
      if (const auto found = set_in(complaint_about(*validator, word), word)) return *found;
    }
  }
}

}  // namespace conform::usage
