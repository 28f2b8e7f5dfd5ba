// SPDX-License-Identifier: Apache-2.0
#include "scenario/catalogue.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/text.hpp"
#include "scenario/files.hpp"
#include "yaml/fields.hpp"
#include "yaml/loader.hpp"

namespace conform::scenario {
namespace {

std::vector<std::string> texts(const yaml::Field& field) {
  std::vector<std::string> out;
  for (const auto& item : field.items_or_one()) {
    if (auto text = item.text()) out.push_back(*text);
  }
  return out;
}

/// As the schema has it: words with hyphens between, the first one of capitals and digits.
bool is_id(std::string_view text) {
  const auto words = split(text, '-');
  const auto is_capital = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); };
  const auto is_letter = [&](char c) { return is_capital(c) || (c >= 'a' && c <= 'z'); };
  return words.size() > 1 && std::ranges::all_of(words.front(), is_capital) &&
         std::ranges::all_of(words, [&](std::string_view word) {
           return !word.empty() && std::ranges::all_of(word, is_letter);
         });
}

Requirement read_requirement(const yaml::Field& item) {
  Requirement out;
  auto fields = item.fields("requirement");
  const auto id = fields.required("id");
  out.id = id.text().value_or("");
  if (!out.id.empty() && !is_id(out.id))
    id.error("a requirement id is capitals and digits with hyphens between, such as SPINDLE-HB-01");
  out.clause = fields.required("clause").text().value_or("");
  out.object = fields.optional("object").text().value_or("");
  out.level = fields.required("level")
                  .one_of({"mandatory", "conditional", "optional", "recommended"})
                  .value_or("mandatory");
  out.applies = fields.optional("applies").text().value_or("");
  out.statement = fields.required("statement").text().value_or("");
  out.passes = fields.required("passes").text().value_or("");
  out.warns = fields.optional("warns").text().value_or("");
  out.fails = fields.optional("fails").text().value_or("");
  if (const auto same_as = fields.optional("same_as")) out.same_as = texts(same_as);
  if (const auto cct = fields.optional("cct")) out.cct = texts(cct);
  out.risk = fields.required("risk").one_of({"read-only", "config", "nvm", "motion"}).value_or("read-only");
  out.note = fields.optional("note").text().value_or("");
  out.proof = fields.optional("proof").one_of({"manual", "reference node only"}).value_or("");
  out.proof_reason = fields.optional("proof_reason").text().value_or("");
  out.not_judged = fields.optional("not_judged").text().value_or("");
  out.planned = fields.optional("planned").text().value_or("");
  if (out.proof.empty() != out.proof_reason.empty()) item.error("'proof' and 'proof_reason' go together");
  out.line = item.node()->position().line;
  return out;
}

}  // namespace

bool Requirement::forbids_restart() const {
  for (const std::string_view word :
       {"crash", "loss of service", "no longer answers", ", reset", "or reset", "boot-up frame"}) {
    if (fails.find(word) != std::string::npos) return true;
  }
  return fails.starts_with("boot-up") || fails.starts_with("reset,") ||
         passes.find("no boot-up") != std::string::npos;
}

std::vector<Requirement> load_requirements(const yaml::Node& root, yaml::Diagnostics& diagnostics,
                                           const std::string& path) {
  std::vector<Requirement> out;
  yaml::Fields fields(root, diagnostics, "requirement file");
  (void)fields.required("format").number(1, 1);
  const auto area = fields.required("area").text().value_or("");
  std::set<std::string> names;
  for (const auto& item : fields.required("requirements").items()) {
    auto requirement = read_requirement(item);
    requirement.area = area;
    requirement.file = path;
    if (item.node()->is_mapping() && !requirement.id.empty() && !names.insert(requirement.id).second) {
      item.error("requirement id '" + requirement.id + "' is given twice");
    }
    for (const auto& name : requirement.same_as) {
      if (!names.insert(name).second) item.error("requirement id '" + name + "' is given twice");
    }
    out.push_back(std::move(requirement));
  }
  return out;
}

Result<Catalogue> Catalogue::load(const std::string& suites, std::vector<std::string>& problems, bool colour,
                                  const std::vector<std::string>& more) {
  Catalogue out;
  if (auto added = out.add_folder(suites, "suites/", problems, colour); !added)
    return std::unexpected(added.error());
  for (const auto& folder : more) {
    std::error_code error;
    if (!std::filesystem::is_directory(std::filesystem::path(folder) / "requirements", error)) continue;
    if (auto added = out.add_folder(folder, folder + "/", problems, colour); !added)
      return std::unexpected(added.error());
  }
  return out;
}

Result<void> Catalogue::add_folder(const std::string& folder, const std::string& prefix,
                                   std::vector<std::string>& problems, bool colour) {
  auto files = yaml_files_below(folder, "requirements");
  if (!files) return std::unexpected(files.error());
  std::vector<yaml::NamedFile> named;
  for (const auto& below : *files) named.push_back({.path = folder + "/" + below, .name = prefix + below});
  std::vector<std::vector<Requirement>> loaded(named.size());
  auto documents =
      yaml::load_files(named, [&](std::size_t i, const yaml::Node& root, yaml::Diagnostics& diagnostics) {
        loaded[i] = load_requirements(root, diagnostics, named[i].name);
      });
  for (std::size_t i = 0; i < named.size(); ++i) {
    const auto first_of_file = requirements_.size();
    auto& document = documents[i];
    if (!document) return std::unexpected(document.error());
    auto& diagnostics = document->diagnostics;
    for (auto& requirement : loaded[i]) {
      std::vector<std::string> names = requirement.same_as;
      names.push_back(requirement.id);
      for (const auto& name : names) {
        const auto [known, fresh] = index_.emplace(name, requirements_.size());
        // One that this file gives twice was reported by load_requirements.
        if (fresh || known->second >= first_of_file) continue;
        const auto& other = requirements_[known->second];
        diagnostics.error({requirement.line, 1}, 1, "requirement id '" + name + "' is given twice",
                          "also in " + other.file + ":" + std::to_string(other.line));
      }
      requirement.path = named[i].path;
      requirements_.push_back(std::move(requirement));
    }
    if (!diagnostics.empty()) problems.push_back(diagnostics.render(colour));
  }
  return {};
}

const Requirement* Catalogue::find(std::string_view id) const {
  const auto found = index_.find(id);
  return found == index_.end() ? nullptr : &requirements_[found->second];
}

std::optional<std::string> Catalogue::canonical(std::string_view id) const {
  const auto* requirement = find(id);
  return requirement == nullptr ? std::nullopt : std::optional(requirement->id);
}

std::vector<std::string_view> Catalogue::ids() const {
  std::vector<std::string_view> out;
  for (const auto& [id, index] : index_) out.push_back(id);
  return out;
}

}  // namespace conform::scenario
