// SPDX-License-Identifier: Apache-2.0
#include "cli/run/device_under_test.hpp"

#include <fmt/format.h>

#include "cli/proof/variant_profile.hpp"
#include "node/node.hpp"

namespace conform::cli {
namespace {

constexpr std::size_t most_remarks = 20;

/// What the twin of a description had to assume, as notes; a file with many mistakes is not worth a flood.
Result<std::vector<std::string>> assumptions(const KnownDevice& known) {
  const auto node =
      refnode::Node::create({.node_id = known.profile.node.value(), .description = known.description});
  if (!node) return std::unexpected(node.error());
  const auto& remarks = (*node)->remarks();
  std::vector<std::string> out;
  for (const auto& [at, text] : remarks.all()) {
    if (out.size() == most_remarks) break;
    const auto place = at.known() ? ":" + to_string(at) : "";
    out.push_back(fmt::format("the twin: {}{}: {}", known.description->name, place, text));
  }
  const auto total = remarks.all().size() + remarks.left_out();
  if (total > out.size())
    out.push_back(
        fmt::format("the twin: {} more remarks about {}", total - out.size(), known.description->name));
  return out;
}

}  // namespace

Result<KnownDevice> device_under_test(DeviceWords words, const Simulated& simulated,
                                      std::optional<NodeId> fallback) {
  const bool of_reference_node = simulated.simulate && words.profile.empty() && words.eds.empty();
  if (of_reference_node) words.profile = simulated.suites + "/devices/reference-node.yaml";
  if (simulated.simulate && !fallback) fallback = NodeId(5);
  auto known = known_device(words, fallback);
  // It stands in the suites.
  if (known && of_reference_node)
    std::erase_if(known->files, [&](const UsedFile& each) { return each.path == words.profile; });
  if (known && of_reference_node && !simulated.variants.empty()) {
    auto node = refnode::Node::create(
        {.node_id = known->profile.node.value(), .defects = {}, .variants = simulated.variants});
    if (!node) return std::unexpected(node.error());
    known->profile = profile_of_variants(known->profile, (*node)->dictionary(), simulated.variants);
  }
  if (known && simulated.simulate && known->description != nullptr) {
    const auto assumed = assumptions(*known);
    if (!assumed) return std::unexpected(assumed.error());
    known->notes.insert(known->notes.end(), assumed->begin(), assumed->end());
  }
  return known;
}

}  // namespace conform::cli
