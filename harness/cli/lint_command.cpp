// SPDX-License-Identifier: Apache-2.0
// `lint`: every mistake in scenario, requirement and profile files, without a bus.
#include <fmt/format.h>

#include <algorithm>

#include "cli/commands.hpp"
#include "cli/suite_folder.hpp"
#include "cli/terminal.hpp"
#include "device/profile.hpp"
#include "scenario/files.hpp"
#include "yaml/loader.hpp"

namespace conform::cli {
namespace {

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

}  // namespace

int lint_command(const LintCommand& options) {
  auto root = find_suites(options.suites);
  if (!root) return report_error(root.error(), exit_usage);
  const bool colour = use_colour(options.color, 1);
  Totals totals;
  std::vector<std::string> problems;
  auto catalogue = scenario::Catalogue::load(*root, problems, colour);
  if (!catalogue) return report_error(catalogue.error(), exit_usage);
  auto files = options.files;
  if (files.empty()) {
    auto found = scenario::yaml_files_below(*root, "");
    if (!found) return report_error(found.error(), exit_usage);
    for (const auto& file : *found) files.push_back(*root + "/" + file);
    for (const auto& problem : problems) print(problem);
    totals.errors += problems.size();
  }
  for (const auto& file : files) {
    if (options.files.empty() && file.find("/requirements/") != std::string::npos) {
      ++totals.files;
      continue;  // read above, as the catalogue
    }
    auto document = yaml::load_file(file);
    if (!document) return report_error(document.error(), exit_usage);
    ++totals.files;
    if (document->root) {
      const auto& node = *document->root;
      // The kinds of file tell themselves apart by the list they hold.
      if (node.find("requirements") != nullptr) {
        // The catalogue loader reads whole folders; a single file is checked for its YAML here.
      } else if (node.find("scenarios") != nullptr || node.find("claims") == nullptr) {
        auto name = file;
        if (name.starts_with(*root + "/")) name = name.substr(root->size() + 1);
        (void)scenario::load_scenarios(node, document->diagnostics, name, *catalogue);
      } else {
        (void)device::load_profile(node, document->diagnostics);
      }
    }
    show(document->diagnostics, colour, totals);
  }
  print(fmt::format("{} files, {} errors, {} warnings\n", totals.files, totals.errors, totals.warnings));
  return totals.errors == 0 ? 0 : exit_usage;
}

}  // namespace conform::cli
