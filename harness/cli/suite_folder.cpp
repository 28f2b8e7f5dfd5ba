// SPDX-License-Identifier: Apache-2.0
#include "cli/suite_folder.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "base/files.hpp"
#include "base/fnv1a.hpp"
#include "base/text.hpp"
#include "result/pattern_file.hpp"
#include "scenario/files.hpp"
#include "yaml/loader.hpp"

namespace conform::cli {
namespace fs = std::filesystem;

namespace {

bool has_folder(const std::string& path, const char* name) {
  std::error_code error;
  return fs::is_directory(fs::path(path) / name, error);
}

/// A set that can stand in for the program's, as a checkout or a changed copy does.
bool is_whole(const std::string& path) {
  return has_folder(path, "requirements/cia301") && has_folder(path, "devices");
}

Result<std::string> suites_of_program() {
  if (const char* environment = std::getenv("CANOPEN_CONFORM_SUITES");
      environment != nullptr && *environment != '\0') {
    if (has_folder(environment, "requirements")) return std::string(environment);
    return fail("no suites there (a folder with requirements/ in it)", environment,
                "CANOPEN_CONFORM_SUITES names it");
  }
  std::error_code error;
  const auto program = fs::read_symlink("/proc/self/exe", error);
  const auto installed = program.parent_path().parent_path() / "share" / "canopen-conform" / "suites";
  if (has_folder(installed, "requirements")) return installed.string();
  for (auto folder = program.parent_path(); folder.has_relative_path(); folder = folder.parent_path()) {
    if (has_folder(folder / "suites", "requirements")) return (folder / "suites").string();
  }
  return fail("the suites were not found", {}, "name them with --suites FOLDER or CANOPEN_CONFORM_SUITES");
}

}  // namespace

Result<SuiteFolders> find_suites(const std::vector<std::string>& given, const std::string& profile) {
  SuiteFolders out;
  std::error_code error;
  const auto same = [&error](const std::string& one) {
    return [&one, &error](const std::string& other) { return fs::equivalent(one, other, error); };
  };
  for (const auto& folder : given) {
    if (!fs::is_directory(folder, error))
      return fail("no such folder", folder, "--suites names folders of scenarios");
    if (!is_whole(folder)) continue;
    if (!out.root.empty() && !same(folder)(out.root))
      return fail("two whole sets of suites are named", folder, "the other is " + out.root);
    out.root = folder;
  }
  if (out.root.empty()) {
    auto program = suites_of_program();
    if (!program) return std::unexpected(program.error());
    out.root = *program;
  }
  const auto add = [&](const std::string& folder) {
    if (!same(folder)(out.root) && std::ranges::none_of(out.own, same(folder))) out.own.push_back(folder);
  };
  for (const auto& folder : given) {
    if (is_whole(folder)) continue;
    if (!has_folder(folder, "requirements") && has_folder(folder, "suites"))
      return fail("no suites there, but in the folder below", folder,
                  "--suites " + (fs::path(folder) / "suites").generic_string());
    const auto files = scenario::yaml_files_below(folder, "");
    if (!files) return std::unexpected(files.error());
    if (files->empty()) return fail("no scenario and no requirement is there", folder);
    add(folder);
  }
  const auto beside = (fs::path(profile).parent_path() / "suites").string();
  if (!profile.empty() && fs::is_directory(beside, error) && !is_whole(beside)) add(beside);
  return out;
}

Result<std::string> find_suites(const std::string& given) {
  auto found = find_suites(given.empty() ? std::vector<std::string>{} : std::vector{given});
  if (!found) return std::unexpected(found.error());
  return found->root;
}

Result<LoadedSuites> load_suites(const SuiteFolders& folders, bool colour) {
  LoadedSuites out;
  std::vector<std::string> problems;
  auto catalogue = scenario::Catalogue::load(folders.root, problems, colour, folders.own);
  if (!catalogue) return std::unexpected(catalogue.error());
  out.catalogue = std::move(*catalogue);
  auto all = folders.own;
  all.insert(all.begin(), folders.root);
  for (const auto& folder : all) {
    auto files = scenario::scenario_files(folder);
    if (!files) return std::unexpected(files.error());
    const auto shown = &folder == &all.front() ? std::string(shown_root) : folder;
    if (auto added = scenario::add_to_suite(out.suite, {folder, shown}, *files, out.catalogue, colour);
        !added)
      return std::unexpected(added.error());
  }
  problems.insert(problems.end(), out.suite.problems.begin(), out.suite.problems.end());
  if (out.suite.errors > 0 || !problems.empty())
    return fail("the suites have mistakes:\n" + join(problems, "\n"), join(all, ", "));
  return out;
}

Result<std::vector<result::Pattern>> load_patterns(const std::string& root) {
  constexpr std::uint64_t largest = std::uint64_t{16} << 20U;
  const auto path = root + "/patterns/reference-node.json";
  std::error_code error;
  if (!fs::exists(path, error)) return std::vector<result::Pattern>{};
  const auto text = read_file(path, largest);
  if (!text) return std::unexpected(text.error());
  return result::read_patterns(*text, path);
}

Result<result::Worths> load_worths(const std::string& root) {
  constexpr std::uint64_t largest = std::uint64_t{16} << 20U;
  const auto path = root + "/patterns/worth.json";
  std::error_code error;
  if (!fs::exists(path, error)) return result::Worths{};
  const auto text = read_file(path, largest);
  if (!text) return std::unexpected(text.error());
  return result::read_worths(*text, path);
}

void name_known_mistakes(result::RunResult& run, const std::string& root) {
  // What a run found is told in any case.
  if (const auto patterns = load_patterns(root)) run.likenesses = result::likenesses_of(run, *patterns);
}

namespace {

std::string digest_of(const std::string& folder) {
  auto digest = fnv1a_of_nothing;
  const auto mix = [&digest](std::string_view text) { digest = fnv1a(text, digest); };
  auto files = scenario::yaml_files_below(folder, "");
  if (!files) return "unknown";
  for (const auto& file : *files) {
    mix(file);
    if (auto text = read_file(folder + "/" + file, yaml::max_file_size)) mix(*text);
  }
  static constexpr char digits[] = "0123456789abcdef";
  std::string out(16, '0');
  for (std::size_t i = 16; i-- > 0; digest >>= 4U) out[i] = digits[digest & 0xFU];
  return out;
}

}  // namespace

std::vector<result::Property> suite_properties(const SuiteFolders& folders) {
  std::vector<result::Property> out{{"suite.digest", digest_of(folders.root)}};
  for (const auto& folder : folders.own) out.push_back({"suite.own", folder + " " + digest_of(folder)});
  return out;
}

}  // namespace conform::cli
