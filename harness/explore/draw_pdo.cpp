// SPDX-License-Identifier: Apache-2.0
// Talk about SYNC and PDOs.
#include <algorithm>
#include <chrono>

#include "canopen/cob_id.hpp"
#include "canopen/pdo.hpp"
#include "explore/draw_talk.hpp"

namespace conform::explore {

using namespace std::chrono_literals;
using namespace talk;

void talk::draw_sync(Draft& draft) {
  auto& random = draft.random;
  const auto count = 1 + random.below(5);
  const bool counts = random.chance(20);
  for (std::size_t i = 0; i < count; ++i) {
    can::Frame sync = can::data_frame(canopen::sync_can_id, {});
    if (counts) sync = can::data_frame(canopen::sync_can_id, {static_cast<std::uint8_t>(i + 1)});
    if (random.chance(5)) sync.remote = true;
    if (random.chance(5)) sync.extended = true;
    if (random.chance(5)) sync.dlc = static_cast<std::uint8_t>(random.below(9));
    draft.add(frame(sync));
    draft.wait(std::chrono::milliseconds(1 + random.below(5)));
  }
}

void talk::draw_sync_producer(Draft& draft) {
  auto& random = draft.random;
  constexpr std::uint32_t periods[] = {0, 1000, 5000, 10000, 25000, 33333};
  const auto period = random.of(periods);
  if (random.chance(30)) {
    draft.write(0x1006, 0, 0);
    constexpr std::uint8_t overflows[] = {0, 1, 2, 3, 10, 240, 241};
    draft.write(0x1019, 0, random.of(overflows));
  }
  if (random.chance(80)) draft.write(0x1006, 0, period);
  if (random.chance(80)) draft.write(0x1005, 0, 0x4000'0080);
  if (random.chance(40)) draft.nmt(random.chance(80) ? start : stop);
  draft.wait(std::chrono::milliseconds(10 + random.below(60)));
  if (random.chance(30)) draft.write(0x1006, 0, random.of(periods));
  if (random.chance(30)) draft.wait(30ms);
  if (random.chance(30)) draft.write(0x1005, 0, 0x80);
}

namespace {

/// One of the PDOs the vocabulary has, 0 to 3; 4: none was found.
std::uint16_t pdo(Draft& draft, std::uint16_t first) {
  for (int i = 0; i < 8; ++i) {
    const auto number = static_cast<std::uint16_t>(draft.random.chance(50) ? 0 : draft.random.below(4));
    if (draft.words.has(static_cast<std::uint16_t>(first + number), 1)) return number;
  }
  return 4;
}

std::uint32_t transmission_type(Random& random) {
  constexpr std::uint8_t types[] = {0, 1, 1, 2, 3, 5, 240, 241, 251, 252, 253, 254, 255, 255};
  return random.of(types);
}

/// A mapping of whole entries, sometimes of what cannot be mapped.
void draw_mapping(Draft& draft, std::uint16_t index) {
  auto& random = draft.random;
  std::vector<std::uint32_t> mappable;
  for (const auto& entry : draft.words.entries) {
    const bool fits = index < 0x1A00 ? entry.writable() : entry.readable();
    if (!entry.pdo_mappable || !fits || !entry.size()) continue;
    mappable.push_back(canopen::mapping_entry(entry.mux, 8 * *entry.size()));
  }
  if (mappable.empty()) return;
  if (random.chance(90)) draft.write(index, 0, 0);
  const auto count = 1 + random.below(random.chance(15) ? 9 : 4);
  for (std::size_t i = 1; i <= count; ++i) {
    auto value = mappable[random.below(mappable.size())];
    constexpr std::uint32_t odd[] = {0x1000'0020, 0x1234'0108, 0x6200'0908, 0x6200'0110,
                                     0x0005'0008, 0x6200'0104, 0x0000'0000, 0x1017'0010};
    if (random.chance(8)) value = random.of(odd);
    draft.write(index, static_cast<std::uint8_t>(i), value);
  }
  draft.write(index, 0, random.chance(90) ? count : random.below(256));
  if (random.chance(20)) draft.read(index, static_cast<std::uint8_t>(random.below(count + 1)));
}

void send_rpdo(Draft& draft, std::uint32_t number) {
  auto& random = draft.random;
  can::Frame data;
  data.id = 0x200U + 0x100U * number + draft.words.node.value();
  constexpr std::uint8_t lengths[] = {4, 4, 8, 8, 6, 5, 3, 1, 0};
  data.dlc = random.of(lengths);
  for (auto& byte : data.data) byte = static_cast<std::uint8_t>(random.next());
  if (random.chance(4)) data.remote = true;
  if (random.chance(4)) data.extended = true;
  draft.add(frame(data));
}

}  // namespace

void talk::draw_rpdo(Draft& draft) {
  auto& random = draft.random;
  const auto number = pdo(draft, 0x1400);
  if (number == 4) return;
  const auto parameters = static_cast<std::uint16_t>(0x1400 + number);
  const auto on = 0x200U + 0x100U * number + draft.words.node.value();
  if (random.chance(30)) {
    if (random.chance(80)) draft.write(parameters, 1, not_valid | on);
    if (random.chance(60)) draft.write(parameters, 2, transmission_type(random));
    if (random.chance(30)) draft.write(parameters, 5, random.chance(50) ? 20 : 0);
    if (random.chance(30)) draw_mapping(draft, static_cast<std::uint16_t>(0x1600 + number));
    draft.write(parameters, 1, on);
  }
  if (random.chance(70)) draft.nmt(start);
  const auto count = 1 + random.below(3);
  for (std::size_t i = 0; i < count; ++i) {
    send_rpdo(draft, number);
    if (random.chance(40)) draw_sync(draft);
    if (random.chance(30)) draft.wait(edge(draft, 20ms));
  }
  if (random.chance(40))
    draft.read(random.chance(50) ? 0x6200 : 0x6411, static_cast<std::uint8_t>(1 + random.below(2)));
}

void talk::draw_tpdo(Draft& draft) {
  auto& random = draft.random;
  const auto number = pdo(draft, 0x1800);
  if (number == 4) return;
  const auto parameters = static_cast<std::uint16_t>(0x1800 + number);
  const auto on =
      (random.chance(50) ? 0x4000'0000U : 0U) + 0x180U + 0x100U * number + draft.words.node.value();
  if (random.chance(85)) draft.write(parameters, 1, not_valid | on);
  if (random.chance(80)) draft.write(parameters, 2, transmission_type(random));
  if (random.chance(30)) draft.write(parameters, 3, random.chance(70) ? 100 + random.below(300) : 0);
  if (random.chance(40)) draft.write(parameters, 5, random.chance(70) ? 5 + random.below(40) : 0);
  if (random.chance(15)) draft.write(parameters, 6, random.below(5));
  if (random.chance(25)) draw_mapping(draft, static_cast<std::uint16_t>(0x1A00 + number));
  if (random.chance(90)) draft.write(parameters, 1, on);
  if (random.chance(80)) draft.nmt(start);
  const auto count = 1 + random.below(4);
  for (std::size_t i = 0; i < count; ++i) {
    switch (random.below(5)) {
      case 0: draw_sync(draft); break;
      case 1: send_rpdo(draft, number); break;
      case 2: draft.write(0x6200, static_cast<std::uint8_t>(1 + random.below(8)), random.below(256)); break;
      case 3:
        draft.add(frame(can::remote_frame(CanId(0x180U + 0x100U * number + draft.words.node.value()),
                                          static_cast<std::uint8_t>(random.below(9)))));
        break;
      default: draft.wait(edge(draft, std::chrono::milliseconds(5 + random.below(45)))); break;
    }
  }
  if (random.chance(20)) draft.read(parameters, static_cast<std::uint8_t>(1 + random.below(6)));
  if (random.chance(15)) draft.nmt(random.chance(50) ? pre_operational : stop);
  if (random.chance(30)) draw_sync(draft);
}

}  // namespace conform::explore
