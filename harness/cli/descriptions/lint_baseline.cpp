// SPDX-License-Identifier: Apache-2.0
#include "cli/descriptions/lint_baseline.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "base/files.hpp"
#include "base/text.hpp"
#include "cli/descriptions/fingerprint.hpp"

namespace conform::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view schema = "canopen-conform/eds-lint-baseline/1";
constexpr std::uint64_t largest = std::uint64_t{64} << 20U;

fs::path absolute_path(const fs::path& path) {
  std::error_code error;
  auto out = fs::absolute(path, error);
  return error ? path : out.lexically_normal();
}

std::string word(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

}  // namespace

Result<LintBaseline> LintBaseline::read(const std::string& path, bool may_be_new) {
  LintBaseline out;
  out.path_ = path;
  std::error_code ignored;
  if (may_be_new && !fs::exists(path, ignored)) return out;
  const auto bytes = read_file(path, largest);
  if (!bytes) {
    auto error = bytes.error();
    if (error.hint.empty()) error.hint = "--write-baseline makes one";
    return std::unexpected(error);
  }
  const auto wrong = [&path](std::string what) {
    return fail(std::move(what), path, "it is written by 'eds lint --baseline FILE --write-baseline'");
  };
  const auto root = Json::parse(*bytes, nullptr, false);
  if (root.is_discarded()) return wrong("the baseline is no JSON");
  if (!root.is_object() || word(root, "schema") != schema || !root.contains("files") ||
      !root["files"].is_object())
    return wrong(fmt::format("the file is no baseline ({})", schema));
  for (const auto& [file, entries] : root["files"].items()) {
    if (!entries.is_array()) return wrong(fmt::format("'{}' holds no list", printable(file)));
    for (const auto& entry : entries) {
      const auto print = entry.is_object() ? word(entry, "fingerprint") : std::string();
      if (print.empty()) return wrong(fmt::format("an entry of '{}' has no fingerprint", printable(file)));
      out.files_[file][print] = {word(entry, "code"), word(entry, "place"), word(entry, "message")};
    }
  }
  return out;
}

std::string LintBaseline::key_of(const std::string& file) const {
  const auto out =
      absolute_path(file).lexically_relative(absolute_path(path_).parent_path()).generic_string();
  return printable(out.empty() ? file : out);
}

bool LintBaseline::exists(const std::string& key) const {
  std::error_code ignored;
  return fs::exists(absolute_path(path_).parent_path() / key, ignored);
}

void LintBaseline::apply(EdsLinted& file) const {
  if (file.unreadable) return;
  const auto known = files_.find(key_of(file.file));
  if (known == files_.end()) return;
  const FindingPlaces places(file.bytes, file.xml);
  const auto prints = fingerprints(file.report, places);
  const std::set<std::string> found(prints.begin(), prints.end());
  std::vector<eds::Finding> findings;
  std::vector<std::optional<eds::Fix>> fixes;
  for (std::size_t i = 0; i < prints.size(); ++i) {
    if (known->second.contains(prints[i])) {
      ++file.known;
      continue;
    }
    findings.push_back(std::move(file.report.findings[i]));
    if (i < file.fixes.size()) fixes.push_back(std::move(file.fixes[i]));
  }
  file.report.findings = std::move(findings);
  file.fixes = std::move(fixes);
  for (const auto& [print, entry] : known->second) {
    if (!found.contains(print))
      file.gone.push_back(entry.code + (entry.place.empty() ? "" : " " + entry.place) + ": " + entry.message);
  }
}

std::vector<std::string> LintBaseline::missing_files() const {
  std::vector<std::string> out;
  for (const auto& [file, entries] : files_) {
    if (!exists(file)) out.push_back(file);
  }
  return out;
}

void LintBaseline::take(const EdsLinted& file) {
  if (file.unreadable) return;
  auto& entries = files_[key_of(file.file)];
  entries.clear();
  const FindingPlaces places(file.bytes, file.xml);
  const auto prints = fingerprints(file.report, places);
  for (std::size_t i = 0; i < prints.size(); ++i) {
    const auto& finding = file.report.findings[i];
    entries[prints[i]] = {std::string(finding.rule->code), printable(places.name(finding.at)),
                          printable(finding.message)};
  }
  if (entries.empty()) files_.erase(key_of(file.file));
}

void LintBaseline::drop_missing() {
  std::erase_if(files_, [this](const auto& file) { return !exists(file.first); });
}

std::size_t LintBaseline::count() const {
  std::size_t out = 0;
  for (const auto& [file, entries] : files_) out += entries.size();
  return out;
}

Result<void> LintBaseline::write() const {
  Json out;
  out["schema"] = schema;
  out["files"] = Json::object();
  for (const auto& [file, entries] : files_) {
    auto& list = out["files"][file] = Json::array();
    for (const auto& [print, entry] : entries)
      list.push_back(
          {{"fingerprint", print}, {"code", entry.code}, {"place", entry.place}, {"message", entry.message}});
  }
  return write_file_atomically(path_, std::string_view(out.dump(1) + "\n"));
}

}  // namespace conform::cli
