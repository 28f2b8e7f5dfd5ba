// SPDX-License-Identifier: Apache-2.0
#include "cli/run/settings.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/shell_word.hpp"
#include "base/text.hpp"
#include "cli/commands/run_options.hpp"
#include "device/profile.hpp"
#include "device/run_settings.hpp"
#include "yaml/loader.hpp"

namespace conform::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view by_line = "command line";
constexpr std::string_view by_default = "default";

/// Of two options that exclude each other the one that comes from nearer counts.
constexpr std::pair<std::string_view, std::string_view> exclusive[] = {{"interface", "simulate"},
                                                                       {"cct", "shuffle"}};

struct DefaultWord {
  std::string_view option, word;
};
constexpr DefaultWord defaults[] = {
    {"select", "all"},
    {"allow", "read-only on a real interface, motion on a virtual one"},
    {"waivers", "waivers.yaml beside the device profile"},
    {"journal", "in ~/.local/state/canopen-conform"},
    {"repeat", "1"},
    {"seed", "1"},
    {"color", "auto"},
};

std::string name_of(const CLI::Option& option) {
  return option.get_lnames().empty() ? option.get_name() : option.get_lnames().front();
}

bool is_list(const CLI::Option& option) { return option.get_items_expected_max() > 1; }

class Merger {
 public:
  Merger(std::span<char* const> arguments, const Environment& environment)
      : arguments_(arguments.begin(), arguments.end()), environment_(environment) {
    options_.add_to(app_);
    // What belongs together may come from different places; the parser looks at all of it later.
    for (auto* option : app_.get_options()) {
      for (auto* other : std::set<CLI::Option*>(option->get_needs())) option->remove_needs(other);
      for (auto* other : std::set<CLI::Option*>(option->get_excludes())) option->remove_excludes(other);
    }
  }

  MergedLine merged() {
    MergedLine out;
    out.words = out.told = arguments_;
    if (arguments_.size() < 2 || arguments_[1] != "run" || !read_line()) return out;
    read_environment();
    find_profile(out);
    read_profile();
    leave_out_excluded();
    out.settings = settings_;
    insert(out.words, true);
    insert(out.told, false);
    return out;
  }

 private:
  /// False: there are mistakes, or help is wanted; the parser has the word.
  bool read_line() {
    std::vector<std::string> reversed(arguments_.rbegin(), arguments_.rend() - 2);
    try {
      app_.parse(reversed);
    } catch (const CLI::Error&) {
      return false;
    }
    for (const auto* option : app_.get_options()) {
      const auto name = name_of(*option);
      if (name == "help" || name == "show-config") continue;
      const bool given = option->count() > 0;
      settings_.push_back({name, given ? option->results() : std::vector<std::string>(),
                           std::string(given ? by_line : by_default)});
      listed_.push_back(option);
    }
    return true;
  }

  void read_environment() {
    for (std::size_t i = 0; i < settings_.size(); ++i) {
      auto& setting = settings_[i];
      if (!setting.words.empty()) continue;
      const auto variable = variable_of(setting.option);
      const char* const text = environment_(variable);
      if (text == nullptr || *text == '\0') continue;
      setting.origin = variable;
      if (!is_list(*listed_[i])) {
        setting.words.emplace_back(text);
        continue;
      }
      for (const auto word : split(text, ','))
        if (!trim(word).empty()) setting.words.emplace_back(trim(word));
    }
  }

  [[nodiscard]] Setting* find(std::string_view option) {
    const auto found = std::ranges::find(settings_, option, &Setting::option);
    return found == settings_.end() ? nullptr : &*found;
  }
  [[nodiscard]] bool is_set(std::string_view option) {
    const auto* found = find(option);
    return found != nullptr && !found->words.empty() && found->words.front() != "false";
  }

  void find_profile(MergedLine& out) {
    std::error_code ignored;
    if (is_set("device") || is_set("interface") || is_set("simulate") || is_set("eds") ||
        !fs::is_regular_file(found_profile, ignored))
      return;
    *find("device") = {"device", {found_profile}, "found in this folder"};
    out.profile_found = true;
  }

  /// A profile with mistakes says nothing here; the run tells them.
  void read_profile() {
    if (!is_set("device")) return;
    const auto path = find("device")->words.back();
    auto document = yaml::load_file(path);
    if (!document || !document->root) return;
    yaml::Diagnostics diagnostics(document->source);
    const auto profile = device::load_profile(*document->root, diagnostics);
    if (diagnostics.has_errors()) return;
    yaml::Diagnostics unused(document->source);
    std::vector<device::RunSetting> said;
    {
      yaml::Fields fields(*document->root, unused, "profile");
      said = device::read_run_settings(fields.optional("run"));
    }
    for (auto& each : said) {
      auto* const setting = find(each.key);
      if (setting == nullptr || !setting->words.empty()) continue;
      *setting = {std::string(each.key), std::move(each.words), fmt::format("{}:{}", path, each.line)};
      const auto key = std::ranges::find(device::run_keys(), each.key, &device::RunKey::key);
      if (key->kind != device::RunKey::Kind::path && key->kind != device::RunKey::Kind::paths) continue;
      for (auto& word : setting->words) word = (fs::path(path).parent_path() / word).string();
    }
    told_by_profile(profile, path);
  }

  /// What the profile has keys of its own for is only shown: the run reads it there.
  void told_by_profile(const device::Profile& profile, const std::string& path) {
    const auto show = [&](std::string_view option, const std::string& word) {
      auto* const setting = find(option);
      if (word.empty() || setting == nullptr || !setting->words.empty()) return;
      *setting = {std::string(option), {word}, path};
    };
    if (!is_set("simulate")) show("interface", profile.interface);
    show("node", std::to_string(profile.node.value()));
    show("eds", profile.eds.empty() ? "" : (fs::path(path).parent_path() / profile.eds).string());
  }

  [[nodiscard]] static int distance(const Setting& setting) {
    if (setting.origin == by_line) return 0;
    return setting.origin.starts_with("CANOPEN_CONFORM_") ? 1 : 2;
  }

  void leave_out_excluded() {
    for (const auto& [one, other] : exclusive) {
      if (!is_set(one) || !is_set(other)) continue;
      auto* const first = find(one);
      auto* const second = find(other);
      if (distance(*first) == distance(*second)) continue;
      auto* const farther = distance(*first) > distance(*second) ? first : second;
      *farther = {farther->option, {}, std::string(by_default)};
    }
  }

  /// Behind "run", so that a "--" on the command line does not make it something else.
  void insert(std::vector<std::string>& words, bool profile) const {
    std::vector<std::string> added;
    for (std::size_t i = 0; i < settings_.size(); ++i) {
      const auto& setting = settings_[i];
      const bool own_key =
          setting.option == "interface" || setting.option == "node" || setting.option == "eds";
      const bool by_environment = distance(setting) == 1;
      const bool found = setting.origin == "found in this folder";
      if (setting.words.empty() || setting.origin == by_line) continue;
      if (!by_environment && !found && (!profile || own_key)) continue;
      for (const auto& word : setting.words)
        added.push_back(listed_[i]->get_positional() ? word : "--" + setting.option + "=" + word);
    }
    words.insert(words.begin() + 2, added.begin(), added.end());
  }

  std::vector<std::string> arguments_;
  const Environment& environment_;
  RunOptions options_;
  CLI::App app_;
  std::vector<Setting> settings_;
  std::vector<const CLI::Option*> listed_;  ///< as `settings_`
};

/// As a person reads it.
std::string value_of(const Setting& setting) {
  if (setting.words.empty()) {
    const auto found = std::ranges::find(defaults, setting.option, &DefaultWord::option);
    return found == std::end(defaults) ? "-" : std::string(found->word);
  }
  std::vector<std::string> words;
  for (const auto& word : setting.words) words.push_back(shell_word(word));
  return join(words, " ");
}

}  // namespace

std::string variable_of(std::string_view option) {
  // CANOPEN_CONFORM_SUITES is where the suites of the program are.
  if (option == "suites") return "CANOPEN_CONFORM_OWN_SUITES";
  std::string out = "CANOPEN_CONFORM_";
  for (const char c : option)
    out += c == '-' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return out;
}

MergedLine merge_settings(std::span<char* const> arguments, const Environment& environment) {
  return Merger(arguments, environment).merged();
}

std::string origins_in(std::string_view message, const MergedLine& line) {
  std::string out;
  for (const auto& each : line.settings) {
    const auto at = message.find("--" + each.option);
    if (at == std::string_view::npos || each.words.empty() || each.origin == by_line) continue;
    // Not of a longer name.
    const auto end = at + 2 + each.option.size();
    if (end < message.size() &&
        (message[end] == '-' || std::isalnum(static_cast<unsigned char>(message[end]))))
      continue;
    out += fmt::format("--{} comes from {}\n", each.option, each.origin);
  }
  return out;
}

std::string config_table(const MergedLine& line) {
  std::size_t option = 0, value = 0;
  for (const auto& each : line.settings) {
    option = std::max(option, each.option.size());
    value = std::max(value, value_of(each).size());
  }
  std::string out;
  for (const auto& each : line.settings)
    out += fmt::format("{:{}}  {:{}}  {}\n", each.option, option, value_of(each), value, each.origin);
  return out;
}

}  // namespace conform::cli
