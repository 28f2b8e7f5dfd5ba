// SPDX-License-Identifier: Apache-2.0
// Defects that any entry can have, made for all of them: what a firmware gets wrong about one object,
// whatever the object is for. They have no table of requirements; the suite is to notice each that can be
// seen from outside.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "defects/defect.hpp"

namespace refnode {

enum class EditKind : std::uint8_t {
  absent,         ///< the entry is not there
  object_absent,  ///< nothing of its object is there
  read_only,      ///< ro instead of rw
  writable,       ///< rw instead of ro or const
  write_only,     ///< cannot be read
  readable,       ///< rw instead of wo
  longer,         ///< the next longer integer type
  shorter,        ///< the next shorter one
  other_default,
  stuck,      ///< writes are confirmed and forgotten
  more_subs,  ///< sub-index 00h counts one too many
  fewer_subs  ///< and one too few
};

struct Edit {
  Multiplexer mux;
  EditKind kind = EditKind::absent;

  /// "edit:1017h:00:longer": also an id for Options::defects and `canopen-refnode --defect`.
  [[nodiscard]] std::string id() const;
  /// "1017h:00 has a longer type"
  [[nodiscard]] std::string summary() const;
  /// Does it.
  [[nodiscard]] DictionaryEdit how() const;
};

/// Every edit that changes something, for every entry of `dictionary`, in its order.
[[nodiscard]] std::vector<Edit> edits_of(const ObjectDictionary& dictionary);
/// nullopt when `id` is none of an edit.
[[nodiscard]] std::optional<Edit> parse_edit(std::string_view id);
/// Whether the edit is one of those of `dictionary`: the entry is there and can be edited so.
[[nodiscard]] bool applies(const Edit& edit, const ObjectDictionary& dictionary);

}  // namespace refnode
