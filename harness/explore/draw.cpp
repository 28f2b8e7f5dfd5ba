// SPDX-License-Identifier: Apache-2.0
#include "explore/draw.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "canopen/cob_id.hpp"

namespace conform::explore {
namespace {

using device::Entry;

std::span<const Entry> all_of(const Draft& draft) { return draft.words.entries; }

/// An entry for which `wanted` holds, or any if luck does not find one soon.
template <typename F>
const Entry& entry_where(Draft& draft, F wanted) {
  for (int i = 0; i < 30; ++i) {
    const auto& entry = draft.random.of(all_of(draft));
    if (wanted(entry)) return entry;
  }
  return draft.random.of(all_of(draft));
}

bool is_long(const Entry& entry) { return entry.size().value_or(8) > 4; }

Bytes random_bytes(Random& random, std::size_t size) {
  Bytes out(size);
  for (auto& byte : out) byte = static_cast<std::uint8_t>(random.next());
  return out;
}

/// Visible characters are right for texts, and bytes for all else.
Bytes free_value(Random& random, const Entry& entry) {
  constexpr std::size_t sizes[] = {0, 1, 4, 5, 6, 7, 8, 13, 14, 15, 20, 21, 22, 28, 32};
  auto out = random_bytes(random, random.of(sizes));
  if (entry.type == canopen::DataType::visible_string) {
    for (auto& byte : out) byte = static_cast<std::uint8_t>('a' + byte % 26);
  }
  if (entry.type == canopen::DataType::domain && random.chance(30))
    out = random_bytes(random, 100 + random.below(900));
  return out;
}

/// Limits and what lies beside them, the default, few bits and many.
Bytes value_for(Draft& draft, const Entry& entry) {
  auto& random = draft.random;
  const auto size = entry.size();
  if (!size) return free_value(random, entry);
  const auto beside = [&](const Bytes& limit, std::uint64_t by) { return to_le(load_le(limit) + by, *size); };
  switch (random.below(9)) {
    case 0:
      if (entry.low) return beside(*entry.low, random.chance(50) ? ~std::uint64_t{0} : 0);
      break;
    case 1:
      if (entry.high) return beside(*entry.high, random.chance(50) ? 1 : 0);
      break;
    case 2:
      if (entry.default_value && entry.default_value->size() == *size) return *entry.default_value;
      break;
    case 3: return to_le(random.below(4), *size);
    case 4: return Bytes(*size, 0xFF);
    case 5:
      if (entry.default_value && entry.default_value->size() == *size) {
        auto out = *entry.default_value;
        out[random.below(out.size())] ^= static_cast<std::uint8_t>(1U << random.below(8));
        return out;
      }
      break;
    case 6: return to_le(std::uint64_t{1} << random.below(8 * std::min<std::size_t>(*size, 8)), *size);
    case 7: return to_le(2 + random.below(100), *size);
    default: break;
  }
  return random_bytes(random, *size);
}

Transfer transfer_for(Random& random, bool upload, std::size_t size) {
  if (random.chance(50)) return Transfer::automatic;
  if (upload) return random.chance(60) ? Transfer::block : Transfer::automatic;
  constexpr Transfer small[] = {Transfer::expedited_unsized, Transfer::segmented, Transfer::segmented_unsized,
                                Transfer::block, Transfer::block_unsized};
  constexpr Transfer large[] = {Transfer::segmented, Transfer::segmented_unsized, Transfer::block,
                                Transfer::block_unsized};
  return size >= 1 && size <= 4 ? random.of(small) : random.of(large);
}

void draw_read(Draft& draft) {
  const auto& entry = draft.random.of(all_of(draft));
  auto action = upload(entry.mux, transfer_for(draft.random, true, 0));
  if (action.transfer == Transfer::block && draft.random.chance(50)) {
    constexpr std::uint8_t sizes[] = {0, 1, 2, 3, 20, 126, 127, 128, 255};
    action.blksize = draft.random.of(sizes);
  }
  draft.add(std::move(action));
  if (draft.random.chance(20)) draft.add(upload(entry.mux));
}

void draw_write(Draft& draft) {
  const auto& entry = entry_where(draft, [](const Entry& each) { return each.writable(); });
  auto value = value_for(draft, entry);
  const auto transfer = transfer_for(draft.random, false, value.size());
  draft.add(download(entry.mux, std::move(value), transfer));
  if (entry.readable()) draft.add(upload(entry.mux));
}

void draw_wrong_access(Draft& draft) {
  auto& random = draft.random;
  const auto& entry = random.of(all_of(draft));
  auto mux = entry.mux;
  auto size = entry.size().value_or(4);
  constexpr std::uint16_t absent[] = {0x0000, 0x0001, 0x0300, 0x0400, 0x0FFF, 0x1004, 0x100B, 0x1011,
                                      0x1030, 0x11FF, 0x1404, 0x15FF, 0x1804, 0x1FFF, 0x2FFF, 0x5FFF,
                                      0x6FFF, 0x9FFF, 0xA000, 0xBFFF, 0xC000, 0xFFFF};
  const bool upload_it = random.chance(50);
  switch (random.below(5)) {
    case 0: mux = {Index(random.of(absent)), SubIndex(static_cast<std::uint8_t>(random.below(3)))}; break;
    case 1: {
      constexpr std::uint8_t subs[] = {1, 2, 4, 5, 6, 7, 9, 0x1C, 0x40, 0x41, 0x7F, 0x80, 0xFE, 0xFF};
      mux.sub = SubIndex(random.of(subs));
      break;
    }
    case 2: {
      const auto& refused =
          entry_where(draft, [](const Entry& each) { return !each.writable() || !each.readable(); });
      const auto bytes = refused.size().value_or(4);
      if (!refused.readable()) return draft.add(upload(refused.mux, transfer_for(random, true, 0)));
      draft.add(download(refused.mux, value_for(draft, refused), transfer_for(random, false, bytes)));
      return draft.add(upload(refused.mux));
    }
    default: {
      const auto& written =
          entry_where(draft, [](const Entry& each) { return each.writable() && each.size(); });
      const auto right = written.size().value_or(4);
      auto value = value_for(draft, written);
      constexpr std::size_t lengths[] = {1, 2, 3, 4, 5, 8, 9};
      auto wrong = random.of(lengths);
      if (wrong == right) ++wrong;
      value.resize(wrong);
      draft.add(download(written.mux, std::move(value), transfer_for(random, false, wrong)));
      if (written.readable()) draft.add(upload(written.mux));
      return;
    }
  }
  if (upload_it) {
    draft.add(upload(mux, transfer_for(random, true, 0)));
  } else {
    draft.add(download(mux, random_bytes(random, size), transfer_for(random, false, size)));
  }
}

std::string fault_of(Random& random, bool upload_it, bool block) {
  const auto k = std::to_string(1 + random.below(3));
  if (!block) {
    const std::string segmented[] = {"wrong toggle in segment " + k,
                                     "repeat segment " + k,
                                     "short segment " + k,
                                     "reserved bits in segment " + k,
                                     "abort after segment " + k,
                                     "new initiate after segment " + k,
                                     "silence after segment " + k,
                                     "reserved bits in initiate",
                                     "short initiate",
                                     "lose segment " + k,
                                     "abort after segment 0",
                                     "new initiate after segment 0",
                                     "silence after segment 0",
                                     "reserved bytes in initiate",
                                     "reserved bytes in segment " + k,
                                     "no end",
                                     "unused bytes " + std::to_string(random.below(8))};
    return segmented[random.below(upload_it ? std::size(segmented) - 2 : std::size(segmented))];
  }
  if (upload_it) {
    const std::string uploads[] = {"lose segment " + k,
                                   "acknowledge " + std::to_string(random.below(130)) + " in sub-block 1",
                                   "blksize " + std::to_string(random.below(130)) + " from sub-block 2",
                                   "abort after segment " + k,
                                   "new initiate after segment " + k,
                                   "silence after segment " + k,
                                   "abort instead of end",
                                   "no end",
                                   "reserved bits in acknowledge 1",
                                   "reserved bytes in end",
                                   "short end",
                                   "new initiate instead of end",
                                   "reserved bits in start",
                                   "silence after segment 0",
                                   "abort after segment 0",
                                   "reserved bits in initiate"};
    return uploads[random.below(std::size(uploads))];
  }
  const std::string downloads[] = {"lose segment " + k,
                                   "repeat segment " + k,
                                   "swap segments 1 and 2",
                                   "number segment " + k + " as " + std::to_string(random.below(128)),
                                   "wrong crc",
                                   "unused bytes " + std::to_string(random.below(8)),
                                   "short segment " + k,
                                   "abort after segment " + k,
                                   "new initiate after segment " + k,
                                   "silence after segment " + k,
                                   "no end",
                                   "abort instead of end",
                                   "short end",
                                   "new initiate instead of end",
                                   "reserved bits in end",
                                   "silence after segment 0",
                                   "reserved bits in initiate",
                                   "reserved bytes in initiate"};
  return downloads[random.below(std::size(downloads))];
}

void draw_fault(Draft& draft) {
  auto& random = draft.random;
  const bool upload_it = random.chance(50);
  const auto& entry = entry_where(draft, [&](const Entry& each) {
    return is_long(each) && (upload_it ? each.readable() : each.writable());
  });
  const bool block = random.chance(50);
  Action action = upload_it ? upload(entry.mux) : download(entry.mux, value_for(draft, entry));
  if (block) action.transfer = Transfer::block;
  if (!block && !upload_it) action.transfer = Transfer::segmented;
  if (block && upload_it && random.chance(60)) {
    constexpr std::uint8_t sizes[] = {1, 2, 3, 10};
    action.blksize = random.of(sizes);
  }
  action.fault = fault_of(random, upload_it, block);
  const auto object = action.object;
  draft.add(std::move(action));
  if (random.chance(30)) {
    constexpr Duration pauses[] = {std::chrono::milliseconds(110), std::chrono::milliseconds(600),
                                   std::chrono::milliseconds(1100), std::chrono::milliseconds(1500)};
    draft.wait(random.of(pauses));
  }
  if (random.chance(40)) {
    constexpr std::uint8_t late[] = {0x60, 0x70, 0x00, 0x11, 0xA1, 0xA2, 0xA3, 0xC1};
    const auto id = canopen::connection_set(draft.words.node).sdo_request;
    draft.add(request(can::data_frame(id, {random.of(late), 0, 0, 0, 0, 0, 0, 0})));
  }
  if (entry.readable()) draft.add(upload(object));
}

void draw_request(Draft& draft) {
  auto& random = draft.random;
  const auto own = canopen::connection_set(draft.words.node).sdo_request;
  const auto& entry = random.of(all_of(draft));
  const auto index = entry.mux.index.value();
  constexpr std::uint8_t commands[] = {0x40, 0x5F, 0x48, 0x60, 0x70, 0x00, 0x10, 0x01, 0x11, 0x0F, 0x80,
                                       0x9F, 0xA0, 0xA1, 0xA2, 0xA3, 0xC0, 0xC1, 0xE0, 0xFF, 0xE5, 0x20,
                                       0x21, 0x22, 0x23, 0x2F, 0x33, 0x3F, 0xA4, 0xC4, 0xC6};
  const auto command = random.of(commands);
  auto frame =
      can::data_frame(own, {command, static_cast<std::uint8_t>(index & 0xFFU),
                            static_cast<std::uint8_t>(index >> 8U), entry.mux.sub.value(), 0, 0, 0, 0});
  if (random.chance(20)) frame.data[4 + random.below(4)] = static_cast<std::uint8_t>(random.next());
  switch (random.below(8)) {
    case 0: frame.dlc = static_cast<std::uint8_t>(random.below(8)); break;
    case 1: {
      constexpr std::uint32_t ids[] = {0x600, 0x602, 0x67F, 0x581, 0x582};
      frame.id =
          random.chance(40) ? canopen::connection_set(draft.words.node).sdo_response.value() : random.of(ids);
      break;
    }
    case 2: frame.extended = true; break;
    case 3: frame.remote = true; break;
    default: break;
  }
  draft.add(request(frame));
  if (random.chance(40)) draft.add(request(can::data_frame(own, {0x40, 0x00, 0x10, 0, 0, 0, 0, 0})));
}

constexpr Talk entries[] = {
    {"reading", 10, draw_read},
    {"writing", 12, draw_write},
    {"wrong access", 12, draw_wrong_access},
    {"broken transfers", 14, draw_fault},
    {"single requests", 10, draw_request},
};

}  // namespace

std::span<const Talk> talks_of_entries() { return entries; }

const device::Entry* Vocabulary::find(Multiplexer mux) const {
  const auto found = std::ranges::lower_bound(entries, mux, {}, &device::Entry::mux);
  return found != entries.end() && found->mux == mux ? &*found : nullptr;
}

Vocabulary vocabulary_of(const device::Profile& profile) {
  Vocabulary out;
  out.node = profile.node;
  out.errors = profile.errors;
  out.lss = profile.claims.contains("lss");
  for (const auto& trigger : profile.errors) {
    if (trigger.heartbeat_node) out.other = *trigger.heartbeat_node;
  }
  const auto dictionary = device::dictionary_of(profile);
  for (const auto& entry : dictionary.entries()) {
    const bool is_there = entry.claimed || entry.category == device::Category::mandatory;
    // The device's own description is long, and says only once more what the entries say.
    const bool is_description = entry.mux.index == Index(0x1021);
    if (is_there && !is_description && !entry.untouchable && !entry.not_to_be_read)
      out.entries.push_back(entry);
  }
  return out;
}

void Draft::write(std::uint16_t index, std::uint8_t sub, std::uint64_t value) {
  const auto* entry = words.find({Index(index), SubIndex(sub)});
  if (entry != nullptr && entry->writable())
    add(download(entry->mux, to_le(value, entry->size().value_or(4))));
}

void Draft::read(std::uint16_t index, std::uint8_t sub) {
  const auto* entry = words.find({Index(index), SubIndex(sub)});
  if (entry != nullptr && entry->readable()) add(upload(entry->mux));
}

Conversation draw(const Vocabulary& words, std::uint64_t seed, std::size_t length) {
  Random random(seed);
  Conversation out;
  out.reserve(length + 16);
  Draft draft{words, random, out};
  if (words.entries.empty()) return out;
  std::vector<const Talk*> chosen;
  unsigned total = 0;
  while (chosen.empty()) {
    for (const auto talks : {talks_of_entries(), talks_of_services()}) {
      for (const auto& talk : talks) {
        if (random.chance(70)) continue;
        chosen.push_back(&talk);
        total += talk.weight;
      }
    }
  }
  // A device may have nothing of what was chosen: one without PDOs has nothing to say of RPDOs.
  constexpr int most_idle = 50;
  for (int idle = 0; out.size() < length && idle < most_idle;) {
    const auto before = out.size();
    auto at = random.below(total);
    for (const auto* talk : chosen) {
      if (at < talk->weight) {
        talk->draw(draft);
        break;
      }
      at -= talk->weight;
    }
    idle = out.size() == before ? idle + 1 : 0;
  }
  return out;
}

}  // namespace conform::explore
