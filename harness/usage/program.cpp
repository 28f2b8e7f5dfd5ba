// SPDX-License-Identifier: Apache-2.0
#include "usage/program.hpp"

#include <filesystem>
#include <vector>

#include "base/files.hpp"
#include "usage/shells.hpp"

namespace conform::usage {
namespace {

namespace fs = std::filesystem;

Result<void> write_below(const std::string& folder, const std::string& name, const std::string& text) {
  const auto path = fs::path(folder) / name;
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  if (error) return fail("cannot make the folder: " + error.message(), path.parent_path().string());
  return write_file_atomically(path.string(), text);
}

Result<std::string> write_share(CLI::App& app, const Manual& manual, const std::string& folder,
                                const std::string& date, const std::string& version) {
  for (const auto& page : man_pages(app, manual, date, version)) {
    if (auto done = write_below(folder, "man/man1/" + page.name, page.text); !done)
      return std::unexpected(done.error());
  }
  for (const auto* shell : shells) {
    const auto script = completion_script(shell, manual.program);
    if (auto done = write_below(folder, completion_path(shell, manual.program), script); !done)
      return std::unexpected(done.error());
  }
  return "";
}

Result<std::string> parse_only(CLI::App& app, std::span<const std::string> words) {
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::ParseError& error) {
    return fail(error.what());
  }
  return "";
}

}  // namespace

std::optional<Result<std::string>> answer_hidden(CLI::App& app, std::span<const std::string> arguments,
                                                 const Manual& manual, const Values& values,
                                                 const std::string& version) {
  if (arguments.empty()) return std::nullopt;
  const auto& asked = arguments.front();
  const auto rest = arguments.subspan(1);
  if (asked == "__complete") return completion_answer(app, rest, values);
  if (asked == "__examples") return example_list(manual);
  if (asked == "__parse") return parse_only(app, rest);
  if (asked == "__share" && rest.size() == 2) return write_share(app, manual, rest[0], rest[1], version);
  return std::nullopt;
}

}  // namespace conform::usage
