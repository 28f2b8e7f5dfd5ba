// SPDX-License-Identifier: Apache-2.0
#include "usage/complete.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "base/text.hpp"
#include "usage/model.hpp"

namespace conform::usage {
namespace {

/// Names of values in the help that are files.
constexpr std::array<std::string_view, 13> file_types{"FILE",    "RESULT",     "JOURNAL", "CAPTURE", "PAGE",
                                                      "KEY.pem", "PUBLIC.pem", "OLD",     "NEW",     "IN",
                                                      "OUT",     "BEFORE",     "AFTER"};

Completion::Kind kind_of(const CLI::Option& option) {
  const auto type = type_of(option);
  for (const auto part : split(type, '|')) {
    if (part == "FOLDER") return Completion::Kind::folders;
    if (std::ranges::find(file_types, part) != file_types.end()) return Completion::Kind::files;
  }
  return Completion::Kind::words;
}

/// Whether an option takes all that follows up to the next one.
bool takes_the_rest(const CLI::Option& option) {
  return is_repeatable(option) && option.get_allow_extra_args();
}

/// The words before the cursor, as the parser would take them.
class Reader {
 public:
  explicit Reader(CLI::App& app) { place_.command = &app; }

  void read(const std::string& word) {
    if (pending_ != nullptr && (needs_value_ || only_arguments_ || !word.starts_with('-'))) {
      place_.given[name_of(*pending_)].push_back(word);
      needs_value_ = false;
      if (!takes_the_rest(*pending_)) pending_ = nullptr;
      return;
    }
    pending_ = nullptr;
    if (!only_arguments_ && word == "--") {
      only_arguments_ = true;
    } else if (!only_arguments_ && word.size() > 1 && word.starts_with('-')) {
      read_option(word);
    } else if (auto* const sub = arguments_ == 0 ? command_named(word) : nullptr; sub != nullptr) {
      place_ = {.command = sub, .option = nullptr, .given = {}};
    } else {
      ++arguments_;
    }
  }

  [[nodiscard]] const Place& place() const { return place_; }
  /// The option whose value is next; nullptr: none has to be.
  [[nodiscard]] CLI::Option* pending() const { return pending_; }
  [[nodiscard]] bool needs_value() const { return needs_value_; }
  [[nodiscard]] bool only_arguments() const { return only_arguments_; }
  [[nodiscard]] std::size_t arguments() const { return arguments_; }

 private:
  void read_option(const std::string& word) {
    const bool is_long = word.starts_with("--");
    const auto equals = is_long ? word.find('=') : std::string::npos;
    const auto name = is_long ? word.substr(0, equals) : word.substr(0, 2);
    auto* const option = place_.command->get_option_no_throw(name);
    if (option == nullptr) return;
    auto& given = place_.given[name_of(*option)];
    if (equals != std::string::npos) {
      given.push_back(word.substr(equals + 1));
      return;
    }
    if (type_of(*option).empty()) {
      // "-qv": two flags.
      if (!is_long && word.size() > 2) read_option("-" + word.substr(2));
      return;
    }
    if (!is_long && word.size() > 2) {
      given.push_back(word.substr(2));
      return;
    }
    pending_ = option;
    needs_value_ = true;
  }

  [[nodiscard]] CLI::App* command_named(const std::string& word) const {
    const auto all = commands_of(*place_.command);
    const auto found = std::ranges::find(all, word, [](const CLI::App* sub) { return sub->get_name(); });
    return found == all.end() ? nullptr : *found;
  }

  Place place_;
  CLI::Option* pending_ = nullptr;
  bool needs_value_ = false;
  bool only_arguments_ = false;
  std::size_t arguments_ = 0;
};

/// Those that begin with `current`; where many have a slash behind it only the part up to there.
std::vector<Candidate> by_parts(const std::vector<Candidate>& all, std::string current) {
  for (;;) {
    std::vector<Candidate> out;
    std::set<std::string> seen;
    for (const auto& each : all) {
      if (!each.word.starts_with(current)) continue;
      const auto slash = each.word.find('/', current.size());
      // Nothing but the folder itself is in the folder that has been typed.
      const bool whole = slash == std::string::npos;
      auto word = whole ? each.word : each.word.substr(0, slash + 1);
      if (seen.insert(word).second) out.push_back({std::move(word), whole ? each.about : ""});
    }
    // A folder alone is no choice: what is in it is one.
    if (out.size() != 1 || !out.front().word.ends_with('/') || out.front().word == current) return out;
    current = out.front().word;
  }
}

Completion values_at(Place place, CLI::Option& option, const std::string& current, const Values& values) {
  Completion out;
  for (auto& word : closed_set_of(option))
    if (word.starts_with(current)) out.words.push_back({std::move(word), ""});
  if (!out.words.empty()) return out;
  place.option = &option;
  if (const auto known = values(place)) {
    out.words = by_parts(*known, current);
  } else {
    out.kind = kind_of(option);
  }
  return out;
}

/// Options that can still be given: not those that are there or that are excluded by one.
std::vector<Candidate> options_at(const Place& place, const std::string& current) {
  std::set<const CLI::Option*> excluded;
  for (const auto& [name, unused] : place.given) {
    const auto* const option = place.command->get_option_no_throw(name);
    if (option == nullptr) continue;
    if (!is_repeatable(*option)) excluded.insert(option);
    for (const auto* other : option->get_excludes()) excluded.insert(other);
  }
  std::vector<Candidate> out;
  for (const auto* option : options_of(*place.command)) {
    if (excluded.contains(option)) continue;
    for (const auto& name : option->get_lnames()) {
      if (("--" + name).starts_with(current)) out.push_back({"--" + name, option->get_description()});
    }
  }
  return out;
}

}  // namespace

Completion complete(CLI::App& app, std::span<const std::string> before, const std::string& current,
                    const Values& values) {
  Reader reader(app);
  for (const auto& word : before) reader.read(word);
  const auto& place = reader.place();
  const bool is_option = !reader.only_arguments() && current.starts_with('-');
  if (reader.needs_value() || (reader.pending() != nullptr && !is_option))
    return values_at(place, *reader.pending(), current, values);
  if (is_option) {
    const auto equals = current.find('=');
    if (equals == std::string::npos || !current.starts_with("--"))
      return {.words = options_at(place, current)};
    auto* const option = place.command->get_option_no_throw(current.substr(0, equals));
    if (option == nullptr || type_of(*option).empty()) return {};
    auto out = values_at(place, *option, current.substr(equals + 1), values);
    for (auto& each : out.words) each.word.insert(0, current, 0, equals + 1);
    return out;
  }
  Completion out;
  if (reader.arguments() == 0) {
    for (const auto* sub : commands_of(*place.command))
      if (sub->get_name().starts_with(current))
        out.words.push_back({sub->get_name(), sub->get_description()});
  }
  const auto arguments = arguments_of(*place.command);
  if (!arguments.empty() && (reader.arguments() < arguments.size() || is_repeatable(*arguments.back()))) {
    const auto at = std::min(reader.arguments(), arguments.size() - 1);
    auto more = values_at(place, *arguments[at], current, values);
    out.kind = more.kind;
    out.words.insert(out.words.end(), more.words.begin(), more.words.end());
  }
  // Where nothing else can stand, what can is shown without a dash to be typed first.
  if (out.words.empty() && out.kind == Completion::Kind::words && current.empty())
    out.words = options_at(place, current);
  return out;
}

}  // namespace conform::usage
