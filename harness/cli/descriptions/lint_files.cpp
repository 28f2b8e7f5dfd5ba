// SPDX-License-Identifier: Apache-2.0
#include "cli/descriptions/lint_files.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <string_view>

#include "base/text.hpp"

namespace conform::cli {
namespace {

namespace fs = std::filesystem;

bool is_description(const fs::path& path) {
  constexpr std::array<std::string_view, 4> endings = {".eds", ".dcf", ".xdd", ".xdc"};
  return std::ranges::find(endings, lower(path.extension().string())) != endings.end();
}

Result<std::vector<std::string>> in_folder(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> out;
  // Links to folders are not followed: they may lead in a circle.
  auto entry = fs::recursive_directory_iterator(folder, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    const auto& path = entry->path();
    std::error_code ignored;
    if (path.filename().string().starts_with('.')) {
      if (entry->is_directory(ignored)) entry.disable_recursion_pending();
      continue;
    }
    if (is_description(path) && entry->is_regular_file(ignored)) out.push_back(path.string());
  }
  if (error) return fail(error.message(), folder);
  if (out.empty())
    return fail("there is no device description in the folder", folder,
                "*.eds, *.dcf, *.xdd and *.xdc are looked for");
  std::ranges::sort(out);
  return out;
}

}  // namespace

Result<std::vector<std::string>> description_files(const std::vector<std::string>& named) {
  std::vector<std::string> out;
  std::set<std::string> known;
  const auto add = [&](const std::string& file) {
    if (known.insert(fs::path(file).lexically_normal().string()).second) out.push_back(file);
  };
  for (const auto& name : named) {
    std::error_code ignored;
    if (!fs::is_directory(name, ignored)) {
      add(name);
      continue;
    }
    const auto files = in_folder(name);
    if (!files) return std::unexpected(files.error());
    for (const auto& file : *files) add(file);
  }
  return out;
}

}  // namespace conform::cli
