// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "base/text.hpp"
#include "usage/manual.hpp"
#include "usage/model.hpp"
#include "usage/roff.hpp"

namespace conform::usage {
namespace {

/// "canopen-conform-eds-lint"
std::string page_name(const Manual& manual, const CLI::App& command) {
  auto name = manual.program;
  const auto path = path_of(command);
  for (const auto word : split(path, ' '))
    if (!word.empty()) name += fmt::format("-{}", word);
  return name;
}

std::string reference(const std::string& name) { return roff_bold(name) + "(1)"; }

std::string sentence(std::string_view text) {
  auto out = roff_text(text);
  if (!out.ends_with('.')) out += '.';
  return out + "\n";
}

std::string entry(const std::string& term, const std::string& body) { return ".TP\n" + term + "\n" + body; }

std::string section(std::string_view title, const std::string& body) {
  return body.empty() ? "" : fmt::format(".SH {}\n{}", title, body);
}

std::string name_section(const Manual& manual, const CLI::App& command) {
  auto what = command.get_parent() == nullptr ? manual.summary : command.get_description();
  // "Run the suite", but not "EDS".
  if (what.size() > 1 && std::islower(static_cast<unsigned char>(what[1])) != 0)
    what[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(what[0])));
  return section("NAME", roff_literal(page_name(manual, command)) + " \\- " + roff_text(what) + "\n");
}

std::string typed_command(const Manual& manual, const CLI::App& command) {
  const auto path = path_of(command);
  return path.empty() ? manual.program : manual.program + " " + path;
}

std::string synopsis(const Manual& manual, CLI::App& command) {
  auto out = roff_bold(typed_command(manual, command));
  if (!commands_of(command).empty()) out += " " + roff_italic("command");
  out += " [" + roff_italic("option") + " ...]";
  for (const auto* argument : arguments_of(command)) {
    const auto name = roff_italic(type_of(*argument)) + (is_repeatable(*argument) ? " ..." : "");
    out += argument->get_required() ? " " + name : " [" + name + "]";
  }
  return section("SYNOPSIS", out + "\n");
}

std::string description(const Manual& manual, const CLI::App& command) {
  std::string out;
  if (command.get_parent() != nullptr) out += sentence(command.get_description());
  if (const auto* page = page_of(manual, command); page != nullptr) {
    for (const auto paragraph : page->about) out += (out.empty() ? "" : ".PP\n") + sentence(paragraph);
  }
  return section("DESCRIPTION", out);
}

std::string commands(const Manual& manual, CLI::App& command) {
  std::string out;
  for (const auto* sub : commands_of(command))
    out += entry(reference(page_name(manual, *sub)), sentence(sub->get_description()));
  return section("COMMANDS", out);
}

/// "-i, --interface NAME"
std::string names_of(const CLI::Option& option) {
  std::string out;
  const auto add = [&out](const std::string& name) { out += (out.empty() ? "" : ", ") + roff_bold(name); };
  for (const auto& name : option.get_snames()) add("-" + name);
  for (const auto& name : option.get_lnames()) add("--" + name);
  const auto type = type_of(option);
  if (type.empty()) return out;
  return out.empty() ? roff_italic(type) : out + " " + roff_italic(type);
}

/// In the order of their names: a set of pointers has another one each time.
std::string listed(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const auto* each : options) names.push_back(roff_bold(name_of(*each)));
  std::ranges::sort(names);
  return join(names, ", ");
}

std::string options(CLI::App& command) {
  std::string out;
  const auto add = [&out](const CLI::Option& option) {
    auto body = sentence(option.get_description());
    if (const auto needs = option.get_needs(); !needs.empty()) body += "It needs " + listed(needs) + ".\n";
    if (const auto others = option.get_excludes(); !others.empty())
      body += "It excludes " + listed(others) + ".\n";
    out += entry(names_of(option), body);
  };
  for (const auto* argument : arguments_of(command)) add(*argument);
  for (const auto* option : options_of(command)) {
    if (!option->get_positional()) add(*option);
  }
  return section("OPTIONS", out);
}

std::string entries(std::string_view title, const std::vector<Entry>& all, bool italic = false) {
  std::string out;
  for (const auto& each : all)
    out += entry(italic ? roff_italic(each.term) : roff_bold(each.term), sentence(each.meaning));
  return section(title, out);
}

std::string examples(const CommandPage* page) {
  std::string out;
  if (page == nullptr) return out;
  for (const auto& each : page->examples) out += entry(roff_bold(each.line), sentence(each.does));
  return section("EXAMPLES", out);
}

std::string see_also(const Manual& manual, CLI::App& command) {
  std::vector<std::string> all;
  for (const auto* above = command.get_parent(); above != nullptr; above = above->get_parent())
    all.push_back(reference(page_name(manual, *above)));
  for (const auto* sub : commands_of(command)) all.push_back(reference(page_name(manual, *sub)));
  if (command.get_parent() == nullptr) {
    for (const auto& other : manual.see_also) all.push_back(reference(other));
  }
  return section("SEE ALSO", join(all, ",\n") + "\n.PP\nThe documentation is in\n" +
                                 roff_italic("/usr/share/doc/canopen-conform") + ".\n");
}

void add_pages(CLI::App& command, const Manual& manual, const std::string& margins,
               std::vector<ManPage>& pages) {
  const auto name = page_name(manual, command);
  std::string title = name;
  for (char& c : title) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  const auto* page = page_of(manual, command);
  auto text =
      fmt::format(".\\\" Made by {} from its own options.\n.TH {} 1 {}\n", manual.program, title, margins);
  text += name_section(manual, command) + synopsis(manual, command) + description(manual, command);
  text += commands(manual, command) + options(command);
  if (page != nullptr) text += entries("EXIT STATUS", page->exits);
  if (manual.environment) text += entries("ENVIRONMENT", manual.environment(command));
  if (command.get_parent() == nullptr) text += entries("FILES", manual.files, true);
  text += examples(page) + see_also(manual, command);
  pages.push_back({name + ".1", std::move(text)});
  for (auto* sub : commands_of(command)) add_pages(*sub, manual, margins, pages);
}

}  // namespace

std::vector<ManPage> man_pages(CLI::App& app, const Manual& manual, std::string_view date,
                               std::string_view version) {
  std::vector<ManPage> pages;
  const auto margins = fmt::format("\"{}\" \"canopen-conform {}\" \"User commands\"", date, version);
  add_pages(app, manual, margins, pages);
  return pages;
}

}  // namespace conform::usage
