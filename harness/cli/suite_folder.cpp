// SPDX-License-Identifier: Apache-2.0
#include "cli/suite_folder.hpp"

#include <cstdlib>
#include <filesystem>

#include "base/files.hpp"
#include "base/text.hpp"
#include "scenario/files.hpp"
#include "yaml/loader.hpp"

namespace conform::cli {
namespace fs = std::filesystem;

Result<std::string> find_suites(const std::string& given) {
  std::error_code error;
  const auto usable = [&error](const fs::path& path) {
    return fs::is_directory(path / "requirements", error);
  };
  if (!given.empty()) {
    if (usable(given)) return given;
    return fail("no suites there (a folder with requirements/ in it)", given);
  }
  if (const char* environment = std::getenv("CANOPEN_CONFORM_SUITES");
      environment != nullptr && *environment != '\0') {
    if (usable(environment)) return std::string(environment);
    return fail("no suites there (a folder with requirements/ in it)", environment,
                "CANOPEN_CONFORM_SUITES names it");
  }
  const auto program = fs::read_symlink("/proc/self/exe", error);
  const auto installed = program.parent_path().parent_path() / "share" / "canopen-conform" / "suites";
  if (usable(installed)) return installed.string();
  for (auto folder = program.parent_path(); folder.has_relative_path(); folder = folder.parent_path()) {
    if (usable(folder / "suites")) return (folder / "suites").string();
  }
  return fail("the suites were not found", {}, "name them with --suites FOLDER or CANOPEN_CONFORM_SUITES");
}

Result<LoadedSuites> load_suites(const std::string& root, bool colour) {
  LoadedSuites out;
  out.root = root;
  std::vector<std::string> problems;
  auto catalogue = scenario::Catalogue::load(root, problems, colour);
  if (!catalogue) return std::unexpected(catalogue.error());
  out.catalogue = std::move(*catalogue);
  auto files = scenario::scenario_files(root);
  if (!files) return std::unexpected(files.error());
  auto suite = scenario::load_suite(root, *files, out.catalogue, colour);
  if (!suite) return std::unexpected(suite.error());
  out.suite = std::move(*suite);
  problems.insert(problems.end(), out.suite.problems.begin(), out.suite.problems.end());
  if (out.suite.errors > 0 || !problems.empty())
    return fail("the suites have mistakes:\n" + join(problems, "\n"), root);
  return out;
}

std::string suite_digest(const std::string& root) {
  std::uint64_t digest = 0xCBF29CE484222325ULL;
  const auto mix = [&digest](std::string_view text) {
    for (const char c : text) digest = (digest ^ static_cast<std::uint8_t>(c)) * 0x100000001B3ULL;
  };
  auto files = scenario::yaml_files_below(root, "");
  if (!files) return "unknown";
  for (const auto& file : *files) {
    mix(file);
    if (auto text = read_file(root + "/" + file, yaml::max_file_size)) mix(*text);
  }
  static constexpr char digits[] = "0123456789abcdef";
  std::string out(16, '0');
  for (std::size_t i = 16; i-- > 0; digest >>= 4U) out[i] = digits[digest & 0xFU];
  return out;
}

}  // namespace conform::cli
