// SPDX-License-Identifier: Apache-2.0
// Typed reads of a mapping that report every mistake at its place: missing, unknown and mistyped keys.
//
//   Fields fields(node, diagnostics, "step");
//   auto id = fields.required("id").text();                            // optional<string>, reported if
//   absent auto wait = fields.optional("wait").duration().value_or(100ms); auto access =
//   fields.optional("access").one_of<Access>({{"ro", Access::ro}, {"rw", Access::rw}}); auto checks =
//   fields.optional("checks").list_or_one([](Field item) { return item.text(); }); Fields expect =
//   fields.optional("expect").fields("outcome");       // silent when the key is absent
//   // unknown keys are reported when `fields` goes out of scope, or at finish()
#pragma once

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/bytes.hpp"
#include "base/strong.hpp"
#include "base/time.hpp"
#include "yaml/diagnostic.hpp"
#include "yaml/node.hpp"

namespace conform::yaml {

class Fields;

/// One value, present or not. Reads of an absent value return nothing and stay silent (required() has
/// reported it).
class Field {
 public:
  Field(const Node* node, Diagnostics& diagnostics, std::string name)
      : node_(node), diagnostics_(&diagnostics), name_(std::move(name)) {}

  [[nodiscard]] explicit operator bool() const { return node_ != nullptr; }
  [[nodiscard]] bool present() const { return node_ != nullptr; }
  [[nodiscard]] const Node* node() const { return node_; }
  [[nodiscard]] Diagnostics& diagnostics() const { return *diagnostics_; }
  [[nodiscard]] const std::string& name() const {
    return name_;
  }  ///< as in messages: "'key'" or "an item of 'key'"

  /// Any scalar that is not empty.
  [[nodiscard]] std::optional<std::string> text() const;
  /// 17, 11h, 0x11 within min..max.
  [[nodiscard]] std::optional<std::uint64_t> number(
      std::uint64_t min = 0, std::uint64_t max = std::numeric_limits<std::uint64_t>::max()) const;
  /// Decimal with sign, or one of the forms of number().
  [[nodiscard]] std::optional<std::int64_t> integer(
      std::int64_t min = std::numeric_limits<std::int64_t>::min(),
      std::int64_t max = std::numeric_limits<std::int64_t>::max()) const;
  /// 100 ms; the unit is mandatory.
  [[nodiscard]] std::optional<Duration> duration() const;
  /// 1003h:00 or 1003h
  [[nodiscard]] std::optional<Multiplexer> multiplexer() const;
  /// 2F 03 10 00
  [[nodiscard]] std::optional<Bytes> bytes() const;
  /// true or false
  [[nodiscard]] std::optional<bool> boolean() const;

  /// The items of a list; anything else is reported.
  [[nodiscard]] std::vector<Field> items() const;
  /// The same, but a value that is no list counts as a list of one.
  [[nodiscard]] std::vector<Field> items_or_one() const;
  /// Nothing when absent or not a list; items that do not read are reported by `read` and left out.
  template <typename Read>
  [[nodiscard]] auto list(Read read) const {
    return collect(items(), node_ != nullptr && node_->is_sequence(), read);
  }
  template <typename Read>
  [[nodiscard]] auto list_or_one(Read read) const {
    return collect(items_or_one(), node_ != nullptr, read);
  }

  /// A word out of a table; the message lists the words or names the nearest.
  template <typename Value>
  [[nodiscard]] std::optional<Value> one_of(
      std::initializer_list<std::pair<std::string_view, std::type_identity_t<Value>>> words) const {
    std::vector<std::string_view> names;
    for (const auto& word : words) names.push_back(word.first);
    const auto index = word_index(names);
    if (!index) return std::nullopt;
    return (words.begin() + *index)->second;
  }
  [[nodiscard]] std::optional<std::string> one_of(const std::vector<std::string_view>& words) const;

  /// The value as a mapping of its own; `what` names it in messages ("outcome").
  [[nodiscard]] Fields fields(std::string what) const;

  /// Reports at this value (does nothing when absent).
  void error(std::string message, std::string hint = {}) const;
  void warning(std::string message, std::string hint = {}) const;
  /// "expected <what> for 'name', found ..."; silent when the loader has already reported the value.
  void expected(std::string_view what, std::string hint = {}) const;

 private:
  [[nodiscard]] std::optional<std::ptrdiff_t> word_index(const std::vector<std::string_view>& words) const;

  template <typename Read>
  [[nodiscard]] static auto collect(const std::vector<Field>& items, bool is_list, Read& read) {
    using Item = typename std::invoke_result_t<Read&, Field>::value_type;
    std::optional<std::vector<Item>> out;
    if (!is_list) return out;
    out.emplace();
    for (const Field& item : items) {
      if (auto value = read(item)) out->push_back(*std::move(value));
    }
    return out;
  }

  const Node* node_;
  Diagnostics* diagnostics_;
  std::string name_;
};

/// The keys of one mapping. Every key that was never asked for is reported as unknown in the end.
class Fields {
 public:
  /// `what` names the mapping in messages: "step", "scenario". A node that is no mapping is reported here,
  /// and every read then stays silent.
  Fields(const Node& node, Diagnostics& diagnostics, std::string what);
  /// An absent mapping: everything is absent and nothing is reported.
  Fields(Diagnostics& diagnostics, std::string what);
  ~Fields();
  Fields(const Fields&) = delete;
  Fields& operator=(const Fields&) = delete;

  [[nodiscard]] bool present() const { return node_ != nullptr; }
  [[nodiscard]] const Node* node() const { return node_; }
  [[nodiscard]] Diagnostics& diagnostics() const { return *diagnostics_; }

  [[nodiscard]] Field required(std::string_view key);
  [[nodiscard]] Field optional(std::string_view key);
  /// Counts as asked for.
  [[nodiscard]] bool has(std::string_view key);
  /// The one key of `keys` that is present; none or several are reported. For steps named by their verb.
  [[nodiscard]] Field exactly_one_of(std::initializer_list<std::string_view> keys);
  /// Names keys that are read elsewhere (or that `did you mean` should know).
  void known(std::initializer_list<std::string_view> keys);
  /// Accepts whatever else is there: no report of unknown keys.
  void allow_others() { others_allowed_ = true; }

  void error(std::string message, std::string hint = {}) const;

  /// Reports the unknown and the missing keys, once. A missing key that an unknown one resembles is not
  /// reported twice.
  void finish();

 private:
  struct Missing {
    std::string message;
    std::vector<std::string> keys;  // any of these would have done
  };

  [[nodiscard]] const Node* look_up(std::string_view key);

  const Node* node_ = nullptr;
  Diagnostics* diagnostics_;
  std::string what_;
  std::vector<std::string> asked_;
  std::vector<Missing> missing_;
  bool others_allowed_ = false;
  bool finished_ = false;
};

}  // namespace conform::yaml
