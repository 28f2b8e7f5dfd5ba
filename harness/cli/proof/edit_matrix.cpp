// SPDX-License-Identifier: Apache-2.0
#include "cli/proof/edit_matrix.hpp"
#include "base/in_parallel.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "cli/proof/verdicts.hpp"
#include "defects/edits.hpp"
#include "node/node.hpp"

namespace conform::cli {
namespace {

Result<EditVerdict> verdict_of(const Bench& bench, const refnode::Edit& edit) {
  EditVerdict out{edit.id(), edit.summary(), {}};
  for (const auto& patterns : {std::vector<std::string>{"cia301/dictionary"}, {}}) {
    engine::RunOptions options;
    options.plan.selection.patterns = patterns;
    const auto worse = worse_with(out.id, bench, std::move(options));
    if (!worse) return std::unexpected(worse.error());
    std::set<std::string> noticed_by;
    for (const auto& [key, verdict] : *worse) noticed_by.insert(key.first);
    out.noticed_by.assign(noticed_by.begin(), noticed_by.end());
    if (!out.noticed_by.empty()) break;
  }
  return out;
}

}  // namespace

std::vector<std::string> EditMatrix::survivors() const {
  std::vector<std::string> out;
  for (const auto& edit : edits) {
    if (edit.noticed_by.empty()) out.push_back(edit.id);
  }
  return out;
}

Result<EditMatrix> edit_matrix(const device::Profile& profile, const scenario::Suite& suite,
                               const scenario::Catalogue& catalogue, std::uint64_t seed, unsigned jobs,
                               const std::vector<std::string>& only) {
  auto conformant = simulate({}, profile, suite, catalogue, {}, seed);
  if (!conformant) return std::unexpected(conformant.error());
  const auto good = verdicts_of(conformant->result);
  auto node = refnode::Node::create({.node_id = profile.node.value()});
  if (!node) return std::unexpected(node.error());
  auto edits = refnode::edits_of((*node)->dictionary());
  if (!only.empty())
    std::erase_if(edits, [&](const auto& edit) { return std::ranges::find(only, edit.id()) == only.end(); });
  const Bench bench{profile, suite, catalogue, seed, good};
  auto verdicts =
      all_in_parallel(edits.size(), jobs, [&](std::size_t i) { return verdict_of(bench, edits[i]); });
  if (!verdicts) return std::unexpected(verdicts.error());
  EditMatrix out;
  out.edits = std::move(*verdicts);
  return out;
}

}  // namespace conform::cli
