// SPDX-License-Identifier: Apache-2.0
#include "cli/run/run_inputs.hpp"

#include <algorithm>
#include <filesystem>

#include "base/files.hpp"
#include "base/text.hpp"
#include "bundle/digest.hpp"
#include "bundle/verify.hpp"
#include "result/properties.hpp"
#include "scenario/files.hpp"

namespace conform::cli {
namespace {

namespace fs = std::filesystem;
using bundle::Content;
using result::value_of;

/// Descriptions and profiles are far below it; a recording may be large.
constexpr std::uint64_t largest_input = std::uint64_t{1} << 30U;

/// "a/b c.yaml" -> "a/b%20c.yaml"
std::string safe_path(const std::string& path) {
  std::vector<std::string> parts;
  for (const auto part : split(path, '/')) parts.push_back(bundle::safe_part(part));
  return join(parts, "/");
}

std::string base_name(const std::string& path) {
  return bundle::safe_part(fs::path(path).lexically_normal().filename().string());
}

std::string folder_name(const std::string& path) {
  auto whole = fs::path(path).lexically_normal();
  return bundle::safe_part((whole.has_filename() ? whole : whole.parent_path()).filename().string());
}

/// Of waivers there may be several, of one name in different folders.
std::string name_of(const UsedFile& file, std::size_t number) {
  const auto front = "inputs/" + file.role + "/";
  return front + (file.role == role::waivers ? std::to_string(number) + "-" : "") + base_name(file.path);
}

std::size_t count(const std::vector<Content>& contents, const std::string& role) {
  return static_cast<std::size_t>(std::ranges::count(contents, role, &Content::role));
}

Result<void> add_folder(RunInputs& inputs, const std::string& folder, const std::string& role,
                        const std::string& front) {
  const auto files = scenario::yaml_files_below(folder, "");
  if (!files) return std::unexpected(files.error());
  for (const auto& file : *files) {
    auto text = read_file(folder + "/" + file, largest_input);
    if (!text) return std::unexpected(text.error());
    inputs.contents.push_back({front + safe_path(file), role, std::move(*text)});
  }
  return {};
}

std::string front_of_own(const std::string& folder, std::size_t number) {
  return "own-suites/" + std::to_string(number) + "-" + folder_name(folder) + "/";
}

/// "PATH DIGEST"
struct Told {
  std::string path, digest;
};
Told told_by(const std::string& value) {
  const auto blank = value.rfind(' ');
  if (blank == std::string::npos) return {value, {}};
  return {value.substr(0, blank), value.substr(blank + 1)};
}

void add_file(RunInputs& inputs, const char* role, const std::vector<std::string>& places,
              const std::string& digest) {
  const auto number = count(inputs.contents, role) + 1;
  const auto& shown = places.front();
  if (digest.empty()) {
    inputs.left_out.push_back({role, printable(shown) + ": the result does not tell its digest"});
    return;
  }
  for (const auto& place : places) {
    if (place.empty()) continue;
    auto text = read_file(place, largest_input);
    if (!text || bundle::sha256(*text) != digest) continue;
    inputs.contents.push_back({name_of({role, shown}, number), role, std::move(*text)});
    return;
  }
  inputs.left_out.push_back({role, printable(shown) + ": it is not there any more, or is another one now"});
}

/// The suites that the program finds now, where they are those that the run used.
void add_suites_of(RunInputs& inputs, const result::RunResult& run) {
  const auto* const digest = value_of(run, "suite.digest");
  const auto root = find_suites(std::string());
  const bool same =
      digest != nullptr && root && suite_properties(SuiteFolders{*root}).front().value == *digest;
  if (!same || !add_folder(inputs, *root, role::suite, "suites/"))
    inputs.left_out.push_back({role::suite, "the suites of this program are not those that the run used"});
  std::size_t number = 0;
  for (const auto& property : run.properties) {
    if (property.name != "suite.own") continue;
    ++number;
    const auto told = told_by(property.value);
    const auto now = suite_properties(SuiteFolders{told.path}).front().value;
    if (now != told.digest ||
        !add_folder(inputs, told.path, role::own_suite, front_of_own(told.path, number)))
      inputs.left_out.push_back(
          {role::own_suite, printable(told.path) + ": it is not there any more, or has changed"});
  }
}

}  // namespace

Result<RunInputs> take_files(const std::vector<UsedFile>& files) {
  RunInputs out;
  for (const auto& file : files) {
    auto text = read_file(file.path, largest_input);
    if (!text) return std::unexpected(text.error());
    const auto number = count(out.contents, file.role) + 1;
    out.contents.push_back({name_of(file, number), file.role, std::move(*text)});
  }
  return out;
}

Result<void> add_suites(RunInputs& inputs, const SuiteFolders& folders) {
  if (auto added = add_folder(inputs, folders.root, role::suite, "suites/"); !added) return added;
  std::size_t number = 0;
  for (const auto& folder : folders.own) {
    if (auto added = add_folder(inputs, folder, role::own_suite, front_of_own(folder, ++number)); !added)
      return added;
  }
  return {};
}

std::vector<result::Property> input_properties(const RunInputs& inputs, const std::vector<UsedFile>& files) {
  std::vector<result::Property> out;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto digest = bundle::sha256(inputs.contents[i].bytes);
    if (files[i].role == role::description) {
      out.push_back({"dut.description_digest", digest});
    } else {
      out.push_back({"input." + files[i].role, files[i].path + " " + digest});
    }
  }
  return out;
}

Result<TakenInputs> take_inputs(const std::vector<UsedFile>& files, const SuiteFolders& suites, bool whole) {
  auto inputs = take_files(files);
  if (!inputs) return std::unexpected(inputs.error());
  auto told = input_properties(*inputs, files);
  if (whole) {
    if (auto added = add_suites(*inputs, suites); !added) return std::unexpected(added.error());
    told.push_back(digest_of(*inputs));
  }
  return TakenInputs{std::move(*inputs), std::move(told)};
}

RunInputs inputs_of(const result::RunResult& run, const std::string& profile, const std::string& eds) {
  RunInputs out;
  for (const auto& property : run.properties) {
    const auto told = told_by(property.value);
    if (property.name == "input.profile") add_file(out, role::profile, {told.path, profile}, told.digest);
    if (property.name == "input.waivers") add_file(out, role::waivers, {told.path}, told.digest);
    if (property.name == "input.recording") add_file(out, role::recording, {told.path}, told.digest);
  }
  if (const auto* const path = value_of(run, "dut.description"); path != nullptr) {
    const auto* const digest = value_of(run, "dut.description_digest");
    add_file(out, role::description, {*path, eds}, digest == nullptr ? std::string() : *digest);
  }
  add_suites_of(out, run);
  return out;
}

result::Property digest_of(const RunInputs& inputs) {
  std::vector<std::string> lines;
  for (const auto& each : inputs.contents)
    lines.push_back(bundle::sha256(each.bytes) + "  " + each.name + "\n");
  std::ranges::sort(lines);
  return {"bundle.inputs", bundle::sha256(join(lines, ""))};
}

Result<RunInputs> inputs_in(const std::string& path, const result::RunResult& run) {
  auto found = bundle::contents(
      path, {role::suite, role::own_suite, role::profile, role::description, role::waivers, role::recording});
  if (!found) return std::unexpected(found.error());
  RunInputs out{.contents = std::move(*found)};
  const auto now = digest_of(out);
  const auto* const then = value_of(run, now.name);
  if (then == nullptr || *then != now.value) return fail("is a bundle of another run", path);
  return out;
}

}  // namespace conform::cli
