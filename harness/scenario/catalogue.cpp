// SPDX-License-Identifier: Apache-2.0
#include "scenario/catalogue.hpp"

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

Requirement read_requirement(const yaml::Field& item) {
  Requirement out;
  auto fields = item.fields("requirement");
  out.id = fields.required("id").text().value_or("");
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

Result<Catalogue> Catalogue::load(const std::string& suites, std::vector<std::string>& problems,
                                  bool colour) {
  auto files = yaml_files_below(suites, "requirements");
  if (!files) return std::unexpected(files.error());
  Catalogue out;
  for (const auto& file : *files) {
    auto document = yaml::load_file(suites + "/" + file, file);
    if (!document) return std::unexpected(document.error());
    auto& diagnostics = document->diagnostics;
    if (document->root) {
      for (auto& requirement : load_requirements(*document->root, diagnostics, file)) {
        std::vector<std::string> names = requirement.same_as;
        names.push_back(requirement.id);
        for (const auto& name : names) {
          const auto [known, fresh] = out.index_.emplace(name, out.requirements_.size());
          if (fresh || known->second >= out.requirements_.size()) continue;
          const auto& other = out.requirements_[known->second];
          if (other.file == file) continue;  // reported by load_requirements
          diagnostics.error({requirement.line, 1}, 1, "requirement id '" + name + "' is given twice",
                            "also in " + other.file + ":" + std::to_string(other.line));
        }
        out.requirements_.push_back(std::move(requirement));
      }
    }
    if (!diagnostics.empty()) problems.push_back(diagnostics.render(colour));
  }
  return out;
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
