// SPDX-License-Identifier: Apache-2.0
#include "cli/descriptions/eds_target.hpp"

#include <filesystem>

#include "base/text.hpp"

namespace conform::cli {

std::optional<eds::Format> target_format(const std::string& word, const std::string& path) {
  auto name = lower(word);
  if (name.empty()) name = lower(std::filesystem::path(path).extension().string());
  if (name.starts_with('.')) name.erase(0, 1);
  for (const auto format : {eds::Format::eds, eds::Format::dcf, eds::Format::xdd, eds::Format::xdc}) {
    if (lower(to_string(format)) == name) return format;
  }
  return std::nullopt;
}

std::string file_name_for(const std::string& out, const std::string& in, eds::Format format) {
  if (out != "-") return printable(std::filesystem::path(out).filename().string());
  auto name = std::filesystem::path(in).filename();
  name.replace_extension(lower(to_string(format)));
  return printable(name.string());
}

}  // namespace conform::cli
