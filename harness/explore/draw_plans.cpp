// SPDX-License-Identifier: Apache-2.0
// Talk about whole services: what has to come in some order before anything shows. Each piece is drawn anew
// and may fall out while a conversation is made shorter.
#include <algorithm>
#include <array>
#include <chrono>

#include "canopen/cob_id.hpp"
#include "explore/draw_talk.hpp"

namespace conform::explore {
namespace {

using namespace std::chrono_literals;

using namespace talk;

void draw_nmt(Draft& draft) {
  auto& random = draft.random;
  constexpr std::uint8_t known[] = {start, start, stop, pre_operational, reset_node, reset_communication};
  const auto node = draft.words.node.value();
  switch (random.below(10)) {
    case 0: draft.send(0, {random.of(known), 0}); break;
    case 1: draft.send(0, {random.of(known), static_cast<std::uint8_t>(node + 1)}); break;
    case 2: {
      constexpr std::uint8_t unknown[] = {0, 3, 4, 0x05, 0x7F, 0x83, 0x90, 0xFF};
      draft.send(0, {random.of(unknown), node});
      break;
    }
    case 3: {
      auto frame = can::data_frame(canopen::nmt_can_id, {random.of(known), node, 0});
      constexpr std::uint8_t lengths[] = {0, 1, 3, 8};
      frame.dlc = random.of(lengths);
      draft.add(explore::frame(frame));
      break;
    }
    case 4: {
      auto frame = can::data_frame(canopen::nmt_can_id, {random.of(known), node});
      (random.chance(50) ? frame.extended : frame.remote) = true;
      draft.add(explore::frame(frame));
      break;
    }
    default: draft.nmt(random.of(known)); break;
  }
  if (random.chance(40)) draft.wait(random.chance(50) ? 30ms : 3ms);
  // Error control tells the state.
  if (random.chance(50)) draft.add(frame(can::remote_frame(CanId(0x700U + node), 1)));
}

void draw_heartbeat(Draft& draft) {
  constexpr std::uint16_t periods[] = {0, 1, 5, 10, 20, 50, 100, 250};
  const auto period = draft.random.of(periods);
  draft.write(0x1017, 0, period);
  draft.wait(edge(draft, std::chrono::milliseconds(period) * static_cast<int>(1 + draft.random.below(3))));
  if (draft.random.chance(40)) draft.read(0x1017, 0);
}

void draw_other_heartbeat(Draft& draft) {
  auto& random = draft.random;
  const auto sub = static_cast<std::uint8_t>(1 + random.below(3));
  constexpr std::uint32_t nodes[] = {0x7E, 0x7E, 0x10, 0x7F, 0x00, 0x80};
  const auto node = random.of(nodes);
  constexpr std::uint32_t times[] = {20, 50, 100, 0};
  const auto time = random.of(times);
  if (random.chance(50)) draft.nmt(start);
  if (random.chance(30)) draft.write(0x1029, 1, random.below(4));
  draft.write(0x1016, sub, (node << 16U) | time);
  if (random.chance(30)) draft.write(0x1016, static_cast<std::uint8_t>(sub % 4 + 1), (node << 16U) | 40);
  const auto beats = random.below(4);
  for (std::size_t i = 0; i < beats; ++i) {
    auto beat = can::data_frame(CanId(0x700U + node), {std::uint8_t{5}});
    if (random.chance(10)) beat.remote = true;
    if (random.chance(10)) beat.dlc = random.chance(50) ? std::uint8_t{0} : std::uint8_t{2};
    if (random.chance(10)) beat.data[0] = 0;
    if (random.chance(10)) beat.id ^= 1U;
    draft.add(frame(beat));
    draft.wait(std::chrono::milliseconds(5 + random.below(15)));
  }
  draft.wait(edge(draft, std::chrono::milliseconds(time)));
  draft.wait(30ms);
  if (random.chance(40)) draft.add(frame(can::data_frame(CanId(0x700U + node), {std::uint8_t{5}})));
  draft.read(0x1001, 0);
}

void draw_guarding(Draft& draft) {
  auto& random = draft.random;
  const auto id = CanId(0x700U + draft.words.node.value());
  constexpr std::uint16_t times[] = {0, 10, 20, 50};
  const auto time = random.of(times);
  const auto factor = random.below(4);
  if (random.chance(50)) draft.write(0x1017, 0, 0);
  if (random.chance(40)) draft.nmt(start);
  draft.write(0x100C, 0, time);
  draft.write(0x100D, 0, factor);
  const auto count = 1 + random.below(5);
  for (std::size_t i = 0; i < count; ++i) {
    auto guard = can::remote_frame(
        id, random.chance(80) ? std::uint8_t{1} : static_cast<std::uint8_t>(random.below(9)));
    if (random.chance(8)) guard.id ^= 3U;
    if (random.chance(8)) guard.extended = true;
    draft.add(frame(guard));
    draft.wait(std::chrono::milliseconds(1 + random.below(10)));
    if (random.chance(15)) draft.nmt(random.chance(50) ? start : pre_operational);
    if (random.chance(5)) draft.nmt(reset_communication);
  }
  draft.wait(edge(draft, std::chrono::milliseconds(time) * static_cast<int>(factor)));
  if (random.chance(60)) draft.wait(30ms);
  if (random.chance(50)) draft.add(frame(can::remote_frame(id, 1)));
  if (random.chance(30)) draft.read(0x1001, 0);
}

void draw_errors(Draft& draft) {
  auto& random = draft.random;
  if (draft.words.errors.empty()) return;
  const auto count = 1 + random.below(random.chance(15) ? 10 : 3);
  if (random.chance(15)) draft.write(0x1015, 0, 100 + random.below(400));
  for (std::size_t i = 0; i < count; ++i) {
    const auto& trigger = draft.words.errors[random.below(draft.words.errors.size())];
    const auto& write = random.chance(70) ? trigger.raise : trigger.clear;
    if (write) draft.add(download(write->object, write->bytes));
    if (random.chance(30)) draft.wait(std::chrono::milliseconds(1 + random.below(40)));
  }
  if (random.chance(60)) draft.read(0x1001, 0);
  if (random.chance(60)) draft.read(0x1003, static_cast<std::uint8_t>(random.below(4)));
  if (random.chance(30)) draft.read(0x1003, static_cast<std::uint8_t>(random.below(9)));
  if (random.chance(20)) draft.write(0x1003, 0, random.below(2));
  if (random.chance(20)) draft.read(0x1003, 1);
}

/// Entries that hold a COB-ID.
std::vector<const device::Entry*> cob_ids(const Vocabulary& words) {
  std::vector<const device::Entry*> out;
  for (const auto& entry : words.entries) {
    if (canopen::cob_id_kind(entry.mux) && entry.writable()) out.push_back(&entry);
  }
  return out;
}

void draw_cob_id(Draft& draft) {
  auto& random = draft.random;
  const auto all = cob_ids(draft.words);
  if (all.empty()) return;
  const auto& entry = *all[random.below(all.size())];
  const auto kind = *canopen::cob_id_kind(entry.mux);
  constexpr std::uint32_t ids[] = {0x000, 0x001, 0x07F, 0x080, 0x101, 0x180, 0x181,  0x1F0,
                                   0x281, 0x3F0, 0x581, 0x601, 0x67F, 0x6A0, 0x6B0,  0x6E0,
                                   0x6FF, 0x701, 0x780, 0x7FF, 0x100, 0x800, 0x12345};
  const auto index = entry.mux.index.value();
  const auto sub = entry.mux.sub.value();
  const auto control = canopen::control_mask(kind);
  const auto was = entry.default_value ? static_cast<std::uint32_t>(load_le(*entry.default_value)) : 0U;
  const auto off = canopen::deactivated(kind, CobId(was)).value();
  const auto id = random.of(ids);
  if (random.chance(75)) draft.write(index, sub, off);
  if (random.chance(75)) draft.write(index, sub, (off & ~0x7FFU) | id);
  if (random.chance(20)) draft.write(index, sub, off ^ (1U << (11 + random.below(21))));
  auto on = (off & ~0x7FFU) | id;
  on = control == not_valid && kind != canopen::CobIdKind::sync
           ? on & ~not_valid
           : on | (control & ~(random.chance(50) ? not_valid : 0U));
  if (random.chance(70)) draft.write(index, sub, on);
  if (random.chance(50)) draft.read(index, sub);
  if (random.chance(25)) draft.write(index, sub, on ^ 1U);
  if (random.chance(25)) draft.read(index, sub);
  if (random.chance(30)) draft.nmt(start);
  if (random.chance(20)) draft.nmt(reset_communication);
}

void draw_storage(Draft& draft) {
  auto& random = draft.random;
  constexpr std::uint32_t save = 0x6576'6173, load = 0x6461'6F6C;
  const auto change = [&] {
    draft.write(0x1017, 0, random.below(3) * 50);
    if (random.chance(50)) draft.write(0x2007, 0, random.next() & 0xFFFF'FFFFU);
    if (random.chance(30)) draft.write(0x6206, 1, random.below(256));
    if (random.chance(30)) draft.write(0x1020, 1, random.below(100));
    if (random.chance(20)) draft.write(0x1020, 2, random.below(100));
    if (random.chance(20)) draft.write(0x1800, 1, not_valid | 0x1F0);
    if (random.chance(20)) draft.write(0x1800, 5, random.below(30));
  };
  change();
  const auto index = random.chance(65) ? std::uint16_t{0x1010} : std::uint16_t{0x1011};
  const auto right = index == 0x1010 ? save : load;
  const auto sub = static_cast<std::uint8_t>(random.chance(50) ? 1 : random.below(5));
  if (random.chance(80))
    draft.write(index, sub, random.chance(85) ? right : random.chance(50) ? right ^ 0x20U : 0);
  if (random.chance(10)) draft.add(download({Index(index), SubIndex(sub)}, {'s', 'a', 'v'}));
  if (random.chance(40)) change();
  if (random.chance(50)) draft.read(index, sub);
  if (random.chance(80)) {
    random.chance(25) ? draft.add({.kind = Action::Kind::power})
                      : draft.nmt(random.chance(50) ? reset_node : reset_communication);
    draft.wait(random.chance(50) ? 30ms : 700ms);
  }
  draft.read(0x1017, 0);
  draft.read(0x2007, 0);
  if (random.chance(40)) draft.read(0x1020, 1);
  if (random.chance(40)) draft.read(0x6206, 1);
  if (random.chance(40)) draft.read(0x1800, 1);
}

void draw_reset(Draft& draft) {
  if (draft.random.chance(25)) {
    draft.add({.kind = Action::Kind::power});
    draft.wait(700ms);
  } else {
    draft.nmt(draft.random.chance(50) ? reset_node : reset_communication);
    draft.wait(30ms);
  }
}

void draw_time(Draft& draft) {
  auto& random = draft.random;
  constexpr std::uint32_t uses[] = {0x8000'0100, 0x4000'0100, 0xC000'0100, 0x100};
  if (random.chance(70)) draft.write(0x1012, 0, random.of(uses));
  if (random.chance(40)) draft.nmt(random.chance(70) ? start : stop);
  auto time = can::data_frame(canopen::time_can_id, {std::uint8_t{0}, 0x2E, 0x93, 0x02, 0x10, 0x27});
  time.data[0] = static_cast<std::uint8_t>(random.next());
  if (random.chance(15)) time.data[3] |= 0xF0;
  if (random.chance(10)) time.dlc = static_cast<std::uint8_t>(random.below(9));
  if (random.chance(5)) time.remote = true;
  if (random.chance(70)) draft.add(frame(time));
  if (random.chance(30)) draft.wait(1100ms);
  draft.read(0x2F10, 0);
}

void draw_emergency_consumer(Draft& draft) {
  auto& random = draft.random;
  const auto sub = static_cast<std::uint8_t>(1 + random.below(4));
  const std::uint32_t id = 0x80U + sub;
  if (random.chance(70)) draft.write(0x1028, sub, id);
  auto message = can::data_frame(CanId(id), {0x00, 0x10, 0x01, 0, 0, 0, 0, 0});
  message.data[5] = static_cast<std::uint8_t>(random.next());
  if (random.chance(20)) message.dlc = static_cast<std::uint8_t>(random.below(9));
  draft.add(frame(message));
  draft.read(0x2F11, 0);
}

void draw_commands(Draft& draft) {
  auto& random = draft.random;
  constexpr std::uint16_t objects[] = {0x1023, 0x1025};
  const auto index = random.of(objects);
  if (!draft.words.has(index)) return;
  const Bytes texts[] = {{'t', 'r', 'u', 'e'}, {'e', 'c', 'h', 'o', ' ', 'x'}, {'n', 'o'}};
  if (random.chance(30)) draft.write(0x1024, 0, random.below(5));
  draft.add(download({Index(index), SubIndex(1)}, texts[random.below(3)]));
  if (random.chance(60)) draft.read(index, 2);
  if (random.chance(70)) draft.wait(30ms);
  draft.read(index, 2);
  draft.read(index, 3);
  if (random.chance(40)) draft.write(0x1026, 1, 0x41);
  if (random.chance(40)) draft.read(0x1026, static_cast<std::uint8_t>(random.below(4)));
}

void draw_wait(Draft& draft) {
  constexpr Duration times[] = {1ms, 5ms, 19ms, 20ms, 21ms, 50ms, 100ms, 1000ms};
  draft.wait(draft.random.of(times));
}

constexpr Talk services[] = {
    {"NMT", 8, draw_nmt},
    {"heartbeat", 4, draw_heartbeat},
    {"heartbeats of others", 6, draw_other_heartbeat},
    {"guarding", 6, draw_guarding},
    {"errors", 6, draw_errors},
    {"COB-IDs", 14, draw_cob_id},
    {"SYNC", 4, draw_sync},
    {"SYNC producer", 5, draw_sync_producer},
    {"RPDO", 8, draw_rpdo},
    {"TPDO", 10, draw_tpdo},
    {"storage", 5, draw_storage},
    {"resets", 3, draw_reset},
    {"TIME", 3, draw_time},
    {"emergencies of others", 3, draw_emergency_consumer},
    {"commands", 3, draw_commands},
    {"waiting", 2, draw_wait},
    {"LSS", 8, draw_lss},
    {"other SDO channels", 5, draw_channels},
};

}  // namespace

Duration talk::edge(Draft& draft, Duration time) {
  constexpr Duration by[] = {-1ms, 0ms, 1ms, 5ms};
  return std::max(Duration(1ms), time + draft.random.of(by));
}

std::span<const Talk> talks_of_services() { return services; }

}  // namespace conform::explore
