// SPDX-License-Identifier: Apache-2.0
// "entries with access ro and not domain": a scenario for every entry with a property.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "device/dictionary.hpp"

namespace conform::scenario {

/// entries | objects | rpdos | tpdos [with CLAUSE {and CLAUSE}], where a clause may begin with `not` and is
/// one of access WORD {or WORD}, readable, writable, type NAME, size N or A..B, index A..B, low limit, high
/// limit, limits (one of them at least), full range (no limit leaves out a value of the type), default, high
/// limit below type maximum, low limit above type minimum, declared default, mappable, domain, integer,
/// command, claimed, complex, array, element (of a complex object, from 01h on), fixed size, changing, open
/// access, safe. `holding 15.. bytes` is a question to the device: only `given` knows it.
class Query {
 public:
  static Result<Query> parse(std::string_view text);
  /// In the order of the dictionary. `objects` gives one multiplexer per index, with sub-index 00h.
  [[nodiscard]] std::vector<Multiplexer> select(const device::Dictionary& dictionary) const;
  /// Least and most bytes an entry must hold on the device; `select` cannot know and leaves it to the caller.
  struct Holding {
    std::uint64_t least = 0, most = 0;
  };
  [[nodiscard]] const std::optional<Holding>& holding() const { return holding_; }
  /// Whether one of its clauses reads so.
  [[nodiscard]] bool says(std::string_view clause) const;
  /// What it looks for, as a person asks for it: "writable string or DOMAIN of 29 bytes or more".
  [[nodiscard]] std::string words() const;

 private:
  bool whole_objects_ = false;
  std::optional<Holding> holding_;
  std::string kind_;                ///< entries, objects, rpdos, tpdos
  std::vector<std::string> texts_;  ///< of the clauses
  std::vector<std::function<bool(const device::Entry&)>> clauses_;
};

}  // namespace conform::scenario
