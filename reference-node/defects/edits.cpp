// SPDX-License-Identifier: Apache-2.0
#include "defects/edits.hpp"

#include <algorithm>
#include <array>

#include "base/text.hpp"
#include "defects/tools.hpp"

namespace refnode {
namespace {

struct KindRow {
  EditKind kind;
  std::string_view word;
  std::string_view summary;
};
constexpr auto kinds = std::to_array<KindRow>({
    {EditKind::absent, "absent", "does not exist"},
    {EditKind::object_absent, "object-absent", "does not exist, nor does its object"},
    {EditKind::read_only, "read-only", "cannot be written"},
    {EditKind::writable, "writable", "can be written"},
    {EditKind::write_only, "write-only", "cannot be read"},
    {EditKind::readable, "readable", "can be read"},
    {EditKind::longer, "longer", "has a longer type"},
    {EditKind::shorter, "shorter", "has a shorter type"},
    {EditKind::other_default, "other-default", "has another default"},
    {EditKind::stuck, "stuck", "confirms writes and forgets them"},
    {EditKind::more_subs, "more-subs", "counts a sub-index too many"},
    {EditKind::fewer_subs, "fewer-subs", "counts a sub-index too few"},
});

const KindRow& row_of(EditKind kind) { return *std::ranges::find(kinds, kind, &KindRow::kind); }

/// The integer types by length, signed and unsigned.
constexpr std::array unsigned_types{DataType::unsigned8, DataType::unsigned16, DataType::unsigned32,
                                    DataType::unsigned64};
constexpr std::array signed_types{DataType::integer8, DataType::integer16, DataType::integer32,
                                  DataType::integer64};

/// The neighbour of a type, `step` places up or down; nullopt at the ends and for other types.
std::optional<DataType> neighbour(DataType type, int step) {
  for (const auto& row : {unsigned_types, signed_types}) {
    const auto found = std::ranges::find(row, type);
    if (found == row.end()) continue;
    const auto place = (found - row.begin()) + step;
    if (place < 0 || place >= std::ssize(row)) return std::nullopt;
    return row[static_cast<std::size_t>(place)];
  }
  return std::nullopt;
}

Bytes changed(const Entry& entry) {
  Bytes value = entry.default_value;
  // The last bit of the first byte: numbers stay near, text stays text.
  if (!value.empty()) value.front() ^= 0x01U;
  return value;
}

bool is_writable(const Entry& entry) { return entry.access == Access::rw || entry.access == Access::wo; }

bool counts_subs(const Object& object, std::uint8_t sub) {
  return sub == 0 && object.kind != ObjectKind::variable;
}

bool applies_to(EditKind kind, const Object& object, std::uint8_t sub, const Entry& entry) {
  const bool computed = entry.read != nullptr || entry.command;
  switch (kind) {
    case EditKind::absent: return true;
    case EditKind::object_absent: return counts_subs(object, sub);
    case EditKind::read_only: return is_writable(entry);
    case EditKind::writable: return !is_writable(entry);
    case EditKind::write_only: return entry.access != Access::wo;
    case EditKind::readable: return entry.access == Access::wo;
    case EditKind::longer: return neighbour(entry.type, 1).has_value();
    case EditKind::shorter: return neighbour(entry.type, -1).has_value();
    case EditKind::other_default:
      return !computed && !entry.default_value.empty() && !counts_subs(object, sub);
    case EditKind::stuck: return entry.access == Access::rw && !entry.command;
    case EditKind::more_subs: return counts_subs(object, sub) && !computed && entry.number() < 0xFE;
    case EditKind::fewer_subs: return counts_subs(object, sub) && !computed && entry.number() > 0;
  }
  return false;
}

}  // namespace

std::string Edit::id() const { return "edit:" + to_string(mux) + ":" + std::string(row_of(kind).word); }

std::string Edit::summary() const { return to_string(mux) + " " + std::string(row_of(kind).summary); }

DictionaryEdit Edit::how() const {
  using namespace defect;
  const auto index = mux.index.value();
  const auto sub = mux.sub.value();
  const auto on_entry = [index, sub](auto change) -> DictionaryEdit {
    return [index, sub, change](ObjectDictionary& dictionary, std::uint8_t) {
      if (auto* entry = dictionary.entry(index, sub)) change(*entry);
    };
  };
  const auto retype = [index, sub](int step) -> DictionaryEdit {
    return [index, sub, step](ObjectDictionary& dictionary, std::uint8_t node) {
      const auto* entry = dictionary.entry(index, sub);
      const auto other = entry == nullptr ? std::nullopt : neighbour(entry->type, step);
      if (other) defect::type(index, sub, *other)(dictionary, node);
    };
  };
  const auto recount = [&on_entry](int step) {
    return on_entry([step](Entry& entry) {
      entry.value = entry.default_value =
          Bytes{static_cast<std::uint8_t>(static_cast<int>(entry.number()) + step)};
    });
  };
  switch (kind) {
    case EditKind::absent:
      return [index, sub](ObjectDictionary& dictionary, std::uint8_t) {
        const auto found = dictionary.objects().find(index);
        if (found == dictionary.objects().end()) return;
        dictionary.remove_sub(index, sub);
        if (found->second.entries.empty()) dictionary.remove(index);
      };
    case EditKind::object_absent: return defect::absent(index);
    case EditKind::read_only: return access(index, sub, Access::ro);
    case EditKind::writable:
    case EditKind::readable: return access(index, sub, Access::rw);
    case EditKind::write_only: return access(index, sub, Access::wo);
    case EditKind::longer: return retype(1);
    case EditKind::shorter: return retype(-1);
    case EditKind::other_default:
      return on_entry([](Entry& entry) { entry.value = entry.default_value = changed(entry); });
    case EditKind::stuck: return not_stored(index, sub);
    case EditKind::more_subs: return recount(1);
    case EditKind::fewer_subs: return recount(-1);
  }
  return {};
}

std::vector<Edit> edits_of(const ObjectDictionary& dictionary) {
  std::vector<Edit> out;
  for (const auto& [index, object] : dictionary.objects()) {
    for (const auto& [sub, entry] : object.entries) {
      for (const auto& row : kinds) {
        if (applies_to(row.kind, object, sub, entry)) out.push_back({defect::mux(index, sub), row.kind});
      }
    }
  }
  return out;
}

std::optional<Edit> parse_edit(std::string_view id) {
  constexpr std::string_view front = "edit:";
  const auto colon = id.rfind(':');
  if (!id.starts_with(front) || colon < front.size()) return std::nullopt;
  const auto mux = conform::parse_multiplexer(id.substr(front.size(), colon - front.size()));
  const auto row = std::ranges::find(kinds, id.substr(colon + 1), &KindRow::word);
  if (!mux || row == kinds.end()) return std::nullopt;
  return Edit{*mux, row->kind};
}

bool applies(const Edit& edit, const ObjectDictionary& dictionary) {
  const auto object = dictionary.objects().find(edit.mux.index.value());
  const auto* entry = dictionary.entry(edit.mux.index.value(), edit.mux.sub.value());
  return entry != nullptr && applies_to(edit.kind, object->second, edit.mux.sub.value(), *entry);
}

}  // namespace refnode
