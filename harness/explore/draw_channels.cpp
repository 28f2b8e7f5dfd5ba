// SPDX-License-Identifier: Apache-2.0
// Talk on the channels of additional SDO servers (1201h and up): opened by their COB-IDs, asked frame by
// frame, so that what is served there and on the default channel may be interleaved.
#include <algorithm>
#include <chrono>

#include "canopen/cob_id.hpp"
#include "explore/draw_talk.hpp"

namespace conform::explore {

using namespace std::chrono_literals;

namespace {

using device::Entry;

struct Channel {
  std::uint16_t index;
  std::uint32_t request, response;
};

void send(Draft& draft, const Channel& channel, std::uint8_t command, Multiplexer object,
          std::uint32_t value = 0) {
  auto out = can::data_frame(
      CanId(channel.request),
      {command, static_cast<std::uint8_t>(object.index.value() & 0xFFU),
       static_cast<std::uint8_t>(object.index.value() >> 8U), object.sub.value(), 0, 0, 0, 0});
  for (unsigned i = 0; i < 4; ++i) out.data[4 + i] = static_cast<std::uint8_t>(value >> (8 * i));
  if (draft.random.chance(4)) out.id ^= 1U << draft.random.below(4);
  draft.add(frame(out));
}

void go_on(Draft& draft, const Channel& channel, std::uint8_t command) {
  draft.add(frame(can::data_frame(CanId(channel.request), {command, 0, 0, 0, 0, 0, 0, 0})));
}

const Entry* some_entry(Draft& draft, bool (*wanted)(const Entry&)) {
  for (int i = 0; i < 40; ++i) {
    const auto& entry = draft.words.entries[draft.random.below(draft.words.entries.size())];
    if (wanted(entry)) return &entry;
  }
  return nullptr;
}

bool is_long(const Entry& entry) { return entry.readable() && entry.size().value_or(8) > 4; }
bool is_number(const Entry& entry) {
  return entry.readable() && entry.writable() && entry.size().value_or(8) <= 4 && !entry.command &&
         entry.mux.index.value() >= 0x2000;
}
bool can_be_read(const Entry& entry) { return entry.readable(); }

/// A segmented upload, in the middle of which something else may be asked on the default channel.
void upload_long(Draft& draft, const Channel& channel) {
  auto& random = draft.random;
  const auto* entry = some_entry(draft, is_long);
  if (entry == nullptr) return;
  send(draft, channel, 0x40, entry->mux);
  const auto count = 1 + random.below(4);
  for (std::size_t i = 0; i < count; ++i) {
    if (random.chance(35)) {
      const auto* other = random.chance(50) ? some_entry(draft, is_long) : some_entry(draft, can_be_read);
      if (other != nullptr) draft.add(upload(other->mux));
    }
    go_on(draft, channel, i % 2 == 0 ? 0x60 : 0x70);
  }
  if (random.chance(40)) go_on(draft, channel, 0x80);
}

void change_number(Draft& draft, const Channel& channel) {
  const auto* entry = some_entry(draft, is_number);
  if (entry == nullptr) return;
  const auto size = static_cast<unsigned>(entry->size().value_or(4));
  const auto command = static_cast<std::uint8_t>(0x23U | ((4U - size) << 2U));
  send(draft, channel, command, entry->mux, static_cast<std::uint32_t>(draft.random.below(100)));
  if (draft.random.chance(60)) draft.add(upload(entry->mux));
}

}  // namespace

void talk::draw_channels(Draft& draft) {
  auto& random = draft.random;
  // None of these is what other talk gives to other services.
  const Channel channels[] = {{0x1201, 0x690, 0x684}, {0x1202, 0x6C8, 0x6D4}};
  const auto& channel = channels[random.chance(80) ? 0 : 1];
  const auto* first = draft.words.find({Index(channel.index), SubIndex(1)});
  if (first == nullptr || !first->writable()) return;
  if (random.chance(25)) {
    draft.write(channel.index, 1, talk::not_valid | channel.request);
    draft.write(channel.index, 2, talk::not_valid | channel.response);
  }
  if (random.chance(90)) draft.write(channel.index, 1, channel.request);
  if (random.chance(90)) draft.write(channel.index, 2, channel.response);
  const auto count = 1 + random.below(4);
  for (std::size_t i = 0; i < count; ++i) {
    switch (random.below(5)) {
      case 0: upload_long(draft, channel); break;
      case 1: change_number(draft, channel); break;
      case 2: draft.read(channel.index, static_cast<std::uint8_t>(random.below(4))); break;
      default:
        if (const auto* entry = some_entry(draft, can_be_read)) send(draft, channel, 0x40, entry->mux);
        break;
    }
    if (random.chance(30)) draft.read(0x1000, 0);
  }
  if (random.chance(30)) {
    draft.nmt(random.chance(70) ? reset_communication : reset_node);
    draft.wait(40ms);
    draft.read(channel.index, 1);
    send(draft, channel, 0x40, {Index(0x1000), SubIndex(0)});
  } else if (random.chance(40)) {
    const bool request = random.chance(50);
    draft.write(channel.index, request ? 1 : 2,
                talk::not_valid | (request ? channel.request : channel.response));
    send(draft, channel, 0x40, {Index(0x1000), SubIndex(0)});
  }
}

}  // namespace conform::explore
