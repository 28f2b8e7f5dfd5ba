// SPDX-License-Identifier: Apache-2.0
// "entries with access ro and not domain": a scenario for every entry with a property.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "device/dictionary.hpp"

namespace conform::scenario {

/// entries | objects | rpdos | tpdos [with CLAUSE {and CLAUSE}], where a clause may begin with `not` and is one of
/// access WORD {or WORD}, readable, writable, type NAME, size N or A..B, index A..B, low limit, high limit, limits, default,
/// high limit below type maximum, low limit above type minimum, declared default, mappable, domain, integer, command, claimed,
/// complex, array, fixed size, changing, open access, safe.
class Query {
 public:
  static Result<Query> parse(std::string_view text);
  /// In the order of the dictionary. `objects` gives one multiplexer per index, with sub-index 00h.
  [[nodiscard]] std::vector<Multiplexer> select(const device::Dictionary& dictionary) const;

 private:
  bool whole_objects_ = false;
  std::vector<std::function<bool(const device::Entry&)>> clauses_;
};

}  // namespace conform::scenario
