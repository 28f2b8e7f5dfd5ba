// SPDX-License-Identifier: Apache-2.0
// `run --nodes`: several devices of one bus, one after the other.
#include <cstdio>
#include <filesystem>
#include <set>
#include <system_error>

#include <fmt/format.h>
#include <stdlib.h>

#include "base/files.hpp"
#include "cli/commands/commands.hpp"
#include "cli/run/run_source.hpp"
#include "cli/run/several.hpp"
#include "cli/run/terminal.hpp"

namespace conform::cli {
namespace {

namespace fs = std::filesystem;

/// A folder that is gone with it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::error_code error;
    auto path = (fs::temp_directory_path(error) / "canopen-conform-XXXXXX").string();
    if (!error && ::mkdtemp(path.data()) != nullptr) path_ = path;
  }
  ~TemporaryFolder() {
    std::error_code error;
    if (!path_.empty()) fs::remove_all(path_, error);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// "out/report.html" -> "out/report.node5.html"; of "run.tar.zst" both ends stay together.
std::string of_node(const std::string& path, std::uint32_t node) {
  if (path.empty()) return path;
  const fs::path whole(path);
  auto stem = whole.stem().string(), end = whole.extension().string();
  if (const fs::path inner(stem); inner.extension() == ".tar") {
    end = inner.extension().string() + end;
    stem = inner.stem().string();
  }
  return (whole.parent_path() / fmt::format("{}.node{}{}", stem, node, end)).string();
}

RunCommand for_node(const RunCommand& all, std::uint32_t node) {
  auto out = all;
  out.nodes.clear();
  out.node = node;
  for (auto& [format, path] : out.reports) path = of_node(path, node);
  for (auto* path : {&out.capture, &out.captures, &out.candump, &out.bundle, &out.journal})
    *path = of_node(*path, node);
  return out;
}

}  // namespace

int run_nodes(const RunCommand& options) {
  const std::set<std::uint32_t> unique(options.nodes.begin(), options.nodes.end());
  if (unique.size() != options.nodes.size())
    return report_error({"--nodes names a node twice", {}, {}}, exit_usage);
  if (!options.baseline.empty() || !options.choice.rerun_failed.empty())
    return report_error({"--nodes makes results of several devices, and these are of one",
                         {},
                         "run with --node for --baseline and --rerun-failed"},
                        exit_usage);
  const TemporaryFolder folder;
  if (folder.path().empty())
    return report_error({"cannot make a temporary folder", {}, "is there room, and may it be written to?"},
                        exit_environment);
  std::vector<result::NamedRun> runs;
  for (const auto node : options.nodes) {
    auto one = for_node(options, node);
    auto& json = one.reports["json"];
    if (json.empty()) json = folder.path() + fmt::format("/node{}.json", node);
    if (!options.quiet) print(fmt::format("\n== node {}\n\n", node));
    std::fflush(stdout);
    const int code = run_command(one);
    if (options.dry_run) {
      if (code != 0) return code;
      continue;
    }
    auto source = read_run(json);
    if (!source) return code == 0 ? report_error(source.error(), exit_environment) : code;
    // What is refused for one node is refused for each.
    if (code == exit_usage && source->run.cases.empty()) return code;
    runs.push_back({fmt::format("node {}", node), std::move(source->run)});
    if (code > 128) break;
  }
  if (options.dry_run) return 0;
  auto devices = devices_of(std::move(runs));
  if (!devices) return report_error(devices.error(), exit_environment);
  if (!options.quiet) print(fmt::format("\n== {} nodes\n\n", devices->size()));
  return report_devices(*devices, options.reports, false, options.color);
}

}  // namespace conform::cli
