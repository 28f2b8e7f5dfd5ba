// SPDX-License-Identifier: Apache-2.0
#include "device/dictionary.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "base/check.hpp"

namespace conform::device {
namespace {

constexpr std::array<std::pair<Access, std::string_view>, 6> access_words{{
    {Access::ro, "ro"},
    {Access::wo, "wo"},
    {Access::rw, "rw"},
    {Access::rwr, "rwr"},
    {Access::rww, "rww"},
    {Access::constant, "const"},
}};

constexpr std::array<std::pair<ObjectCode, std::string_view>, 4> object_words{{
    {ObjectCode::domain, "DOMAIN"},
    {ObjectCode::var, "VAR"},
    {ObjectCode::array, "ARRAY"},
    {ObjectCode::record, "RECORD"},
}};

template <typename Table, typename Value>
std::string_view word_of(const Table& table, Value value) {
  const auto found = std::ranges::find(table, value, &Table::value_type::first);
  CONFORM_CHECK(found != table.end());
  return found->second;
}

template <typename Table>
auto value_of(const Table& table, std::string_view word)
    -> std::optional<typename Table::value_type::first_type> {
  const auto found = std::ranges::find(table, word, &Table::value_type::second);
  if (found == table.end()) return std::nullopt;
  return found->first;
}

}  // namespace

std::string_view to_string(Access access) { return word_of(access_words, access); }
std::optional<Access> parse_access(std::string_view word) { return value_of(access_words, word); }
std::string_view to_string(ObjectCode code) { return word_of(object_words, code); }
std::optional<ObjectCode> parse_object_code(std::string_view word) { return value_of(object_words, word); }

std::string_view to_string(Category category) {
  switch (category) {
    case Category::mandatory: return "mandatory";
    case Category::conditional: return "conditional";
    case Category::optional: break;
  }
  return "optional";
}

Entry at_node(Entry entry, NodeId node) {
  if (entry.default_adds_node_id && entry.default_value) {
    store_le(*entry.default_value, load_le(*entry.default_value) + node.value());
  }
  return entry;
}

void Dictionary::add(Entry entry) {
  const auto place = std::ranges::lower_bound(entries_, entry.mux, {}, &Entry::mux);
  if (place != entries_.end() && place->mux == entry.mux) {
    *place = std::move(entry);
  } else {
    entries_.insert(place, std::move(entry));
  }
}

void Dictionary::remove(Multiplexer mux) {
  std::erase_if(entries_, [&](const Entry& entry) { return entry.mux == mux; });
}

const Entry* Dictionary::find(Multiplexer mux) const {
  const auto place = std::ranges::lower_bound(entries_, mux, {}, &Entry::mux);
  return place != entries_.end() && place->mux == mux ? &*place : nullptr;
}

Entry* Dictionary::find(Multiplexer mux) {
  const auto place = std::ranges::lower_bound(entries_, mux, {}, &Entry::mux);
  return place != entries_.end() && place->mux == mux ? &*place : nullptr;
}

std::span<const Entry> Dictionary::object(Index index) const& {
  const auto range =
      std::ranges::equal_range(entries_, index, {}, [](const Entry& entry) { return entry.mux.index; });
  return {range.begin(), range.end()};
}

std::vector<Index> Dictionary::objects() const {
  std::vector<Index> out;
  for (const Entry& entry : entries_) {
    if (out.empty() || out.back() != entry.mux.index) out.push_back(entry.mux.index);
  }
  return out;
}

}  // namespace conform::device
