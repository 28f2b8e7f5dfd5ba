// SPDX-License-Identifier: Apache-2.0
// `lint`: every mistake in scenario, requirement and profile files, without a bus.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cli/commands.hpp"
#include "cli/suite_folder.hpp"
#include "cli/terminal.hpp"
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

/// The name by which the suites know a file, however the user wrote its path.
std::string name_in_suites(const std::string& file, const std::string& root) {
  std::error_code error;
  const auto whole = fs::weakly_canonical(file, error);
  const auto top = fs::weakly_canonical(root, error);
  const auto relative = whole.lexically_relative(top).generic_string();
  return relative.empty() || relative.starts_with("..") ? file : relative;
}

/// Ids of this file that another file of the catalogue gives as well.
void compare_with_catalogue(const std::vector<scenario::Requirement>& requirements, const std::string& name,
                            const scenario::Catalogue& catalogue, yaml::Diagnostics& diagnostics) {
  for (const auto& requirement : requirements) {
    std::vector<std::string> ids = requirement.same_as;
    ids.push_back(requirement.id);
    for (const auto& id : ids) {
      const auto* other = catalogue.find(id);
      if (other == nullptr || other->file == name) continue;
      diagnostics.error({requirement.line, 1}, 1, "requirement id '" + id + "' is given twice",
                        "also in " + other->file + ":" + std::to_string(other->line));
    }
  }
}

/// The kinds of file tell themselves apart by the keys only one of them has.
void check(const yaml::Node& root, const std::string& name, const scenario::Catalogue& catalogue,
           yaml::Diagnostics& diagnostics) {
  const auto has = [&root](std::initializer_list<std::string_view> keys) {
    return std::ranges::any_of(keys, [&root](std::string_view key) { return root.find(key) != nullptr; });
  };
  if (has({"requirements", "area"})) {
    compare_with_catalogue(scenario::load_requirements(root, diagnostics, name), name, catalogue,
                           diagnostics);
  } else if (!has({"scenarios"}) &&
             has({"node", "claims", "objects", "errors", "identity", "boot_time", "interface", "name"})) {
    (void)device::load_profile(root, diagnostics);
  } else {
    (void)scenario::load_scenarios(root, diagnostics, name, catalogue);
  }
}

}  // namespace

int lint_command(const LintCommand& options) {
  auto root = find_suites(options.suites);
  if (!root) return report_error(root.error(), exit_usage);
  const bool colour = use_colour(options.color, 1);
  Totals totals;
  // Mistakes of the catalogue are told where its files are checked.
  std::vector<std::string> problems;
  auto catalogue = scenario::Catalogue::load(*root, problems, colour);
  if (!catalogue) return report_error(catalogue.error(), exit_usage);
  auto files = options.files;
  if (files.empty()) {
    auto found = scenario::yaml_files_below(*root, "");
    if (!found) return report_error(found.error(), exit_usage);
    for (const auto& file : *found) files.push_back(*root + "/" + file);
  }
  for (const auto& file : files) {
    auto document = yaml::load_file(file);
    if (!document) return report_error(document.error(), exit_usage);
    ++totals.files;
    if (document->root)
      check(*document->root, name_in_suites(file, *root), *catalogue, document->diagnostics);
    show(document->diagnostics, colour, totals);
  }
  print(fmt::format("{}, {}, {}\n", counted(totals.files, "file"), counted(totals.errors, "error"),
                    counted(totals.warnings, "warning")));
  return totals.errors == 0 ? 0 : exit_usage;
}

}  // namespace conform::cli
