// SPDX-License-Identifier: Apache-2.0
// What may be sent at which tier: the table, and where a frame stands in it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "base/strong.hpp"
#include "can/frame.hpp"

namespace conform::steps {

/// How much harm a scenario may do, to the machine and to the other nodes of the bus, in rising order. A run
/// allows everything up to one tier.
enum class Tier : std::uint8_t { read_only, config, nvm, motion };
[[nodiscard]] std::string_view word_of(Tier tier);
[[nodiscard]] std::optional<Tier> parse_tier(std::string_view word);

/// One row of the table for people: `explain tiers` and the documentation print it.
struct TierRow {
  Tier tier;
  std::string_view sends;
};
[[nodiscard]] std::span<const TierRow> tier_table();
/// What no tier allows.
[[nodiscard]] std::string_view never_sent();

/// The lowest tier that covers something, and what that something is: "a scenario of risk 'config' must not
/// ...".
struct Need {
  Tier tier = Tier::read_only;
  std::string_view what;
  [[nodiscard]] bool covered_by(Tier allowed) const { return tier <= allowed; }
};

/// What a frame needs that we send while the device under test is `node`.
[[nodiscard]] Need need_of(const can::Frame& frame, NodeId node);
/// What a download to this entry needs.
[[nodiscard]] Need need_of_download(Multiplexer object);
/// The object that a frame on the device's own SDO channel begins a download to; nullopt: it begins none.
[[nodiscard]] std::optional<Multiplexer> download_begun(const can::Frame& frame, NodeId node);

/// Entries of the application: written only where the profile says that this does no harm.
[[nodiscard]] constexpr bool is_of_application(Index index) { return index.value() >= 0x2000; }

}  // namespace conform::steps
