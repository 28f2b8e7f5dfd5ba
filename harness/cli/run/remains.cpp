// SPDX-License-Identifier: Apache-2.0
#include "cli/run/remains.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "result/properties.hpp"

namespace conform::cli {

std::optional<Multiplexer> stored_by(Multiplexer command) {
  const bool stores = command.index == Index(0x1010), restores = command.index == Index(0x1011);
  if (!stores && !restores) return std::nullopt;
  return Multiplexer{Index(0x1010), command.sub};
}

namespace {

struct Number {
  std::string_view property, words;
  std::uint8_t sub;  ///< of 1018h
};

/// By these a device is known. A new firmware may have another revision.
constexpr auto known_by = std::to_array<Number>({{"dut.vendor_id", "vendor-ID", 1},
                                                 {"dut.product_code", "product code", 2},
                                                 {"dut.serial", "serial number", 4}});

std::vector<std::pair<Multiplexer, std::uint64_t>> identity_of(const result::RunResult& run) {
  std::vector<std::pair<Multiplexer, std::uint64_t>> out;
  for (const auto& each : known_by) {
    const auto* value = result::value_of(run, each.property);
    const auto number = value == nullptr ? std::nullopt : parse_number(*value);
    if (number) out.emplace_back(Multiplexer{Index(0x1018), SubIndex(each.sub)}, *number);
  }
  return out;
}

}  // namespace

std::string device_of(const result::RunResult& run) {
  std::vector<std::string> out;
  for (const auto& each : known_by) {
    if (const auto* value = result::value_of(run, each.property))
      out.push_back(std::string(each.words) + " " + *value);
  }
  return join(out, ", ");
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
