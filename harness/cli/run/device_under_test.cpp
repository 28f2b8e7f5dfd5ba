// SPDX-License-Identifier: Apache-2.0
#include "cli/run/device_under_test.hpp"

#include "cli/proof/variant_profile.hpp"
#include "node/node.hpp"

namespace conform::cli {

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
  return known;
}

}  // namespace conform::cli
