// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "variants/variant.hpp"

namespace refnode {

std::span<const Variant> variants() {
  static const VariantTable all = [] {
    VariantTable joined;
    for (VariantTable table :
         {objects_variants(), dictionary_variants(), storage_variants(), sync_variants(), time_variants(),
          emergency_variants(), error_control_variants(), nmt_variants(), lss_variants(), pdo_variants(),
          sdo_variants(), cob_id_variants()}) {
      for (Variant& row : table) joined.push_back(std::move(row));
    }
    return joined;
  }();
  return all;
}

const Variant* find_variant(std::string_view id) {
  const auto all = variants();
  const auto found = std::ranges::find(all, id, &Variant::id);
  return found == all.end() ? nullptr : &*found;
}

bool compatible(const Variant& one, const Variant& other) {
  if (one.id == other.id) return false;
  if (!one.group.empty() && one.group == other.group) return false;
  const auto names = [](const Variant& from, const Variant& to) {
    return std::ranges::any_of(from.excludes, [&](std::string_view word) {
      return word == to.id || (!to.group.empty() && word == to.group);
    });
  };
  return !names(one, other) && !names(other, one);
}

}  // namespace refnode
