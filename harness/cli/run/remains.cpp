// SPDX-License-Identifier: Apache-2.0
#include "cli/run/remains.hpp"

#include <algorithm>

namespace conform::cli {

std::optional<Multiplexer> stored_by(Multiplexer command) {
  const bool stores = command.index == Index(0x1010), restores = command.index == Index(0x1011);
  if (!stores && !restores) return std::nullopt;
  return Multiplexer{Index(0x1010), command.sub};
}

engine::Remains remains_of(const journal::Journal& journal, bool all, bool store) {
  engine::Remains out;
  for (const auto& each : all ? journal.changed : journal.outstanding)
    out.changes.push_back({each.object, each.before});
  if (!store) return out;
  for (const auto& command : journal.commands) {
    const auto object = stored_by(command);
    if (object && std::ranges::find(out.store, *object) == out.store.end()) out.store.push_back(*object);
  }
  return out;
}

}  // namespace conform::cli
