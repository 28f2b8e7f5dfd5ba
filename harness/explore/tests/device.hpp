// SPDX-License-Identifier: Apache-2.0
// The reference node as device and as model, for tests.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "device/profile.hpp"
#include "explore/explorer.hpp"
#include "node/powered_node.hpp"
#include "variants/variant.hpp"

namespace conform::explore {

inline MakeDevice reference_node(std::vector<std::string> defects, std::vector<std::string> variants = {}) {
  return [defects = std::move(defects),
          variants = std::move(variants)]() -> Result<std::unique_ptr<can::Participant>> {
    auto node = refnode::PoweredNode::create({.node_id = 5, .defects = defects, .variants = variants});
    if (!node) return std::unexpected(node.error());
    return std::unique_ptr<can::Participant>(std::move(*node));
  };
}

inline Bench bench_of(std::vector<std::string> defects) {
  Bench out;
  out.device = reference_node(std::move(defects));
  out.model = reference_node({});
  out.facts.node = NodeId(5);
  out.facts.power_is_known = true;
  out.facts.alone = true;
  for (const auto& rule : monitor::rules()) out.monitors.push_back(&rule);
  return out;
}

/// The choices that a model may have made, by ids of legal variants.
inline Offer offer_of(const std::vector<std::string>& ids) {
  Offer out;
  for (const auto& id : ids) {
    const auto* variant = refnode::find_variant(id);
    out.choices.push_back({.name = id,
                           .group = std::string(variant->group),
                           .warns = std::string(variant->warns.empty() ? "" : variant->warns.front())});
  }
  out.model_of = [ids](const Choices& chosen) {
    std::vector<std::string> variants;
    for (const auto choice : chosen) variants.push_back(ids[choice]);
    return reference_node({}, std::move(variants));
  };
  return out;
}

/// What the standard says is there, and the heartbeat trigger.
inline Vocabulary words_of_the_standard() {
  auto profile = device::default_profile(NodeId(5));
  const auto dictionary = device::dictionary_of(profile);
  for (auto entry : dictionary.entries()) {
    const bool is_there = entry.mux.index < Index(0x1020) || entry.mux.index == Index(0x1400);
    if (is_there) profile.objects.push_back(std::move(entry));
  }
  for (auto& entry : profile.objects) entry.claimed = true;
  return vocabulary_of(profile);
}

}  // namespace conform::explore
