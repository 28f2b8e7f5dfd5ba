// SPDX-License-Identifier: Apache-2.0
#include "cli/run/several.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include <fmt/format.h>

#include "base/files.hpp"
#include "cli/commands/commands.hpp"
#include "cli/run/run_reports.hpp"
#include "cli/run/terminal.hpp"
#include "reports/beside.hpp"
#include "reports/html/html.hpp"
#include "reports/junit.hpp"
#include "reports/matrix.hpp"

namespace conform::cli {
namespace {

using result::NamedRun;

std::string number_of_parts(const NamedRun& each) { return std::to_string(part_of_run(each.run)->of); }

/// As short as tells them apart: the device, its node-ID, its serial number, at last the file.
void name_apart(std::vector<NamedRun>& devices) {
  std::vector<std::string> names(devices.size());
  const auto add = [&](const auto& words) {
    auto before = names;
    for (std::size_t i = 0; i < devices.size(); ++i) {
      const auto same = [&](const std::string& name) { return name == before[i]; };
      const std::string more = words(devices[i]);
      if (!more.empty() && (before[i].empty() || std::ranges::count_if(before, same) > 1))
        names[i] += (names[i].empty() ? "" : ", ") + more;
    }
  };
  add([](const NamedRun& each) { return each.run.device; });
  add([](const NamedRun& each) {
    const auto node = property_of(each.run, "dut.node_id");
    return node.empty() ? node : "node " + node;
  });
  add([](const NamedRun& each) { return property_of(each.run, "dut.serial"); });
  add([](const NamedRun& each) { return each.name; });
  for (std::size_t i = 0; i < devices.size(); ++i) devices[i].name = names[i];
}

/// In front of class names: "drive_a_node_5".
std::string class_prefix(const std::string& name) {
  std::string out;
  for (const char c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-';
    if (plain)
      out += c;
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (out.ends_with('_')) out.pop_back();
  return out;
}

std::string junit_of(const std::vector<NamedRun>& devices) {
  std::vector<reports::JUnitDevice> out;
  for (const auto& each : devices)
    out.push_back({&each.run, {.class_prefix = class_prefix(each.name), .source_prefix = {}}});
  return reports::junit_of_several(out);
}

}  // namespace

bool is_of_several(std::string_view format) {
  constexpr std::array formats{"html", "csv", "markdown", "junit"};
  return std::ranges::find(formats, format) != formats.end();
}

Result<std::vector<NamedRun>> devices_of(std::vector<NamedRun> runs) {
  std::vector<NamedRun> out;
  // The parts of one run: of one device, cut into the same number of parts.
  std::map<std::string, std::vector<NamedRun>> groups;
  for (auto& each : runs) {
    if (part_of_run(each.run)) {
      groups[number_of_parts(each) + "\n" + identity_of(each.run)].push_back(std::move(each));
    } else {
      out.push_back(std::move(each));
    }
  }
  for (const auto& [key, parts] : groups) {
    auto whole = merge_parts(parts);
    if (!whole) return std::unexpected(whole.error());
    out.push_back({parts.front().name, std::move(*whole)});
  }
  name_apart(out);
  return out;
}

std::vector<std::string> pages_beside(const std::string& result, const std::string& own) {
  const std::filesystem::path path(absolute(result));
  std::vector<std::string> out;
  if (!own.empty()) out.push_back(own);
  out.push_back(std::filesystem::path(path).replace_extension(".html").string());
  out.push_back((path.parent_path() / "report.html").string());
  return out;
}

std::string page_of(const result::RunResult& run, const std::vector<std::string>& files) {
  constexpr std::uint64_t largest = std::uint64_t{1} << 30U;
  for (const auto& file : files) {
    const auto text = read_file(file, largest);
    if (text && reports::is_html_report_of(*text, run)) return file;
  }
  return {};
}

int report_devices(const std::vector<NamedRun>& devices, const std::map<std::string, std::string>& asked,
                   bool quiet, const std::string& color) {
  const auto html = asked.find("html");
  // A page that is about to be replaced by the matrix is nowhere to lead to.
  const reports::Beside page{.path = html == asked.end() ? std::string() : absolute(html->second)};
  std::vector<reports::MatrixColumn> columns;
  for (const auto& each : devices) {
    const bool has_page = !page.path.empty() && !each.page.empty() && each.page != page.path;
    columns.push_back({each.name, &each.run, has_page ? page.relative(each.page) : std::string()});
  }
  const reports::Matrix matrix(std::move(columns));
  bool written = true;
  for (const auto& [format, path] : asked) {
    if (path.empty() || !is_of_several(format)) continue;
    const auto text = format == "html"       ? matrix_html(matrix)
                      : format == "csv"      ? matrix_csv(matrix)
                      : format == "markdown" ? matrix_markdown(matrix)
                                             : junit_of(devices);
    if (const auto done = write_file_atomically(path, text); !done) {
      written = false;
      (void)report_error(done.error(), exit_environment);
    }
  }
  if (!quiet) print(matrix_text(matrix, {use_colour(color, 1), terminal_width(), 0}));
  const int code = matrix.exit_code();
  return !written && code == 0 ? exit_environment : code;
}

}  // namespace conform::cli
