// SPDX-License-Identifier: Apache-2.0
// `lint`: every mistake in scenario, requirement and profile files, without a bus.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cli/commands/commands.hpp"
#include "cli/run/terminal.hpp"
#include "cli/suite_folder.hpp"
#include "device/profile.hpp"
#include "scenario/files.hpp"
#include "yaml/loader.hpp"

namespace conform::cli {
namespace {

namespace fs = std::filesystem;

struct Totals {
  std::size_t files = 0, errors = 0, warnings = 0;
};

void show(const yaml::Diagnostics& diagnostics, bool colour, Totals& totals) {
  totals.errors += diagnostics.error_count();
  for (const auto& each : diagnostics.sorted()) {
    if (each.severity == yaml::Diagnostic::Severity::warning) ++totals.warnings;
  }
  if (!diagnostics.empty()) print(diagnostics.render(colour));
}

std::string counted(std::size_t count, std::string_view word) {
  return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
}

bool same_file(const std::string& one, const std::string& other) {
  std::error_code error;
  return fs::equivalent(one, other, error);
}

/// The path of a file below the innermost of the folders that it is in, however the user wrote it; else
/// empty.
std::string name_in_suites(const std::string& file, const SuiteFolders& folders) {
  std::error_code error;
  const auto whole = fs::weakly_canonical(file, error);
  std::string out;
  std::size_t deepest = 0;
  auto all = folders.own;
  all.push_back(folders.root);
  for (const auto& folder : all) {
    const auto top = fs::weakly_canonical(folder, error);
    const auto name = whole.lexically_relative(top).generic_string();
    if (name.empty() || name.starts_with("..") || top.native().size() <= deepest) continue;
    deepest = top.native().size();
    out = name;
  }
  return out;
}

/// The innermost folder `suites` above a file: what it holds belongs together. Empty: none.
std::string suites_above(const std::string& file) {
  for (auto folder = fs::path(file).parent_path(); folder.has_filename(); folder = folder.parent_path()) {
    if (folder.filename() == "suites") return folder.generic_string();
  }
  std::error_code error;
  if (const auto whole = fs::absolute(file, error); !error && whole != file) return suites_above(whole);
  return {};
}

/// What the user named: folders are replaced by the files in them.
struct Named {
  std::vector<std::string> files;
  std::vector<std::string> suites;  ///< those that the files belong to
};

Result<Named> look_into(const std::vector<std::string>& paths) {
  Named out;
  std::error_code error;
  for (const auto& path : paths) {
    if (!fs::is_directory(path, error)) {
      out.files.push_back(path);
      continue;
    }
    auto found = scenario::yaml_files_below(path, "");
    if (!found) return std::unexpected(found.error());
    if (found->empty()) return fail("no scenario, requirement or profile is there", path);
    for (const auto& file : *found) out.files.push_back((fs::path(path) / file).generic_string());
    if (!fs::is_directory(fs::path(path) / "suites", error) && suites_above(out.files.back()).empty())
      out.suites.push_back(path);
  }
  for (const auto& file : out.files) {
    const auto suites = suites_above(file);
    if (!suites.empty() && std::ranges::find(out.suites, suites) == out.suites.end())
      out.suites.push_back(suites);
  }
  return out;
}

/// What a file is held against.
struct Known {
  SuiteFolders folders;
  scenario::Catalogue catalogue;
};

/// Ids of this file that another file of the catalogue gives as well.
void compare_with_catalogue(const std::vector<scenario::Requirement>& requirements, const std::string& file,
                            const scenario::Catalogue& catalogue, yaml::Diagnostics& diagnostics) {
  for (const auto& requirement : requirements) {
    std::vector<std::string> ids = requirement.same_as;
    ids.push_back(requirement.id);
    for (const auto& id : ids) {
      const auto* other = catalogue.find(id);
      if (other == nullptr || same_file(other->path, file)) continue;
      diagnostics.error({requirement.line, 1}, 1, "requirement id '" + id + "' is given twice",
                        "also in " + other->file + ":" + std::to_string(other->line));
    }
  }
}

void check_scenarios(const yaml::Node& root, const std::string& file, const Known& known,
                     yaml::Diagnostics& diagnostics) {
  const auto name = name_in_suites(file, known.folders);
  const auto loaded =
      scenario::load_scenarios(root, diagnostics, name.empty() ? file : name, known.catalogue);
  if (name.empty()) return;
  auto all = known.folders.own;
  all.insert(all.begin(), known.folders.root);
  for (const auto& folder : all) {
    const auto other = (fs::path(folder) / name).generic_string();
    std::error_code error;
    if (fs::exists(other, error) && !same_file(other, file))
      scenario::refuse_same_name(loaded, diagnostics, other);
  }
}

/// The kinds of file tell themselves apart by the keys only one of them has.
void check(const yaml::Node& root, const std::string& file, const Known& known,
           yaml::Diagnostics& diagnostics) {
  const auto has = [&root](std::initializer_list<std::string_view> keys) {
    return std::ranges::any_of(keys, [&root](std::string_view key) { return root.find(key) != nullptr; });
  };
  if (has({"requirements", "area"})) {
    compare_with_catalogue(scenario::load_requirements(root, diagnostics, file), file, known.catalogue,
                           diagnostics);
  } else if (!has({"scenarios"}) &&
             has({"node", "claims", "objects", "errors", "identity", "boot_time", "interface", "name"})) {
    (void)device::load_profile(root, diagnostics);
  } else {
    check_scenarios(root, file, known, diagnostics);
  }
}

}  // namespace

int lint_command(const LintCommand& options) {
  auto named = look_into(options.files);
  if (!named) return report_error(named.error(), exit_usage);
  auto given = options.suites;
  given.insert(given.end(), named->suites.begin(), named->suites.end());
  auto found = find_suites(given);
  if (!found) return report_error(found.error(), exit_usage);
  if (options.files.empty()) {
    auto all = found->own;
    all.insert(all.begin(), found->root);
    named = look_into(all);
    if (!named) return report_error(named.error(), exit_usage);
  }
  const bool colour = use_colour(options.color, 1);
  Totals totals;
  // Mistakes of the catalogue are told where its files are checked.
  std::vector<std::string> problems;
  auto catalogue = scenario::Catalogue::load(found->root, problems, colour, found->own);
  if (!catalogue) return report_error(catalogue.error(), exit_usage);
  const Known known{std::move(*found), std::move(*catalogue)};
  for (const auto& file : named->files) {
    auto document = yaml::load_file(file);
    if (!document) return report_error(document.error(), exit_usage);
    ++totals.files;
    if (document->root) check(*document->root, file, known, document->diagnostics);
    show(document->diagnostics, colour, totals);
  }
  print(fmt::format("{}, {}, {}\n", counted(totals.files, "file"), counted(totals.errors, "error"),
                    counted(totals.warnings, "warning")));
  return totals.errors == 0 ? 0 : exit_usage;
}

}  // namespace conform::cli
