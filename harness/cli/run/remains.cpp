// SPDX-License-Identifier: Apache-2.0
#include "cli/run/remains.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text.hpp"

namespace conform::cli {

std::optional<Multiplexer> stored_by(Multiplexer command) {
  const bool stores = command.index == Index(0x1010), restores = command.index == Index(0x1011);
  if (!stores && !restores) return std::nullopt;
  return Multiplexer{Index(0x1010), command.sub};
}

/// A new firmware may have another revision.
static std::vector<std::pair<Multiplexer, std::uint64_t>> identity_of(const result::RunResult& run) {
  constexpr auto told = std::to_array<std::pair<std::string_view, std::uint8_t>>(
      {{"dut.vendor_id", 1}, {"dut.product_code", 2}, {"dut.serial", 4}});
  std::vector<std::pair<Multiplexer, std::uint64_t>> out;
  for (const auto& [name, sub] : told) {
    const auto found = std::ranges::find(run.properties, name, &result::Property::name);
    if (found == run.properties.end()) continue;
    if (const auto number = parse_number(found->value))
      out.emplace_back(Multiplexer{Index(0x1018), SubIndex(sub)}, *number);
  }
  return out;
}

engine::Remains remains_of(const journal::Journal& journal, bool all, bool store) {
  engine::Remains out;
  for (const auto& each : all ? journal.changed : journal.outstanding)
    out.changes.push_back({each.object, each.before});
  out.identity = identity_of(journal.run);
  if (!store) return out;
  for (const auto& command : journal.commands) {
    const auto object = stored_by(command);
    if (object && std::ranges::find(out.store, *object) == out.store.end()) out.store.push_back(*object);
  }
  return out;
}

}  // namespace conform::cli
