// SPDX-License-Identifier: Apache-2.0
// What is known of the object dictionary of the device under test: CiA 301's table, the EDS, the profile,
// discovery.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.hpp"
#include "base/strong.hpp"
#include "canopen/data_type.hpp"

namespace conform::device {

/// Access attributes of CiA 301, 7.4.5 (table 43) and CiA 306 (rwr: mapped to TPDOs, rww: to RPDOs).
enum class Access : std::uint8_t { ro, wo, rw, rwr, rww, constant };
/// "ro", "wo", "rw", "rwr", "rww", "const"
[[nodiscard]] std::string_view to_string(Access access);
[[nodiscard]] std::optional<Access> parse_access(std::string_view word);
[[nodiscard]] constexpr bool is_readable(Access access) { return access != Access::wo; }
[[nodiscard]] constexpr bool is_writable(Access access) {
  return access != Access::ro && access != Access::constant;
}

/// Whether the standard asks for the entry.
enum class Category : std::uint8_t { mandatory, conditional, optional };
[[nodiscard]] std::string_view to_string(Category category);

/// What an absent entry means: a failure of its presence requirement, or nothing at all.
enum class Presence : std::uint8_t { claimed_mandatory, claimed, unclaimed };

/// Object codes of CiA 301, 7.4.3 (table 42).
enum class ObjectCode : std::uint8_t { domain = 0x02, var = 0x07, array = 0x08, record = 0x09 };
/// "DOMAIN", "VAR", "ARRAY", "RECORD"
[[nodiscard]] std::string_view to_string(ObjectCode code);
[[nodiscard]] std::optional<ObjectCode> parse_object_code(std::string_view word);

struct Entry {
  Multiplexer mux;
  std::string name;
  canopen::DataType type = canopen::DataType::unsigned32;
  Access access = Access::rw;
  Category category = Category::optional;
  ObjectCode object = ObjectCode::var;  ///< of the object this entry belongs to
  std::optional<Bytes> low;             ///< limits and default as on the wire
  std::optional<Bytes> high;
  std::optional<Bytes> default_value;  ///< in a Dictionary with the node-ID already added where it counts
  bool default_adds_node_id = false;   ///< the default is a constant plus the node-ID
  bool access_open =
      false;  ///< the standard leaves rw or const (ro) to the device: `access` is the wider one
  bool pdo_mappable = false;
  bool may_change = false;  ///< changes by itself: error register, process inputs, counters
  bool command = false;     ///< a write has an effect other than storing: 1003h:00, 1010h, 1011h, 1F50h ...
  bool claimed = false;     ///< the EDS or the profile says that it is there
  bool declared_default = false;  ///< the default is the description's, not only the standard's
  bool configured = false;        ///< ... and what the device was set to, not what it was made with
  bool open_to_writes = true;     ///< tests may try to write it: from 2000h on only where the profile says so
  bool safe = false;              ///< the profile allows tests to write it, and it can be written
  bool untouchable = false;       ///< the profile, or ObjFlags of the EDS, forbids every write to it
  bool not_to_be_read = false;    ///< ObjFlags of the EDS keep scans off it (CiA 306): it is left alone
  std::optional<Multiplexer> wired_input = {};  ///< an output: the entry that shows what is written to it
  bool clock = false;      ///< shows the time that TIME sets: the profile says so, or it may well be
  bool described = false;  ///< what is claimed is the EDS's: Profile::described_places says where

  [[nodiscard]] Presence presence() const {
    if (category == Category::mandatory) return Presence::claimed_mandatory;
    return claimed ? Presence::claimed : Presence::unclaimed;
  }
  [[nodiscard]] bool readable() const { return is_readable(access); }
  [[nodiscard]] bool writable() const { return is_writable(access); }
  /// Bytes on the wire; nullopt where the length varies.
  [[nodiscard]] std::optional<std::size_t> size() const { return canopen::size_bytes(type); }
};

/// `entry` with the node-ID added to a default that wants it: the step from a description to a device.
[[nodiscard]] Entry at_node(Entry entry, NodeId node);

/// Entries ordered by multiplexer, at most one each.
class Dictionary {
 public:
  /// Adds the entry, replacing one with the same multiplexer.
  void add(Entry entry);
  void remove(Multiplexer mux);
  [[nodiscard]] const Entry* find(Multiplexer mux) const;
  [[nodiscard]] Entry* find(Multiplexer mux);
  // Of a dictionary that is there as long as the entries are looked at: a loop over those of a temporary
  // would run over what is gone.
  [[nodiscard]] std::span<const Entry> entries() const& { return entries_; }
  [[nodiscard]] std::span<const Entry> entries() const&& = delete;
  /// The entries of one object in ascending order; empty when there is none.
  [[nodiscard]] std::span<const Entry> object(Index index) const&;
  [[nodiscard]] std::span<const Entry> object(Index index) const&& = delete;
  [[nodiscard]] bool has(Index index) const { return !object(index).empty(); }
  [[nodiscard]] bool has(Multiplexer mux) const { return find(mux) != nullptr; }
  /// Indices of all objects, ascending.
  [[nodiscard]] std::vector<Index> objects() const;
  [[nodiscard]] std::size_t size() const { return entries_.size(); }

 private:
  std::vector<Entry> entries_;
};

}  // namespace conform::device
