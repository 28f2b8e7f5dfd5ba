// SPDX-License-Identifier: Apache-2.0
// What the trace shows of the communication parameters: values that were uploaded, or downloaded and
// confirmed. A reset brings back values that nobody has seen, so that they are unknown again.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/strong.hpp"
#include "base/time.hpp"

namespace conform::monitor {

class Entries {
 public:
  struct Entry {
    std::uint32_t value = 0;
    BusTime since{};        ///< it has been known from then on
    bool by_write = false;  ///< the last thing that happened to it was a download
    bool known = false;
    std::uint8_t doubts = 0;  ///< downloads of which the trace does not tell what became of them
  };
  /// A CAN-ID with the format in bit 29, as COB-ID entries hold it.
  using Key = std::uint32_t;

  /// A client asks for a download, which may take effect before it is confirmed. `value` of an expedited one.
  void asked(Multiplexer object, std::optional<std::uint32_t> value, BusTime time);
  void written(Multiplexer object, std::uint32_t value, BusTime time);
  void refused(Multiplexer object, BusTime time);
  void read(Multiplexer object, std::uint32_t value, BusTime time);
  /// An upload said that there is no such entry. Resets do not change that.
  void absent(Multiplexer object);
  /// All values are those of power-on, or may be.
  void reset();
  /// Frames were lost, and downloads may have been among them.
  void lose_track();

  /// nullptr: the trace leaves it open.
  [[nodiscard]] const Entry* known(std::uint16_t index, std::uint8_t sub) const;
  [[nodiscard]] bool is_absent(std::uint16_t index, std::uint8_t sub) const {
    return absent_.contains(key_of(index, sub));
  }
  /// The value is 0, or there is no such entry.
  [[nodiscard]] bool is_zero(std::uint16_t index, std::uint8_t sub) const;
  /// A value was seen, or that there is none.
  [[nodiscard]] bool is_told(std::uint16_t index, std::uint8_t sub) const;
  /// The largest value that was ever seen, 0 where there is none.
  [[nodiscard]] std::uint32_t most(std::uint16_t index, std::uint8_t sub) const;
  /// The entry was seen, and no value that it may have had before or after a reset has one of these bits set.
  [[nodiscard]] bool never_had(std::uint16_t index, std::uint8_t sub, std::uint32_t bits) const;
  /// Whether a COB-ID entry of the device ever held this CAN-ID, or may have.
  [[nodiscard]] bool ever_held(Key can_id) const { return held_.contains(can_id); }
  /// ... this one.
  [[nodiscard]] bool ever_held(std::uint16_t index, Key can_id) const {
    return held_by_.contains({can_id, index});
  }
  /// Calls `use` with the index of every object that ever held this CAN-ID.
  template <typename Use>
  void for_holders(Key can_id, Use use) const {
    for (auto each = held_by_.lower_bound({can_id, 0}); each != held_by_.end() && each->first == can_id;
         ++each)
      use(each->second);
  }
  /// When a parameter of the service was last asked to change; these are the first and last index of its
  /// objects.
  [[nodiscard]] BusTime touched(std::uint16_t first, std::uint16_t last) const;

 private:
  using Place = std::uint32_t;
  static Place key_of(std::uint16_t index, std::uint8_t sub) { return std::uint32_t{index} << 8U | sub; }
  static Place key_of(Multiplexer object) { return key_of(object.index.value(), object.sub.value()); }
  static bool concerns(Multiplexer object);
  void forget_values();
  void note(Multiplexer object, std::uint32_t value, bool of_start);
  void note_can_id(Multiplexer object, std::uint32_t value, bool in_use);

  std::map<Place, Entry> entries_;
  std::map<Place, std::uint32_t> most_;
  /// Of all values. Begins with one that a start gave: behind a download nobody knows what the next start
  /// brings back.
  std::map<Place, std::uint32_t> seen_bits_;
  bool started_ = false;   ///< the trace shows the start that these values come from
  std::set<Place> asked_;  ///< for a download since then
  std::set<Place> open_;   ///< downloads of which nobody knows what became of them
  /// Defaults may have come back that nobody has seen: by a confirmed command, by one that is not answered
  /// yet.
  bool restored_ = false, restoring_ = false;
  std::map<std::uint16_t, BusTime> touched_;  ///< by index
  std::set<Place> absent_;
  std::set<Key> held_;
  std::set<std::pair<Key, std::uint16_t>> held_by_;
};

}  // namespace conform::monitor
