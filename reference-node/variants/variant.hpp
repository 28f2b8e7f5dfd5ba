// SPDX-License-Identifier: Apache-2.0
// Legal variants: ways to be another device than by default and just as conformant. A row says what differs
// and why it is legal; no combination of compatible rows may ever be failed by a test of conformance.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "parts/parts.hpp"

namespace refnode {

struct Variant {
  std::string_view id;
  std::string_view summary;
  std::string_view legal;  ///< clause of CiA 301, or requirements that name this way among those that pass
  std::function<void(Parts&)> how;
  std::string_view group = {};                  ///< of all rows with the same word here one can be chosen
  std::vector<std::string_view> excludes = {};  ///< further ids or groups it cannot be combined with
  std::vector<std::string_view> lacks = {};     ///< features of a device profile that go with it
  std::vector<std::string_view> gains = {};     ///< and that come with it
  std::vector<std::string_view> warns = {};     ///< requirements whose catalogue entry warns of it
};

/// All rows, in the order of the tables; ids are unique and never reused.
[[nodiscard]] std::span<const Variant> variants();
/// nullptr when there is no such variant.
[[nodiscard]] const Variant* find_variant(std::string_view id);
/// Whether both can be chosen for one node.
[[nodiscard]] bool compatible(const Variant& one, const Variant& other);

using VariantTable = std::vector<Variant>;

// The tables, one per room of the node.
[[nodiscard]] VariantTable objects_variants();
[[nodiscard]] VariantTable dictionary_variants();
[[nodiscard]] VariantTable storage_variants();
[[nodiscard]] VariantTable sync_variants();
[[nodiscard]] VariantTable time_variants();
[[nodiscard]] VariantTable emergency_variants();
[[nodiscard]] VariantTable error_control_variants();
[[nodiscard]] VariantTable nmt_variants();
[[nodiscard]] VariantTable lss_variants();
[[nodiscard]] VariantTable pdo_variants();
[[nodiscard]] VariantTable sdo_variants();
[[nodiscard]] VariantTable cob_id_variants();
[[nodiscard]] VariantTable rare_variants();

}  // namespace refnode
