// SPDX-License-Identifier: Apache-2.0
// Draws conversations: random, but of what means something to the device. Every conversation has only some of
// all kinds of talk (swarm testing): where everything happens at once, much never happens for long enough.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/random.hpp"
#include "device/dictionary.hpp"
#include "device/profile.hpp"
#include "explore/action.hpp"

namespace conform::explore {

/// What there is to talk about.
struct Vocabulary {
  NodeId node{1};
  std::vector<device::Entry> entries;  ///< that the device has, ascending; none of those nobody may touch
  std::vector<device::ErrorTrigger> errors;
  NodeId other{0x7E};  ///< a node that is not there, whose heartbeats may be sent
  bool lss = false;    ///< it has layer setting services

  [[nodiscard]] const device::Entry* find(Multiplexer mux) const;
  [[nodiscard]] bool has(std::uint16_t index, std::uint8_t sub = 0) const {
    return find({Index(index), SubIndex(sub)}) != nullptr;
  }
};
/// Of what the profile claims and the standard makes mandatory.
[[nodiscard]] Vocabulary vocabulary_of(const device::Profile& profile);

/// The same numbers on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  [[nodiscard]] std::uint64_t next() { return next_random(state_); }
  /// 0 to `count` - 1; `count` is at least 1.
  [[nodiscard]] std::size_t below(std::size_t count) { return static_cast<std::size_t>(next() % count); }
  [[nodiscard]] bool chance(unsigned percent) { return next() % 100 < percent; }
  template <typename T>
  [[nodiscard]] const T& of(std::span<const T> all) {
    return all[below(all.size())];
  }
  template <typename T, std::size_t size>
  [[nodiscard]] T of(const T (&all)[size]) {
    return all[below(size)];
  }

 private:
  std::uint64_t state_;
};

/// A place where talk is put together.
struct Draft {
  const Vocabulary& words;
  Random& random;
  Conversation& out;

  void add(Action action) { out.push_back(std::move(action)); }
  /// Writes a number as long as the entry is; nothing where there is none.
  void write(std::uint16_t index, std::uint8_t sub, std::uint64_t value);
  void read(std::uint16_t index, std::uint8_t sub);
  void nmt(std::uint8_t command) { add(explore::nmt(words.node, command)); }
  void wait(Duration time) { add(explore::wait(time)); }
  void send(std::uint32_t id, std::initializer_list<std::uint8_t> bytes) {
    add(explore::frame(can::data_frame(CanId(id), bytes)));
  }
};

/// One kind of talk.
struct Talk {
  std::string_view name;
  unsigned weight;  ///< how often it comes against the others of a conversation
  void (*draw)(Draft& draft);
};
/// All of them: about single entries and requests, and about whole services.
[[nodiscard]] std::span<const Talk> talks_of_entries();
[[nodiscard]] std::span<const Talk> talks_of_services();

/// CAN-IDs that additional SDO servers are given, and those near them.
[[nodiscard]] constexpr bool is_other_channel(std::uint32_t id) { return id >= 0x680 && id <= 0x6DF; }
/// A request there that changes nothing in the dictionary: an upload or its segments, an abort.
[[nodiscard]] constexpr bool only_reads(const can::Frame& frame) {
  const auto specifier = frame.data[0] >> 5U;
  return frame.dlc == 8 && specifier >= 2 && specifier <= 5;
}

/// A conversation of at least `length` actions; the same for the same seed.
[[nodiscard]] Conversation draw(const Vocabulary& words, std::uint64_t seed, std::size_t length);

}  // namespace conform::explore
