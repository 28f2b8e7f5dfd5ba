// SPDX-License-Identifier: Apache-2.0
#include "scenario/files.hpp"

#include <algorithm>
#include <filesystem>

namespace conform::scenario {
namespace fs = std::filesystem;

Result<std::vector<std::string>> yaml_files_below(const std::string& root, const std::string& folder) {
  std::error_code error;
  const fs::path top = folder.empty() ? fs::path(root) : fs::path(root) / folder;
  if (!fs::is_directory(top, error))
    return fail("no such folder", top.string(), "name the suites with --suites");
  std::vector<std::string> out;
  for (auto it = fs::recursive_directory_iterator(top, fs::directory_options::skip_permission_denied, error);
       it != fs::recursive_directory_iterator(); it.increment(error)) {
    if (error) return fail("cannot list the folder: " + error.message(), top.string());
    if (it->path().extension() == ".yaml" && it->is_regular_file(error)) {
      out.push_back(it->path().lexically_relative(root).generic_string());
    }
  }
  std::ranges::sort(out);
  return out;
}

Result<std::vector<std::string>> scenario_files(const std::string& root) {
  auto files = yaml_files_below(root, "");
  if (!files) return files;
  std::erase_if(*files, [](const std::string& file) {
    return file.starts_with("requirements/") || file.starts_with("devices/") || file.starts_with("schema/");
  });
  return files;
}

}  // namespace conform::scenario
