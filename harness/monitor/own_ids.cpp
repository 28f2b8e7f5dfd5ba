// SPDX-License-Identifier: Apache-2.0
#include "monitor/own_ids.hpp"

#include <algorithm>
#include <array>

#include "canopen/cob_id.hpp"

namespace conform::monitor {
namespace {

namespace cob_id = canopen::cob_id;

bool sends(std::uint16_t index) {
  return index == 0x1005 || index == 0x1012 || index == 0x1014 || is_tpdo(index) ||
         (index >= 0x1200 && index <= 0x12FF);
}

/// Whether the service sends with this value: SYNC and TIME are produced with bit 30, all others are not
/// valid with bit 31.
bool is_on(std::uint16_t index, std::uint32_t value) {
  if (index == 0x1005 || index == 0x1012) return (value & cob_id::bit30) != 0;
  return (value & cob_id::bit31) == 0;
}

}  // namespace

std::uint8_t sending_sub(std::uint16_t index) {
  if (index < 0x1200) return 0;
  return index <= 0x127F ? 2 : 1;
}

Entries::Key can_id_in(std::uint32_t value) {
  return canopen::is_extended(CobId{value}) ? value & (cob_id::extended_frame | cob_id::can_id_mask)
                                            : value & cob_id::base_id_mask;
}

std::optional<Entries::Key> predefined(std::uint16_t index, NodeId node) {
  const auto set = canopen::connection_set(node);
  if (index == 0x1005) return canopen::sync_can_id.value();
  if (index == 0x1012) return canopen::time_can_id.value();
  if (index == 0x1014) return set.emcy.value();
  if (index == 0x1200) return set.sdo_response.value();
  if (index >= 0x1800 && index <= 0x1803) return set.tpdo[index - 0x1800].value();
  return std::nullopt;
}

Holder holder(const Follower& follower, std::uint16_t index, Entries::Key can_id) {
  const auto& entries = follower.entries();
  const auto sub = sending_sub(index);
  if (const auto* entry = entries.known(index, sub)) {
    const auto held = can_id_in(entry->value) != can_id ? Held::no
                      : is_on(index, entry->value)      ? Held::yes
                                                        : Held::off;
    return {index, held, entry};
  }
  const bool likely = !entries.is_absent(index, sub) && (predefined(index, follower.facts().node) == can_id ||
                                                         entries.ever_held(index, can_id));
  if (!likely) return {index, Held::no, nullptr};
  // What has never been a producer is none after a reset.
  const bool producer = index == 0x1005 || index == 0x1012;
  const bool off = producer && entries.never_had(index, sub, cob_id::bit30);
  return {index, off ? Held::off : Held::maybe, nullptr};
}

std::vector<Holder> holders(const Follower& follower, Entries::Key can_id) {
  std::vector<Holder> out;
  const auto add = [&](std::uint16_t index) {
    if (!sends(index) || std::ranges::find(out, index, &Holder::index) != out.end()) return;
    if (const auto found = holder(follower, index, can_id); found.held != Held::no) out.push_back(found);
  };
  constexpr std::array<std::uint16_t, 7> with_default{0x1005, 0x1012, 0x1014, 0x1800, 0x1801, 0x1802, 0x1803};
  for (const auto index : with_default) {
    if (predefined(index, follower.facts().node) == can_id) add(index);
  }
  follower.entries().for_holders(can_id, add);
  return out;
}

bool other_holder(const std::vector<Holder>& holders, std::uint16_t first, std::uint16_t last) {
  return std::ranges::any_of(holders, [&](const Holder& each) {
    return (each.index < first || each.index > last) && each.held != Held::off;
  });
}

bool may_be_left_over(const Follower& follower, const std::vector<Holder>& holders, Entries::Key can_id,
                      std::uint16_t first, std::uint16_t last) {
  if (std::ranges::any_of(holders, [](const Holder& each) { return each.held == Held::yes; })) return false;
  bool other = false;
  follower.entries().for_holders(
      can_id, [&](std::uint16_t index) { other = other || index < first || index > last; });
  return other;
}

}  // namespace conform::monitor
