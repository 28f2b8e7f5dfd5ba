// SPDX-License-Identifier: Apache-2.0
#include "device/standard_objects.hpp"

#include "base/check.hpp"
#include "device/described_value.hpp"
#include "eds/standard_table.hpp"

namespace conform::device {
namespace {

using eds::StandardFlag;
using Row = eds::StandardRow;

canopen::DataType type_of(const Row& row) {
  const auto type = canopen::data_type_at(row.type);
  CONFORM_CHECK(type.has_value());
  return *type;
}

Category category_of(eds::Category category) {
  switch (category) {
    case eds::Category::mandatory: return Category::mandatory;
    case eds::Category::conditional: return Category::conditional;
    case eds::Category::optional: break;
  }
  return Category::optional;
}

std::optional<Bytes> value_of(const Row& row, std::int64_t value) {
  if (value == Row::none) return std::nullopt;
  const auto size = canopen::size_bytes(type_of(row));
  CONFORM_CHECK(size.has_value());
  return to_le(static_cast<std::uint64_t>(value), *size);
}

Entry entry_of(const Row& row, Multiplexer mux) {
  Entry entry;
  entry.mux = mux;
  entry.name = row.name;
  entry.type = type_of(row);
  entry.access = access_of(row.access);
  entry.category = category_of(row.category);
  entry.object = static_cast<ObjectCode>(row.object);  // the codes are those of the standard
  entry.low = value_of(row, row.low);
  entry.high = value_of(row, row.high);
  entry.default_value = value_of(row, row.default_value);
  entry.default_adds_node_id = row.has(StandardFlag::adds_node_id);
  entry.access_open = row.has(StandardFlag::leaves_access);
  entry.pdo_mappable = row.has(StandardFlag::pdo_mappable);
  entry.may_change = row.has(StandardFlag::may_change);
  entry.command = row.has(StandardFlag::is_command);
  return entry;
}

/// How far a run of alike sub-indices is shown in standard_dictionary().
std::uint8_t shown_until(const Row& row) {
  if (row.first_sub == row.last_sub) return row.last_sub;
  const bool is_mapping = row.first_index >= 0x1600;
  return is_mapping ? std::uint8_t{8} : std::uint8_t{0};  // arrays: only what the standard names singly
}

}  // namespace

std::optional<Entry> standard_entry(Multiplexer mux) {
  const auto* row = eds::find_standard_row(mux);
  return row == nullptr ? std::nullopt : std::optional(entry_of(*row, mux));
}

std::optional<canopen::DataType> type_of(const Dictionary& dictionary, Multiplexer mux) {
  if (const auto* entry = dictionary.find(mux); entry != nullptr) return entry->type;
  const auto standard = standard_entry(mux);
  return standard ? std::optional(standard->type) : std::nullopt;
}

Dictionary standard_dictionary(NodeId node) {
  Dictionary dictionary;
  for (const Row& row : eds::standard_rows()) {
    const bool is_pdo = row.first_index >= 0x1400;
    for (int i = 0; i < (is_pdo ? 4 : 1); ++i) {
      const auto index = static_cast<std::uint16_t>((is_pdo ? row.first_index & 0xFE00U : row.first_index) +
                                                    static_cast<unsigned>(i));
      if (index < row.first_index || index > row.last_index) continue;
      for (int sub = row.first_sub; sub <= shown_until(row); ++sub) {
        const Multiplexer mux{Index{index}, SubIndex{static_cast<std::uint8_t>(sub)}};
        dictionary.add(at_node(entry_of(row, mux), node));
      }
    }
  }
  return dictionary;
}

}  // namespace conform::device
