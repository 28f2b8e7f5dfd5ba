// SPDX-License-Identifier: Apache-2.0
#include "node/switches.hpp"

#include <algorithm>
#include <string_view>

#include "base/text.hpp"
#include "defects/defect.hpp"
#include "defects/edits.hpp"
#include "variants/variant.hpp"

namespace refnode {

namespace {

/// The complaint about an id that no row has.
template <typename Rows>
std::unexpected<conform::Error> unknown(const std::string& kind, const std::string& id, const Rows& rows) {
  std::vector<std::string_view> known;
  for (const auto& row : rows) known.push_back(row.id);
  const std::string_view near = conform::did_you_mean(id, known);
  return conform::fail(
      "there is no " + kind + " '" + conform::printable(id) + "'", {},
      near.empty() ? "--list-" + kind + "s prints all of them" : "did you mean '" + std::string(near) + "'?");
}

}  // namespace

conform::Result<void> apply_variants(const std::vector<std::string>& ids, Parts& parts) {
  std::vector<const Variant*> used;
  for (const std::string& id : ids) {
    const Variant* variant = find_variant(id);
    if (variant == nullptr) return unknown("variant", id, variants());
    for (const Variant* other : used) {
      if (!compatible(*variant, *other)) {
        return conform::fail("variants '" + std::string(other->id) + "' and '" + id + "' exclude each other");
      }
    }
    used.push_back(variant);
    variant->how(parts);
  }
  return {};
}

conform::Result<void> apply_defects(const std::vector<std::string>& ids, Parts& parts) {
  std::vector<std::string_view> used;
  for (const std::string& id : ids) {
    if (const auto edit = parse_edit(id)) {
      if (!applies(*edit, parts.device.dictionary))
        return conform::fail("the dictionary has nothing for '" + id + "' to change");
      edit->how()(parts.device.dictionary, parts.device.node_id);
      continue;
    }
    const Defect* defect = find_defect(id);
    if (defect == nullptr) return unknown("defect", id, defects());
    if (std::ranges::find(used, defect->id) != used.end()) {
      return conform::fail("defect '" + id + "' is named twice");
    }
    used.push_back(defect->id);
    defect->how(parts);
  }
  return {};
}

}  // namespace refnode
