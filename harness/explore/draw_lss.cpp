// SPDX-License-Identifier: Apache-2.0
// Talk about layer setting services (CiA 305): states, the identity part by part, node-ID and bit rate.
#include <algorithm>
#include <array>
#include <chrono>
#include <vector>

#include "canopen/cob_id.hpp"
#include "canopen/lss.hpp"
#include "explore/draw_talk.hpp"

namespace conform::explore {

using namespace std::chrono_literals;
using canopen::LssAddress;
using canopen::LssCommand;

namespace {

constexpr std::uint8_t no_node_id = canopen::lss_no_node_id;

/// 1018h as it is described; 0 where it is not.
LssAddress address_of(const Vocabulary& words) {
  LssAddress out{};
  for (std::uint8_t part = 0; part < canopen::lss_parts; ++part) {
    const auto* entry = words.find({Index(0x1018), SubIndex(static_cast<std::uint8_t>(part + 1))});
    if (entry != nullptr && entry->default_value)
      out[part] = static_cast<std::uint32_t>(load_le(*entry->default_value));
  }
  return out;
}

void ask(Draft& draft, can::Frame request) {
  auto& random = draft.random;
  if (random.chance(3)) request.dlc = static_cast<std::uint8_t>(random.below(8));
  if (random.chance(2)) request.remote = true;
  if (random.chance(2)) request.extended = true;
  draft.add(frame(request));
}

void ask(Draft& draft, LssCommand command, std::uint8_t first = 0, std::uint8_t second = 0) {
  ask(draft, canopen::encode_lss(command, first, second));
}

LssCommand command_behind(LssCommand first, std::size_t by) {
  return static_cast<LssCommand>(static_cast<std::uint8_t>(first) + by);
}

/// Near to a number: a bit more or less, a half.
std::uint32_t beside(Random& random, std::uint32_t number) {
  switch (random.below(5)) {
    case 0: return number + 1;
    case 1: return number - 1;
    case 2: return number ^ 0x8000'0000U;
    case 3: return number ^ (1U << random.below(32));
    default: return static_cast<std::uint32_t>(random.next());
  }
}

/// The four parts of an address, in half of all cases with one thing wrong.
void draw_selection(Draft& draft) {
  auto& random = draft.random;
  auto frames = canopen::encode_lss_selection(address_of(draft.words));
  const auto at = random.below(frames.size());
  switch (random.below(9)) {
    case 0:
    case 1:
      frames[at] = canopen::encode_lss_number(command_behind(LssCommand::select_vendor, at),
                                              beside(random, address_of(draft.words)[at]));
      break;
    case 2: frames.erase(frames.begin() + static_cast<std::ptrdiff_t>(at)); break;
    case 3: std::swap(frames[at], frames[(at + 1) % frames.size()]); break;
    case 4: {
      // One that was begun only, before the right one.
      const auto begun = std::vector<can::Frame>(frames.begin(), frames.begin() + 1);
      frames.insert(frames.begin(), begun.begin(), begun.end());
      break;
    }
    default: break;
  }
  for (const auto& each : frames) ask(draft, each);
}

void draw_inquiries(Draft& draft) {
  const auto count = 1 + draft.random.below(3);
  for (std::size_t i = 0; i < count; ++i) {
    ask(draft, draft.random.chance(40) ? LssCommand::inquire_node_id
                                       : command_behind(LssCommand::inquire_vendor, draft.random.below(4)));
  }
}

/// Ranges around the own identity, in some cases beside it.
void draw_identify(Draft& draft) {
  auto& random = draft.random;
  const auto own = address_of(draft.words);
  std::array<std::uint32_t, 6> named{own[0], own[1], own[2], own[2], own[3], own[3]};
  if (random.chance(40)) {
    named[2] = named[4] = 0;
    named[3] = named[5] = 0xFFFF'FFFFU;
  }
  if (random.chance(50)) {
    const auto at = random.below(named.size());
    named[at] = at < 2 || random.chance(20) ? beside(random, named[at])
                : random.chance(50)         ? named[at] + 1
                                            : named[at] - 1;
  }
  const auto first = random.chance(85) ? std::size_t{0} : random.below(named.size());
  const auto until = random.chance(85) ? named.size() : random.below(named.size());
  for (auto i = first; i < until; ++i)
    ask(draft, canopen::encode_lss_number(command_behind(LssCommand::identify_vendor, i), named[i]));
}

/// Bit by bit is long: a few bits of each part, as a master does that knows the rest already.
void draw_fastscan(Draft& draft) {
  auto& random = draft.random;
  const auto own = address_of(draft.words);
  if (random.chance(90)) ask(draft, canopen::encode(canopen::LssFastscan{0, 0x80, 0, 0}));
  const auto parts = random.chance(70) ? std::uint8_t{4} : static_cast<std::uint8_t>(random.below(5));
  for (std::uint8_t part = 0; part < parts; ++part) {
    if (random.chance(25)) {
      const auto bit = static_cast<std::uint8_t>(random.chance(80) ? random.below(32) : random.below(256));
      ask(draft, canopen::encode(canopen::LssFastscan{
                     random.chance(70) ? own[part] : own[part] ^ (1U << (bit % 32U)), bit, part, part}));
    }
    const auto next = static_cast<std::uint8_t>((part + 1) % canopen::lss_parts);
    const auto named = random.chance(8) ? beside(random, own[part]) : own[part];
    const auto told = random.chance(8) ? static_cast<std::uint8_t>(random.below(6)) : part;
    ask(draft, canopen::encode(canopen::LssFastscan{named, 0, told, next}));
  }
}

void draw_odd_command(Draft& draft) {
  constexpr std::uint8_t odd[] = {0x00, 0x01, 0x03, 0x05, 0x10, 0x12, 0x14, 0x18, 0x3F,
                                  0x44, 0x45, 0x4D, 0x4F, 0x50, 0x52, 0x59, 0x5F, 0x60,
                                  0x84, 0x91, 0xCC, 0xDA, 0xDE, 0xD1, 0xFF};
  ask(draft, canopen::encode_lss(static_cast<LssCommand>(draft.random.of(odd)), 1));
}

/// A request to the SDO server of a node-ID that the device may have now.
void ask_as(Draft& draft, std::uint8_t node) {
  constexpr std::uint16_t objects[] = {0x1000, 0x1014, 0x1200, 0x1400, 0x1800};
  const auto index = draft.random.of(objects);
  const std::uint8_t sub = index >= 0x1200 ? 1 : 0;
  const auto read =
      can::data_frame(CanId(0x600U + node), {0x40, static_cast<std::uint8_t>(index & 0xFFU),
                                             static_cast<std::uint8_t>(index >> 8U), sub, 0, 0, 0, 0});
  draft.add(node == draft.words.node.value() ? request(read) : frame(read));
}

/// How a device is told to begin with what was configured.
void restart(Draft& draft) {
  auto& random = draft.random;
  if (random.chance(25)) {
    draft.add({.kind = Action::Kind::power});
    draft.wait(700ms);
    return;
  }
  draft.send(0, {random.chance(70) ? talk::reset_communication : talk::reset_node, 0});
  draft.wait(40ms);
}

/// So that there is somebody to talk to.
void give_back_node_id(Draft& draft) {
  ask(draft, LssCommand::switch_global, 1);
  ask(draft, LssCommand::configure_node_id, draft.words.node.value());
  ask(draft, LssCommand::switch_global, 0);
  draft.wait(30ms);
  if (draft.random.chance(40)) ask_as(draft, draft.words.node.value());
  draft.send(0, {talk::reset_communication, 0});
  draft.wait(40ms);
}

void draw_node_id(Draft& draft) {
  auto& random = draft.random;
  constexpr std::uint8_t ids[] = {2, 3, 32, 63, 64, 100, 126, 127, 0, 128, 129, 200, 254};
  const auto node = random.chance(15) ? static_cast<std::uint8_t>(random.below(256)) : random.of(ids);
  if (random.chance(90)) ask(draft, LssCommand::switch_global, 1);
  ask(draft, LssCommand::configure_node_id, node);
  if (random.chance(40)) {
    // Another value is no worse, and is asked for without the rest.
    ask(draft, LssCommand::configure_node_id, random.of(ids));
    ask(draft, LssCommand::configure_node_id, node);
  }
  if (random.chance(30)) ask(draft, LssCommand::inquire_node_id);
  if (random.chance(25)) ask(draft, LssCommand::store);
  if (random.chance(50)) ask(draft, LssCommand::switch_global, 0);
  if (random.chance(30)) ask_as(draft, draft.words.node.value());
  if (random.chance(75)) restart(draft);
  const auto count = random.below(4);
  for (std::size_t i = 0; i < count; ++i) {
    if (random.chance(80)) {
      ask_as(draft, node);
    } else {
      draft.add(frame(can::remote_frame(CanId(0x700U + (node & 0x7FU)), 1)));
    }
  }
  if (random.chance(30)) draw_inquiries(draft);
  give_back_node_id(draft);
}

/// What only a slave without node-ID does.
void draw_unconfigured(Draft& draft) {
  auto& random = draft.random;
  ask(draft, LssCommand::switch_global, 1);
  ask(draft, LssCommand::configure_node_id, no_node_id);
  if (random.chance(20)) ask(draft, LssCommand::store);
  restart(draft);
  const auto count = 1 + random.below(4);
  for (std::size_t i = 0; i < count; ++i) {
    switch (random.below(7)) {
      case 0: ask(draft, LssCommand::identify_non_configured); break;
      case 1: draw_selection(draft); break;
      case 2: draw_odd_command(draft); break;
      case 3: ask(draft, LssCommand::switch_global, 1); break;
      default: draw_fastscan(draft); break;
    }
    if (random.chance(50)) ask(draft, LssCommand::inquire_node_id);
    if (random.chance(40)) ask(draft, LssCommand::switch_global, 0);
  }
  give_back_node_id(draft);
}

void draw_bit_timing(Draft& draft) {
  auto& random = draft.random;
  const auto table = random.chance(80) ? std::uint8_t{0} : static_cast<std::uint8_t>(random.below(256));
  const auto index = random.chance(85) ? random.below(10) : random.below(256);
  ask(draft, LssCommand::configure_bit_timing, table, static_cast<std::uint8_t>(index));
}

void draw_change_of_state(Draft& draft) {
  auto& random = draft.random;
  constexpr std::uint8_t modes[] = {1, 1, 1, 0, 0, 2, 3, 0x80, 0x81, 0xFF};
  switch (random.below(6)) {
    case 0: draft.nmt(talk::stop); break;
    case 1: draft.nmt(talk::pre_operational); break;
    case 2: draft.nmt(random.chance(50) ? talk::reset_communication : talk::reset_node); break;
    default: return ask(draft, LssCommand::switch_global, random.of(modes));
  }
  draft.wait(40ms);
}

/// In the configuration state.
void draw_configuration(Draft& draft) {
  auto& random = draft.random;
  random.chance(75) ? ask(draft, LssCommand::switch_global, 1) : draw_selection(draft);
  const auto count = 1 + random.below(5);
  for (std::size_t i = 0; i < count; ++i) {
    switch (random.below(6)) {
      case 0:
      case 1: draw_bit_timing(draft); break;
      case 2: draw_odd_command(draft); break;
      case 3: draw_change_of_state(draft); break;
      default: draw_inquiries(draft); break;
    }
  }
  if (random.chance(50)) ask(draft, LssCommand::inquire_node_id);
}

/// In the waiting state, from which some of it leads into the other.
void draw_waiting(Draft& draft) {
  auto& random = draft.random;
  const auto count = 1 + random.below(3);
  for (std::size_t i = 0; i < count; ++i) {
    switch (random.below(10)) {
      case 0: ask(draft, LssCommand::identify_non_configured); break;
      case 1: draw_fastscan(draft); break;
      case 2: draw_odd_command(draft); break;
      case 3: draw_change_of_state(draft); break;
      case 4: draw_inquiries(draft); break;
      case 5:
      case 6: draw_identify(draft); break;
      default: draw_selection(draft); break;
    }
    if (random.chance(60)) ask(draft, LssCommand::inquire_node_id);
    if (random.chance(40)) ask(draft, LssCommand::switch_global, 0);
  }
}

}  // namespace

void talk::draw_lss(Draft& draft) {
  if (!draft.words.lss) return;
  auto& random = draft.random;
  switch (random.below(8)) {
    case 0:
    case 1: return draw_node_id(draft);
    case 2: return draw_unconfigured(draft);
    case 3:
    case 4: draw_configuration(draft); break;
    default: draw_waiting(draft); break;
  }
  if (random.chance(10)) draft.read(0x1000, 0);
  if (random.chance(70)) ask(draft, LssCommand::switch_global, 0);
}

}  // namespace conform::explore
