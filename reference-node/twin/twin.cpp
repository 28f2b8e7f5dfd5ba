// SPDX-License-Identifier: Apache-2.0
#include "twin/twin.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "eds/expand.hpp"
#include "twin/entry.hpp"
#include "twin/usual.hpp"

namespace refnode {

namespace eds = conform::eds;

namespace {

class TwinMaker {
 public:
  TwinMaker(const eds::EdsFile& file, std::uint8_t node_id)
      : file_(&file), entries_(node_id, file.device_info, twin_.remarks) {}
  TwinMaker(const TwinMaker&) = delete;  // the maker of entries points here
  TwinMaker& operator=(const TwinMaker&) = delete;

  conform::Result<Twin> run() {
    const auto objects = eds::expand(*file_);
    if (!objects) return std::unexpected(objects.error());
    for (const auto& object : *objects) add(object);
    compare_lists(*objects);
    share_memory();
    for (const auto& [type, field] : file_->dummy_usage.entries) {
      if (type > 0 && type < twin_.placeholders.size())
        twin_.placeholders[type] = eds::flag_of(field).value_or(false);
    }
    return std::move(twin_);
  }

 private:
  void add(const eds::Object& object) {
    const auto code = eds::object_code(object.entry);
    const std::uint16_t index = object.index.value();
    if (code == eds::ObjectCode::null && object.subs.empty()) {
      remark(object, object.entry.object_type.at, "an object of type NULL has no entries and is left out");
      return;
    }
    if (!code) {
      remark(object, object.entry.object_type.at,
             fmt::format("the object type '{}' is not known; it is served as what its sub-indices make it",
                         conform::printable(eds::shortened(object.entry.object_type.text))));
    }
    Object& made = twin_.objects[index];
    made.name = object.entry.parameter_name.text;
    if (!eds::is_structured(object)) {
      add_entry(made, object, 0, object.entry, false);
      return;
    }
    made.kind = code == eds::ObjectCode::array ? ObjectKind::array : ObjectKind::record;
    for (const auto& [sub, entry] : object.subs) add_entry(made, object, sub.value(), entry, true);
    if (object.subs.empty()) remark(object, object.entry.at, "no sub-index is described");
    if (object.entry.implied_by.known() && is_pdo_mapping(index)) add_mapping(made);
  }

  /// CompactPDO says nothing of the entries of a mapping, but without them a PDO could carry nothing: there
  /// are as many as the granularity lets into a PDO.
  void add_mapping(Object& to) {
    constexpr std::uint64_t bits_of_pdo = 64, usual = 8;
    const auto bits = eds::number_of(file_->device_info.granularity).value_or(usual);
    const auto entries = bits_of_pdo / (bits >= 1 && bits <= bits_of_pdo ? bits : usual);
    for (std::uint64_t sub = 1; sub <= entries && count_ < most_twin_entries; ++sub) {
      ++count_;
      Entry entry;
      entry.name = fmt::format("Mapped object {}", sub);
      entry.type = DataType::unsigned32;
      entry.access = Access::rw;
      entry.value = entry.default_value = Bytes(fixed_size(entry.type), 0);
      to.entries.emplace(static_cast<std::uint8_t>(sub), std::move(entry));
    }
  }

  void add_entry(Object& to, const eds::Object& object, std::uint8_t sub, const eds::Entry& from,
                 bool is_sub) {
    if (count_ == most_twin_entries) {
      remark(object, from.at, fmt::format("left out: more than {} entries", most_twin_entries));
      return;
    }
    ++count_;
    to.entries.emplace(sub, entries_.make(object, sub, from, is_sub));
  }

  /// What a list names and no section describes has neither type nor access.
  void compare_lists(const std::vector<eds::Object>& objects) {
    for (const auto* list :
         {&file_->mandatory_objects, &file_->optional_objects, &file_->manufacturer_objects}) {
      for (const auto& entry : list->entries) {
        const auto number = eds::number_of(entry.field);
        if (!number || *number > 0xFFFF) continue;
        const conform::Index index(static_cast<std::uint16_t>(*number));
        if (eds::find_object(objects, index) != nullptr) continue;
        twin_.remarks.add(entry.field.at,
                          conform::to_string(index) +
                              ": the object is listed, but no section describes it; it does not exist");
      }
    }
  }

  /// How long a DOMAIN can get is not in the file.
  void share_memory() {
    std::vector<Entry*> domains;
    for (auto& [index, object] : twin_.objects) {
      for (auto& [sub, entry] : object.entries) {
        if (entry.type == DataType::domain && entry.access != Access::ro && entry.access != Access::constant)
          domains.push_back(&entry);
      }
    }
    for (Entry* entry : domains)
      entry->max_size =
          std::max(entry->max_size, std::min(most_twin_domain, twin_domain_budget / domains.size()));
  }

  void remark(const eds::Object& object, eds::Position at, std::string_view text) {
    twin_.remarks.add(at, fmt::format("{}: {}", conform::to_string(object.index), text));
  }

  const eds::EdsFile* file_;
  Twin twin_;
  TwinEntryMaker entries_;
  std::size_t count_ = 0;
};

}  // namespace

conform::Result<Twin> make_twin(const eds::EdsFile& file, std::uint8_t node_id) {
  return TwinMaker(file, node_id).run();
}

std::optional<std::uint8_t> configured_node_id(const eds::EdsFile& file) {
  const auto number = eds::number_of(file.commissioning.node_id);
  if (!number || *number < 1 || *number > 127) return std::nullopt;
  return static_cast<std::uint8_t>(*number);
}

}  // namespace refnode
