// SPDX-License-Identifier: Apache-2.0
// `run --nodes`: several devices of one bus, one after the other.
#include <cstdio>
#include <filesystem>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "cli/commands/commands.hpp"
#include "cli/run/run_reports.hpp"
#include "cli/run/several.hpp"
#include "cli/run/terminal.hpp"

namespace conform::cli {
namespace {

namespace fs = std::filesystem;

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
  std::vector<result::NamedRun> runs;
  for (const auto node : options.nodes) {
    if (!options.quiet) print(fmt::format("\n== node {}\n\n", node));
    std::fflush(stdout);
    std::optional<result::RunResult> done;
    const int code = run_command(for_node(options, node), &done);
    if (done) {
      const auto html = options.reports.find("html");
      auto page = html == options.reports.end() || html->second.empty()
                      ? std::string()
                      : page_of(*done, {absolute(of_node(html->second, node))});
      runs.push_back({fmt::format("node {}", node), std::move(*done), std::move(page)});
    } else if (code != 0) {
      // What is refused for one node is refused for each.
      return code;
    }
    if (code > 128) break;
  }
  if (runs.empty()) return 0;
  auto devices = devices_of(std::move(runs));
  if (!devices) return report_error(devices.error(), exit_environment);
  if (!options.quiet) print(fmt::format("\n== {} nodes\n\n", devices->size()));
  return report_devices(*devices, options.reports, false, options.color);
}

}  // namespace conform::cli
