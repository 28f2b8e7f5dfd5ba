// SPDX-License-Identifier: Apache-2.0
// The object dictionary of the reference node: entries with type, access, limits and hooks, and the rules
// that decide whether an access by SDO is granted (CiA 301, 7.4 and 7.2.4.3.17).
#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/bytes.hpp"
#include "base/strong.hpp"
#include "dictionary/abort_codes.hpp"
#include "rules/rule.hpp"

namespace refnode {

using conform::AbortCode;
using conform::Bytes;
using conform::ByteView;
using conform::Multiplexer;

/// Numbers of CiA 301, 7.4.7.1.
enum class DataType : std::uint16_t {
  boolean = 0x01,
  integer8 = 0x02,
  integer16 = 0x03,
  integer32 = 0x04,
  unsigned8 = 0x05,
  unsigned16 = 0x06,
  unsigned32 = 0x07,
  real32 = 0x08,
  visible_string = 0x09,
  octet_string = 0x0A,
  unicode_string = 0x0B,
  time_of_day = 0x0C,
  time_difference = 0x0D,
  domain = 0x0F,
  integer24 = 0x10,
  real64 = 0x11,
  integer40 = 0x12,
  integer48 = 0x13,
  integer56 = 0x14,
  integer64 = 0x15,
  unsigned24 = 0x16,
  unsigned40 = 0x18,
  unsigned48 = 0x19,
  unsigned56 = 0x1A,
  unsigned64 = 0x1B,
};

/// Length in bytes, 0 for types of variable length.
[[nodiscard]] std::size_t fixed_size(DataType type);
[[nodiscard]] bool is_signed_integer(DataType type);
[[nodiscard]] bool is_unsigned_integer(DataType type);

enum class Access : std::uint8_t { ro, wo, rw, constant };

using Upload = std::expected<Bytes, AbortCode>;
using Accepted = std::expected<void, AbortCode>;
[[nodiscard]] inline std::unexpected<AbortCode> refuse(AbortCode code) { return std::unexpected(code); }

/// One sub-index.
struct Entry {
  std::string name;
  DataType type = DataType::unsigned8;
  Access access = Access::ro;
  Bytes value;
  Bytes default_value;              ///< the power-on value while nothing is stored
  std::optional<std::int64_t> low;  ///< inclusive limits of integer entries; UNSIGNED64: the same 64 bits
  std::optional<std::int64_t> high;
  std::optional<double> low_real;  ///< of REAL32 and REAL64
  std::optional<double> high_real;
  std::size_t max_size = 0;  ///< longest value of a type of variable length
  bool rx_mappable = false;
  bool tx_mappable = false;
  bool command = false;                  ///< a write triggers `check` and is not kept (1010h, 1011h, 2F00h)
  bool storable = true;                  ///< taken into the storage image if it is rw and no command
  bool adds_node_id = false;             ///< the default value is a base plus the node-ID
  std::function<bool()> not_stored_now;  ///< true: left out of the storage image for the present
  std::function<Upload()> read;          ///< replaces `value` on an upload
  std::function<Accepted(ByteView)> check;  ///< last word before a value is taken
  std::function<void()> written;            ///< after a value has been taken

  [[nodiscard]] std::uint64_t number() const { return conform::load_le(value); }
};

/// Lets `read` answer uploads; what it gives is cut or filled up to the length of the entry's type.
void read_by(Entry& entry, std::function<Upload()> read);

enum class ObjectKind : std::uint8_t { variable, array, record };

struct Object {
  std::string name;
  ObjectKind kind = ObjectKind::variable;
  std::map<std::uint8_t, Entry> entries;
};

/// An integer entry; the default value has the length of the type.
[[nodiscard]] Entry integer_entry(std::string name, DataType type, Access access, std::uint64_t value);
/// A COB-ID of 32 bits whose default value is the sum of both.
[[nodiscard]] Entry cob_id_entry(std::string name, Access access, std::uint32_t base, std::uint8_t node_id);
/// An entry of a type of variable length (or of REAL, TIME_OF_DAY, ...) with its bytes.
[[nodiscard]] Entry bytes_entry(std::string name, DataType type, Access access, Bytes value,
                                std::size_t max_size = 0);
[[nodiscard]] Entry text_entry(std::string name, Access access, std::string_view text,
                               std::size_t max_size = 0);

/// CiA 301 names several codes for these.
struct DictionaryChoices {
  AbortCode value_too_long = abort_code::length_too_high;
  AbortCode value_too_short = abort_code::length_too_low;
  AbortCode value_above_limit = abort_code::value_too_high;
  AbortCode value_below_limit = abort_code::value_too_low;
};

class ObjectDictionary {
 public:
  ObjectDictionary();
  ObjectDictionary(const ObjectDictionary&) = delete;
  ObjectDictionary& operator=(const ObjectDictionary&) = delete;

  DictionaryChoices choices;

  Entry& add_variable(std::uint16_t index, Entry entry);
  /// An array or record without entries; sub-index 00h is const and counts up with add_sub().
  Object& add_complex(std::uint16_t index, std::string name, ObjectKind kind);
  /// Adds a sub-index and raises the highest sub-index in sub-index 00h.
  Entry& add_sub(std::uint16_t index, std::uint8_t sub, Entry entry);
  void remove(std::uint16_t index) { objects_.erase(index); }
  void remove_sub(std::uint16_t index, std::uint8_t sub);
  /// The defaults follow another node-ID; values that cannot be written do so at once.
  void change_node_id(std::uint8_t from, std::uint8_t to);

  [[nodiscard]] const std::map<std::uint16_t, Object>& objects() const { return objects_; }
  [[nodiscard]] std::map<std::uint16_t, Object>& objects() { return objects_; }
  /// nullptr when the entry does not exist.
  [[nodiscard]] Entry* entry(std::uint16_t index, std::uint8_t sub);
  [[nodiscard]] const Entry* entry(std::uint16_t index, std::uint8_t sub) const;
  /// The integer value of an entry, or `otherwise` when it does not exist.
  [[nodiscard]] std::uint64_t number(std::uint16_t index, std::uint8_t sub,
                                     std::uint64_t otherwise = 0) const;
  /// Sets a value from inside the device: no access check, no hook.
  void set_number(std::uint16_t index, std::uint8_t sub, std::uint64_t value);

  // Access by SDO: what is read, granted and written (CiA 301, 7.2.4.3.17).
  Rule<Upload(Multiplexer)> upload;
  /// Whether a download of this many bytes (nullopt: not known yet) may start.
  Rule<Accepted(Multiplexer, std::optional<std::size_t> size)> may_download;
  /// All checks, the value, the hooks.
  Rule<Accepted(Multiplexer, ByteView)> download;
  std::function<void(Multiplexer)> on_download;  ///< a value has been taken by SDO, all hooks have run

  /// Longest value the entry takes; 0 when it does not exist.
  [[nodiscard]] std::size_t capacity(Multiplexer mux) const;

 private:
  [[nodiscard]] Upload read(Multiplexer mux) const;
  [[nodiscard]] Accepted check_writable(Multiplexer mux, std::optional<std::size_t> size) const;
  [[nodiscard]] Accepted write(Multiplexer mux, ByteView bytes);
  [[nodiscard]] Accepted check_exists(Multiplexer mux) const;
  [[nodiscard]] Accepted check_size(const Entry& entry, std::size_t size) const;
  [[nodiscard]] Accepted check_limits(const Entry& entry, ByteView bytes) const;
  template <typename Value>
  [[nodiscard]] Accepted compare(Value value, const std::optional<Value>& low,
                                 const std::optional<Value>& high) const;

  std::map<std::uint16_t, Object> objects_;
};

}  // namespace refnode
